//! Drag: a force and a moment against the motion of a body, axis by axis, (S24)–(S25).

use lie::{Scalar, Vec3};

use super::{Twist, Wrench};
use crate::loads::size::is_size;
use crate::scene::entry::{Table, Value};
use crate::scene::error::SceneError;

/// Drag of a body along and about its axes: $f_a = -(c_a + q_a |V_a|) V_a$ and $m_a = -(r_a + s_a |\Omega_a|) \Omega_a$ at its mass centre.
///
/// The quadratic part has no second derivative where $V_a$ is zero, and methods lose order there. With a speed $v_0 > 0$ it is smooth:
/// $|V_a|$ gives way to $\sqrt{V_a^2 + v_0^2} - v_0$.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drag {
    /// $c$, N s/m.
    pub linear: [f64; 3],
    /// $q$, N s²/m².
    pub quadratic: [f64; 3],
    /// $r$, N m s.
    pub angular_linear: [f64; 3],
    /// $s$, N m s².
    pub angular_quadratic: [f64; 3],
    /// $v_0$, m/s.
    pub smooth_below: f64,
}

impl Drag {
    pub(super) const NAME: &str = "drag";

    /// By its keys in a scene.
    pub(super) fn read(table: &Table) -> Result<Self, SceneError> {
        let numbers = |key: &str| table.read(key, [0.0; 3], Value::not_negative_array);
        Ok(Self {
            linear: numbers("linear")?,
            quadratic: numbers("quadratic")?,
            angular_linear: numbers("angular_linear")?,
            angular_quadratic: numbers("angular_quadratic")?,
            smooth_below: table.read("smooth_below", 0.0, Value::not_negative)?,
        })
    }

    /// Whether no number is negative or not finite.
    pub(super) fn is_sound(&self) -> bool {
        self.numbers().flatten().all(|x| is_size(*x)) && is_size(self.smooth_below)
    }

    /// Whether it does anything.
    pub fn acts(&self) -> bool {
        self.numbers().flatten().any(|x| *x != 0.0)
    }

    fn numbers(&self) -> impl Iterator<Item = &[f64; 3]> {
        let linear = [&self.linear, &self.angular_linear];
        let quadratic = [&self.quadratic, &self.angular_quadratic];
        linear.into_iter().chain(quadratic)
    }

    /// The force and the moment on a body with these rates and this velocity, all in its frame.
    #[inline(always)]
    pub(super) fn wrench<S: Scalar>(&self, [omega, v]: Twist<S>) -> Wrench<S> {
        let speed = |x: S| {
            let below = self.smooth_below;
            match below == 0.0 {
                true => magnitude(x),
                false => (x * x + S::from_f64(below * below)).sqrt() - S::from_f64(below),
            }
        };
        let along = |a: usize| {
            let quadratic = speed(v[a]).times(self.quadratic[a]);
            -(S::from_f64(self.linear[a]) + quadratic) * v[a]
        };
        let about = |a: usize| {
            let quadratic = magnitude(omega[a]).times(self.angular_quadratic[a]);
            -(S::from_f64(self.angular_linear[a]) + quadratic) * omega[a]
        };
        [Vec3([0, 1, 2].map(along)), Vec3([0, 1, 2].map(about))]
    }
}

/// $|x|$, with a derivative of one sign at zero.
#[inline(always)]
fn magnitude<S: Scalar>(x: S) -> S {
    S::select(x.less(S::zero()), -x, x)
}
