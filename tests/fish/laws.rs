//! The fish chain against the checker, and the derivative of its flow.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{
    Context, Discretised, FirstVariation, Force, Forced, Integrator, Quadrature, State, Symmetry,
    Variation, Variational, laws,
};
use lgvi::{articulated_fluid, dvi, lie};
use lie::{AlgebraOver, DualOver, LieGroup, Power, R3, SO3, Scalar, Vec3, VectorSpace};

use crate::common::{self, attitude_error, paper};
use crate::on_se3::OnSe3;
use crate::value_only::ValueOnly;

const H: f64 = 1e-3;

/// The state after a second, where nothing is aligned any more.
fn bent() -> (ArticulatedBody, State<Configuration>) {
    let (model, start) = paper();
    let mut integrator = Variational::new(model.clone());
    let state = common::run(&mut integrator, &start, 1.0, 1000);
    (model, state)
}

/// The position of the head.
fn at<S: Scalar>(x: Vec3<S>) -> Power<R3<S>> {
    Power::new(vec![x.into()])
}

/// A rotation of space about an axis through the origin, which moves the head's position too.
struct Turn(Vec3);

impl Symmetry<Configuration> for Turn {
    fn act<S: Scalar>(&self, s: S, (r, x, q): &Configuration<S>) -> Configuration<S> {
        let turn = SO3::exp(&(self.0.lift() * s).into());
        let turned = r.iter().map(|r| turn.compose(r));
        (turned.collect(), at(turn.rotate(x[0].vec3())), q.clone())
    }
}

/// A translation of space.
struct Shift(Vec3);

impl Symmetry<Configuration> for Shift {
    fn act<S: Scalar>(&self, s: S, (r, x, q): &Configuration<S>) -> Configuration<S> {
        (r.clone(), at(x[0].vec3() + self.0.lift() * s), q.clone())
    }
}

#[test]
fn the_paper_s_formulas_pass() {
    let (model, state) = bent();
    for h in [H, 0.02] {
        let states = [paper().1, state.clone()];
        let report = laws::check(&model, &states, h).unwrap_or_else(|e| panic!("{e}"));
        println!("h = {h}: {report:?}");
        laws::check_symmetry(&model, &Turn(Vec3([0.3, -1.0, 0.5])), &states, h).unwrap();
        laws::check_symmetry(&model, &Shift(Vec3([1.0, 2.0, 0.5])), &states, h).unwrap();
    }
    laws::check_consistency(&model, &model, core::slice::from_ref(&state)).unwrap();
    laws::check(&OnSe3(model), &[OnSe3::from_direct(&state)], 0.02).unwrap();
}

#[test]
fn the_step_is_symplectic_with_the_model_s_inertia() {
    let (model, state) = bent();
    for h in [H, 0.02, 0.05] {
        let mut integrator = Variational::new(model.clone());
        let defect = laws::symplectic_defect(&mut integrator, &state, h).unwrap();
        println!("h = {h}: defect of the symplectic form {defect:.1e} of |mu|");
        assert!(defect < 1e-11, "{defect:e}");
    }
}

#[test]
fn every_rule_discretises_the_continuous_model() {
    let (model, state) = bent();
    for rule in [Quadrature::LeftPoint, Quadrature::Midpoint] {
        let discrete = Discretised::new(&model, rule);
        laws::check(&discrete, core::slice::from_ref(&state), 0.02)
            .unwrap_or_else(|e| panic!("{e}"));
        let integrator = || Variational::new(&discrete);
        let order = laws::check_order(integrator, &state, 0.5, &[40, 80, 160]);
        println!("{}: {:?}", rule.name(), order.unwrap().slope);
    }
}

