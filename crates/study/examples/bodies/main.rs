//! What a body costs: time per evaluation and per step of several methods, and memory, of a chain of ball joints against its number of bodies.
//!
//! `cargo run --release -p lgvi-study --example bodies [hinge | loads] [BODIES ...]`: by default 1, 3, 10, 30, 100, 300 and 1000 bodies. The joints
//! are general and the matrices full; the forced chain has a brake on every joint. With `hinge`: chains of other joints beside it, in
//! nanoseconds per body; NaN where a step is refused. With `loads`: the chain without and with each load on every body or joint. Times are the shortest of repeated runs; their ratios carry over between machines.

mod loads;

use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

use articulated_fluid::motion::Sinusoid;
use articulated_fluid::{ArticulatedBody, Body, Configuration, Joint, JointKind, Motion};
use dvi::{
    Composition, Context, ContinuousSystem, Discretised, Force, Forced, Gauss, Integrator,
    Lagrangian, Quadrature, State, StepError, Variational,
};
use lie::{AlgebraOver, DualOver, LieGroup, Mat3, SO3, Scalar, Tangent, Vec3};

/// Step size, s.
const H: f64 = 1e-3;
/// How long a time is measured at least.
const LONG: Duration = Duration::from_millis(400);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let what = words.first().filter(|word| word.parse::<usize>().is_err());
    let what = what.cloned();
    words.drain(..usize::from(what.is_some()));
    let counts = words.iter().map(|n| n.parse());
    let mut counts = counts.collect::<Result<Vec<usize>, _>>()?;
    if counts.is_empty() {
        counts = vec![1, 3, 10, 30, 100, 300, 1000];
    }
    match what.as_deref() {
        Some("hinge") => return by_joints(&counts),
        Some("loads") => return counts.into_iter().try_for_each(loads::by_loads),
        Some(word) => return Err(format!("{word:?} is neither a number, hinge nor loads").into()),
        None => {}
    }
    println!(
        "{:>6} | {:>11} {:>8} | {:>11} {:>8} {:>10} | {:>11} {:>13} | {:>9}",
        "bodies",
        "evaluation",
        "per body",
        "lgvi",
        "per body",
        "iterations",
        "forced",
        "composition-4",
        "memory"
    );
    println!(
        "{:>6} | {:>11} {:>8} | {:>11} {:>8} {:>10} | {:>11} {:>13} | {:>9}",
        "", "us", "ns", "us", "ns", "", "us", "us", "kB"
    );
    for n in counts {
        row(n)?;
    }
    Ok(())
}

/// Where a chain starts.
type Start = State<Configuration>;

