//! The paper's three ellipsoids, 100 s: the variational integrator beside an adaptive Runge–Kutta method.
//!
//! `cargo run --release --example fish_chain [SECONDS]` draws Fig. 2 of Lee, Leok & McClamroch (2009) to
//! `out/fish_chain.svg` and `out/fish_chain.png`.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use articulated_fluid::{ArticulatedBody, Configuration, Conserved, Scene};
use dvi::{Integrator, Lagrangian, State, Variational};
use lgvi::{articulated_fluid, dvi, lie};
use lie::Vec3;
use study::baseline::{self, Pair, Tolerance};
use study::figure::{Colour, Figure, Line, Panel, Scale, Style};
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

    let variational = Trajectory::new(
        "LGVI, h = 1 ms",
        &model,
        variational(&model, &start, seconds)?,
    )?;
    let runge_kutta = Trajectory::new(
        "RK 4(5), relative tolerance 1e-3",
        &model,
        runge_kutta(&model, &start, seconds)?,
    )?;
    variational.report();
    runge_kutta.report();

    std::fs::create_dir_all("out")?;
    let saved = figure(&variational, &runge_kutta).save(Path::new("out/fish_chain"))?;
    println!(
        "drawn to {} and {}",
        saved.svg.display(),
        saved.png.display()
    );
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

/// A method's states with what is drawn of them.
struct Trajectory {
    name: &'static str,
    states: Vec<State<Configuration>>,
    /// $\Omega_0, \dot x, \Omega_1, \Omega_2$ of each state.
    velocities: Vec<[Vec3; 4]>,
    /// $\sum_i R_i M_i V_i$ from the velocities: the momentum $p_x$ itself is carried, and proves nothing.
    linear: Vec<Vec3>,
    conserved: Vec<Conserved>,
}

impl Trajectory {
    fn new(
        name: &'static str,
        model: &ArticulatedBody,
        states: Vec<State<Configuration>>,
    ) -> Result<Self, Box<dyn Error>> {
        let (mut velocities, mut linear, mut conserved) = (Vec::new(), Vec::new(), Vec::new());
        for state in &states {
            let xi = model.velocity(state)?;
            linear.push(model.legendre(&state.g, &xi).1.vec3());
            let (omega0, dx, omega) = xi;
            velocities.push([omega0.vec3(), dx.vec3(), omega[0].vec3(), omega[1].vec3()]);
            conserved.push(model.conserved(state)?);
        }
        Ok(Self {
            name,
            states,
            velocities,
            linear,
            conserved,
        })
    }

    /// The largest $\lVert I - R_i^T R_i \rVert$ of a state.
    fn orthogonality(state: &State<Configuration>) -> f64 {
        let tails = state.g.2.iter().map(|r| r.orthogonality_error());
        tails.fold(state.g.0.orthogonality_error(), f64::max)
    }

    fn report(&self) {
        let start = self.conserved[0];
        let worst =
            |f: &dyn Fn(&Conserved) -> f64| self.conserved.iter().map(f).fold(0.0, f64::max);
        println!(
            "{:32} energy error {:.1e}, linear momentum {:.1e} kg m/s, angular {:.1e} kg m^2/s, orthogonality {:.1e}",
            self.name,
            worst(&|c| (c.energy / start.energy - 1.0).abs()),
            self.linear
                .iter()
                .map(|p| (*p - start.linear).norm())
                .fold(0.0, f64::max),
            worst(&|c| (c.angular - start.angular).norm()),
            self.states
                .iter()
                .map(Self::orthogonality)
                .fold(0.0, f64::max),
        );
    }

    fn line(&self, value: impl Fn(usize) -> f64) -> Line {
        let colour = if self.name.starts_with("LGVI") {
            Colour::Vermillion
        } else {
            Colour::SkyBlue
        };
        let points = self
            .states
            .iter()
            .enumerate()
            .map(|(k, s)| (s.t, value(k)))
            .collect();
        Line {
            label: self.name.into(),
            colour,
            style: Style::Solid,
            points,
        }
    }
}

/// Panels (a)–(h): the velocities on the left, what should be kept on the right.
fn figure(variational: &Trajectory, runge_kutta: &Trajectory) -> Figure {
    let panel = |title: &str, y: &str, y_scale, lines: &dyn Fn(&Trajectory) -> Vec<Line>| Panel {
        title: title.into(),
        x_label: "t [s]".into(),
        y_label: y.into(),
        y_scale,
        lines: [lines(runge_kutta), lines(variational)].concat(),
    };
    let velocity = |title, y, which: usize| {
        let lines = |trajectory: &Trajectory| {
            let component = |i| trajectory.line(|k| trajectory.velocities[k][which][i]);
            [0, 1, 2].map(component).to_vec()
        };
        panel(title, y, Scale::Linear, &lines)
    };
    let kept = |title, y, scale, value: &dyn Fn(&Trajectory, usize) -> f64| {
        panel(title, y, scale, &|trajectory| {
            vec![trajectory.line(|k| value(trajectory, k))]
        })
    };
    Figure {
        title: "Three ellipsoids on ball joints in a perfect fluid".into(),
        columns: 2,
        panels: vec![
            velocity("(a) angular velocity of the head, Ω₀", "rad/s", 0),
            kept("(b) total energy", "J", Scale::Linear, &|t, k| {
                t.conserved[k].energy
            }),
            velocity("(c) angular velocity of tail 1, Ω₁", "rad/s", 2),
            kept(
                "(d) change of the linear momentum, from the velocities",
                "kg m/s",
                Scale::Log,
                &|t, k| (t.linear[k] - t.conserved[0].linear).norm(),
            ),
            velocity("(e) angular velocity of tail 2, Ω₂", "rad/s", 3),
            kept(
                "(f) change of the angular momentum",
                "kg m²/s",
                Scale::Log,
                &|t, k| (t.conserved[k].angular - t.conserved[0].angular).norm(),
            ),
            velocity("(g) velocity of the head", "m/s", 1),
            kept(
                "(h) orthogonality, ‖I − RᵀR‖",
                "1",
                Scale::Log,
                &|t, k| Trajectory::orthogonality(&t.states[k]),
            ),
        ],
    }
}
