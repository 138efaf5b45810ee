//! Time of one step of the paper's scene beside one evaluation of its continuous model.
//!
//! `cargo bench --bench step`: the ratio of the two medians is what carries over between machines.

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use divan::{Bencher, black_box};
use dvi::{Context, ContinuousSystem, Gauss, Integrator, State, Variational};
use lgvi::{articulated_fluid, dvi, lie};
use lie::LieGroup;

#[path = "../crates/articulated-fluid/tests/model/by_duals.rs"]
mod by_duals;
#[path = "../tests/fish/value_only.rs"]
mod value_only;

use by_duals::ByDuals;
use value_only::ValueOnly;

const H: f64 = 1e-3;
/// Steps or evaluations in one measured call, so that the clock's own cost does not count.
const BATCH: u32 = 1000;

fn main() {
    divan::main();
}

fn paper() -> (ArticulatedBody, State<Configuration>) {
    let scene = Scene::parse(include_str!("../scenes/fish-chain.toml"), "fish-chain.toml");
    let scene = scene.expect("the shipped scene parses");
    let model = scene.model().expect("the shipped scene is a model");
    (
        model,
        scene
            .initial_state()
            .expect("the shipped scene has a state"),
    )
}

/// 1000 evaluations of velocity and force, (10)–(13).
#[divan::bench]
fn evaluation_x1000(bencher: Bencher) {
    let (model, state) = paper();
    let (at, mut work) = (Context::new(0.0, &[]), Default::default());
    let (mut xi, mut tau) = (state.g.zero_algebra(), state.g.zero_dual());
    bencher.bench_local(|| {
        for _ in 0..BATCH {
            let (g, mu) = black_box((&state.g, &state.mu));
            model.velocity_and_force::<f64>(at, g, mu, &mut work, &mut xi, &mut tau);
            black_box((&xi, &tau));
        }
    });
}

/// 1000 steps with the model's inertia as the quasi-Newton matrix.
#[divan::bench]
fn step_x1000(bencher: Bencher) {
    let (model, mut state) = paper();
    let mut integrator = Variational::new(model);
    bencher.bench_local(|| {
        for _ in 0..BATCH {
            integrator
                .step(black_box(&mut state), H)
                .expect("the paper's step is solved");
        }
    });
}

/// 1000 steps from the value alone: derivatives and Newton matrix from dual numbers.
#[divan::bench]
fn step_value_only_x1000(bencher: Bencher) {
    let (model, mut state) = paper();
    let mut integrator = Variational::new(ValueOnly(model));
    bencher.bench_local(|| {
        for _ in 0..BATCH {
            integrator
                .step(black_box(&mut state), H)
                .expect("the paper's step is solved");
        }
    });
}

/// 1000 steps of 0.1 s of order 8: a hundred times as long.
#[divan::bench(sample_count = 20)]
fn step_gauss_4_x1000(bencher: Bencher) {
    let (model, mut state) = paper();
    let mut integrator = Gauss::new::<4>(model);
    bencher.bench_local(|| {
        for _ in 0..BATCH {
            integrator
                .step(black_box(&mut state), 100.0 * H)
                .expect("the paper's step is solved");
        }
    });
}

/// 1000 steps of the same with the Newton matrix from dual numbers.
#[divan::bench]
fn step_by_duals_x1000(bencher: Bencher) {
    let (model, mut state) = paper();
    let mut integrator = Variational::new(ByDuals(model));
    bencher.bench_local(|| {
        for _ in 0..BATCH {
            integrator
                .step(black_box(&mut state), H)
                .expect("the paper's step is solved");
        }
    });
}
