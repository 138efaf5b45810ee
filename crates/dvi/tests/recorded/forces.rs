//! Forces beside recorded systems, and recorded with them.

use core::cell::Cell;
use std::rc::Rc;

use dvi::{
    Context, DualSystem, FirstVariation, Force, Forced, Gauss, Integrator, Lagrangian, Means,
    ShapeError, System, TracedError, TracedSystem, Variation,
};
use lie::{Cotangent, SO3, Scalar, Tangent, VectorSpace};

use crate::beam::apart;
use crate::means::{Top, top};

/// A drag of the square of the rate, and a torque that is told; the drag looks at the rate where `BRANCHES`.
#[derive(Clone, Copy)]
struct Drag<const BRANCHES: bool>;

impl<const BRANCHES: bool> Force for Drag<BRANCHES> {
    type Group = SO3;
    fn force<S: Scalar>(
        &self,
        at: Context<S>,
        _: &SO3<S>,
        w: &Tangent<3, S>,
        out: &mut Cotangent<3, S>,
    ) {
        let speed = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]).sqrt();
        let drag = if BRANCHES && speed.magnitude() > 100.0 {
            0.0
        } else {
            -0.1
        };
        for i in 0..3 {
            out[i] = w[i] * speed.times(drag);
        }
        out[2] += at.t.sin().times(0.3);
    }
}

#[test]
fn it_acts_as_it_does_beside_dual_numbers() {
    let drag = Drag::<false>;
    let system = TracedSystem::new(&Top, &top().g).unwrap().with_force(&drag);
    let mut recorded = Gauss::new::<4>(system.unwrap());
    let mut beside = Gauss::new::<4>(Forced::new(Top.hamiltonian(), drag));
    let mut by_duals = Gauss::new::<4>(Forced::new(DualSystem(Top), drag));
    assert!(!recorded.is_symplectic());
    let [mut one, mut two, mut three] = [(); 3].map(|()| top());
    let [mut first, mut second] = [(); 2].map(|()| Variation::basis(&top().g));
    for _ in 0..50 {
        let report = recorded.step_varied(&mut one, &mut first, 0.05).unwrap();
        assert_eq!(report.means, Means::Recorded);
        beside.step(&mut two, 0.05).unwrap();
        by_duals.step_varied(&mut three, &mut second, 0.05).unwrap();
    }
    // Fifty solutions to rounding; rounding is carried on by what the flow makes of it, less than tenfold.
    assert!(apart(&one, &three) < 1e-12);
    assert!(apart(&two, &three) < 1e-12);
    for (one, two) in first.iter().zip(&second) {
        let off = (one.eta - two.eta).max_magnitude() + (one.mu - two.mu).max_magnitude();
        assert!(off < 1e-11, "{one:?} {two:?}");
    }
    let branches = TracedSystem::new(&Top, &top().g)
        .unwrap()
        .with_force(&Drag::<true>);
    assert!(matches!(branches, Err(TracedError::Trace(_))));
}

/// A torque about the axis that is set from outside.
#[derive(Clone)]
struct Motor(Rc<Cell<f64>>);

impl Force for Motor {
    type Group = SO3;
    fn force<S: Scalar>(
        &self,
        _: Context<S>,
        _: &SO3<S>,
        _: &Tangent<3, S>,
        out: &mut Cotangent<3, S>,
    ) {
        out[2] = S::from_f64(self.0.get());
    }
}

#[test]
fn a_control_that_is_set_between_steps_is_felt() {
    let torque = Rc::new(Cell::new(0.0));
    let forced = || Forced::new(Top.hamiltonian(), Motor(Rc::clone(&torque)));
    let (mut integrator, mut state, mut never) = (Gauss::new::<4>(forced()), top(), top());
    let mut alone = Gauss::new::<4>(Top.hamiltonian());
    for k in 0..10 {
        torque.set(if k < 5 { 0.0 } else { 0.5 });
        integrator.step(&mut state, 0.05).unwrap();
        alone.step(&mut never, 0.05).unwrap();
        let is_felt = apart(&state, &never) > 1e-3;
        assert_eq!(is_felt, k >= 5, "{k}");
    }
}

/// A top of which mass and lever are parameters.
#[derive(Clone, Copy)]
struct Told([f64; 2]);

impl System for Told {
    type Group = SO3;
    fn parameters(&self) -> &[f64] {
        &self.0
    }
}

impl Lagrangian for Told {
    fn value<S: Scalar>(&self, at: Context<S>, r: &SO3<S>, w: &Tangent<3, S>) -> S {
        let [mass, lever] = at.parameters();
        let kinetic = w[0] * w[0] + w[1] * w[1] + w[2] * w[2].times(0.5);
        mass * (kinetic.times(0.5) - lever * r.rotate(lie::Vec3([0.0, 0.0, 1.0]).lift())[2])
    }
}

#[test]
fn other_parameters_need_no_other_recording() {
    let recorded = TracedSystem::new(&Told([1.0, 1.0]), &top().g).unwrap();
    for told in [[2.0, 0.5], [0.3, 4.0]] {
        let changed = recorded.clone().with_parameters(&told).unwrap();
        let anew = TracedSystem::new(&Told(told), &top().g).unwrap();
        let [mut one, mut two] = [(); 2].map(|()| top());
        for (system, state) in [(changed, &mut one), (anew, &mut two)] {
            let mut integrator = Gauss::new::<4>(system);
            for _ in 0..10 {
                integrator.step(state, 0.05).unwrap();
            }
        }
        assert_eq!(one, two);
    }
    let refused = recorded.with_parameters(&[1.0]).err();
    let (expected, found) = (2, 1);
    assert_eq!(refused, Some(ShapeError::Parameters { expected, found }));
}
