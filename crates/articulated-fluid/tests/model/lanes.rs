//! The continuous models over SIMD lanes: another state in every item, and each as if it were alone.

use core::cell::{Cell, RefCell};

use dvi::{ContinuousSystem, Lagrangian, State};
use lie::lanes::{self, InstructionSet, Job};
use lie::{Batch, LieGroup, Over, RealGroup, VectorSpace};
use proptest::prelude::*;

use crate::common::{Shape, assert_close, at_zero, largest, sample_of, spoil};
use crate::flat_trees::{any_flat, displacement};

/// As many as the widest register has items.
const STATES: usize = 8;

/// Velocities and forces of the states, as many at once as the scalar has items.
struct Evaluate<'a, C: ContinuousSystem>(&'a C, &'a [State<C::Group>]);

impl<C: ContinuousSystem> Job for Evaluate<'_, C> {
    type Output = Vec<Vec<f64>>;

    fn run<S: Batch<Item = f64>>(self) -> Vec<Vec<f64>> {
        let Self(system, states) = self;
        let mut found = vec![];
        for states in states.chunks(S::ITEMS) {
            let g = packed::<C::Group, S>(states);
            let (mut mu, mut xi, mut tau) = (g.zero_dual(), g.zero_algebra(), g.zero_dual());
            for d in 0..mu.dim() {
                mu.set(d, batch(|i| states[i].mu.get(d)));
            }
            spoil(&mut xi);
            spoil(&mut tau);
            let mut work = C::Workspace::<S>::default();
            S::run(
                #[inline(always)]
                || system.velocity_and_force(at_zero(), &g, &mu, &mut work, &mut xi, &mut tau),
            );
            let coordinates = [xi.coordinates(), tau.coordinates()].concat();
            let item = |i: usize| coordinates.iter().map(|x| S::items(&[*x])[i]).collect();
            found.extend((0..states.len()).map(item));
        }
        found
    }
}

fn batch<S: Batch<Item = f64>>(item: impl Fn(usize) -> f64) -> S {
    let mut batch = [S::splat(0.0)];
    let items = S::items_mut(&mut batch).iter_mut();
    items.enumerate().for_each(|(i, x)| *x = item(i));
    batch[0]
}

/// The configurations side by side.
fn packed<G: RealGroup, S: Batch<Item = f64>>(states: &[State<G>]) -> Over<G, S> {
    let numbers = |state: &State<G>| {
        let numbers = RefCell::new(vec![]);
        G::convert::<f64, f64>(&state.g, |x| {
            numbers.borrow_mut().push(x);
            x
        });
        numbers.into_inner()
    };
    let (numbers, next) = (states.iter().map(numbers).collect::<Vec<_>>(), Cell::new(0));
    G::convert::<f64, S>(&states[0].g, |_| {
        let k = next.replace(next.get() + 1);
        batch(|i| numbers[i][k])
    })
}

/// A state, and others on the way along a displacement, ever faster.
fn on_the_way<L: Lagrangian>(
    model: &L,
    (g, f): (&L::Group, &L::Group),
    xi: &<L::Group as LieGroup>::Algebra,
) -> Vec<State<L::Group>> {
    let (mut g, mut faster) = (g.clone(), xi.clone());
    let mut states = vec![];
    for _ in 0..STATES {
        states.push(model.state(0.0, g.clone(), &faster).expect("a state"));
        g = g.compose(f);
        faster.add_scaled(0.25, xi);
    }
    states
}

/// Asserts that every set of instructions finds in every item what a double finds.
fn assert_same<C: ContinuousSystem>(system: &C, states: &[State<C::Group>]) {
    let expected = Evaluate(system, states).run::<f64>();
    for set in InstructionSet::available() {
        let found = lanes::run(set, Evaluate(system, states));
        assert_eq!(found.len(), STATES);
        for (found, expected) in found.iter().zip(&expected) {
            // Relative: rounding, for products are fused, times the condition of the inertia, up to a few hundred.
            assert_close(found, expected, 1e-12 * (1.0 + largest(expected)));
        }
    }
}

proptest! {
    #[test]
    fn trees_are_evaluated_side_by_side(
        sample in (0..=4_usize).prop_flat_map(|others| sample_of(Shape::Any, others, 1.0)),
    ) {
        let states = on_the_way(&sample.model, (&sample.g, &sample.f), &sample.xi);
        assert_same(&sample.model, &states);
    }

    #[test]
    fn trees_in_a_plane_are_evaluated_side_by_side(
        (flat, f) in any_flat().prop_flat_map(|flat| {
            let bodies = flat.parts.len();
            (Just(flat), displacement(bodies, 1.0))
        }),
    ) {
        let (model, State { g, mu, .. }) = flat.planar();
        let mut xi = g.zero_algebra();
        let mut work = Default::default();
        model.velocity_and_force::<f64>(at_zero(), &g, &mu, &mut work, &mut xi, &mut g.zero_dual());
        assert_same(&model, &on_the_way(&model, (&g, &f), &xi));
    }
}
