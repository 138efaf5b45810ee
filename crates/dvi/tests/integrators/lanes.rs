//! The stages of Gauss side by side, for a user's own system: the same steps by whatever instructions.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use dvi::{Context, ContinuousSystem, FirstVariation, Gauss, State, System, Variation};
use lie::lanes::{self, InstructionSet, Job};
use lie::{Batch, Cotangent, SO3, Scalar, Tangent, Vec3, VectorSpace};

use crate::common::{INERTIA, LEVER, distance, top};

/// The heavy top on a table that shakes, written out as a continuous system.
#[derive(Clone, Default)]
struct Shaken<const INLINE: bool> {
    /// The doubles of the widest scalar that it was evaluated over.
    widest: Arc<AtomicUsize>,
}

impl<const INLINE: bool> System for Shaken<INLINE> {
    type Group = SO3;
}

impl<const INLINE: bool> ContinuousSystem for Shaken<INLINE> {
    type Workspace<S: Scalar> = ();
    const INLINE: bool = INLINE;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        r: &SO3<S>,
        mu: &Cotangent<3, S>,
        (): &mut (),
        xi: &mut Tangent<3, S>,
        tau: &mut Cotangent<3, S>,
    ) {
        if S::DUAL_LEVELS == 0 {
            let doubles = size_of::<S>() / size_of::<f64>();
            self.widest.fetch_max(doubles, Ordering::Relaxed);
        }
        let mut i = 0;
        while i < 3 {
            xi.0[i] = mu.0[i].times(1.0 / INERTIA[i]);
            i += 1;
        }
        let weight = S::one() + Scalar::sin(at.t.times(3.0)).times(0.5);
        // L has -w (R l)_z, which R exp(eta) changes by w (R^T e_z x l) . eta.
        let up: Vec3<S> = r.matrix().row(2);
        *tau = (up.cross(LEVER.lift()) * weight).into();
    }
}

/// Ten steps by these instructions, of the state and of its variations.
fn run<const INLINE: bool, const S: usize>(
    set: InstructionSet,
    h: f64,
) -> (State<SO3>, Vec<Variation<SO3>>, usize) {
    let system = Shaken::<INLINE>::default();
    let widest = system.widest.clone();
    let gauss = Gauss::new::<S>(system);
    let mut integrator = gauss.with_instructions(set);
    let (mut state, mut variations) = (top(), Variation::basis(&top().g));
    for _ in 0..10 {
        let step = integrator.step_varied(&mut state, &mut variations, h);
        step.expect("a step");
    }
    (state, variations, widest.load(Ordering::Relaxed))
}

/// The doubles of a set's scalar.
struct Items;

impl Job for Items {
    type Output = usize;
    fn run<S: Batch<Item = f64>>(self) -> usize {
        S::ITEMS
    }
}

fn largest_change(a: &[Variation<SO3>], b: &[Variation<SO3>]) -> f64 {
    let apart = a.iter().zip(b).map(|(a, b)| {
        let eta = (a.eta - b.eta).max_magnitude();
        eta.max((a.mu - b.mu).max_magnitude())
    });
    apart.fold(0.0, f64::max)
}

fn steps_agree<const S: usize>(h: f64, tolerance: f64) {
    let (plain, varied, one) = run::<false, S>(InstructionSet::Baseline, h);
    assert_eq!(one, 1);
    for set in InstructionSet::available() {
        let (state, variations, widest) = run::<true, S>(set, h);
        assert_eq!(widest, lanes::run(set, Items), "{set}");
        let apart = distance(&state, &plain);
        let bent = largest_change(&variations, &varied);
        println!("{S} stages, h = {h}, {set}: {apart:.1e}, {bent:.1e}");
        assert!(apart <= tolerance, "{S} stages, {set}: {apart:e}");
        // Not relative, and the variations have grown.
        assert!(bent <= 10.0 * tolerance, "{S} stages, {set}: {bent:e}");
        assert_eq!(state.t, plain.t);

        // Without `INLINE`, one stage after the other by whatever set.
        let (state, _, widest) = run::<false, S>(set, h);
        assert_eq!(widest, 1, "{set}");
        assert_eq!(state, plain, "{S} stages, {set}");
    }
}

#[test]
fn steps_are_the_same_by_all_instructions() {
    // Ten steps, each solved to a few epsilon.
    const ROUNDING: f64 = 20.0 * f64::EPSILON;
    steps_agree::<1>(0.1, ROUNDING);
    steps_agree::<2>(0.1, ROUNDING);
    steps_agree::<3>(0.1, ROUNDING);
    steps_agree::<4>(0.1, ROUNDING);
    steps_agree::<5>(0.1, ROUNDING);
    steps_agree::<6>(0.1, ROUNDING);
    steps_agree::<7>(0.1, ROUNDING);
    steps_agree::<8>(0.1, ROUNDING);
}

#[test]
fn long_steps_are_the_same_by_all_instructions() {
    // The iteration settles slowly, or Newton's method takes over: what is left of it comes on top, over seven seconds.
    steps_agree::<2>(0.7, 1e-12);
    steps_agree::<5>(0.7, 1e-12);
}
