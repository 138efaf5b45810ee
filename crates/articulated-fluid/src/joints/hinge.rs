//! A hinge: it leaves one angle free, so that one row of $(H, -K^T; -K, A)$ is eliminated and the rest handed up, (S12).

use lie::{LieGroup, Mat3, SO3, Scalar, Sym3, Tangent, Vec3};

use super::link::Link;

/// A hinge about an axis: $C = K \exp(q \hat s)$.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// The unit vector $s$, in the child's frame.
    pub axis: Vec3,
    /// $K$, the attitude on the parent at the angle 0.
    pub rest: SO3,
    /// $q_0$, where a spring in the hinge is at rest, rad.
    pub rest_angle: f64,
}

impl Hinge {
    /// About an axis of any length, with this attitude on the parent at the angle 0.
    pub(crate) fn new(axis: Vec3, rest: SO3) -> Self {
        let axis = axis * (1.0 / axis.norm());
        Self {
            axis,
            rest,
            rest_angle: 0.0,
        }
    }

    /// Whether the axis is a unit vector, the attitude a rotation, and the angle finite.
    pub(crate) fn is_sound(&self) -> bool {
        let off = (self.axis.norm() - 1.0).abs();
        off <= 1e-12 && self.rest.orthogonality_error() <= 1e-6 && self.rest_angle.is_finite()
    }

    /// $\exp(q \hat s)$.
    #[inline(always)]
    fn turn<S: Scalar>(&self, q: S) -> SO3<S> {
        SO3::exp(&Tangent((self.axis.lift() * q).0))
    }

    /// $C = K \exp(q \hat s)$.
    #[inline(always)]
    pub(crate) fn relative<S: Scalar>(&self, q: S) -> SO3<S> {
        let turned = self.rest.matrix().lift::<S>() * *self.turn(q).matrix();
        SO3::from_matrix_unchecked(turned)
    }

    /// $C^T C_+ - I = \exp(\Delta q\, \hat s) - I$, which does not cancel.
    #[inline(always)]
    pub(crate) fn turn_minus_identity<S: Scalar>(&self, dq: S) -> Mat3<S> {
        self.turn(dq).minus_identity()
    }
}

/// What a hinge keeps of its elimination.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HingeFactors<S> {
    /// $H s$.
    h: Vec3<S>,
    /// $K s$.
    k: Vec3<S>,
    /// $1 / D$ with $D = s \cdot H s$, and $h d$ of a damper.
    inverse: S,
    /// $(\pi - s \cdot \nu) / D$.
    free: S,
    /// $\dot q$.
    pub(crate) rate: S,
    /// The moment $n$ about the joint, all that hangs on it included.
    pub(crate) moment: Vec3<S>,
}

impl<S: Scalar> HingeFactors<S> {
    pub(crate) fn at_rest() -> Self {
        let (zero, none) = (Vec3::zero(), S::zero());
        Self {
            h: zero,
            k: zero,
            inverse: none,
            free: none,
            rate: none,
            moment: zero,
        }
    }
}

impl HingeFactors<f64> {
    /// Whether $D > 0$.
    pub(crate) fn is_positive(&self) -> bool {
        self.inverse > 0.0
    }
}

impl<S: Scalar> Link<S> {
    /// $\Lambda^\ast = \Lambda - \Lambda S D^{-1} S^T \Lambda$ with $S = (s; 0)$; a damper's $h d$ is in $D$, (S23).
    #[inline(always)]
    pub(crate) fn eliminate_hinge(
        &mut self,
        axis: Vec3<S>,
        resistance: Option<S>,
        factors: &mut HingeFactors<S>,
    ) {
        let (h, k) = (self.h * axis, self.x * axis);
        let mut own = axis.dot(h);
        if let Some(by) = resistance {
            own += by;
        }
        let inverse = S::one() / own;
        let (hd, kd) = (h * inverse, k * inverse);
        self.h -= Sym3::upper(&hd.outer(h));
        self.x -= kd.outer(h);
        self.mass -= Sym3::upper(&kd.outer(k));
        (factors.h, factors.k, factors.inverse) = (h, k, inverse);
    }

    /// $\beta^\ast = \beta + \Lambda S D^{-1} (\pi - S^T \beta)$.
    #[inline(always)]
    pub(crate) fn eliminate_hinge_force(
        &mut self,
        axis: Vec3<S>,
        momentum: S,
        factors: &mut HingeFactors<S>,
    ) {
        let free = (momentum + axis.dot(self.w)) * factors.inverse;
        self.force -= factors.k * free;
        self.w -= factors.h * free;
        factors.free = free;
    }

    /// $\dot q = D^{-1} (\pi - S^T \beta - S^T \Lambda y')$ and $\Omega_i$, from what the parent hands on.
    #[inline(always)]
    pub(crate) fn advance_hinge(
        &mut self,
        axis: Vec3<S>,
        (turning, u): (Vec3<S>, Vec3<S>),
        factors: &mut HingeFactors<S>,
    ) {
        let carried = factors.h.dot(turning) - factors.k.dot(u);
        factors.rate = factors.free - carried * factors.inverse;
        self.omega = turning + axis * factors.rate;
    }
}
