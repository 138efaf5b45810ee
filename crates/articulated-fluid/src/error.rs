//! What can be wrong with a model's parameters.

use thiserror::Error;

/// Why a model was refused.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// There is no body.
    #[error("a model has at least one body; give the head")]
    NoBody,
    /// A matrix of a body is not symmetric and positive definite, or not finite.
    #[error(
        "the {matrix} of body {body} is not symmetric and positive definite; expected the body's plus the added one, in the body's frame"
    )]
    NotPositiveDefinite {
        /// Index of the body.
        body: usize,
        /// Which matrix.
        matrix: &'static str,
    },
    /// The numbers of a body or its joint are so large or small that what follows from them is not finite.
    #[error(
        "the inertia of body {body} and its joint overflows; expected masses and lengths in kg and m of moderate size"
    )]
    OutOfRange {
        /// Index of the body.
        body: usize,
    },
    /// The joints do not hang every body but the first on another one.
    #[error(
        "body {body} hangs on {count} joints; expected one joint to each body but body 0, which is free"
    )]
    Joints {
        /// Index of the body.
        body: usize,
        /// Joints that lead to it.
        count: usize,
    },
    /// A joint names a body that is not there, hangs a body on itself or on a later one, or lies at no finite point.
    #[error(
        "joint {joint} from body {parent} to body {child} is not possible: expected a child between 1 and {last}, a parent that comes before it, and finite points"
    )]
    Joint {
        /// Index of the joint.
        joint: usize,
        /// Its parent.
        parent: usize,
        /// Its child.
        child: usize,
        /// Index of the last body.
        last: usize,
    },
    /// A hinge has no axis of length 1, or its angle at rest is not finite.
    #[error(
        "the hinge of body {body} has no unit axis or no finite angle at rest; make it by JointKind::hinge"
    )]
    Hinge {
        /// Index of the body that hangs on it.
        body: usize,
    },
    /// There is not one net mass for each body.
    #[error("there are {found} net masses for {expected} bodies; expected one for each")]
    NetMasses {
        /// Bodies of the model.
        expected: usize,
        /// Net masses given.
        found: usize,
    },
    /// There is not one stiffness for each joint.
    #[error("there are {found} stiffnesses for {expected} joints; expected one for each")]
    Stiffnesses {
        /// Joints of the model.
        expected: usize,
        /// Stiffnesses given.
        found: usize,
    },
    /// A stiffness is negative or not finite.
    #[error(
        "the stiffness of the joint of body {body} is {stiffness:?}; expected a finite number >= 0, in N m"
    )]
    Stiffness {
        /// Index of the body that hangs on the joint.
        body: usize,
        /// The stiffness given, N m.
        stiffness: f64,
    },
    /// A load that the body or its joint cannot have.
    #[error(
        "the load of body {body} does not suit: expected finite numbers >= 0, and in a free joint a law of its kind, of a hinge or of a ball"
    )]
    Load {
        /// Index of the body.
        body: usize,
    },
    /// A joint that leaves nothing free has a spring.
    #[error(
        "the joint of body {body} is fixed or prescribed and has a spring; give it no stiffness"
    )]
    Spring {
        /// Index of the body that hangs on the joint.
        body: usize,
    },
    /// A state has, or leads to, a number that is not finite.
    #[error("the state's {quantity} is not finite; check attitudes, velocities and the step")]
    NotFinite {
        /// What is not finite.
        quantity: &'static str,
    },
    /// The state has other unknowns than the model.
    #[error(
        "the state has {} attitudes, {} positions and {} hinge angles, the model {}, {} and {}",
        found[0], found[1], found[2], expected[0], expected[1], expected[2]
    )]
    Shape {
        /// Attitudes, positions and hinge angles of the model.
        expected: [usize; 3],
        /// Those of the state.
        found: [usize; 3],
    },
}
