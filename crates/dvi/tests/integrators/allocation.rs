//! On groups of run-time size too, no step allocates once the storage is made.

use allocation_counter::measure;
use dvi::{
    Context, DiscreteLagrangian, Force, Integrator, Lagrangian, Quadrature, State, System,
    Variational,
};
use lie::{Cayley, Cotangent, Exp, LieGroup, Power, Retraction, SO3, Scalar, Tangent, Vec3};

/// Rigid bodies that hang on points of their own.
#[derive(Clone, Copy)]
struct Pendulums;

impl System for Pendulums {
    type Group = Power<SO3>;
}

impl Lagrangian for Pendulums {
    fn value<S: Scalar>(
        &self,
        _: Context<S>,
        attitudes: &Power<SO3<S>>,
        velocities: &Power<Tangent<3, S>>,
    ) -> S {
        let each = attitudes.iter().zip(velocities.iter());
        each.fold(S::zero(), |sum, (r, omega)| {
            let [a, b, c] = omega.0;
            let kinetic = (a * a + b * b.times(2.0) + c * c.times(3.0)).times(0.5);
            sum + kinetic - r.rotate(Vec3([0.0, 0.0, 1.0]).lift())[2]
        })
    }
}

/// A drag on each of them.
#[derive(Clone, Copy)]
struct Drag;

impl Force for Drag {
    type Group = Power<SO3>;

    fn force<S: Scalar>(
        &self,
        _: Context<S>,
        _: &Power<SO3<S>>,
        velocities: &Power<Tangent<3, S>>,
        out: &mut Power<Cotangent<3, S>>,
    ) {
        for (torque, omega) in out.iter_mut().zip(velocities.iter()) {
            *torque = Cotangent(omega.0.map(|x| x.times(-0.1)));
        }
    }
}

/// Of which only the value is known, and so is the domain.
struct ByValue;

impl System for ByValue {
    type Group = Power<SO3>;
}

impl DiscreteLagrangian for ByValue {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(
        &self,
        _: Context<S>,
        attitudes: &Power<SO3<S>>,
        turns: &Power<SO3<S>>,
        h: S,
    ) -> S {
        let each = attitudes.iter().zip(turns.iter());
        each.fold(S::zero(), |sum, (r, f)| {
            let height = r.rotate(Vec3([0.0, 0.0, 1.0]).lift())[2];
            sum - f.minus_identity().trace() / h - h * height
        })
    }
}

fn start() -> State<Power<SO3>> {
    let angles = [0.4, -0.9, 1.7, 0.1];
    State {
        t: 0.0,
        g: angles
            .map(|x| SO3::exp(&Tangent([x, 0.3, 0.0])))
            .into_iter()
            .collect(),
        mu: angles
            .map(|x| Cotangent([0.2, x, 0.5]))
            .into_iter()
            .collect(),
    }
}

#[track_caller]
fn steps_do_not_allocate(lagrangian: impl DiscreteLagrangian<Group = Power<SO3>>) {
    let (mut integrator, mut state) = (Variational::new(lagrangian), start());
    integrator.step(&mut state, 0.01).unwrap();
    let steps = measure(|| {
        for _ in 0..100 {
            integrator.step(&mut state, 0.01).unwrap();
        }
        // Another step size renews the matrix, in the same storage.
        integrator.step(&mut state, 0.02).unwrap();
    });
    assert_eq!(steps.count_total, 0);
}

fn by_every_rule<R: Retraction>() {
    for rule in Quadrature::ALL {
        let discrete = Pendulums.discretise(rule).with_retraction::<R>();
        steps_do_not_allocate(discrete);
        steps_do_not_allocate(discrete.with_force(Drag));
    }
}

#[test]
fn lagrangians_and_forces_by_a_rule_do_not_allocate() {
    by_every_rule::<Cayley>();
    by_every_rule::<Exp>();
}

#[test]
fn a_value_alone_does_not_allocate() {
    steps_do_not_allocate(ByValue);
}

#[test]
fn the_counter_counts() {
    let counted = measure(|| drop(std::hint::black_box(start())));
    assert_eq!(counted.count_total, 2);
}
