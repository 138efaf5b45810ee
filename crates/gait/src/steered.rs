//! A tree whose prescribed joints do a stroke, so that its motion can be differentiated by the stroke.

use core::ops::Range;

use articulated_fluid::{ArticulatedBody, Configuration, Evaluation};
use dvi::{Context, ContinuousSystem, System};
use lie::{AlgebraOver, DualOver, SO3, Scalar, Vec3};

use crate::joint::Steered;
use crate::stroke::Fourier;

/// A tree whose prescribed joints do as they are told, or a stroke whose coefficients are its parameters.
pub(crate) struct SteeredTree {
    tree: ArticulatedBody,
    steering: Option<Steering>,
}

/// A stroke, and what does it.
struct Steering {
    joints: Vec<(usize, Steered)>,
    stroke: Fourier,
    /// When it begins, s.
    from: f64,
}

impl SteeredTree {
    /// The tree whose joints do as they are told: without parameters.
    pub(crate) fn as_told(tree: ArticulatedBody) -> Self {
        Self {
            tree,
            steering: None,
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
        let stroke = stroke.clone();
        Self {
            tree,
            steering: Some(Steering {
                joints,
                stroke,
                from,
            }),
        }
    }
}

impl Steering {
    /// The attitudes and rates that joints have by these coefficients.
    fn motions<S: Scalar>(
        &self,
        at: Context<S>,
    ) -> impl Iterator<Item = (usize, (SO3<S>, Vec3<S>))> {
        let t = at.t - S::from_f64(self.from);
        let [q, rates] = [0, 1].map(|k| {
            let basis = self.stroke.basis(t, k);
            let of_one = |own: &[S]| {
                let each = own.iter().zip(&basis);
                each.fold(S::zero(), |sum, (c, phi)| sum + *c * *phi)
            };
            at.all
                .chunks_exact(basis.len())
                .map(of_one)
                .collect::<Vec<S>>()
        });
        let joints = self.joints.iter();
        joints.map(move |(body, joint)| (*body, joint.at(&q, &rates)))
    }
}

impl System for SteeredTree {
    type Group = Configuration;

    fn parameters(&self) -> &[f64] {
        let steering = self.steering.as_ref();
        steering.map_or(&[], |steering| steering.stroke.coefficients())
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
        if let Some(steering) = &self.steering {
            work.steer(&self.tree, at.t, steering.motions(at));
        }
        let at = Context::new(at.t, &[]);
        self.tree.velocity_and_force(at, g, mu, work, xi, tau);
    }

    fn is_defined(&self, t: f64, g: &Configuration) -> bool {
        self.tree.is_defined(t, g)
    }
}
