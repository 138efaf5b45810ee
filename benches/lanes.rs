//! Time of one evaluation of the paper's scene on each instruction set of this processor.
//!
//! `cargo bench --bench lanes`: an evaluation on two, four or eight doubles is as many evaluations.
//!
//! What bounds it, by the assembly for AVX2: a block of stages, chart and evaluation together, is about 370 fused products, 330
//! products, 190 sums and 13 divisions as it stands in the code, and beside them 770 moves between registers and memory. Sixteen registers hold a
//! fifth of a body, so loads and stores are the limit and not the arithmetic, which alone would take less than half the time.

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use divan::{Bencher, black_box};
use dvi::{Context, ContinuousSystem, Gauss, Integrator, State};
use lgvi::{articulated_fluid, dvi, lie};
use lie::lanes::{self, InstructionSet, Job};
use lie::{AlgebraOver, Batch, DualOver, LieGroup, RealGroup, VectorSpace};

/// Evaluations in one measured call, so that the clock's own cost does not count.
const REPEATS: u32 = 1000;

fn main() {
    divan::main();
}

/// The fish chain, or one of so many bodies.
fn chain(bodies: usize) -> (ArticulatedBody, State<Configuration>) {
    let path = match bodies {
        3 => include_str!("../scenes/fish-chain.toml"),
        _ => include_str!("../scenes/eel.toml"),
    };
    let scene = Scene::parse(path, "scene.toml").expect("the shipped scene parses");
    let model = scene.model().expect("the shipped scene is a model");
    let state = scene.initial_state().expect("the scene has a state");
    (model, state)
}

struct Evaluate<'a, 'b> {
    model: &'a ArticulatedBody,
    state: &'a State<Configuration>,
    bencher: Bencher<'a, 'b>,
}

impl Job for Evaluate<'_, '_> {
    type Output = ();

    fn run<S: Batch<Item = f64>>(self) {
        let g: Configuration<S> = self.state.g.lift();
        let mut mu = g.zero_dual();
        for i in 0..mu.dim() {
            mu.set(i, S::splat(self.state.mu.get(i)));
        }
        let mut work = Default::default();
        let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
        self.bencher.bench_local(|| {
            for _ in 0..REPEATS {
                let (g, mu) = black_box((&g, &mu));
                evaluate::<S>(self.model, g, mu, &mut work, (&mut xi, &mut tau));
                black_box((&xi, &tau));
            }
        });
    }
}

#[inline(never)]
fn evaluate<S: Batch>(
    model: &ArticulatedBody,
    g: &Configuration<S>,
    mu: &DualOver<Configuration, S>,
    work: &mut <ArticulatedBody as ContinuousSystem>::Workspace<S>,
    (xi, tau): (
        &mut AlgebraOver<Configuration, S>,
        &mut DualOver<Configuration, S>,
    ),
) {
    S::run(
        #[inline(always)]
        || model.velocity_and_force::<S>(Context::new(S::zero(), &[]), g, mu, work, xi, tau),
    );
}

#[divan::bench(args = InstructionSet::available())]
fn fish_x1000(bencher: Bencher, set: InstructionSet) {
    evaluations(bencher, set, 3);
}

#[divan::bench(args = InstructionSet::available())]
fn eel_x1000(bencher: Bencher, set: InstructionSet) {
    evaluations(bencher, set, 30);
}

fn evaluations(bencher: Bencher, set: InstructionSet, bodies: usize) {
    let (model, state) = chain(bodies);
    let job = Evaluate {
        model: &model,
        state: &state,
        bencher,
    };
    lanes::run(set, job);
}

/// 40 steps of 0.25 s with eight stages, iterated to rounding: about 19 sweeps each.
#[divan::bench(args = InstructionSet::available())]
fn fish_gauss_8_x40(bencher: Bencher, set: InstructionSet) {
    let (model, state) = chain(3);
    bencher.bench_local(|| {
        let mut integrator = Gauss::new::<8>(model.clone()).with_instructions(set);
        let mut state = state.clone();
        for _ in 0..40 {
            integrator
                .step(&mut state, 0.25)
                .expect("the step is solved");
        }
        black_box(state)
    });
}
