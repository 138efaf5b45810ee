//! Derivatives of the flow, against central differences and the symplectic form.

use dvi::{
    Context, DiscreteForce, DiscreteLagrangian, FirstVariation, Forced, Integrator, Lagrangian,
    Quadrature, State, Variation, Variational, symplectic_form,
};
use lie::{DualOver, LieGroup, Over, RealGroup, Scalar, VectorSpace};

use crate::common::{Driven, Sinking, Top, driven, sinking, top};

const STEPS: u32 = 100;
const H: f64 = 0.02;
/// Half-width of the central differences: their error is its square, 1e-8, and rounding over it.
const WIDTH: f64 = 1e-4;

/// The same constant force in every step, by half at both of its ends.
#[derive(Clone)]
struct Constant<G: RealGroup>(G::Dual);

impl<G: RealGroup> DiscreteForce for Constant<G> {
    type Group = G;
    type Workspace<S: Scalar> = ();

    fn impulses<S: Scalar>(
        &self,
        _: Context<S>,
        _: &Over<G, S>,
        _: &Over<G, S>,
        h: S,
        (): &mut (),
        out: [&mut DualOver<G, S>; 2],
    ) {
        for impulse in out {
            for i in 0..impulse.dim() {
                impulse.set(i, h * S::from_f64(0.5 * self.0.get(i)));
            }
        }
    }
}

fn run<L: DiscreteLagrangian + Clone>(
    lagrangian: &L,
    start: &State<L::Group>,
    force: <L::Group as LieGroup>::Dual,
) -> State<L::Group> {
    let mut integrator = Variational::new(Forced::new(lagrangian.clone(), Constant(force)));
    let mut state = start.clone();
    for _ in 0..STEPS {
        integrator.step(&mut state, H).unwrap();
    }
    state
}

/// The end of the run whose start and force are moved by `s` along a variation.
fn moved<L: DiscreteLagrangian + Clone>(
    lagrangian: &L,
    start: &State<L::Group>,
    along: &Variation<L::Group>,
    s: f64,
) -> State<L::Group> {
    let (mut start, mut force) = (start.clone(), start.mu.zero_like());
    let mut eta = along.eta.zero_like();
    eta.add_scaled(s, &along.eta);
    start.g = start.g.compose(&L::Group::exp(&eta));
    start.mu.add_scaled(s, &along.mu);
    force.add_scaled(s, &along.force);
    run(lagrangian, &start, force)
}

fn against_differences<L: DiscreteLagrangian + Clone>(lagrangian: &L, start: &State<L::Group>) {
    let units = [Variation::basis(&start.g), Variation::forces(&start.g)].concat();
    let (mut state, mut carried) = (start.clone(), units.clone());
    let mut integrator = Variational::new(lagrangian);
    for _ in 0..STEPS {
        integrator.step_varied(&mut state, &mut carried, H).unwrap();
    }
    let mut worst = 0.0_f64;
    for (unit, carried) in units.iter().zip(&carried) {
        let [ahead, behind] = [WIDTH, -WIDTH].map(|s| moved(lagrangian, start, unit, s));
        let to = |end: &State<L::Group>| state.g.inverse().compose(&end.g).log().unwrap();
        let mut eta = to(&ahead);
        eta.add_scaled(-1.0, &to(&behind));
        let mut mu = ahead.mu.clone();
        mu.add_scaled(-1.0, &behind.mu);
        let size = carried.eta.max_magnitude() + carried.mu.max_magnitude();
        let per = 1.0 / (2.0 * WIDTH);
        for i in 0..eta.dim() {
            worst = worst.max((eta.get(i) * per - carried.eta.get(i)).abs() / size);
            worst = worst.max((mu.get(i) * per - carried.mu.get(i)).abs() / size);
        }
    }
    println!("flow derivative against central differences: {worst:.1e}");
    assert!(worst < 1e-6, "{worst:e}");
}

#[test]
fn the_flow_s_derivative_is_that_of_differences() {
    against_differences(&Top.discretise(Quadrature::Midpoint), &top());
    against_differences(&Top.discretise(Quadrature::LeftPoint), &top());
    against_differences(&Sinking.discretise(Quadrature::Trapezoid), &sinking());
    against_differences(&Driven.discretise(Quadrature::Midpoint), &driven());
}

#[test]
fn the_flow_is_symplectic_over_many_steps() {
    let units = Variation::basis(&sinking().g);
    let (mut state, mut carried) = (sinking(), units.clone());
    let mut integrator = Variational::new(Sinking.discretise(Quadrature::Midpoint));
    for _ in 0..1000 {
        integrator.step_varied(&mut state, &mut carried, H).unwrap();
    }
    let size = carried
        .iter()
        .map(|v| v.eta.max_magnitude().max(v.mu.max_magnitude()));
    let size = size.fold(1.0, f64::max);
    for (i, j) in (0..units.len()).flat_map(|i| (0..i).map(move |j| (i, j))) {
        let before = symplectic_form(&sinking().mu, &units[i], &units[j]);
        let after = symplectic_form(&state.mu, &carried[i], &carried[j]);
        // Rounding of a thousand steps, of products of two grown columns.
        assert!(
            (after - before).abs() < 1e-13 * size * size,
            "{i}, {j}: {after} {before}"
        );
    }
}

#[test]
fn a_refused_step_changes_neither_state_nor_variations() {
    let (mut state, mut carried) = (top(), Variation::basis(&top().g));
    // It has no end that is finite.
    carried[5].mu.set(2, f64::INFINITY);
    let before = carried.clone();
    let mut integrator = Variational::new(Top.discretise(Quadrature::Midpoint));
    integrator
        .step_varied(&mut state, &mut carried, H)
        .unwrap_err();
    assert_eq!((state, carried), (top(), before));
}

/// Carrying variations along takes the same steps.
#[test]
fn the_trajectory_is_that_of_plain_steps() {
    let (mut a, mut b) = (top(), top());
    let mut carried = Variation::forces(&a.g);
    let integrator = || Variational::new(Top.discretise(Quadrature::Midpoint));
    let (mut varied, mut plain) = (integrator(), integrator());
    for _ in 0..50 {
        varied.step_varied(&mut a, &mut carried, H).unwrap();
        plain.step(&mut b, H).unwrap();
    }
    assert_eq!(a, b);
}
