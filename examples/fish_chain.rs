//! The paper's three ellipsoids, 100 s: the variational integrator beside an adaptive Runge–Kutta method.
//!
//! `cargo run --release --example fish_chain [SECONDS]` draws Fig. 2 of Lee, Leok & McClamroch (2009) to
//! `out/fish_chain.svg` and `out/fish_chain.png`.

use std::error::Error;
use std::fs;
use std::time::Instant;

use figure::{Colour, Figure, Line, Panel, Scale, Style};
use lgvi::articulated_fluid::Scene;
use lgvi::lie::Vec3;
use lgvi::sim::{Choice, Frame, Method, Plan, Schedule, Simulation, file};
use study::baseline::{Motion, Pair, Tolerance};

/// The paper's step, s.
const STEP: f64 = 1e-3;
/// Steps between samples.
const EVERY: u64 = 100;
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
    let kept = Trajectory {
        name: "LGVI, h = 1 ms",
        colour: Colour::Vermillion,
        frames: variational(&scene, seconds)?,
    };
    let lost = Trajectory {
        name: "RK 4(5), relative tolerance 1e-3",
        colour: Colour::SkyBlue,
        frames: runge_kutta(&scene, seconds, kept.frames.iter().map(Frame::t))?,
    };
    kept.report();
    lost.report();

    fs::create_dir_all("out")?;
    let drawn = figure(&lost, &kept).render()?;
    file::write("out/fish_chain.svg", drawn.svg)?;
    file::write("out/fish_chain.png", drawn.png)?;
    println!("drawn to out/fish_chain.svg and out/fish_chain.png");
    Ok(())
}

/// Hamilton's form of the variational integrator, (39)–(46), at a fixed step.
fn variational(scene: &Scene, seconds: f64) -> Result<Vec<Frame>, Box<dyn Error>> {
    let plan = Plan {
        choice: Choice::Method {
            method: Method::default(),
            step: Some(STEP),
        },
        until: seconds,
        schedule: Schedule::Steps(EVERY),
        ..Plan::default()
    };
    let mut simulation = Simulation::new(scene, &plan)?;
    let frames = simulation.by_ref().collect::<Result<_, _>>()?;
    let report = simulation.report();
    println!(
        "LGVI: {} steps of {} s in {:.3} s",
        report.steps,
        report.step_seconds,
        1e-6 * report.time_per_step_us * report.steps as f64
    );
    Ok(frames)
}

/// Hamilton's equations (18)–(20) by Dormand–Prince 5(4) on the entries of the rotation matrices.
fn runge_kutta(
    scene: &Scene,
    seconds: f64,
    times: impl Iterator<Item = f64>,
) -> Result<Vec<Frame>, Box<dyn Error>> {
    let (model, start) = (scene.model()?, scene.initial_state()?);
    let clock = Instant::now();
    let mut motion = Motion::new(&Pair::DP54, &model, &start, seconds, TOLERANCE)?;
    let mut frames = Vec::new();
    for t in times {
        frames.push(Frame::new(&model, motion.at(t)?.clone())?);
    }
    println!(
        "RK 4(5): {} steps at relative tolerance {:e} in {:.3} s",
        motion.work().accepted,
        TOLERANCE.relative,
        clock.elapsed().as_secs_f64()
    );
    Ok(frames)
}

/// What is drawn of a method.
struct Trajectory {
    name: &'static str,
    colour: Colour,
    frames: Vec<Frame>,
}

impl Trajectory {
    /// How far a momentum is from its start.
    fn change(&self, frame: &Frame, momentum: fn(&Frame) -> Vec3) -> f64 {
        (momentum(frame) - momentum(&self.frames[0])).norm()
    }

    fn linear_change(&self, frame: &Frame) -> f64 {
        self.change(frame, |frame| frame.sample.linear)
    }

    fn angular_change(&self, frame: &Frame) -> f64 {
        self.change(frame, |frame| frame.sample.angular)
    }

    fn energy_error(&self, frame: &Frame) -> f64 {
        (frame.sample.energy / self.frames[0].sample.energy - 1.0).abs()
    }

    fn report(&self) {
        let worst = |f: &dyn Fn(&Frame) -> f64| self.frames.iter().map(f).fold(0.0, f64::max);
        println!(
            "{:32} energy error {:.1e}, linear momentum {:.1e} kg m/s, angular {:.1e} kg m^2/s, orthogonality {:.1e}",
            self.name,
            worst(&|frame| self.energy_error(frame)),
            worst(&|frame| self.linear_change(frame)),
            worst(&|frame| self.angular_change(frame)),
            worst(&|frame| frame.sample.orthogonality),
        );
    }

    fn line(&self, value: impl Fn(&Frame) -> f64) -> Line {
        let points = self.frames.iter().map(|frame| (frame.t(), value(frame)));
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
    let velocity = |title, y, of: fn(&Frame) -> Vec3| {
        panel(title, y, Scale::Linear, &|method| {
            let component = |i| method.line(|frame| of(frame)[i]);
            [0, 1, 2].map(component).to_vec()
        })
    };
    let constant = |title, y, scale, value: &dyn Fn(&Trajectory, &Frame) -> f64| {
        panel(title, y, scale, &|method| {
            vec![method.line(|frame| value(method, frame))]
        })
    };
    let (linear, log) = (Scale::Linear, Scale::Log);
    Figure {
        title: "Three ellipsoids on ball joints in a perfect fluid".into(),
        columns: 2,
        panels: vec![
            velocity("(a) angular velocity of the head, Ω₀", "rad/s", |f| {
                f.velocity.0[0].vec3()
            }),
            constant("(b) total energy", "J", linear, &|_, f| f.sample.energy),
            velocity("(c) angular velocity of tail 1, Ω₁", "rad/s", |f| {
                f.velocity.0[1].vec3()
            }),
            constant(
                "(d) change of the linear momentum",
                "kg m/s",
                log,
                &Trajectory::linear_change,
            ),
            velocity("(e) angular velocity of tail 2, Ω₂", "rad/s", |f| {
                f.velocity.0[2].vec3()
            }),
            constant(
                "(f) change of the angular momentum",
                "kg m²/s",
                log,
                &Trajectory::angular_change,
            ),
            velocity("(g) velocity of the head", "m/s", |f| {
                f.velocity.1[0].vec3()
            }),
            constant("(h) orthogonality, ‖I − RᵀR‖", "", log, &|_, f| {
                f.sample.orthogonality
            }),
        ],
        ..Figure::default()
    }
}