/// A name, and the joint of body number k.
type Kind = (&'static str, fn(usize) -> JointKind);

/// A row for each number of bodies, of chains of several joints: an evaluation and a step, per body.
fn by_joints(counts: &[usize]) -> Result<(), Box<dyn std::error::Error>> {
    let kinds: [Kind; 4] = [
        ("balls", |_| JointKind::Ball),
        ("hinges", hinge),
        ("prescribed", prescribed),
        ("mixed", |k| match k % 4 {
            0 => JointKind::Ball,
            1 => hinge(k),
            2 => prescribed(k),
            _ => JointKind::fixed(SO3::identity()),
        }),
    ];
    let title = |(name, _): &Kind| format!("{name:>12} {:>8} {:>8}", "lgvi", "gauss-4");
    println!(
        "bodies | {}",
        kinds.iter().map(title).collect::<Vec<_>>().join(" | ")
    );
    for n in counts {
        let mut row = format!("{n:>6}");
        for (_, kind) in &kinds {
            let (model, start) = chain(*n, kind)?;
            let evaluation = evaluation(&model, &start);
            let lgvi = step(Variational::new(model.clone()), &start).unwrap_or(f64::NAN);
            let gauss = step(Gauss::new::<4>(model), &start).unwrap_or(f64::NAN);
            let [evaluation, lgvi, gauss] = [evaluation, lgvi, gauss].map(|t| 1e9 * t / *n as f64);
            row += &format!(" | {evaluation:>12.1} {lgvi:>8.1} {gauss:>8.1}");
        }
        println!("{row}");
    }
    Ok(())
}

fn hinge(k: usize) -> JointKind {
    let rest = SO3::exp(&Tangent([0.1, 0.05 * (k % 3) as f64, -0.1]));
    JointKind::hinge(Vec3([0.2, 0.1 * (k % 5) as f64, 1.0]), rest)
}

fn prescribed(k: usize) -> JointKind {
    let turn = Sinusoid {
        amplitude: [0.0, 0.01, 0.02],
        frequency: 1.0,
        phase: [0.7 * k as f64; 3],
        ..Sinusoid::constant([0.0; 3])
    };
    let (rest, turn) = (SO3::identity(), Arc::new(turn));
    JointKind::Prescribed(Motion::Ball { rest, turn })
}

/// A chain of ellipsoid-like bodies with full matrices, bent and moving.
fn chain(
    n: usize,
    kind: impl Fn(usize) -> JointKind,
) -> Result<(ArticulatedBody, Start), Box<dyn std::error::Error>> {
    let tilt = |k: usize| SO3::exp(&Tangent([0.3, -0.2, 0.1 + 0.01 * (k % 7) as f64]));
    let turned = |r: SO3, d: [f64; 3]| r.matrix().conjugate(Mat3::diagonal(d));
    let body = |k: usize| {
        Body::new(
            turned(tilt(k), [0.27, 0.66, 0.37]),
            turned(tilt(k + 3), [0.2, 1.8, 2.9]),
        )
    };
    let joint = |child: usize| Joint {
        parent: child - 1,
        child,
        at_parent: Vec3([5.5, 0.1, -0.05]),
        at_child: Vec3([-5.5, 0.05, 0.1]),
        kind: kind(child),
    };
    let bodies: Vec<_> = (0..n).map(body).collect();
    let joints: Vec<_> = (1..n).map(joint).collect();
    let model = ArticulatedBody::new(&bodies, &joints)?;
    let wave = |k: usize| 0.1 * (0.7 * k as f64).sin();
    let attitude = |k| SO3::exp(&Tangent([0.0, wave(k), wave(k + 2)]));
    // Slow: the far end of a long chain whips, and the cost of a body is not to depend on that.
    let slow = |k| 0.1 * wave(k) * (30.0 / n as f64).min(1.0);
    let rate = |k| Tangent([slow(k), 2.0 * slow(k + 1), slow(k + 3)]);
    let mut g = model.aligned();
    let mut xi = g.zero_algebra();
    for (k, (r, omega)) in g.0.iter_mut().zip(xi.0.iter_mut()).enumerate() {
        (*r, *omega) = (attitude(k), rate(k));
    }
    for (k, (q, dq)) in g.2.iter_mut().zip(xi.2.iter_mut()).enumerate() {
        // What the far end does is the sum of all before it.
        (q.0[0], dq[0]) = (wave(k), slow(k) / n as f64);
    }
    let state = model.state(0.0, g, &xi)?;
    Ok((model, state))
}

/// A brake of 0.1 N m s on every joint of a chain.
struct Brake;

impl Force for Brake {
    type Group = Configuration;
    const INLINE: bool = true;

    #[inline(always)]
    fn force<S: Scalar>(
        &self,
        _: Context<S>,
        (r, ..): &Configuration<S>,
        (omega, ..): &AlgebraOver<Configuration, S>,
        (torques, ..): &mut DualOver<Configuration, S>,
    ) {
        let rate = |i: usize| r[i].rotate(omega[i].vec3());
        for i in 1..r.len() {
            let torque = (rate(i) - rate(i - 1)) * S::from_f64(0.1);
            torques[i] = (torques[i].vec3() - r[i].inverse_rotate(torque)).into();
            let on_parent = r[i - 1].inverse_rotate(torque);
            torques[i - 1] = (torques[i - 1].vec3() + on_parent).into();
        }
    }
}

fn row(n: usize) -> Result<(), Box<dyn std::error::Error>> {
    let (model, start) = chain(n, |_| JointKind::Ball)?;
    let evaluation = evaluation(&model, &start);
    let mut integrator = Variational::new(model.clone());
    let mut state = start.clone();
    let mut iterations = 0;
    let memory = allocation_counter::measure(|| {
        if let Ok(report) = integrator.step(&mut state, H) {
            iterations = report.iterations;
        }
    });
    let step = step(integrator, &start)?;
    let brake = Discretised::new(Brake, Quadrature::LeftPoint);
    let forced = self::step(Variational::new(Forced::new(model.clone(), brake)), &start)?;
    let composition = self::step(Composition::new::<4>(model), &start)?;
    let (us, each) = (|t: f64| 1e6 * t, |t: f64| 1e9 * t / n as f64);
    println!(
        "{n:>6} | {:>11.3} {:>8.1} | {:>11.3} {:>8.1} {iterations:>10} | {:>11.3} {:>13.3} | {:>9.1}",
        us(evaluation),
        each(evaluation),
        us(step),
        each(step),
        us(forced),
        us(composition),
        memory.bytes_current as f64 / 1e3,
    );
    Ok(())
}

/// Seconds of one step.
fn step(
    mut integrator: impl Integrator<Group = Configuration>,
    start: &Start,
) -> Result<f64, StepError> {
    let mut state = start.clone();
    shortest(|| integrator.step(&mut state, H).map(|_| ()))
}

/// Seconds of one evaluation of velocity and force.
fn evaluation(model: &ArticulatedBody, state: &Start) -> f64 {
    let (mut times, mut workspace) = ([0.0, H].into_iter().cycle(), Default::default());
    let (mut xi, mut tau) = (state.g.zero_algebra(), state.g.zero_dual());
    let evaluated: Result<f64, core::convert::Infallible> = shortest(|| {
        let (g, mu) = black_box((&state.g, &state.mu));
        // What moves as told is read once for each time.
        let at = Context::new(times.next().unwrap_or(0.0), &[]);
        model.velocity_and_force::<f64>(at, g, mu, &mut workspace, &mut xi, &mut tau);
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
