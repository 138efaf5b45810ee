//! What is no model is refused, with the place of the fault.

use articulated_fluid::{ArticulatedBody, Body, Configuration, Joint, ModelError};
use dvi::{Lagrangian, ShapeError, State};
use lie::{Cotangent, LieGroup, Mat3, Power, R3, SO3, Vec3};
use proptest::prelude::*;

use crate::common::*;

fn sound() -> Body {
    Body::new(
        Mat3([[2.0, 0.5, 0.0], [0.5, 1.0, 0.25], [0.0, 0.25, 3.0]]),
        Mat3::diagonal([1.0, 2.0, 4.0]),
    )
}

fn joint(parent: usize, child: usize) -> Joint {
    Joint {
        parent,
        child,
        at_parent: Vec3([1.0, 0.0, 0.5]),
        at_child: Vec3([-1.0, 0.25, 0.0]),
        kind: Default::default(),
    }
}

fn refusal(bodies: &[Body], joints: &[Joint]) -> ModelError {
    ArticulatedBody::new(bodies, joints).expect_err("no model")
}

/// Matrices that are no inertia.
fn unsound() -> Vec<Mat3> {
    let with = |i: usize, j: usize, x: f64| {
        let mut matrix = Mat3::diagonal([1.0, 2.0, 3.0]);
        matrix[(i, j)] = x;
        matrix
    };
    let mut matrices = vec![
        with(0, 1, 1e-9),
        with(2, 2, 0.0),
        Mat3([[1.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        // Two negative eigenvalues: the determinant alone does not show it.
        Mat3::diagonal([-1.0, -1.0, 1.0]),
        Mat3::diagonal([1.0, -1.0, -1.0]),
        // All negative: so is the trace.
        Mat3::diagonal([-1.0, -2.0, -1.5]),
        Mat3::zero(),
    ];
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        matrices.extend((0..9).map(|k| with(k / 3, k % 3, x)));
    }
    matrices
}

#[test]
fn nothing_is_no_model() {
    assert_eq!(refusal(&[], &[]), ModelError::NoBody);
    assert_eq!(refusal(&[], &[joint(0, 1)]), ModelError::NoBody);
}

#[test]
fn a_matrix_that_is_not_positive_definite_is_named() {
    for matrix in unsound() {
        for index in 0..3 {
            let joints = [joint(0, 1), joint(0, 2)];
            let mut bodies = [sound(); 3];
            bodies[index].mass = matrix;
            let expected = |matrix| ModelError::NotPositiveDefinite {
                body: index,
                matrix,
            };
            assert_eq!(refusal(&bodies, &joints), expected("mass"), "{matrix:?}");
            bodies[index] = sound();
            bodies[index].inertia = matrix;
            assert_eq!(refusal(&bodies, &joints), expected("inertia"), "{matrix:?}");
        }
    }
}

#[test]
fn every_body_but_the_first_hangs_on_one_joint() {
    let bodies = [sound(); 3];
    let count = |joints: &[Joint]| refusal(&bodies, joints);
    let expected = |body, count| ModelError::Joints { body, count };
    assert_eq!(count(&[]), expected(1, 0));
    assert_eq!(count(&[joint(0, 1)]), expected(2, 0));
    assert_eq!(count(&[joint(0, 2)]), expected(1, 0));
    let twice = [joint(0, 2), joint(0, 1), joint(0, 2), joint(0, 2)];
    assert_eq!(count(&twice), expected(2, 3));
}

#[test]
fn a_joint_leads_from_a_body_to_a_later_one_at_finite_points() {
    let bodies = [sound(); 3];
    let expected = |index: usize, joint: Joint| ModelError::Joint {
        joint: index,
        parent: joint.parent,
        child: joint.child,
        last: 2,
    };
    let mut wrong = vec![
        joint(2, 1),
        joint(2, 2),
        joint(0, 0),
        joint(0, 3),
        joint(7, 9),
    ];
    for x in [f64::NAN, f64::INFINITY] {
        for i in 0..3 {
            let (mut on_parent, mut on_child) = (joint(0, 2), joint(0, 2));
            on_parent.at_parent[i] = x;
            on_child.at_child[i] = x;
            wrong.extend([on_parent, on_child]);
        }
    }
    for wrong in wrong {
        let first = refusal(&bodies, &[wrong.clone(), joint(0, 1)]);
        assert_eq!(first, expected(0, wrong.clone()));
        let second = refusal(&bodies, &[joint(0, 1), wrong.clone()]);
        assert_eq!(second, expected(1, wrong));
    }
}

#[test]
fn a_tree_that_is_no_tree_is_refused() {
    let bodies = [sound(); 4];
    // A ring beside the first body, and two parents of one body.
    let ring = [joint(0, 1), joint(3, 2), joint(2, 3)];
    let refused = |index, parent, child| ModelError::Joint {
        joint: index,
        parent,
        child,
        last: 3,
    };
    assert_eq!(refusal(&bodies, &ring), refused(1, 3, 2));
    let shared = [joint(0, 1), joint(0, 2), joint(1, 3), joint(2, 3)];
    let expected = ModelError::Joints { body: 3, count: 2 };
    assert_eq!(refusal(&bodies, &shared), expected);
    let chain = [joint(2, 3), joint(0, 1), joint(1, 2)];
    assert!(ArticulatedBody::new(&bodies, &chain).is_ok());
}

#[test]
fn what_overflows_is_refused() {
    for (index, size) in [(1, 1e160), (2, 1e300)] {
        let mut joints = [joint(0, 1), joint(1, 2)];
        joints[index - 1].at_child = Vec3([size, 0.0, 0.0]);
        let refused = refusal(&[sound(); 3], &joints);
        assert_eq!(refused, ModelError::OutOfRange { body: index });
    }
}

#[test]
fn a_weight_that_is_none_is_refused() {
    let joints = [joint(0, 1), joint(1, 2)];
    let model = ArticulatedBody::new(&[sound(); 3], &joints).expect("a model");
    let down = Vec3([0.0, 0.0, -9.81]);
    for found in [0, 2, 4] {
        let refused = model.clone().with_gravity(down, &vec![1.0; found]);
        let expected = ModelError::NetMasses { expected: 3, found };
        assert_eq!(refused, Err(expected));
    }
    let expected = Err(ModelError::NotFinite { quantity: "weight" });
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for i in 0..3 {
            let (mut gravity, mut masses) = (down, [1.0, -1.0, 0.5]);
            gravity[i] = x;
            assert_eq!(model.clone().with_gravity(gravity, &masses), expected);
            masses[i] = x;
            assert_eq!(model.clone().with_gravity(down, &masses), expected);
        }
    }
    let too_much = [f64::MAX, f64::MAX, 0.0];
    assert_eq!(model.clone().with_gravity(down, &too_much), expected);
    assert!(model.with_gravity(down, &[1.0, -1.0, 0.5]).is_ok());
}

#[test]
fn a_stiffness_that_is_none_is_refused() {
    let joints = [joint(0, 1), joint(1, 2)];
    let model = ArticulatedBody::new(&[sound(); 3], &joints).expect("a model");
    for found in [0, 1, 3] {
        let refused = model.clone().with_stiffness(&vec![1.0; found]);
        let expected = ModelError::Stiffnesses { expected: 2, found };
        assert_eq!(refused, Err(expected));
    }
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1e-300] {
        let refused = model
            .clone()
            .with_stiffness(&[2.0, x])
            .expect_err("no spring");
        assert!(matches!(refused, ModelError::Stiffness { body: 2, .. }));
        let message = format!("the stiffness of the joint of body 2 is {x:?}");
        assert!(refused.to_string().starts_with(&message), "{refused}");
    }
    // Without stiffness it is the same model.
    let free = model
        .clone()
        .with_stiffness(&[0.0, -0.0])
        .expect("free joints");
    assert_eq!(free, model);
    assert_ne!(
        model.clone().with_stiffness(&[0.0, 1.0]).expect("springs"),
        model
    );
}

