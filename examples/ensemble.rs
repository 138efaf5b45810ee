//! A thousand starts at once: a trajectory in each SIMD lane, beside one trajectory after the other.
//!
//! `cargo run --release --example ensemble` prints trajectories a second.

use std::thread::available_parallelism;
use std::time::Instant;

use lgvi::articulated_fluid::Scene;
use lgvi::dvi::{
    Context, ContinuousSystem, Ensemble, Gauss, Integrator, Lagrangian, State, System,
};
use lgvi::lie::{LieGroup, SO3, Scalar, Tangent, VectorSpace};

const STARTS: usize = 1000;
const STEPS: usize = 100;
/// Of runs in turns, the fastest counts.
const RUNS: usize = 5;

/// A heavy top: moments of inertia 1, 1 and 1/2 kg m², weight times lever 1 N m.
#[derive(Clone)]
struct HeavyTop;

impl System for HeavyTop {
    type Group = SO3;
}

impl Lagrangian for HeavyTop {
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
        let [a, b, c] = omega.0;
        let kinetic = (a * a + b * b + (c * c).times(0.5)).times(0.5);
        kinetic - r.matrix().0[2][2]
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let top = HeavyTop.state(
        0.0,
        SO3::exp(&Tangent([0.3, 0.0, 0.0])),
        &Tangent([0.0, 0.0, 5.0]),
    )?;
    let fish = Scene::parse(include_str!("../scenes/fish-chain.toml"), "fish-chain.toml")?;
    println!("{STARTS} starts, {STEPS} steps each: trajectories a second");
    println!("                     one by one   one thread  (times)  all threads  (times)");
    for stages in [2, 4, 8] {
        compare("top", &HeavyTop.hamiltonian(), stages, &top, 0.1)?;
    }
    let (model, start) = (fish.model()?, fish.initial_state()?);
    for (stages, h) in [(2, 0.02), (4, 0.1), (8, 0.2)] {
        compare("fish", &model, stages, &start, h)?;
    }
    Ok(())
}

/// A line of the table.
fn compare<C: ContinuousSystem + Clone + Sync + 'static>(
    name: &str,
    system: &C,
    stages: usize,
    start: &State<C::Group>,
    h: f64,
) -> Result<(), Box<dyn std::error::Error>> {
    let starts = around(start);
    let gauss = || Gauss::with_stages(system.clone(), stages).ok_or("stages");
    let ensemble = || Ensemble::with_stages(system.clone(), stages).ok_or("stages");
    let threads = available_parallelism()?.get();
    let mut fastest = [f64::INFINITY; 3];
    let mut apart = 0.0_f64;
    for _ in 0..RUNS {
        let (mut alone, mut integrator, clock) = (starts.clone(), gauss()?, Instant::now());
        for state in &mut alone {
            integrator.reset();
            for _ in 0..STEPS {
                integrator.step(state, h)?;
            }
        }
        let mut times = [clock.elapsed().as_secs_f64(), 0.0, 0.0];
        for (time, threads) in times[1..].iter_mut().zip([1, threads]) {
            let (mut states, clock) = (starts.clone(), Instant::now());
            let mut ensemble = ensemble()?.with_threads(threads);
            for outcome in ensemble.advance(&mut states, h, STEPS) {
                outcome?;
            }
            *time = clock.elapsed().as_secs_f64();
            apart = states
                .iter()
                .zip(&alone)
                .map(|(a, b)| distance(a, b))
                .fold(apart, f64::max);
        }
        fastest = [0, 1, 2].map(|i| fastest[i].min(times[i]));
    }
    let [one, lanes, all] = fastest.map(|time| STARTS as f64 / time);
    println!(
        "{name:5} gauss-{stages} {h:4} s {one:12.0} {lanes:12.0} {:8.2} {all:12.0} {:8.2}   apart {apart:.1e}",
        lanes / one,
        all / one
    );
    Ok(())
}

/// Starts whose momenta differ by up to a tenth.
fn around<G: lgvi::lie::RealGroup>(start: &State<G>) -> Vec<State<G>> {
    let momentum = |i: usize| {
        let mut state = start.clone();
        for d in 0..state.mu.dim() {
            let turn = (i * (d + 1)) as f64;
            state.mu.set(d, start.mu.get(d) * (1.0 + 0.1 * turn.sin()));
        }
        state
    };
    (0..STARTS).map(momentum).collect()
}

/// Of the momenta, relative to the largest.
fn distance<G: lgvi::lie::RealGroup>(a: &State<G>, b: &State<G>) -> f64 {
    let mut apart = a.mu.clone();
    apart.add_scaled(-1.0, &b.mu);
    apart.max_magnitude() / b.mu.max_magnitude()
}
