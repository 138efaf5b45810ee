//! How rounding makes the energy wander: the rms over many trajectories whose truncation error is below rounding.
//!
//! `cargo run --release -p lgvi-study --example round_off -- [TRAJECTORIES] [STEPS]`, by default 32 and 1e6.
//!
//! A random walk grows as the square root of the number of steps (Brouwer's law); a bias, in proportion to it.

use dvi::{Context, ContinuousSystem, Gauss, Integrator, State, System};
use lie::{Cotangent, LieGroup, Mat3, SO3, Scalar, Tangent, Vec3};
use study::survey::slope;

/// Step size, s: at it the energy band of six stages is below rounding.
const H: f64 = 0.05;
/// Samples a decade.
const PER_DECADE: u32 = 4;
/// Moments of inertia, kg m², and weight times the mass centre, N m, of a rigid body on a fixed point.
const INERTIA: [f64; 3] = [1.0, 2.0, 2.5];
const LEVER: Vec3 = Vec3([0.1, 0.2, 0.7]);

struct Body;

impl System for Body {
    type Group = SO3;
}

impl ContinuousSystem for Body {
    type Workspace<S: Scalar> = ();

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _: Context<S>,
        r: &SO3<S>,
        mu: &Cotangent<3, S>,
        _: &mut (),
        omega: &mut Tangent<3, S>,
        tau: &mut Cotangent<3, S>,
    ) {
        for (i, omega) in omega.0.iter_mut().enumerate() {
            *omega = mu[i] * S::from_f64(1.0 / INERTIA[i]);
        }
        *tau = r.matrix().row(2).cross(LEVER.lift()).into();
    }
}

fn energy(state: &State<SO3>) -> f64 {
    let inverse = Mat3::diagonal(INERTIA.map(|j| 1.0 / j));
    let mu = state.mu.vec3();
    0.5 * mu.dot(inverse * mu) + state.g.rotate(LEVER)[2]
}

/// Starts spread over attitudes and momenta by irrational turns.
fn start(k: u32) -> State<SO3> {
    let turn = |a: f64| ((f64::from(k) + 0.5) * a).fract() * 2.0 - 1.0;
    let roots = [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0].map(|x| turn(x.sqrt()));
    let [a, b, c, d, e, f] = roots;
    State {
        t: 0.0,
        g: SO3::exp(&Tangent([2.0 * a, 2.0 * b, 1.5 * c])),
        mu: Cotangent([1.0 + d, 1.5 * e, 2.0 + f]),
    }
}

/// Step counts at which the energy is looked at.
fn samples(steps: u64) -> Vec<u64> {
    let at = |k: u32| 10_f64.powf(f64::from(k) / f64::from(PER_DECADE)).round() as u64;
    (0..).map(at).take_while(|n| *n <= steps).collect()
}

fn trajectory(k: u32, samples: &[u64]) -> Vec<f64> {
    let (mut state, mut integrator) = (start(k), Gauss::new::<6>(Body));
    let initial = energy(&state);
    // Relative to the kinetic and potential parts, since the energy itself may be near zero.
    let size = initial.abs() + LEVER.norm();
    let mut taken = 0;
    let mut look = |n: &u64| {
        while taken < *n {
            if let Err(error) = integrator.step(&mut state, H) {
                eprintln!("trajectory {k}: {error}");
                return f64::NAN;
            }
            taken += 1;
        }
        (energy(&state) - initial) / size
    };
    samples.iter().map(&mut look).collect()
}

fn main() {
    let mut arguments = std::env::args().skip(1).map(|x| x.parse::<f64>());
    let mut next = |default: f64| arguments.next().and_then(Result::ok).unwrap_or(default);
    let (count, steps) = (next(32.0) as u32, next(1e6) as u64);
    let samples = &samples(steps);
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u32);
    let errors: Vec<Vec<f64>> = std::thread::scope(|scope| {
        let share = |thread| {
            move || {
                (thread..count)
                    .step_by(threads as usize)
                    .map(|k| trajectory(k, samples))
                    .collect::<Vec<_>>()
            }
        };
        let running: Vec<_> = (0..threads)
            .map(|thread| scope.spawn(share(thread)))
            .collect();
        running
            .into_iter()
            .flat_map(|thread| thread.join().unwrap_or_default())
            .collect()
    });
    let n = errors.len() as f64;
    println!("{:>10} {:>10} {:>10}", "steps", "rms", "mean");
    let mut line = Vec::new();
    for (i, steps) in samples.iter().enumerate() {
        let column = errors.iter().map(|run| run[i]);
        let rms = (column.clone().map(|e| e * e).sum::<f64>() / n).sqrt();
        let mean = column.sum::<f64>() / n;
        println!("{steps:>10} {rms:>10.2e} {mean:>10.1e}");
        if *steps >= 1000 {
            line.push(((*steps as f64).ln(), rms.ln()));
        }
    }
    let slope = slope(&line);
    let constant_log = line.iter().map(|(x, y)| y - 0.5 * x).sum::<f64>() / line.len() as f64;
    let constant = constant_log.exp() / f64::EPSILON;
    println!("from 1000 steps on: exponent {slope:.3}; rms = {constant:.2} eps sqrt(steps)");
}
