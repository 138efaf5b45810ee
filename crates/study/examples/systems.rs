//! Four systems by every rule, and methods that are wrong on purpose: order, energy, momentum maps, symplecticity.
//!
//! `cargo run --release -p lgvi-study --example systems [TIMES]` prints the tables and draws `out/systems.svg` and
//! `out/systems.png`; the long runs take TIMES, 1000 unless given, periods or characteristic times of the system.

#[path = "systems/picture.rs"]
mod picture;
#[path = "systems/table.rs"]
mod table;

use std::error::Error;
use std::fs;
use std::thread;

use dvi::{Lagrangian, Quadrature};
use lie::{Cayley, Exp};
use study::problems::Problem;
use study::survey::{LongRun, Method, SurveyError, composition, gauss, systems, variational};

/// A method by name.
struct Row<L: Lagrangian> {
    name: &'static str,
    make: fn(L) -> Method<L::Group>,
}

/// Every rule through both retractions, then the methods of higher order.
fn rows<L: Lagrangian + Clone + 'static>() -> [Row<L>; 11] {
    let row = |name, make| Row { name, make };
    [
        row("left, Cayley", |l| {
            variational::<L, Cayley>(l, Quadrature::LeftPoint)
        }),
        row("left, exp", |l| {
            variational::<L, Exp>(l, Quadrature::LeftPoint)
        }),
        row("right, Cayley", |l| {
            variational::<L, Cayley>(l, Quadrature::RightPoint)
        }),
        row("right, exp", |l| {
            variational::<L, Exp>(l, Quadrature::RightPoint)
        }),
        row("midpoint, Cayley", |l| {
            variational::<L, Cayley>(l, Quadrature::Midpoint)
        }),
        row("midpoint, exp", |l| {
            variational::<L, Exp>(l, Quadrature::Midpoint)
        }),
        row("trapezoidal, Cayley", |l| {
            variational::<L, Cayley>(l, Quadrature::Trapezoid)
        }),
        row("trapezoidal, exp", |l| {
            variational::<L, Exp>(l, Quadrature::Trapezoid)
        }),
        row("composition 4", composition::<L, 4>),
        row("Gauss, 2 stages", gauss::<L, 2>),
        row("Gauss, 4 stages", gauss::<L, 4>),
    ]
}

/// The methods of the picture, by their place among the rows.
const DRAWN: [usize; 3] = [0, 4, 10];

/// How a system is measured.
#[derive(Clone, Copy)]
struct Plan {
    /// Steps in one time of the problem over the long run.
    steps: u32,
    /// The length of the long run in times of the problem.
    times: u32,
    /// Steps in one time that show order 8: few enough for errors above rounding, the method's or the reference's.
    high: [u32; 4],
}

impl Plan {
    fn h<L: Lagrangian, X>(&self, problem: &Problem<L, X>) -> f64 {
        problem.time / f64::from(self.steps)
    }
}

const PLAN: Plan = Plan {
    steps: 50,
    times: 1000,
    high: [56, 64, 72, 80],
};

/// What the table of a system says, and the long runs of the [`DRAWN`] methods.
type Surveyed = Result<(String, Vec<LongRun>), SurveyError>;

fn main() -> Result<(), Box<dyn Error>> {
    let times = std::env::args().nth(1).map(|text| text.parse::<u32>());
    let plan = Plan {
        times: times.transpose()?.unwrap_or(PLAN.times).max(1),
        ..PLAN
    };
    let (body, top) = (systems::free_rigid_body()?, systems::heavy_top()?);
    let (pendulum, flutter) = (systems::pendulum()?, systems::flutter()?);
    let surveyed: Vec<Surveyed> = thread::scope(|scope| {
        let running = [
            scope.spawn(|| {
                table::survey(
                    &body,
                    Plan {
                        high: [80, 90, 100, 110],
                        ..plan
                    },
                )
            }),
            scope.spawn(|| {
                table::survey(
                    &top,
                    Plan {
                        high: [64, 72, 80, 88],
                        ..plan
                    },
                )
            }),
            scope.spawn(|| table::survey(&pendulum, plan)),
            scope.spawn(|| {
                table::survey(
                    &flutter,
                    Plan {
                        high: [28, 32, 36, 40],
                        ..plan
                    },
                )
            }),
        ];
        let joined = running.map(thread::ScopedJoinHandle::join);
        joined.into_iter().flatten().collect()
    });
    let mut runs = Vec::new();
    for one in surveyed {
        let (text, drawn) = one?;
        println!("{text}");
        runs.push(drawn);
    }
    println!(
        "The Lagrangians of the free body and of the ellipsoid do not depend on the configuration: there the rules are one\n\
         method for each retraction, symmetric and of order 2.\n"
    );
    println!("{}", table::steady()?);
    println!("{}", table::wrong(&top, plan)?);
    fs::create_dir_all("out")?;
    let drawn = picture::figure(&runs)?.render()?;
    sim::file::write("out/systems.svg", drawn.svg)?;
    sim::file::write("out/systems.png", drawn.png)?;
    println!("drawn to out/systems.svg and out/systems.png");
    Ok(())
}
