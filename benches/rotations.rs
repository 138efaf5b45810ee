//! What keeping rotations orthogonal costs: one product beside one Newton step of the polar decomposition.
//!
//! `cargo bench --bench rotations`.

use divan::{Bencher, black_box};
use lgvi::lie::{LieGroup, SO3, Tangent};

/// Operations in one measured call, each on the result of the one before.
const BATCH: u32 = 1000;

fn main() {
    divan::main();
}

fn start() -> (SO3, SO3) {
    (
        SO3::identity(),
        SO3::cayley(&Tangent([1.1e-3, -2.3e-3, 3.7e-3])),
    )
}

#[divan::bench]
fn compose_x1000(bencher: Bencher) {
    let (mut r, step) = start();
    bencher.bench_local(|| {
        for _ in 0..BATCH {
            r = black_box(r).compose(black_box(&step));
        }
    });
}

#[divan::bench]
fn normalize_x1000(bencher: Bencher) {
    let (mut r, _) = start();
    bencher.bench_local(|| {
        for _ in 0..BATCH {
            black_box(&mut r).normalize();
        }
    });
}
