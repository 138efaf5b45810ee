//! The paper's three ellipsoids, 100 s: the variational integrator beside an adaptive Runge–Kutta method.
//!
//! `cargo run --release --example fish_chain [SECONDS]` draws Fig. 2 of Lee, Leok & McClamroch (2009) to
//! `out/fish_chain.svg` and `out/fish_chain.png`.

use std::error::Error;
use std::fs;
use std::time::Instant;

use articulated_fluid::{ArticulatedBody, Configuration, Conserved, ModelError, Scene};
use dvi::{Integrator, State, Variational};
use figure::{Colour, Figure, Line, Panel, Scale, Style};
use lgvi::{articulated_fluid, dvi, lie};
use lie::Vec3;
use study::baseline::{self, Pair, Tolerance};
use study::raw;

/// The paper's step, s.
const STEP: f64 = 1e-3;
/// Steps between samples.
const EVERY: u32 = 100;
/// What general-purpose Runge–Kutta codes take unless told otherwise.
const TOLERANCE: Tolerance = Tolerance {
    relative: 1e-3,
    absolute: 1e-6,
};

fn main() -> Result<(), Box<dyn Error>> {
    let seconds = std::env::args()
        .nth(1)
        .map_or(Ok(100.0), |text| text.parse::<f64>())?;
    if !(0.1..=10_000.0).contains(&seconds) {
        return Err("expected between 0.1 and 10000 seconds".into());
    }
    let scene = Scene::parse(include_str!("../scenes/fish-chain.toml"), "fish-chain.toml")?;
    let (model, start) = (scene.model()?, scene.initial_state()?);

    let states = variational(&model, &start, seconds)?;
    let kept = Trajectory::new("LGVI, h = 1 ms", Colour::Vermillion, &model, &states)?;
    let states = runge_kutta(&model, &start, seconds)?;
    let lost = Trajectory::new(
        "RK 4(5), relative tolerance 1e-3",
        Colour::SkyBlue,
        &model,
        &states,
    )?;
    kept.report();
    lost.report();

    fs::create_dir_all("out")?;
    let drawn = figure(&lost, &kept).render()?;
    fs::write("out/fish_chain.svg", drawn.svg)?;
    fs::write("out/fish_chain.png", drawn.png)?;
    println!("drawn to out/fish_chain.svg and out/fish_chain.png");
    Ok(())
}

/// Hamilton's form of the variational integrator, (39)–(46), at a fixed step.
fn variational(
    model: &ArticulatedBody,
    start: &State<Configuration>,
    seconds: f64,
) -> Result<Vec<State<Configuration>>, Box<dyn Error>> {
    let clock = Instant::now();
    let (mut state, mut states) = (start.clone(), vec![start.clone()]);
    let mut integrator = Variational::with_inertia(model.clone());
    let samples = (seconds / (STEP * f64::from(EVERY))).round() as u32;
    for _ in 0..samples {
        for _ in 0..EVERY {
            integrator.step(&mut state, STEP)?;
        }
        states.push(state.clone());
    }
    println!(
        "LGVI: {} steps of {STEP} s in {:.3} s",
        samples * EVERY,
        clock.elapsed().as_secs_f64()
    );
    Ok(states)
}

/// Hamilton's equations (18)–(20) by Dormand–Prince 5(4) on the entries of the rotation matrices.
fn runge_kutta(
    model: &ArticulatedBody,
    start: &State<Configuration>,
    seconds: f64,
) -> Result<Vec<State<Configuration>>, Box<dyn Error>> {
    let clock = Instant::now();
    let (rhs, y) = (raw::right_hand_side(model, start), raw::pack(start));
    let every = STEP * f64::from(EVERY);
    let samples = baseline::integrate(Pair::DormandPrince54, rhs, &y, seconds, every, TOLERANCE)?;
    let seconds = clock.elapsed().as_secs_f64();
    println!(
        "RK 4(5): {} steps at relative tolerance {:e} in {seconds:.3} s",
        samples.accepted, TOLERANCE.relative
    );
    let states = samples
        .t
        .iter()
        .zip(&samples.y)
        .filter_map(|(t, y)| raw::unpack(*t, y));
    Ok(states.collect())
}

