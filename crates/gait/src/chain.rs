//! A swimmer by its shape.

use articulated_fluid::Scene;
use lie::{SO3, Tangent, Vec3};

use crate::error::GaitError;
use crate::formulas::Formulas;
use crate::stroke::Stroke;
use crate::tree::{Moving, Tree};

/// A free tree of bodies by its shape $q$: the angles of hinges and the rotation vectors of balls, rad, in the order of the bodies.
///
/// At zero momentum the first body moves at $\xi = -A(q) \dot q$, in its own frame, (S6). The connection is
/// $A = \mathbb{I}^{-1} M_{gq}$ with the locked inertia $\mathbb{I}$. The kinetic energy is $\frac12 \dot q^T G \dot q$ with the metric
/// $G = M_{qq} - M_{qg} \mathbb{I}^{-1} M_{gq}$.
///
/// The formulas are recorded once, with their derivatives.
pub struct Chain {
    tree: Tree,
    formulas: Formulas,
}

impl Chain {
    /// The chain of a scene.
    ///
    /// # Errors
    /// [`GaitError`] where the first body is held, a joint is free, nothing moves, or a motion is a function of one's own.
    pub fn new(scene: &Scene) -> Result<Self, GaitError> {
        let model = scene.model()?;
        if scene.mount.is_some() {
            return Err(GaitError::Held);
        }
        let name = |child: usize| {
            let joint = scene.joints.iter().find(|joint| joint.child == child);
            joint.map_or_else(String::new, |joint| joint.name.clone())
        };
        let tree = Tree::new(&model, &name)?;
        Ok(Self {
            formulas: Formulas::new(&tree)?,
            tree,
        })
    }

    /// How many coordinates a shape has.
    pub fn dim(&self) -> usize {
        self.tree.dim()
    }

    /// The joints that move, in the order of the bodies.
    pub fn joints(&self) -> &[Moving] {
        self.tree.joints()
    }

    /// The columns $A_j$ of the connection at a shape: angular, then linear velocity, in the frame of the first body.
    ///
    /// # Errors
    /// [`GaitError::Shape`].
    pub fn connection(&self, q: &[f64]) -> Result<Vec<Tangent<6>>, GaitError> {
        self.check(q)?;
        Ok(self.tree.at(q).connection)
    }

    /// Where the bodies are in the frame of the first: attitudes and mass centres, m.
    ///
    /// # Errors
    /// [`GaitError::Shape`].
    pub fn bodies(&self, q: &[f64]) -> Result<Vec<(SO3, Vec3)>, GaitError> {
        self.check(q)?;
        Ok(self.tree.bodies(q))
    }

    /// The torques that the joints do at zero momentum, N m: $\tau = \frac{d}{dt}(G \dot q) - \frac12 \partial_q (\dot q^T G \dot q)$.
    ///
    /// They follow from a shape, its rates and its accelerations, rad and s.
    ///
    /// # Errors
    /// [`GaitError::Shape`].
    pub fn torques(&self, state: [&[f64]; 3]) -> Result<Vec<f64>, GaitError> {
        state.iter().try_for_each(|part| self.check(part))?;
        self.formulas.torques.at(state.concat())
    }

    /// The radius of gyration of the whole where all coordinates are zero, with what the fluid adds, m.
    pub fn gyration(&self) -> f64 {
        self.tree.gyration(&vec![0.0; self.dim()])
    }

    pub(crate) fn tree(&self) -> &Tree {
        &self.tree
    }

    pub(crate) fn formulas(&self) -> &Formulas {
        &self.formulas
    }

    /// Shape, rates and accelerations of a stroke, in a row.
    pub(crate) fn state(&self, stroke: &dyn Stroke, t: f64) -> Vec<f64> {
        [0, 1, 2].map(|k| stroke.derivative(t, k)).concat()
    }

    /// The same at each time.
    pub(crate) fn states(
        &self,
        stroke: &dyn Stroke,
        times: impl Iterator<Item = f64>,
    ) -> Vec<Vec<f64>> {
        times.map(|t| self.state(stroke, t)).collect()
    }

    fn check(&self, q: &[f64]) -> Result<(), GaitError> {
        match q.len() == self.dim() {
            true => Ok(()),
            false => Err(GaitError::Shape {
                expected: self.dim(),
                found: q.len(),
            }),
        }
    }
}