/// Of so many bodies, all attitudes the identity.
fn configuration(bodies: usize) -> Configuration {
    (
        Power::new(vec![SO3::identity(); bodies]),
        alone(R3::identity()),
        Power::new(vec![]),
    )
}

#[test]
fn a_state_with_another_number_of_bodies_is_refused() {
    let joints = [joint(0, 1), joint(0, 2)];
    let model = ArticulatedBody::new(&[sound(); 3], &joints).expect("a model");
    let state = |attitudes: usize, momenta: usize| State {
        t: 0.0,
        g: configuration(attitudes),
        mu: (
            Power::new(vec![Cotangent::zero(); momenta]),
            alone(Cotangent::zero()),
            Power::new(vec![]),
        ),
    };
    for (attitudes, momenta, found) in [
        (0, 0, 0),
        (1, 1, 1),
        (2, 2, 2),
        (4, 4, 4),
        (4, 3, 4),
        (3, 5, 5),
    ] {
        let refused = ModelError::Shape {
            expected: [3, 1, 0],
            found: [found, 1, 0],
        };
        let state = state(attitudes, momenta);
        assert_eq!(model.conserved(&state), Err(refused.clone()));
        assert_eq!(model.velocity(&state), Err(refused));
    }
    assert!(model.conserved(&state(3, 3)).is_ok());
    assert!(model.conserved(&state(3, 2)).is_err());
    for translations in [0, 2] {
        let (mut nowhere, mut unmoved) = (state(3, 3), state(3, 3));
        nowhere.g.1 = Power::new(vec![R3::identity(); translations]);
        unmoved.mu.1 = Power::new(vec![Cotangent::zero(); translations]);
        for state in [nowhere, unmoved] {
            assert!(model.conserved(&state).is_err());
            assert!(model.velocity(&state).is_err());
        }
    }
}

