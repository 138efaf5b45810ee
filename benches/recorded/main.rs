//! What a Lagrangian by its value alone costs: recorded, beside formulas by hand and beside dual numbers, in one run.
//!
//! `cargo bench --bench recorded`: the ratios are what carries over between machines.

use std::hint::black_box;
use std::time::Instant;

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::{
    ContinuousSystem, DualSystem, Gauss, Integrator, Lagrangian, Means, Quadrature, State,
    Variational,
};
use lgvi::{articulated_fluid, dvi, lie};
use lie::{RealGroup, VectorSpace};

#[path = "../../crates/dvi/tests/recorded/by_jets.rs"]
mod by_jets;
mod dumbbells;
mod pendulum;
mod top;
#[path = "../../tests/fish/value_only.rs"]
mod value_only;

use by_jets::ByJets;
use top::Top;
use value_only::ValueOnly;

/// What a step takes, microseconds, the best of some runs; and where the first steps lead to.
struct Timed<G: RealGroup> {
    step: f64,
    means: Means,
    after: State<G>,
}

fn time<I: Integrator>(
    mut integrator: I,
    start: &State<I::Group>,
    h: f64,
    steps: u32,
) -> Timed<I::Group> {
    const RUNS: u32 = 7;
    let mut timed = Timed {
        step: f64::INFINITY,
        means: Means::default(),
        after: start.clone(),
    };
    for _ in 0..RUNS {
        let mut state = start.clone();
        integrator.reset();
        // Not the recording, nor the search for a guess.
        for _ in 0..8 {
            let report = integrator.step(&mut state, h).expect("a step");
            timed.means = report.means;
        }
        timed.after = state.clone();
        let clock = Instant::now();
        for _ in 0..steps {
            integrator.step(black_box(&mut state), h).expect("a step");
        }
        let step = clock.elapsed().as_secs_f64() * 1e6 / f64::from(steps);
        timed.step = timed.step.min(step);
    }
    timed
}

fn print<G: RealGroup>(
    name: &str,
    by_hand: Option<&Timed<G>>,
    recorded: &Timed<G>,
    by_duals: Option<&Timed<G>>,
) {
    assert_eq!(recorded.means, Means::Recorded);
    // Eight steps, each solved to rounding.
    for other in [by_hand, by_duals].into_iter().flatten() {
        let apart = distance(&recorded.after, &other.after);
        assert!(apart < 1e-12, "{name}: {apart:e} apart after eight steps");
    }
    let step = |timed: Option<&Timed<G>>| timed.map_or(f64::NAN, |timed| timed.step);
    let (hand, duals, recorded) = (step(by_hand), step(by_duals), recorded.step);
    let [ratio, gain] = [recorded / hand, duals / recorded];
    println!("{name:28}{hand:10.2}{recorded:10.2}{duals:12.2}{ratio:12.2}{gain:12.1}");
}

/// Of configurations, and of momenta relative to the largest.
fn distance<G: RealGroup>(a: &State<G>, b: &State<G>) -> f64 {
    let turn = a.g.inverse().compose(&b.g).cayley_inverse();
    let mut momentum = a.mu.clone();
    momentum.add_scaled(-1.0, &b.mu);
    let apart = turn.map_or(f64::NAN, |c| c.max_magnitude());
    apart.max(momentum.max_magnitude() / b.mu.max_magnitude())
}

/// By hand, recorded, and over dual numbers.
fn gauss<const S: usize, L: Lagrangian + Clone + Sync + 'static>(
    name: &str,
    (by_hand, lagrangian): (impl ContinuousSystem<Group = L::Group> + 'static, &L),
    start: &State<L::Group>,
    (h, steps): (f64, u32),
) {
    let hand = time(Gauss::new::<S>(by_hand), start, h, steps);
    let recorded = time(
        Gauss::new::<S>(lagrangian.clone().hamiltonian()),
        start,
        h,
        steps,
    );
    let duals = time(Gauss::new::<S>(DualSystem(lagrangian.clone())), start, h, 8);
    print(name, Some(&hand), &recorded, Some(&duals));
}

/// Chains of bodies, without dual numbers where these would take minutes.
fn chain<const S: usize>(
    name: &str,
    (model, start): (&ArticulatedBody, &State<Configuration>),
    (h, steps): (f64, u32),
    with_duals: bool,
) {
    let hand = time(Gauss::new::<S>(model.clone()), start, h, steps);
    let recorded = time(
        Gauss::new::<S>(model.clone().hamiltonian()),
        start,
        h,
        steps,
    );
    let by_duals = || time(Gauss::new::<S>(DualSystem(model.clone())), start, h, 8);
    let duals = with_duals.then(by_duals);
    print(name, Some(&hand), &recorded, duals.as_ref());
}

fn scene(text: &str, name: &str) -> (ArticulatedBody, State<Configuration>) {
    let scene = Scene::parse(text, name).expect("the shipped scene parses");
    let model = scene.model().expect("the shipped scene is a model");
    (model, scene.initial_state().expect("the scene has a state"))
}

fn main() {
    println!("microseconds a step            by hand  recorded    by duals  rec./hand  duals/rec.");
    let top = top::start();
    let pair = (top::ByHand, &Top);
    gauss::<2, _>("top, gauss-4, h = 0.05", pair, &top, (0.05, 4000));
    gauss::<4, _>("top, gauss-8, h = 0.2", pair, &top, (0.2, 4000));
    let midpoint = || Top.discretise(Quadrature::Midpoint);
    let recorded = time(Variational::new(midpoint()), &top, 0.01, 4000);
    let duals = time(Variational::new(ByJets(midpoint())), &top, 0.01, 4000);
    print("top, midpoint, h = 0.01", None, &recorded, Some(&duals));

    let pair = (pendulum::ByHand, &pendulum::Pendulum);
    let start = pendulum::start();
    gauss::<4, _>("two pendulums, gauss-8, 0.05", pair, &start, (0.05, 4000));
    let pair = (dumbbells::ByHand, &dumbbells::Dumbbells);
    let start = dumbbells::start();
    gauss::<4, _>("dumbbells, gauss-8, h = 0.05", pair, &start, (0.05, 4000));

    let (model, start) = scene(
        include_str!("../../scenes/fish-chain.toml"),
        "fish-chain.toml",
    );
    let fish = (&model, &start);
    chain::<2>("fish, gauss-4, h = 0.05", fish, (0.05, 1000), true);
    chain::<4>("fish, gauss-8, h = 0.1", fish, (0.1, 1000), true);
    let h = 1e-3;
    let hand = time(Variational::new(model.clone()), &start, h, 4000);
    let recorded = time(Variational::new(ValueOnly(model.clone())), &start, h, 4000);
    let by_jets = Variational::new(ByJets(ValueOnly(model.clone())));
    let duals = time(by_jets, &start, h, 1000);
    print(
        "fish, lgvi, h = 0.001",
        Some(&hand),
        &recorded,
        Some(&duals),
    );
    let midpoint = || model.clone().discretise(Quadrature::Midpoint);
    let recorded = time(Variational::new(midpoint()), &start, h, 2000);
    let duals = time(Variational::new(ByJets(midpoint())), &start, h, 500);
    print("fish, midpoint, h = 0.001", None, &recorded, Some(&duals));

    let (model, start) = scene(include_str!("../../scenes/eel.toml"), "eel.toml");
    chain::<4>(
        "eel of 30, gauss-8, h = 0.01",
        (&model, &start),
        (0.01, 100),
        false,
    );
}
