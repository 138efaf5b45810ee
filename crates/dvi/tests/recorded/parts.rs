//! A recording is used for the formula alone that it was made of.

use dvi::{
    Context, Derivatives, DiscreteLagrangian, Integrator, Means, State, System, TracedError,
    Variational,
};
use lie::{Over, SO3, Scalar};

use crate::by_jets::ByJets;
use crate::means::{Body, top};

/// A body whose mass grows with time; its formula is made anew for each evaluation.
#[derive(Clone, Copy)]
struct Growing;

impl Growing {
    fn now<S: Scalar>(t: S) -> Body {
        // As a constant: the body is another one at each step.
        Body(1.0 + t.magnitude())
    }
}

impl System for Growing {
    type Group = SO3;
}

impl DiscreteLagrangian for Growing {
    type Workspace<S: Scalar> = ();
    fn value<S: Scalar>(&self, at: Context<S>, g: &SO3<S>, f: &SO3<S>, h: S) -> S {
        Self::now(at.t).value(at, g, f, h)
    }
    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<SO3, S>,
        f: &Over<SO3, S>,
        h: S,
        (): &mut (),
        out: &mut Derivatives<SO3, S>,
    ) {
        Self::now(at.t).derivatives(at, g, f, h, &mut (), out);
    }
}

#[test]
fn what_is_made_anew_for_each_evaluation_is_not_recorded() {
    let (mut one, mut two) = (top(), top());
    let (mut by_value, mut by_jets) =
        (Variational::new(Growing), Variational::new(ByJets(Growing)));
    for _ in 0..20 {
        let report = by_value.step(&mut one, 0.1).unwrap();
        by_jets.step(&mut two, 0.1).unwrap();
        let why = Some(TracedError::Elsewhere);
        assert_eq!(report.means, Means::DualNumbers { why });
    }
    assert_eq!(one, two);
}

#[test]
fn what_is_borrowed_is_recorded() {
    let body = Body(2.0);
    let (mut one, mut two) = (top(), top());
    let (mut owns, mut borrows) = (Variational::new(body), Variational::new(&body));
    for _ in 0..5 {
        let report = borrows.step(&mut one, 0.01).unwrap();
        owns.step(&mut two, 0.01).unwrap();
        assert_eq!(report.means, Means::Recorded);
    }
    assert_eq!(one, two);
}

#[test]
fn an_integrator_may_be_moved() {
    fn step<I: Integrator<Group = SO3>>(mut moved: I, state: &mut State<SO3>) -> (I, Means) {
        let means = moved.step(state, 0.01).unwrap().means;
        (moved, means)
    }
    let (mut integrator, mut state, mut means) = (
        Box::new(Variational::new(Body(2.0))),
        top(),
        Means::Formulas,
    );
    // More often than another formula would be recorded.
    for _ in 0..100 {
        let (moved, found) = step(*integrator, &mut state);
        (integrator, means) = (Box::new(moved), found);
    }
    assert_eq!(means, Means::Recorded);
}
