//! The same discrete Lagrangian on the paper's own group, $SE(3) \times SO(3)^n$.

use core::iter::once;

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{Context, DiscreteLagrangian, State, Still, System};
use lie::{Power, R3, SE3, SO3, Scalar, Vec3};

/// The semidirect configuration $((R_0, x), R_1, \dots, R_n)$.
pub type SemidirectConfiguration<S = f64> = (SE3<S>, Power<SO3<S>>);

/// [`ArticulatedBody`] with its head's pose in $SE(3)$: another trivialisation of the same configuration space.
///
/// The displacement is then $f_0 = (F_0, R_0^T \Delta x)$ and the head's linear momentum $R_0^T p_x$. Nothing but the group
/// and the value (22) is given; the derivatives come from dual numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct OnSe3(pub ArticulatedBody);

/// The attitudes of all, and this translation.
fn direct<S: Scalar>(
    (head, tails): &SemidirectConfiguration<S>,
    translation: Vec3<S>,
) -> Configuration<S> {
    let attitudes = once(head.rotation).chain(tails.iter().copied());
    (
        attitudes.collect(),
        once(R3::from(translation)).collect(),
        Power::new(vec![]),
    )
}

impl System for OnSe3 {
    type Group = SemidirectConfiguration;

    fn fits(&self, g: &SemidirectConfiguration) -> bool {
        g.1.len() == self.0.joints().len()
    }
}

impl DiscreteLagrangian for OnSe3 {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &SemidirectConfiguration<S>,
        f: &SemidirectConfiguration<S>,
        h: S,
    ) -> S {
        let dx = g.0.rotation.rotate(f.0.translation);
        let (g, f) = (direct(g, g.0.translation), direct(f, dx));
        DiscreteLagrangian::value(&self.0, at, &g, &f, h)
    }

    fn is_defined(
        &self,
        _: f64,
        _: &SemidirectConfiguration,
        _: &Still<SemidirectConfiguration>,
    ) -> bool {
        true
    }
}

impl OnSe3 {
    /// The same state in the direct product's trivialisation.
    pub fn to_direct(state: &State<SemidirectConfiguration>) -> State<Configuration> {
        let ((head, _), (momentum, p)) = (&state.g, &state.mu);
        let (p0, linear) = momentum.split();
        let spins = once(p0.into()).chain(p.iter().copied());
        let linear = head.rotation.rotate(linear).into();
        State {
            t: state.t,
            g: direct(&state.g, head.translation),
            mu: (spins.collect(), once(linear).collect(), Power::new(vec![])),
        }
    }

    /// The inverse of [`to_direct`](Self::to_direct).
    pub fn from_direct(state: &State<Configuration>) -> State<SemidirectConfiguration> {
        let ((r, x, _), (p, px, _)) = (&state.g, &state.mu);
        let linear = r[0].inverse_rotate(px[0].vec3());
        State {
            t: state.t,
            g: (SE3::new(r[0], x[0].vec3()), Power::new(r[1..].to_vec())),
            mu: ((p[0].vec3(), linear).into(), Power::new(p[1..].to_vec())),
        }
    }
}
