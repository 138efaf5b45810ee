//! Trees of bodies under a force that is no gradient: steps by the model's inertia, and stages side by side.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{
    Composition, Context, ContinuousSystem, Discretised, Force, Forced, Gauss, Integrator,
    Quadrature, State, Variational,
};
use lie::Scalar;
use lie::lanes::InstructionSet;
use proptest::prelude::*;

use crate::by_duals::ByDuals;
use crate::common::*;

/// Each joint brakes the turning of its body against the parent, and pushes neither; inlined or not.
#[derive(Clone)]
struct Brakes<const INLINED: bool>(Vec<(usize, usize)>);

impl<const INLINED: bool> Brakes<INLINED> {
    /// N m s.
    const DRAG: f64 = 0.5;

    fn on(model: &ArticulatedBody) -> Self {
        Self(model.joints().map(|j| (j.parent, j.child)).collect())
    }
}

impl<const INLINED: bool> Force for Brakes<INLINED> {
    type Group = Configuration;
    const INLINE: bool = INLINED;

    #[inline(always)]
    fn force<S: Scalar>(
        &self,
        _: Context<S>,
        (r, ..): &Configuration<S>,
        (omega, ..): &Velocity<S>,
        (torques, ..): &mut Momentum<S>,
    ) {
        for &(p, c) in &self.0 {
            let (parent, child) = (r[p].rotate(omega[p].vec3()), r[c].rotate(omega[c].vec3()));
            let torque = (child - parent) * S::from_f64(Self::DRAG);
            torques[p] = (torques[p].vec3() + r[p].inverse_rotate(torque)).into();
            torques[c] = (torques[c].vec3() - r[c].inverse_rotate(torque)).into();
        }
    }
}

/// The model with its joints braked.
fn braked(
    model: &ArticulatedBody,
    rule: Quadrature,
) -> Forced<ArticulatedBody, Discretised<Brakes<false>>> {
    Forced::new(model.clone(), Discretised::new(Brakes::on(model), rule))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn the_model_s_inertia_and_the_exact_matrix_lead_to_the_same_step(
        sample in prop::sample::select(vec![2, 11]).prop_flat_map(|others| sample_of(Shape::Any, others, 0.1)),
        rule in prop::sample::select(Quadrature::ALL.to_vec()),
    ) {
        const STEP: (f64, u32) = (0.005, 1);
        let (start, system) = (sample.state(), braked(&sample.model, rule));
        let by_duals = ByDuals(system.clone());
        let found = run(Variational::new(&system), &start, STEP);
        assert_same(&found, &run(Variational::new(&by_duals), &start, STEP), 1e-12);
        let found = run(Composition::new::<4>(&system), &start, STEP);
        assert_same(&found, &run(Composition::new::<4>(&by_duals), &start, STEP), 1e-12);
    }
}

/// More coordinates than the dense matrix may have.
#[test]
fn two_hundred_braked_bodies_keep_their_momenta() {
    const STEPS: u32 = 100;
    let (model, start) = gentle(Shape::Comb, 200);
    let system = braked(&model, Quadrature::LeftPoint);
    let kept = |state: &State<Configuration>| model.conserved(state).expect("a state");
    let before = kept(&start);
    let integrators: [(&str, Box<dyn Integrator<Group = Configuration>>); 2] = [
        ("order 1", Box::new(Variational::new(system.clone()))),
        ("order 4", Box::new(Composition::new::<4>(system))),
    ];
    for (name, integrator) in integrators {
        let after = kept(&run(integrator, &start, (5e-3, STEPS)));
        let moved = |a: lie::Vec3, b: lie::Vec3| (a - b).norm() / b.norm();
        let linear = moved(after.linear, before.linear);
        let angular = moved(after.angular, before.angular);
        let energy = after.energy / before.energy;
        println!("{name}: linear {linear:.1e}, angular {angular:.1e}, energy to {energy:.3}");
        assert!(energy < 0.99, "{name}: {energy}");
        // A random walk of rounding.
        let rounding = 10.0 * f64::EPSILON * f64::from(STEPS).sqrt();
        assert!(
            linear.max(angular) < rounding,
            "{name}: {linear:e} {angular:e}"
        );
    }
}

#[test]
fn a_forced_system_is_inlined_where_both_parts_are() {
    fn is_inlined<C: ContinuousSystem>() -> bool {
        C::INLINE
    }
    assert!(is_inlined::<Forced<ArticulatedBody, Brakes<true>>>());
    assert!(!is_inlined::<Forced<ArticulatedBody, Brakes<false>>>());
}

#[test]
fn a_forced_run_in_lanes_is_the_one_without() {
    let (model, start) = gentle(Shape::Comb, 7);
    let lanes = Forced::new(model.clone(), Brakes::<true>::on(&model));
    let alone = Forced::new(model.clone(), Brakes::<false>::on(&model));
    let steps = (0.02, 50);
    let expected = run(Gauss::new::<4>(alone), &start, steps);
    let energy = |state| model.conserved(state).expect("a state").energy;
    println!("energy {} -> {}", energy(&start), energy(&expected));
    assert!(energy(&expected) < 0.95 * energy(&start));
    for set in InstructionSet::available() {
        let integrator = Gauss::new::<4>(lanes.clone()).with_instructions(set);
        assert_same(&run(integrator, &start, steps), &expected, 1e-13);
    }
    assert_same(
        &run(Gauss::new::<4>(lanes), &start, steps),
        &expected,
        1e-13,
    );
}
