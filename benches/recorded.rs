//! What a Lagrangian by its value alone costs: recorded, beside formulas by hand and beside dual numbers, in one run.
//!
//! `cargo bench --bench recorded`: the ratios are what carries over between machines.

use std::hint::black_box;
use std::time::Instant;

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::{
    Context, ContinuousSystem, Derivatives, DiscreteLagrangian, DualSystem, Gauss, Integrator,
    Lagrangian, Means, Quadrature, State, System, Variational,
};
use lgvi::{articulated_fluid, dvi, lie};
use lie::{Cotangent, LieGroup, Over, SO3, Scalar, Tangent, Vec3};

#[path = "../tests/fish/value_only.rs"]
mod value_only;

use value_only::ValueOnly;

/// A heavy top.
#[derive(Clone, Copy)]
struct Top;

const INERTIA: [f64; 3] = [1.0, 2.0, 2.5];
const LEVER: Vec3 = Vec3([0.1, 0.2, 0.7]);

impl System for Top {
    type Group = SO3;
}

impl Lagrangian for Top {
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, w: &Tangent<3, S>) -> S {
        let kinetic = (0..3).fold(S::zero(), |sum, k| sum + (w[k] * w[k]).times(INERTIA[k]));
        kinetic.times(0.5) - r.rotate(LEVER.lift())[2]
    }
}

/// The same with its equations by hand.
#[derive(Clone, Copy)]
struct ByHand;

impl System for ByHand {
    type Group = SO3;
}

impl ContinuousSystem for ByHand {
    type Workspace<S: Scalar> = ();
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _: Context<S>,
        r: &SO3<S>,
        mu: &Cotangent<3, S>,
        (): &mut (),
        xi: &mut Tangent<3, S>,
        tau: &mut Cotangent<3, S>,
    ) {
        let mut i = 0;
        while i < 3 {
            xi.0[i] = mu.0[i].times(1.0 / INERTIA[i]);
            i += 1;
        }
        *tau = r.matrix().row(2).cross(LEVER.lift()).into();
    }
}

/// A discrete Lagrangian by dual numbers, whether or not it can be recorded.
struct ByJets<L>(L);

impl<L: DiscreteLagrangian> System for ByJets<L> {
    type Group = L::Group;
}

impl<L: DiscreteLagrangian> DiscreteLagrangian for ByJets<L> {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
    ) -> S {
        self.0.value(at, g, f, h)
    }
    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
        (): &mut (),
        out: &mut Derivatives<L::Group, S>,
    ) {
        out.by_jets(&self.0, at, g, f, h);
    }
}

/// The microseconds of a step, the best of some runs.
fn time<I: Integrator>(
    mut integrator: I,
    start: &State<I::Group>,
    h: f64,
    steps: u32,
) -> (f64, Means) {
    const RUNS: u32 = 7;
    let (mut best, mut means) = (f64::INFINITY, Means::default());
    for _ in 0..RUNS {
        let mut state = start.clone();
        integrator.reset();
        // Not the recording, nor the search for a guess.
        for _ in 0..8 {
            let report = integrator.step(&mut state, h).expect("a step");
            means = report.means;
        }
        let clock = Instant::now();
        for _ in 0..steps {
            integrator.step(black_box(&mut state), h).expect("a step");
        }
        best = best.min(clock.elapsed().as_secs_f64() * 1e6 / f64::from(steps));
    }
    (best, means)
}

fn print(name: &str, [by_hand, recorded, by_duals]: [(f64, Means); 3]) {
    assert_eq!(recorded.1, Means::Recorded);
    let [hand, recorded, duals] = [by_hand.0, recorded.0, by_duals.0];
    let [ratio, gain] = [recorded / hand, duals / recorded];
    println!("{name:24}{hand:10.2}{recorded:10.2}{duals:12.2}{ratio:12.2}{gain:12.1}");
}

fn gauss<const S: usize>(
    name: &str,
    by_hand: impl ContinuousSystem<Group = SO3> + 'static,
    start: &State<SO3>,
    (h, steps): (f64, u32),
) {
    let hand = time(Gauss::new::<S>(by_hand), start, h, steps);
    let recorded = time(Gauss::new::<S>(Top.hamiltonian()), start, h, steps);
    let duals = time(Gauss::new::<S>(DualSystem(Top)), start, h, steps / 8);
    print(name, [hand, recorded, duals]);
}

fn fish<const S: usize>(
    name: &str,
    (model, start): (&ArticulatedBody, &State<Configuration>),
    (h, steps): (f64, u32),
) {
    let hand = time(Gauss::new::<S>(model.clone()), start, h, steps);
    let recorded = time(
        Gauss::new::<S>(model.clone().hamiltonian()),
        start,
        h,
        steps,
    );
    let duals = time(Gauss::new::<S>(DualSystem(model.clone())), start, h, 8);
    print(name, [hand, recorded, duals]);
}

fn main() {
    println!("microseconds a step        by hand  recorded    by duals  rec./hand  duals/rec.");
    let turn = SO3::exp(&Tangent([0.4, -0.8, 0.3]));
    let top = Top
        .state(0.0, turn, &Tangent([0.3, -0.5, 1.0]))
        .expect("a state");
    gauss::<2>("top, gauss-4, h = 0.05", ByHand, &top, (0.05, 4000));
    gauss::<4>("top, gauss-8, h = 0.2", ByHand, &top, (0.2, 4000));
    let midpoint = || Top.discretise(Quadrature::Midpoint);
    let recorded = time(Variational::new(midpoint()), &top, 0.01, 4000);
    let duals = time(Variational::new(ByJets(midpoint())), &top, 0.01, 4000);
    print("top, midpoint, h = 0.01", [recorded, recorded, duals]);

    let scene = Scene::parse(include_str!("../scenes/fish-chain.toml"), "fish-chain.toml");
    let scene = scene.expect("the shipped scene parses");
    let model = scene.model().expect("the shipped scene is a model");
    let start = scene.initial_state().expect("the scene has a state");
    fish::<2>("fish, gauss-4, h = 0.05", (&model, &start), (0.05, 1000));
    fish::<4>("fish, gauss-8, h = 0.1", (&model, &start), (0.1, 1000));
    let h = 1e-3;
    let hand = time(Variational::new(model.clone()), &start, h, 4000);
    let recorded = time(Variational::new(ValueOnly(model.clone())), &start, h, 4000);
    let duals = time(
        Variational::new(ByJets(ValueOnly(model.clone()))),
        &start,
        h,
        1000,
    );
    print("fish, lgvi, h = 0.001", [hand, recorded, duals]);
    let midpoint = || model.clone().discretise(Quadrature::Midpoint);
    let recorded = time(Variational::new(midpoint()), &start, h, 2000);
    let duals = time(Variational::new(ByJets(midpoint())), &start, h, 500);
    print("fish, midpoint, h = 0.001", [hand, recorded, duals]);
}
