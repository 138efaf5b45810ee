//! A frame that moves and falls with the mass centre.
//!
//! In a vacuum, and of spheres in water, every total mass $m_i$ is the same in all directions. Uniform motion and a uniform field then
//! do not change how the bodies move about their mass centre. With $M = \sum_i m_i$ and the total net mass $W$ under the gravity
//! $\gamma$, that centre and its velocity are
//! $$ a = \frac{W}{M} \gamma, \qquad V(t) = V_0 + a (t - t_0), \qquad X(t) = X_0 + V_0 (t - t_0) + \tfrac12 a (t - t_0)^2 , $$
//! where $V_0 = p_x / M$. With the constants $s_i$ of $\sum_i m_i x_i = M x + \sum_i R_i s_i$, a state of the frame is
//! $$ p_x' = p_x - M V = 0, \qquad p_i' = p_i - s_i \times R_i^T V, \qquad x = X(t) - \frac1M \sum_i R_i s_i . $$
//! The attitudes alone are solved for. What is left of the weight are the net masses $w_i - (W/M) m_i$: none in a vacuum, and elsewhere
//! none in sum. $X$ and $V$ are taken from the time, and no rounding gathers in them.

use dvi::{State, System};
use lie::{Mat3, RealGroup, Vec3, VectorSpace};

use super::view::View;
use crate::loads::{Weight, moments};
use crate::tree::{ArticulatedBody, Configuration};

/// A part of a net mass that is the rounding of the quotient and the product it is the rest of, relative.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The [`View`] from a frame that moves and falls with the mass centre.
#[derive(Clone, Debug, PartialEq)]
pub struct Comoving {
    model: ArticulatedBody,
    /// $M$, kg.
    mass: f64,
    /// $a$, m/s², reference frame.
    acceleration: Vec3,
    /// $s_i$, kg m, each in its body's frame.
    levers: Vec<Vec3>,
}

/// How the mass centre moves: $t_0$, $X_0$ and $V_0$.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    t: f64,
    centre: Vec3,
    v: Vec3,
}

impl Comoving {
    /// The view of a free tree on ball joints whose masses are the same in all directions, exactly.
    ///
    /// ```
    /// use articulated_fluid::{ArticulatedBody, Body, Comoving};
    /// use lie::{Mat3, Vec3};
    ///
    /// let stone = Body::new(Mat3::diagonal([5.0; 3]), Mat3::diagonal([1.0, 2.0, 3.0]));
    /// let falling = ArticulatedBody::new(&[stone], &[])?.with_gravity(Vec3([0.0, 0.0, -9.81]), &[5.0])?;
    /// let view = Comoving::new(&falling).expect("a vacuum");
    /// assert_eq!(view.model().gravity(), None);
    /// # Ok::<(), articulated_fluid::ModelError>(())
    /// ```
    pub fn new(model: &ArticulatedBody) -> Option<Self> {
        if !model.has_views() {
            return None;
        }
        let number = |m: &Mat3| (*m == Mat3::diagonal([m[(0, 0)]; 3])).then_some(m[(0, 0)]);
        let masses: Vec<f64> = model.masses.iter().map(number).collect::<Option<_>>()?;
        let (mass, levers) = moments(&masses, &model.nodes);
        let (mut inner, mut acceleration) = (model.clone(), Vec3::zero());
        if let Some(weight) = &model.loads.weight {
            let ratio = weight.total() / mass;
            let rest = |(net, m): (&f64, &f64)| match net - ratio * m {
                rest if rest.abs() <= ROUNDING * net.abs() => 0.0,
                rest => rest,
            };
            let rests: Vec<f64> = weight.net_masses().iter().zip(&masses).map(rest).collect();
            let rest = Weight::new(weight.gravity(), &rests, &model.nodes).afloat();
            inner.loads.weight = (!rest.is_balanced()).then_some(rest);
            acceleration = weight.force() * (1.0 / mass);
        }
        let finite = mass.is_finite() && levers.iter().all(|s| s.is_finite());
        finite.then_some(Self {
            model: inner,
            mass,
            acceleration,
            levers,
        })
    }

    /// The model in the frame: with what is left of the weight.
    pub fn model(&self) -> ArticulatedBody {
        self.model.clone()
    }

    /// The frame of a state.
    fn drift(&self, state: &State<Configuration>) -> Drift {
        Drift {
            t: state.t,
            centre: state.g.1[0].vec3() + self.lever(&state.g),
            v: state.mu.1[0].vec3() * (1.0 / self.mass),
        }
    }

    /// From the first body to the mass centre, $\frac1M \sum_i R_i s_i$.
    fn lever(&self, g: &Configuration) -> Vec3 {
        let levers = self.levers.iter().zip(g.0.iter());
        let turned = levers.map(|(lever, r)| r.rotate(*lever));
        turned.fold(Vec3::zero(), |sum, lever| sum + lever) * (1.0 / self.mass)
    }

    /// Adds $V$ times `sign` to the momenta: $p_i + s_i \times R_i^T V$.
    fn boost(&self, state: &mut State<Configuration>, v: Vec3, sign: f64) {
        let State { g, mu, .. } = state;
        let bodies = g.0.iter().zip(mu.0.iter_mut());
        for (lever, (r, p)) in self.levers.iter().zip(bodies) {
            let along = r.inverse_rotate(v);
            *p = (p.vec3() + lever.cross(along) * sign).into();
        }
    }
}

impl View for Comoving {
    type Inner = Configuration;
    type Frame = Drift;

    fn enter(&self, outer: &State<Configuration>) -> Option<(Drift, State<Configuration>)> {
        if !(self.model.fits(&outer.g) && self.model.has_shape_of(&outer.mu)) {
            return None;
        }
        let (drift, mut inner) = (self.drift(outer), outer.clone());
        self.boost(&mut inner, drift.v, -1.0);
        (inner.g.1[0], inner.mu.1[0]) = (Vec3::zero().into(), Vec3::zero().into());
        Some((drift, inner))
    }

    fn leave(&self, drift: &Drift, inner: &State<Configuration>, outer: &mut State<Configuration>) {
        let s = inner.t - drift.t;
        let v = drift.v + self.acceleration * s;
        let way = (drift.v + self.acceleration * (0.5 * s)) * s;
        outer.t = inner.t;
        outer.g.copy_from(&inner.g);
        outer.mu.copy_from(&inner.mu);
        self.boost(outer, v, 1.0);
        outer.g.1[0] = (drift.centre + (way - self.lever(&inner.g))).into();
        outer.mu.1[0] = (v * self.mass).into();
    }
}
