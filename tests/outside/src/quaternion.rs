//! The unit quaternions: the double cover of the rotations.

use lgvi::lie::{Cotangent, LieGroup, NotUnique, Over, SO3, Scalar, Tangent, Vec3};

/// A unit quaternion $q = w + v$, an element of $S^3$; $q$ and $-q$ turn a vector alike.
///
/// The algebra's coordinates are those of the angular velocity in the body's frame, $\dot q = \frac12 q\, \Omega$: so velocities
/// and momenta are those of [`SO3`], and $\exp\xi = \cos\frac\theta2 + \frac{\sin(\theta/2)}{\theta}\, \xi$ with $\theta = |\xi|$.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitQuaternion<S = f64> {
    w: S,
    v: Vec3<S>,
}

impl<S: Scalar> UnitQuaternion<S> {
    /// $q x q^{-1} = x + 2 w\, v \times x + 2 v \times (v \times x)$.
    pub fn rotate(&self, x: Vec3<S>) -> Vec3<S> {
        let once = self.v.cross(x) * S::from_f64(2.0);
        x + once * self.w + self.v.cross(once)
    }

    /// The rotation that it covers.
    pub fn rotation(&self) -> SO3<S> {
        let [x, y, z] = self.v.0;
        SO3::from_quaternion([self.w, x, y, z])
    }

    /// The real part $w = \cos\frac\theta2$: $1$ at the identity, $-1$ after a full turn.
    pub fn real(&self) -> S {
        self.w
    }
}

impl<S: Scalar> LieGroup for UnitQuaternion<S> {
    type Scalar = S;
    type Algebra = Tangent<3, S>;
    type Dual = Cotangent<3, S>;
    type WithScalar<T: Scalar> = UnitQuaternion<T>;

    fn zero_algebra(&self) -> Tangent<3, S> {
        Tangent::zero()
    }
    fn zero_dual(&self) -> Cotangent<3, S> {
        Cotangent::zero()
    }
    fn convert<A: Scalar, B: Scalar>(
        g: &UnitQuaternion<A>,
        f: impl Fn(A) -> B + Copy,
    ) -> Over<Self, B> {
        UnitQuaternion {
            w: f(g.w),
            v: Vec3(g.v.0.map(f)),
        }
    }
    fn compose(&self, h: &Self) -> Self {
        Self {
            w: self.w * h.w - self.v.dot(h.v),
            v: h.v * self.w + self.v * h.w + self.v.cross(h.v),
        }
    }
    fn inverse(&self) -> Self {
        Self {
            w: self.w,
            v: -self.v,
        }
    }
    fn exp(xi: &Tangent<3, S>) -> Self {
        let half = xi.vec3() * S::from_f64(0.5);
        let [cos, sinc] = cos_and_sinc(half.norm_squared());
        Self {
            w: cos,
            v: half * sinc,
        }
    }
    fn log(&self) -> Result<Tangent<3, S>, NotUnique<Tangent<3, S>>> {
        let (square, two) = (self.v.norm_squared(), S::from_f64(2.0));
        let full_turn =
            square.magnitude().sqrt() <= 4.0 * S::EPSILON && (self.w - S::one()).magnitude() > 1.0;
        if full_turn {
            let angle = S::from_f64(core::f64::consts::TAU);
            let representative = Tangent([angle, S::zero(), S::zero()]);
            return Err(NotUnique { representative });
        }
        Ok((self.v * (angle_over_sine(square, self.w) * two)).into())
    }
    fn adjoint(&self, xi: &Tangent<3, S>) -> Tangent<3, S> {
        self.rotate(xi.vec3()).into()
    }
    fn bracket(xi: &Tangent<3, S>, eta: &Tangent<3, S>) -> Tangent<3, S> {
        xi.vec3().cross(eta.vec3()).into()
    }
    // Four numbers for three dimensions: rounding moves them off the sphere.
    fn normalize(&mut self) {
        let scale = S::one() / (self.w * self.w + self.v.norm_squared()).sqrt();
        (self.w, self.v) = (self.w * scale, self.v * scale);
    }
}

/// $\cos\alpha$ and $\sin\alpha/\alpha$ at $x = \alpha^2$.
///
/// Both are smooth in $x$, but $\alpha = \sqrt x$ is not at zero: near it a series takes over, so that dual numbers
/// find the derivatives. Both sides are evaluated, and the root's argument is kept off zero.
fn cos_and_sinc<S: Scalar>(x: S) -> [S; 2] {
    let small = x.less(S::from_f64(0.25));
    // Terms (-x)^k / (2k)! and (-x)^k / (2k + 1)!: the first one left out is below 1e-18.
    let series = |first: u32| {
        (1..=8).rev().fold(S::one(), |tail, k| {
            let factor = f64::from((2 * k + first - 1) * (2 * k + first));
            S::one() - x * tail / S::from_f64(factor)
        })
    };
    let angle = S::select(small, S::one(), x).sqrt();
    let (sin, cos) = angle.sin_cos();
    [
        S::select(small, series(0), cos),
        S::select(small, series(1), sin / angle),
    ]
}

/// $\alpha/\sin\alpha$ for $n = \sin^2\alpha$ and $w = \cos\alpha$, with $\alpha \in [0, \pi)$; smooth at $\alpha = 0$ likewise.
fn angle_over_sine<S: Scalar>(n: S, w: S) -> S {
    // Near a full turn, w = -1, the sine is small too, and the angle is not.
    let front = S::select(w.less(S::zero()), S::zero(), w);
    let small = n.less(S::from_f64(0.02) * front * front);
    // The arc tangent's series in (tan alpha)^2.
    let square = n / S::select(small, w * w, S::one());
    let series = (0..9).rev().fold(S::zero(), |tail, k| {
        S::from_f64(1.0 / f64::from(2 * k + 1)) - square * tail
    });
    let sine = S::select(small, S::one(), n).sqrt();
    S::select(small, series / w, sine.atan2(w) / sine)
}
