//! The test problems: exact solutions against an independent integration, their equations and conserved quantities.
//!
//! The figures are printed: `cargo test -p lgvi-study --test experiments problems -- --nocapture`.

mod free_rigid_body;
mod heavy_top;
mod kirchhoff;
mod pendulum;
mod reference;
mod welded;

use dvi::{Context, ContinuousSystem, Lagrangian, State};
use lie::{LieGroup, RealGroup, VectorSpace};
use study::baseline::{Tolerance, on_group};
use study::problems::{Problem, Solution};

/// Of the reference: its error over ten periods is then a few 1e-12, as that of the baseline on known motions.
const TIGHT: Tolerance = Tolerance::uniform(1e-14);

/// The larger of the distance of the configurations, by the logarithm, and of the momenta.
fn distance<G: RealGroup>(a: &State<G>, b: &State<G>) -> f64 {
    let c = a.g.inverse().compose(&b.g).log().expect("no half turn");
    let mut difference = a.mu.clone();
    difference.add_scaled(-1.0, &b.mu);
    c.max_magnitude().max(difference.max_magnitude())
}

/// What is measured of a problem, the largest over the samples.
#[derive(Debug)]
struct Measured {
    /// Distance to the reference.
    reference: f64,
    /// Change of the energy and the momentum maps.
    conserved: f64,
    /// Defect of Hamilton's equations.
    equations: f64,
}

/// Measures a problem over `periods` of its time; the sampling is incommensurable with the period.
fn measure<L, X>(problem: &Problem<L, X>, periods: f64) -> Measured
where
    L: Lagrangian,
    X: Solution<L::Group>,
{
    let times: Vec<f64> = (1..=50)
        .map(|k| 0.0197 * f64::from(k) * periods * problem.time)
        .collect();
    let system = (&problem.lagrangian).hamiltonian();
    let reference = on_group::sample(&system, &problem.start, &times, TIGHT).expect("a reference");
    let exact: Vec<_> = times
        .iter()
        .map(|&t| problem.exact.at(t).expect("a state"))
        .collect();
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let measured = Measured {
        reference: largest(&mut exact.iter().zip(&reference).map(|(a, b)| distance(a, b))),
        conserved: largest(&mut exact.iter().map(|state| drift(problem, state))),
        equations: largest(&mut times.iter().map(|&t| defect(problem, t))),
    };
    let start = problem.exact.at(problem.start.t).expect("a state");
    println!("{}: {measured:?}", problem.name);
    assert!(distance(&start, &problem.start) < 1e-14);
    measured
}

fn drift<L: Lagrangian, X>(problem: &Problem<L, X>, state: &State<L::Group>) -> f64 {
    let now = problem
        .momenta(state)
        .into_iter()
        .chain([problem.energy(state)]);
    let then = problem
        .momenta(&problem.start)
        .into_iter()
        .chain([problem.energy(&problem.start)]);
    now.zip(then)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// $\dot g - g \xi$ and $\dot\mu - \mathrm{ad}^\ast_\xi \mu - \tau$ by central differences of fourth order; the step leaves
/// 1e-12 of them and 1e-12 of rounding for a motion whose derivatives are of order one in the unit of its time.
fn defect<L, X>(problem: &Problem<L, X>, t: f64) -> f64
where
    L: Lagrangian,
    X: Solution<L::Group>,
{
    let h = 2e-4 * problem.time;
    let here = problem.exact.at(t).expect("a state");
    let (mut xi, mut tau) = (here.g.zero_algebra(), here.g.zero_dual());
    let system = (&problem.lagrangian).hamiltonian();
    let (at, mut work) = (Context::new(t, &[]), Default::default());
    system.velocity_and_force::<f64>(at, &here.g, &here.mu, &mut work, &mut xi, &mut tau);
    tau.add_scaled(1.0, &L::Group::coadjoint_bracket(&xi, &here.mu));
    for (offset, weight) in [(1.0, 8.0), (-1.0, -8.0), (2.0, -1.0), (-2.0, 1.0)] {
        let there = problem.exact.at(t + offset * h).expect("a state");
        let c = here
            .g
            .inverse()
            .compose(&there.g)
            .log()
            .expect("a short way");
        xi.add_scaled(-weight / (12.0 * h), &c);
        tau.add_scaled(-weight / (12.0 * h), &there.mu);
    }
    xi.max_magnitude().max(tau.max_magnitude())
}