/// $\partial(\text{state after 1 s})/\partial(\text{state before})$ against central differences.
#[test]
fn the_flow_s_derivative_is_that_of_differences() {
    const STEPS: u32 = 200;
    const LONG: f64 = 5e-3;
    /// Half-width of the differences: their error is its square times the flow's third derivative.
    const WIDTH: f64 = 3e-5;
    let (model, start) = bent();
    let units = Variation::basis(&start.g);
    let (mut state, mut carried) = (start.clone(), units.clone());
    let mut integrator = Variational::new(model.clone());
    for _ in 0..STEPS {
        integrator
            .step_varied(&mut state, &mut carried, LONG)
            .unwrap();
    }
    let moved = |unit: &Variation<Configuration>, s: f64| {
        let mut start = start.clone();
        let mut eta = unit.eta.zero_like();
        eta.add_scaled(s, &unit.eta);
        start.g = start.g.compose(&Configuration::exp(&eta));
        start.mu.add_scaled(s, &unit.mu);
        let integrator = Variational::new(model.clone());
        common::run(integrator, &start, f64::from(STEPS) * LONG, STEPS)
    };
    let mut worst = 0.0_f64;
    for (unit, carried) in units.iter().zip(&carried) {
        let [ahead, behind] = [WIDTH, -WIDTH].map(|s| moved(unit, s));
        let to = |end: &State<Configuration>| state.g.inverse().compose(&end.g).log().unwrap();
        let mut eta = to(&ahead);
        eta.add_scaled(-1.0, &to(&behind));
        let mut mu = ahead.mu.clone();
        mu.add_scaled(-1.0, &behind.mu);
        let size = carried.eta.max_magnitude() + carried.mu.max_magnitude();
        for i in 0..eta.dim() {
            let slope = eta.get(i) / (2.0 * WIDTH);
            worst = worst.max((slope - carried.eta.get(i)).abs() / size);
            let slope = mu.get(i) / (2.0 * WIDTH);
            worst = worst.max((slope - carried.mu.get(i)).abs() / size);
        }
    }
    println!("flow derivative against central differences: {worst:.1e}");
    assert!(worst < 1e-6, "{worst:e}");
}

/// Each joint brakes the rotation of its tail against the head, and pushes neither.
struct Joints;

impl Force for Joints {
    type Group = Configuration;

    fn force<S: Scalar>(
        &self,
        _: Context<S>,
        (r, ..): &Configuration<S>,
        (omega, ..): &AlgebraOver<Configuration, S>,
        (torques, ..): &mut DualOver<Configuration, S>,
    ) {
        let spin = |i: usize| r[i].rotate(omega[i].vec3());
        for i in 1..r.len() {
            let torque = (spin(i) - spin(0)) * S::from_f64(0.5);
            torques[0] = (torques[0].vec3() + r[0].inverse_rotate(torque)).into();
            torques[i] = (-r[i].inverse_rotate(torque)).into();
        }
    }
}

#[test]
fn braked_joints_keep_the_momenta() {
    let (model, start) = paper();
    let force = Discretised::new(Joints, Quadrature::LeftPoint);
    let mut integrator = Variational::new(Forced::new(model.clone(), force));
    let kept = model.conserved(&start).unwrap();
    let mut state = start;
    for _ in 0..5000 {
        integrator.step(&mut state, 2.0 * H).unwrap();
    }
    let now = model.conserved(&state).unwrap();
    let angular = (now.angular - kept.angular).norm() / kept.angular.norm();
    let linear = (now.linear - kept.linear).norm();
    println!(
        "energy {:.3} -> {:.3} J, angular momentum {angular:.1e}, linear {linear:.1e}",
        kept.energy, now.energy
    );
    assert!(now.energy < 0.95 * kept.energy);
    // A random walk of rounding, 10 eps sqrt(N).
    assert!(
        angular < 10.0 * f64::EPSILON * 5000_f64.sqrt(),
        "{angular:e}"
    );
    assert!(linear < 1e-13, "{linear:e}");
}

#[test]
fn the_value_alone_is_enough() {
    let (model, start) = paper();
    for (steps, bound) in [(1, 2e-13), (10_000, 1e-9)] {
        let until = f64::from(steps) * H;
        let by_hand = common::run(Variational::new(model.clone()), &start, until, steps);
        let by_value = common::run(
            Variational::new(ValueOnly(model.clone())),
            &start,
            until,
            steps,
        );
        let apart = attitude_error(&by_hand, &by_value);
        println!("value only against (29)-(33), {steps} steps: {apart:.1e}");
        assert!(apart < bound, "{apart:e}");
    }
}
