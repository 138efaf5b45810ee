//! Many trajectories at once are those that one by one are.

use dvi::{
    Cause, Context, ContinuousSystem, Ensemble, Gauss, Integrator, Lagrangian, Means, State,
    StepError, StepReport, System,
};
use lie::lanes::InstructionSet;
use lie::{Cotangent, LieGroup, Rn, SO3, Scalar, Tangent, Vec3};
use proptest::prelude::*;

use crate::beam::{BEAM, apart, bent};
use crate::means::{Branching, Top};

/// A heavy body by its own formulas, for a hundred seconds.
#[derive(Clone, Copy)]
struct Body;

impl System for Body {
    type Group = SO3;
}

impl ContinuousSystem for Body {
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
        for (i, inertia) in [1.0, 2.0, 2.5].into_iter().enumerate() {
            xi.0[i] = mu.0[i].times(1.0 / inertia);
        }
        let up: Vec3<S> = r.matrix().row(2);
        *tau = up.cross(Vec3([0.1, 0.2, 0.7]).lift()).into();
    }

    fn is_defined(&self, t: f64, _: &SO3) -> bool {
        t < 100.0
    }
}

/// A start and a velocity that are drawn.
fn turned([a, b, c]: [f64; 3], mu: [f64; 3]) -> State<SO3> {
    State {
        t: a,
        g: SO3::exp(&Tangent([a, b, c])),
        mu: Cotangent(mu),
    }
}

type Outcome = Result<StepReport, StepError>;

/// Each by an integrator of its own; those that fail stay where they are.
fn one_by_one<C: ContinuousSystem + Clone + 'static>(
    system: &C,
    stages: usize,
    states: &mut [State<C::Group>],
    (h, steps): (f64, usize),
) -> Vec<Outcome> {
    let advance = |state: &mut State<C::Group>| {
        let mut gauss = Gauss::with_stages(system.clone(), stages).expect("stages");
        let mut outcome = Ok(StepReport::default());
        for _ in 0..steps {
            if outcome.is_ok() {
                outcome = gauss.step(state, h);
            }
        }
        outcome
    };
    states.iter_mut().map(advance).collect()
}

/// The ensemble against one by one, in two calls; how far apart they come at most.
fn compare<C: ContinuousSystem + Clone + Sync + 'static>(
    system: &C,
    stages: usize,
    starts: &[State<C::Group>],
    (h, steps): (f64, usize),
) -> f64 {
    let (mut alone, mut together) = (starts.to_vec(), starts.to_vec());
    let expected = one_by_one(system, stages, &mut alone, (h, 2 * steps));
    let mut ensemble = Ensemble::with_stages(system.clone(), stages).expect("stages");
    ensemble.advance(&mut together, h, steps);
    let found = ensemble.advance(&mut together, h, steps);
    for (expected, found) in expected.iter().zip(&found) {
        match (expected, found) {
            (Ok(a), Ok(b)) => assert_eq!(a.means, b.means),
            (Err(a), Err(b)) => assert_eq!((a.step, a.h), (b.step, b.h), "{a:?}, {b:?}"),
            (a, b) => panic!("{a:?} and {b:?}"),
        }
    }
    for threads in 1..4 {
        let mut again = starts.to_vec();
        let ensemble = Ensemble::with_stages(system.clone(), stages).expect("stages");
        let mut ensemble = ensemble.with_threads(threads);
        ensemble.advance(&mut again, h, steps);
        ensemble.advance(&mut again, h, steps);
        assert_eq!(again, together, "{threads} threads");
    }
    let far = alone.iter().zip(&together).map(|(a, b)| apart(a, b));
    far.fold(0.0, f64::max)
}

fn starts(count: usize) -> impl Strategy<Value = Vec<State<SO3>>> {
    let turn = [-1.0..1.0, -1.0..1.0, -1.0..1.0_f64];
    let momentum = [-2.0..2.0, -2.0..2.0, -2.0..2.0_f64];
    let start = (turn, momentum).prop_map(|(turn, mu)| turned(turn, mu));
    proptest::collection::vec(start, 1..count)
}

