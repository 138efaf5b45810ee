//! Joints by their coordinates in the shape.

use articulated_fluid::{JointKind, Motion};
use lie::{Exp, LieGroup, SO3, Scalar, Tangent, Vec3};

/// What moves a joint, with the first of its coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Turning {
    Fixed,
    Hinge { axis: Vec3, first: usize },
    Ball { first: usize },
}

/// A joint that moves as told, or not at all.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Steered {
    pub(crate) rest: SO3,
    pub(crate) turning: Turning,
}

impl Steered {
    /// The joint with its coordinates from `first` on; none where it is free, or its motion is no law of such coordinates.
    pub(crate) fn of(kind: &JointKind, first: usize) -> Option<Self> {
        let (rest, turning) = match kind {
            JointKind::Prescribed(Motion::Fixed(rest)) => (rest, Turning::Fixed),
            JointKind::Prescribed(Motion::Hinge { axis, rest, .. }) => {
                (rest, Turning::Hinge { axis: *axis, first })
            }
            JointKind::Prescribed(Motion::Ball { rest, .. }) => (rest, Turning::Ball { first }),
            _ => return None,
        };
        Some(Self {
            rest: *rest,
            turning,
        })
    }

    /// How many coordinates it has.
    pub(crate) fn dim(&self) -> usize {
        match self.turning {
            Turning::Fixed => 0,
            Turning::Hinge { .. } => 1,
            Turning::Ball { .. } => 3,
        }
    }

    /// The attitude on the parent, and the angular velocity in the body's frame for a unit rate of each coordinate, (S1).
    pub(crate) fn turn<S: Scalar>(&self, q: &[S]) -> (SO3<S>, Vec<Vec3<S>>) {
        let rest = SO3::from_matrix_unchecked(self.rest.matrix().lift());
        match self.turning {
            Turning::Fixed => (rest, vec![]),
            Turning::Hinge { axis, first } => {
                let axis = axis.lift();
                let turn = SO3::exp(&Tangent((axis * q[first]).0));
                (rest.compose(&turn), vec![axis])
            }
            Turning::Ball { first } => {
                let theta = Tangent([q[first], q[first + 1], q[first + 2]]);
                let rate = |k: usize| {
                    let mut unit = Tangent::zero();
                    unit[k] = S::one();
                    SO3::d_left::<Exp>(&theta, &unit).vec3()
                };
                let turn = SO3::exp(&theta);
                (rest.compose(&turn), (0..3).map(rate).collect())
            }
        }
    }

    /// The attitude on the parent and its rate, of a shape and its rates.
    pub(crate) fn at<S: Scalar>(&self, q: &[S], rates: &[S]) -> (SO3<S>, Vec3<S>) {
        let (attitude, units) = self.turn(q);
        let first = match self.turning {
            Turning::Fixed => 0,
            Turning::Hinge { first, .. } | Turning::Ball { first } => first,
        };
        let each = units.iter().zip(&rates[first..]);
        (
            attitude,
            each.fold(Vec3::zero(), |sum, (unit, rate)| sum + *unit * *rate),
        )
    }
}
