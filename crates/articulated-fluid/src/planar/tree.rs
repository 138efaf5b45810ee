//! A tree of bodies in a plane: where it is, and what acts on it.

use core::ops::Range;

use dvi::System;
use lie::{AlgebraOver, DualOver, Power, Rn, SO2};

use super::loads::Loads;
use super::vector::{Sym2, Vec2};

/// $SO(2)^{n+1} \times \mathbb{R}^2$, $g = ((R_0, \dots, R_n), x)$, in the frame of a [`Plane`](super::Plane).
///
/// $R_i$ maps body $i$'s frame in the plane to that of the plane; $x$ is the mass centre of the first body, in metres.
pub type PlanarConfiguration<S = f64> = (Power<SO2<S>>, Power<Rn<2, S>>);

/// Angular velocities, and that of the first body's mass centre.
pub(super) type Velocity<S = f64> = AlgebraOver<PlanarConfiguration, S>;
/// The momenta conjugate to them.
pub(super) type Momentum<S = f64> = DualOver<PlanarConfiguration, S>;

/// Rigid bodies on hinges in a perfect fluid, all in one plane: a tree with a free base, made by [`Plane::model`](super::Plane::model).
///
/// Evaluations, the inertia solve and steps cost time and memory in proportion to the bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarBody {
    /// A parent stands before its children.
    pub(super) nodes: Vec<Node>,
    pub(super) loads: Loads,
}

/// A body, its joint to its parent, and what follows from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    /// Index of the parent; of the first body, which has none, 0.
    pub(super) parent: usize,
    /// $M_i$ in the plane, kg, in the body's frame.
    pub(super) mass: Sym2,
    /// $J_i$ about the normal, kg m².
    pub(super) j: f64,
    /// $d_{pi}$, m, in the parent's frame.
    pub(super) at_parent: Vec2,
    /// $d_{ip}$, m, in the body's frame.
    pub(super) at_self: Vec2,
    /// $l_i = d_{pi} - d_{pp(p)}$: from the parent's joint to this body's, in the parent's frame.
    pub(super) lever: Vec2,
    /// $K = M_i J d_{ip}$ with the quarter turn $J$.
    pub(super) k: Vec2,
    /// $J'_i = J_i + J d_{ip} \cdot M_i J d_{ip}$: about the joint.
    pub(super) j_joint: f64,
}

impl Node {
    pub(super) fn new(
        parent: usize,
        mass: Sym2,
        j: f64,
        [at_parent, at_self, lever]: [Vec2; 3],
    ) -> Self {
        let swept = at_self.quarter_turn();
        let k = mass.apply(swept);
        Self {
            parent,
            mass,
            j,
            at_parent,
            at_self,
            lever,
            k,
            j_joint: j + swept.dot(k),
        }
    }
}

impl PlanarBody {
    /// The coordinates of $x$.
    pub(super) fn translation(&self) -> Range<usize> {
        let first = self.nodes.len();
        first..first + 2
    }
}

impl System for PlanarBody {
    type Group = PlanarConfiguration;

    /// The first body's position, but under a weight: $x$ enters nowhere, and the displacement $\Delta x$ enters (31) linearly.
    fn cyclic(&self) -> Range<usize> {
        match self.loads.let_float() {
            true => self.translation(),
            false => 0..0,
        }
    }

    fn fits(&self, (r, x): &PlanarConfiguration) -> bool {
        (r.len(), x.len()) == (self.nodes.len(), 1)
    }
}
