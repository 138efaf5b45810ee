//! The attitude of a body on its parent, as told.

use core::fmt;
use std::sync::Arc;

use lie::{LieGroup, Mat3, SO3, Scalar, Tangent, Vec3};

use super::law::{self, Law, Timed};

/// A prescribed attitude $Q(t)$ of a body relative to its parent, and its rate $a = (Q^T \dot Q)^\vee$, (S1) of the swimming tree.
#[derive(Clone)]
pub enum Motion {
    /// A weld, $Q = K$.
    Fixed(SO3),
    /// $Q = K \exp(q(t) \hat s)$ with the unit vector $s$ in the body's frame.
    Hinge {
        /// $s$.
        axis: Vec3,
        /// $K$.
        rest: SO3,
        /// $q$, rad.
        angle: Arc<dyn Law<1>>,
    },
    /// $Q = K \exp(\hat\theta(t))$.
    Ball {
        /// $K$.
        rest: SO3,
        /// The rotation vector $\theta$, rad.
        turn: Arc<dyn Law<3>>,
    },
    /// $t \mapsto (Q, a)$, in rad/s. Its second derivative is not known: where one is asked for, it is not a number.
    Function(Arc<dyn Fn(f64) -> (SO3, Vec3) + Send + Sync>),
}

impl fmt::Debug for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(rest) => f.debug_tuple("Fixed").field(rest).finish(),
            Self::Hinge { axis, rest, angle } => f
                .debug_struct("Hinge")
                .field("axis", axis)
                .field("rest", rest)
                .field("angle", angle)
                .finish(),
            Self::Ball { rest, turn } => f
                .debug_struct("Ball")
                .field("rest", rest)
                .field("turn", turn)
                .finish(),
            Self::Function(_) => f.write_str("Function"),
        }
    }
}

impl PartialEq for Motion {
    /// Laws are the same where they are one and the same.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Fixed(a), Self::Fixed(b)) => a == b,
            (
                Self::Hinge { axis, rest, angle },
                Self::Hinge {
                    axis: a,
                    rest: r,
                    angle: q,
                },
            ) => axis == a && rest == r && Arc::ptr_eq(angle, q),
            (Self::Ball { rest, turn }, Self::Ball { rest: r, turn: t }) => {
                rest == r && Arc::ptr_eq(turn, t)
            }
            (Self::Function(a), Self::Function(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

impl Motion {
    /// What it is told by, if it is a law.
    fn law(&self) -> Option<&dyn Timed> {
        match self {
            Self::Hinge { angle, .. } => Some(angle),
            Self::Ball { turn, .. } => Some(turn),
            Self::Fixed(_) | Self::Function(_) => None,
        }
    }

    /// Whether it does anything: a weld does not, nor a constant law.
    pub fn is_driven(&self) -> bool {
        let moves = matches!(self, Self::Function(_));
        self.law().map_or(moves, |law| !law.is_constant())
    }

    /// From when to when it is [told](Law::told), s.
    pub fn told(&self) -> [f64; 2] {
        let always = [f64::NEG_INFINITY, f64::INFINITY];
        self.law().map_or(always, Timed::told)
    }

    /// From when on it [repeats](Law::repeats) itself, and after how long, s.
    pub fn repeats(&self) -> Option<[f64; 2]> {
        let still = matches!(self, Self::Fixed(_)).then_some([0.0; 2]);
        self.law().map_or(still, Timed::repeats)
    }

    /// How fast it changes in the first seconds, rad/s.
    pub(crate) fn rate(&self, until: f64) -> f64 {
        self.law().map_or(0.0, |law| law.rate(until))
    }

    /// The angle of a hinge, rad, and its rate; of the others, not a number.
    pub(crate) fn angle<S: Scalar>(&self, t: S) -> [S; 2] {
        match self {
            Self::Hinge { angle, .. } => law::at(angle.as_ref(), t).map(|[x]| x),
            _ => [S::from_f64(f64::NAN); 2],
        }
    }

    /// $Q(t)$ and $a(t)$, rad/s in the body's frame.
    pub fn at<S: Scalar>(&self, t: S) -> (SO3<S>, Vec3<S>) {
        match self {
            Self::Fixed(rest) => (lift(rest), Vec3::zero()),
            Self::Hinge { axis, rest, angle } => {
                let [[q], [rate]] = law::at(angle.as_ref(), t);
                let turn = SO3::exp(&Tangent((axis.lift() * q).0));
                (lift(rest).compose(&turn), axis.lift() * rate)
            }
            Self::Ball { rest, turn } => {
                let [theta, rate] = law::at(turn.as_ref(), t);
                let theta = Tangent(theta);
                // The left-trivialised differential: exp(θ)^T d exp(θ).
                let rate = SO3::d_left::<lie::Exp>(&theta, &Tangent(rate));
                (lift(rest).compose(&SO3::exp(&theta)), rate.vec3())
            }
            Self::Function(f) => function(f.as_ref(), t),
        }
    }
}

fn function<S: Scalar>(f: &dyn Fn(f64) -> (SO3, Vec3), t: S) -> (SO3<S>, Vec3<S>) {
    let entries = t.smooth(&|t, k| {
        let (q, a) = f(t);
        let rows = match k {
            0 => *q.matrix(),
            1 => *q.matrix() * a.hat(),
            _ => Mat3([[f64::NAN; 3]; 3]),
        };
        flat(rows)
    });
    let rate = t.smooth(&|t, k| match k {
        0 => f(t).1.0,
        _ => [f64::NAN; 3],
    });
    let row = |i: usize| core::array::from_fn(|j| entries[3 * i + j]);
    let matrix = Mat3([row(0), row(1), row(2)]);
    (SO3::from_matrix_unchecked(matrix), Vec3(rate))
}

fn flat(m: Mat3) -> [f64; 9] {
    core::array::from_fn(|k| m.0[k / 3][k % 3])
}

fn lift<S: Scalar>(r: &SO3) -> SO3<S> {
    SO3::from_matrix_unchecked(r.matrix().lift())
}
