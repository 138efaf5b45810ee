//! What a body costs: time per evaluation and per step, and memory, of a chain of ball joints against its number of bodies.
//!
//! `cargo run --release -p lgvi-study --example bodies [BODIES ...]`: by default 1, 3, 10, 30, 100, 300 and 1000 bodies. The joints
//! are general and the matrices full. Times are the shortest of repeated runs; their ratios carry over between machines.

use std::hint::black_box;
use std::time::{Duration, Instant};

use articulated_fluid::{ArticulatedBody, Body, Configuration, Joint};
use dvi::{ContinuousSystem, Integrator, Lagrangian, State, Variational};
use lie::{LieGroup, Mat3, Power, R3, SO3, Tangent, Vec3};

/// Step size, s.
const H: f64 = 1e-3;
/// How long a time is measured at least.
const LONG: Duration = Duration::from_millis(400);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut counts = std::env::args()
        .skip(1)
        .map(|n| n.parse())
        .collect::<Result<Vec<usize>, _>>()?;
    if counts.is_empty() {
        counts = vec![1, 3, 10, 30, 100, 300, 1000];
    }
    println!(
        "{:>8} | {:>12} {:>9} | {:>12} {:>9} {:>10} | {:>12}",
        "bodies", "evaluation", "per body", "step", "per body", "iterations", "memory"
    );
    println!(
        "{:>8} | {:>12} {:>9} | {:>12} {:>9} {:>10} | {:>12}",
        "", "us", "ns", "us", "ns", "", "kB"
    );
    for n in counts {
        row(n)?;
    }
    Ok(())
}

/// A chain of ellipsoid-like bodies with full matrices, bent and moving.
fn chain(n: usize) -> Result<(ArticulatedBody, State<Configuration>), Box<dyn std::error::Error>> {
    let tilt = |k: usize| SO3::exp(&Tangent([0.3, -0.2, 0.1 + 0.01 * (k % 7) as f64]));
    let turned = |r: SO3, d: [f64; 3]| r.matrix().conjugate(Mat3::diagonal(d));
    let body = |k: usize| Body {
        mass: turned(tilt(k), [0.27, 0.66, 0.37]),
        inertia: turned(tilt(k + 3), [0.2, 1.8, 2.9]),
    };
    let joint = |child: usize| Joint {
        parent: child - 1,
        child,
        at_parent: Vec3([5.5, 0.1, -0.05]),
        at_child: Vec3([-5.5, 0.05, 0.1]),
    };
    let bodies: Vec<_> = (0..n).map(body).collect();
    let joints: Vec<_> = (1..n).map(joint).collect();
    let model = ArticulatedBody::new(&bodies, &joints)?;
    let wave = |k: usize| 0.1 * (0.7 * k as f64).sin();
    let attitude = |k| SO3::exp(&Tangent([0.0, wave(k), wave(k + 2)]));
    // Slow: the far end of a long chain whips, and the cost of a body is not to depend on that.
    let slow = |k| 0.1 * wave(k);
    let rate = |k| Tangent([slow(k), 2.0 * slow(k + 1), slow(k + 3)]);
    let g = (
        attitude(0),
        R3::identity(),
        (1..n).map(attitude).collect::<Power<_>>(),
    );
    let xi = (
        rate(0),
        Tangent([0.0; 3]),
        (1..n).map(rate).collect::<Power<_>>(),
    );
    let state = model.state(0.0, g, &xi)?;
    Ok((model, state))
}

fn row(n: usize) -> Result<(), Box<dyn std::error::Error>> {
    let (model, mut state) = chain(n)?;
    let evaluation = evaluation(&model, &state);
    let mut integrator = Variational::with_inertia(model);
    let mut iterations = 0;
    let memory = allocation_counter::measure(|| {
        if let Ok(report) = integrator.step(&mut state, H) {
            iterations = report.iterations;
        }
    });
    let step = shortest(|| {
        integrator
            .step(&mut state, H)
            .map(|report| iterations = report.iterations)
    })?;
    let (us, each) = (|t: f64| 1e6 * t, |t: f64| 1e9 * t / n as f64);
    println!(
        "{n:>8} | {:>12.3} {:>9.1} | {:>12.3} {:>9.1} {iterations:>10} | {:>12.1}",
        us(evaluation),
        each(evaluation),
        us(step),
        each(step),
        memory.bytes_current as f64 / 1e3,
    );
    Ok(())
}

/// Seconds of one evaluation of velocity and force.
fn evaluation(model: &ArticulatedBody, state: &State<Configuration>) -> f64 {
    let mut workspace = ContinuousSystem::workspace::<f64>(model, &state.g);
    let (mut xi, mut tau) = (state.g.zero_algebra(), state.g.zero_dual());
    let evaluated: Result<f64, core::convert::Infallible> = shortest(|| {
        let (g, mu) = black_box((&state.g, &state.mu));
        model.velocity_and_force::<f64>(0.0, g, mu, &mut workspace, &mut xi, &mut tau);
        black_box((&xi, &tau));
        Ok(())
    });
    match evaluated {
        Ok(seconds) => seconds,
    }
}

/// Seconds of one call, the shortest mean of batches.
fn shortest<E>(mut call: impl FnMut() -> Result<(), E>) -> Result<f64, E> {
    let (begin, mut best, mut batch) = (Instant::now(), f64::INFINITY, 1_u32);
    while begin.elapsed() < LONG {
        let start = Instant::now();
        for _ in 0..batch {
            call()?;
        }
        let took = start.elapsed();
        best = best.min(took.as_secs_f64() / f64::from(batch));
        if took < Duration::from_millis(5) {
            batch *= 2;
        }
    }
    Ok(best)
}