#[test]
fn a_velocity_of_another_number_of_bodies_is_refused() {
    let joints = [joint(0, 1), joint(0, 2)];
    let model = ArticulatedBody::new(&[sound(); 3], &joints).expect("a model");
    for (attitudes, rates) in [(3, 2), (3, 4), (2, 2), (4, 4), (0, 0)] {
        let refused = match attitudes {
            3 => ShapeError::Velocity {
                expected: 12,
                found: 3 + 3 * rates,
            },
            _ => ShapeError::Configuration,
        };
        let xi = configuration(rates).zero_algebra();
        let state = model.state(0.0, configuration(attitudes), &xi);
        assert_eq!(state, Err(refused));
    }
    let mut twice = configuration(3);
    twice.1 = Power::new(vec![R3::identity(); 2]);
    let xi = twice.zero_algebra();
    let state = model.state(0.0, twice, &xi);
    assert_eq!(state, Err(ShapeError::Configuration));
}

#[test]
fn the_messages_name_the_fault() {
    let message = |bodies: &[Body], joints: &[Joint]| refusal(bodies, joints).to_string();
    let mut bodies = [sound(); 2];
    assert!(message(&[], &[]).contains("at least one body"));
    assert!(message(&bodies, &[]).contains("body 1 hangs on 0 joints"));
    assert!(message(&bodies, &[joint(1, 5)]).contains("joint 0 from body 1 to body 5"));
    bodies[1].mass = Mat3::zero();
    assert!(message(&bodies, &[joint(0, 1)]).contains("the mass of body 1"));
}

/// Any double: NaN, infinities, zeros and subnormals too.
fn wild() -> impl Strategy<Value = f64> {
    prop_oneof![prop::num::f64::ANY, -2.0..2.0]
}

fn wild_body() -> impl Strategy<Value = Body> {
    let matrix = || prop::array::uniform3(prop::array::uniform3(wild())).prop_map(Mat3);
    let diagonal = prop::array::uniform3(prop::num::f64::ANY).prop_map(Mat3::diagonal);
    let mass = prop_oneof![spd(), matrix(), diagonal];
    (mass, prop_oneof![spd(), matrix()]).prop_map(|(mass, inertia)| Body::new(mass, inertia))
}

fn wild_joint() -> impl Strategy<Value = Joint> {
    let point = || prop_oneof![vector(1.0), prop::array::uniform3(wild()).prop_map(Vec3)];
    let ends = (
        prop_oneof![Just(0), 0..3_usize],
        prop_oneof![0..4_usize, Just(usize::MAX)],
    );
    (ends, point(), point()).prop_map(|((parent, child), at_parent, at_child)| Joint {
        parent,
        child,
        at_parent,
        at_child,
        kind: Default::default(),
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn whatever_is_given_is_a_model_or_refused(
        bodies in prop::collection::vec(wild_body(), 0..4),
        joints in prop::collection::vec(wild_joint(), 0..4),
    ) {
        match ArticulatedBody::new(&bodies, &joints) {
            Ok(model) => {
                prop_assert_eq!(model.bodies().len(), bodies.len());
                prop_assert_eq!(joints.len(), model.joints().len());
                for body in &bodies {
                    let entries = [body.mass.0, body.inertia.0].concat();
                    prop_assert!(entries.iter().flatten().all(|x| x.is_finite()));
                }
            }
            Err(error) => prop_assert!(!error.to_string().contains('\n')),
        }
    }

    #[test]
    fn a_model_gives_back_what_it_was_made_from(sample in any_sample(), turn in 0..4_usize) {
        let Sample { bodies, joints, model, .. } = &sample;
        prop_assert_eq!(&model.bodies().collect::<Vec<_>>(), bodies);
        prop_assert_eq!(&model.joints().collect::<Vec<_>>(), joints);
        // The joints may come in any order.
        let mut shuffled = joints.clone();
        shuffled.rotate_left(turn.min(joints.len()));
        let shuffled = build(bodies, &shuffled, &sample.weight);
        prop_assert_eq!(&shuffled.with_stiffness(&sample.stiffnesses).expect("springs"), model);
    }
}