/// What is drawn of a method's states.
struct Trajectory {
    name: &'static str,
    colour: Colour,
    t: Vec<f64>,
    /// $\Omega_0, \dot x, \Omega_1, \Omega_2$ of each state.
    velocities: Vec<[Vec3; 4]>,
    conserved: Vec<Conserved>,
    orthogonality: Vec<f64>,
}

impl Trajectory {
    fn new(
        name: &'static str,
        colour: Colour,
        model: &ArticulatedBody,
        states: &[State<Configuration>],
    ) -> Result<Self, ModelError> {
        let velocities = |state| {
            let (omega0, dx, omega) = model.velocity(state)?;
            Ok([omega0.vec3(), dx.vec3(), omega[0].vec3(), omega[1].vec3()])
        };
        Ok(Self {
            name,
            colour,
            t: states.iter().map(|state| state.t).collect(),
            velocities: states.iter().map(velocities).collect::<Result<_, _>>()?,
            conserved: states
                .iter()
                .map(|s| model.conserved(s))
                .collect::<Result<_, _>>()?,
            orthogonality: states
                .iter()
                .map(|s| model.orthogonality_error(&s.g))
                .collect(),
        })
    }

    fn linear_change(&self, k: usize) -> f64 {
        (self.conserved[k].linear - self.conserved[0].linear).norm()
    }

    fn angular_change(&self, k: usize) -> f64 {
        (self.conserved[k].angular - self.conserved[0].angular).norm()
    }

    fn energy_error(&self, k: usize) -> f64 {
        (self.conserved[k].energy / self.conserved[0].energy - 1.0).abs()
    }

    fn report(&self) {
        let worst = |f: &dyn Fn(usize) -> f64| (0..self.t.len()).map(f).fold(0.0, f64::max);
        println!(
            "{:32} energy error {:.1e}, linear momentum {:.1e} kg m/s, angular {:.1e} kg m^2/s, orthogonality {:.1e}",
            self.name,
            worst(&|k| self.energy_error(k)),
            worst(&|k| self.linear_change(k)),
            worst(&|k| self.angular_change(k)),
            worst(&|k| self.orthogonality[k]),
        );
    }

    fn line(&self, value: impl Fn(usize) -> f64) -> Line {
        let points = self.t.iter().enumerate().map(|(k, t)| (*t, value(k)));
        Line {
            label: self.name.into(),
            colour: self.colour,
            style: Style::Solid,
            points: points.collect(),
            marker: None,
        }
    }
}

/// Panels (a)–(h): the velocities on the left, what should be kept on the right.
fn figure(lost: &Trajectory, kept: &Trajectory) -> Figure {
    let panel = |title: &str, y: &str, y_scale, lines: &dyn Fn(&Trajectory) -> Vec<Line>| Panel {
        title: title.into(),
        x_label: "t [s]".into(),
        y_label: y.into(),
        y_scale,
        lines: [lines(lost), lines(kept)].concat(),
        ..Panel::default()
    };
    let velocity = |title, y, which: usize| {
        panel(title, y, Scale::Linear, &|method| {
            let component = |i| method.line(|k| method.velocities[k][which][i]);
            [0, 1, 2].map(component).to_vec()
        })
    };
    let constant = |title, y, scale, value: &dyn Fn(&Trajectory, usize) -> f64| {
        panel(title, y, scale, &|method| {
            vec![method.line(|k| value(method, k))]
        })
    };
    let (linear, log) = (Scale::Linear, Scale::Log);
    Figure {
        title: "Three ellipsoids on ball joints in a perfect fluid".into(),
        columns: 2,
        panels: vec![
            velocity("(a) angular velocity of the head, Ω₀", "rad/s", 0),
            constant("(b) total energy", "J", linear, &|m, k| {
                m.conserved[k].energy
            }),
            velocity("(c) angular velocity of tail 1, Ω₁", "rad/s", 2),
            constant(
                "(d) change of the linear momentum",
                "kg m/s",
                log,
                &Trajectory::linear_change,
            ),
            velocity("(e) angular velocity of tail 2, Ω₂", "rad/s", 3),
            constant(
                "(f) change of the angular momentum",
                "kg m²/s",
                log,
                &Trajectory::angular_change,
            ),
            velocity("(g) velocity of the head", "m/s", 1),
            constant("(h) orthogonality, ‖I − RᵀR‖", "", log, &|m, k| {
                m.orthogonality[k]
            }),
        ],
        ..Figure::default()
    }
}
