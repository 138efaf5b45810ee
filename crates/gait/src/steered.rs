//! A tree whose prescribed joints do a stroke, so that its motion can be differentiated by the stroke.

use core::f64::consts::TAU;
use core::ops::Range;

use articulated_fluid::{ArticulatedBody, Configuration, Evaluation};
use dvi::{Context, ContinuousSystem, System};
use lie::{AlgebraOver, DualOver, Scalar};

use crate::joint::Steered;
use crate::stroke::{Fourier, Stroke};

/// A tree whose prescribed joints do a stroke, whose coefficients are its parameters.
pub(crate) struct SteeredTree {
    tree: ArticulatedBody,
    joints: Vec<(usize, Steered)>,
    order: usize,
    /// $2 \pi / T$.
    omega: f64,
    from: f64,
    coefficients: Vec<f64>,
}

impl SteeredTree {
    /// The tree whose joints do as they are told: without parameters.
    pub(crate) fn as_told(tree: ArticulatedBody) -> Self {
        Self {
            tree,
            joints: Vec::new(),
            order: 0,
            omega: 0.0,
            from: 0.0,
            coefficients: Vec::new(),
        }
    }

    /// The tree whose joints do a stroke, which begins at the time `from`.
    pub(crate) fn new(tree: ArticulatedBody, stroke: &Fourier, from: f64) -> Self {
        let mut joints: Vec<(usize, Steered)> = Vec::new();
        let mut first = 0;
        for joint in tree.joints() {
            if let Some(steered) = Steered::of(&joint.kind, first) {
                first += steered.dim();
                joints.push((joint.child, steered));
            }
        }
        Self {
            tree,
            joints,
            order: stroke.order(),
            omega: TAU / stroke.period(),
            from,
            coefficients: stroke.coefficients().to_vec(),
        }
    }

    /// The shape and its rates, of these coefficients.
    fn shape<S: Scalar>(&self, at: Context<S>) -> [Vec<S>; 2] {
        let t = at.t - S::from_f64(self.from);
        let mut bases = [vec![S::one()], vec![S::zero()]];
        for multiple in (1..=self.order).map(|k| self.omega * k as f64) {
            let (sin, cos) = t.times(multiple).sin_cos();
            bases[0].extend([cos, sin]);
            bases[1].extend([-sin.times(multiple), cos.times(multiple)]);
        }
        bases.map(|basis| {
            let of_one = |own: &[S]| {
                let each = own.iter().zip(&basis);
                each.fold(S::zero(), |sum, (c, phi)| sum + *c * *phi)
            };
            at.all.chunks_exact(basis.len()).map(of_one).collect()
        })
    }
}

impl System for SteeredTree {
    type Group = Configuration;

    fn parameters(&self) -> &[f64] {
        &self.coefficients
    }

    fn cyclic(&self) -> Range<usize> {
        self.tree.cyclic()
    }

    fn fits(&self, g: &Configuration) -> bool {
        self.tree.fits(g)
    }

    fn is_driven(&self) -> bool {
        self.tree.is_driven()
    }

    fn terms(&self) -> usize {
        self.tree.terms()
    }

    fn is_symplectic(&self) -> bool {
        self.tree.is_symplectic()
    }
}

impl ContinuousSystem for SteeredTree {
    type Workspace<S: Scalar> = Evaluation<S>;
    // Strokes are short: lanes would take longer to compile than they save.
    const INLINE: bool = false;

    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Configuration<S>,
        mu: &DualOver<Configuration, S>,
        work: &mut Evaluation<S>,
        xi: &mut AlgebraOver<Configuration, S>,
        tau: &mut DualOver<Configuration, S>,
    ) {
        if !self.joints.is_empty() {
            let [q, rates] = self.shape(at);
            let motions = self.joints.iter();
            let motions = motions.map(|(body, joint)| (*body, joint.at(&q, &rates)));
            work.steer(&self.tree, at.t, motions);
        }
        let at = Context::new(at.t, &[]);
        self.tree.velocity_and_force(at, g, mu, work, xi, tau);
    }

    fn is_defined(&self, t: f64, g: &Configuration) -> bool {
        self.tree.is_defined(t, g)
    }
}
