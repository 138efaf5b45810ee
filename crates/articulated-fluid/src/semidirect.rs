//! The same discrete Lagrangian on the paper's own group, $SE(3) \times SO(3)^n$.

use dvi::{DiscreteLagrangian, State};
use lie::{Power, SE3, SO3, Scalar, Vec3};

use crate::{ArticulatedBody, Configuration};

/// The semidirect configuration $((R_0, x), R_1, \dots, R_n)$.
pub type SemidirectConfiguration<S = f64> = (SE3<S>, Power<SO3<S>>);

/// [`ArticulatedBody`] with its head's pose in $SE(3)$: another trivialisation of the same configuration space.
///
/// The displacement is then $f_0 = (F_0, R_0^T \Delta x)$ and the head's linear momentum $R_0^T p_x$. Nothing but the group
/// and the value (22) is given; the derivatives come from dual numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct OnSe3(pub ArticulatedBody);

impl DiscreteLagrangian for OnSe3 {
    type Group = SemidirectConfiguration;

    fn value<S: Scalar>(
        &self,
        g: &SemidirectConfiguration<S>,
        f: &SemidirectConfiguration<S>,
        h: S,
    ) -> S {
        let (r0, f0) = (&g.0.rotation, &f.0.rotation);
        let dx = r0.rotate(f.0.translation);
        self.0
            .action(((r0, &g.1), g.0.translation), ((f0, &f.1), dx), h)
    }

    fn fits(&self, g: &SemidirectConfiguration) -> bool {
        g.1.len() == self.0.joints().len()
    }

    fn is_defined(&self, _t: f64, _g: &SemidirectConfiguration) -> bool {
        true
    }
}

impl OnSe3 {
    /// The same state in the direct product's trivialisation.
    pub fn to_direct(state: &State<SemidirectConfiguration>) -> State<Configuration> {
        let ((head, tails), (momentum, p)) = (&state.g, &state.mu);
        let (p0, linear) = momentum.split();
        State {
            t: state.t,
            g: (head.rotation, head.translation.into(), tails.clone()),
            mu: (p0.into(), head.rotation.rotate(linear).into(), p.clone()),
        }
    }

    /// The inverse of [`to_direct`](Self::to_direct).
    pub fn from_direct(state: &State<Configuration>) -> State<SemidirectConfiguration> {
        let ((r0, x, r), (p0, px, p)) = (&state.g, &state.mu);
        let linear: Vec3 = r0.inverse_rotate(px.vec3());
        State {
            t: state.t,
            g: (SE3::new(*r0, x.vec3()), r.clone()),
            mu: ((p0.vec3(), linear).into(), p.clone()),
        }
    }
}