/// Forty steps, each solved to a few roundings, which the motion of a top lets grow by less than this.
const ROUNDING: f64 = 1e-13;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn any_number_of_starts_is_as_one_by_one(starts in starts(40), stages in 1_usize..=8) {
        let recorded = compare(&Top.hamiltonian(), stages, &starts, (0.05, 20));
        prop_assert!(recorded < ROUNDING, "recorded: {recorded:e}");
        let by_hand = compare(&Body, stages, &starts, (0.05, 20));
        prop_assert!(by_hand < ROUNDING, "by hand: {by_hand:e}");
    }

    /// Some need Newton's method and some are refused, each as if it were alone.
    #[test]
    fn long_steps_are_solved_one_by_one(starts in starts(20)) {
        // Newton's steps end where the change is rounding, seven seconds on.
        let apart = compare(&Top.hamiltonian(), 4, &starts, (0.7, 5));
        prop_assert!(apart < 1e-10, "{apart:e}");
    }
}

/// A trajectory that fails is told with its step, stays as it was, and the others do not feel it.
#[test]
fn the_others_go_on() {
    let mut starts: Vec<_> = (0..19)
        .map(|i| turned([0.1 * f64::from(i), -0.3, 0.2], [0.3, 0.2, -0.1]))
        .collect();
    let mut sound = starts.clone();
    starts[3].mu.0[1] = f64::NAN;
    starts[11].t = 98.55;
    starts[17].t = f64::NAN;
    let before = starts.clone();
    let mut ensemble = Ensemble::new::<3>(Body);
    let outcomes = ensemble.advance(&mut starts, 0.1, 30);
    let failed: Vec<_> = (0..19).filter(|i| outcomes[*i].is_err()).collect();
    assert_eq!(failed, [3, 11, 17]);
    let error = outcomes[3].expect_err("a momentum that is no number");
    assert_eq!((error.step, error.cause), (0, Cause::NotFinite));
    let error = outcomes[11].expect_err("a start near the end");
    assert_eq!((error.step, error.cause), (14, Cause::NotFinite));
    assert!((starts[11].t - 99.95).abs() < 1e-12);
    assert_eq!(format!("{:?}", starts[17]), format!("{:?}", before[17]));

    one_by_one(&Body, 3, &mut sound, (0.1, 30));
    let others = (0..19).filter(|i| !failed.contains(i));
    let far = others.map(|i| apart(&sound[i], &starts[i]));
    assert!(far.fold(0.0, f64::max) < ROUNDING);
}

/// Systems of many bodies, and systems that have no lanes.
#[test]
fn whatever_the_system() {
    let start = |i: u32| State {
        t: f64::from(i),
        ..bent(4, false)
    };
    let starts: Vec<_> = (0..9).map(start).collect();
    let far = compare(&BEAM.hamiltonian(), 2, &starts, (1e-3, 5));
    assert!(far < 1e-12, "{far:e}");
    let starts = (0..3).map(|i| State {
        t: 0.0,
        g: Rn([0.5 + f64::from(i)]),
        mu: Cotangent([0.1]),
    });
    let starts: Vec<_> = starts.collect();
    assert_eq!(compare(&Branching.hamiltonian(), 2, &starts, (0.1, 5)), 0.0);
}

/// What is told of a recording's steps; and no states, no steps, a step of no length.
#[test]
fn reports() {
    let mut states = vec![turned([0.1, 0.2, 0.3], [1.0, 0.5, 0.2]); 5];
    let mut ensemble = Ensemble::new::<2>(Top.hamiltonian());
    assert!(ensemble.advance(&mut [], 0.1, 3).is_empty());
    let none = ensemble.advance(&mut states, 0.1, 0);
    assert!(
        none.iter()
            .all(|outcome| *outcome == Ok(StepReport::default()))
    );
    for outcome in ensemble.advance(&mut states, 0.0, 1) {
        assert_eq!(outcome.expect_err("no step").cause, Cause::InvalidStep);
    }
    for outcome in ensemble.advance(&mut states, 0.1, 2) {
        let report = outcome.expect("a step");
        assert_eq!(report.means, Means::Recorded);
        assert_eq!(report.evaluations, 2 * report.iterations);
        assert!(report.residual < 1e-13 && report.iterations > 2);
    }
}

#[test]
fn by_any_instructions() {
    let starts: Vec<_> = (0..11)
        .map(|i| turned([0.1 * f64::from(i), 0.3, 0.2], [1.0, 0.5, 0.2]))
        .collect();
    let run = |set| {
        let mut states = starts.clone();
        let mut ensemble = Ensemble::new::<4>(Top.hamiltonian()).with_instructions(set);
        ensemble.advance(&mut states, 0.1, 20);
        states
    };
    let plain = run(InstructionSet::Baseline);
    for set in InstructionSet::available() {
        let states = run(set);
        let far = plain.iter().zip(&states).map(|(a, b)| apart(a, b));
        assert!(far.fold(0.0, f64::max) < ROUNDING, "{set}");
    }
}
