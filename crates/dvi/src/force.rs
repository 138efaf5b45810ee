//! Forces that are no gradient of the Lagrangian: drag, control, thrust. Discrete Lagrange–d'Alembert.

use core::ops::Range;

use lie::{AlgebraOver, DualOver, LieGroup, Over, RealGroup, Retraction, Scalar, VectorSpace};

use crate::quadrature::{at, mean_velocity};
use crate::{ContinuousSystem, Derivatives, DiscreteLagrangian, Discretised, Place, Quadrature};

/// A force $F(t, g, \xi) \in \mathfrak g^\ast$, left-trivialised: its virtual work is $\langle F, g^{-1} \delta g \rangle$.
///
/// On a rotation that is a torque in the body's frame, on $\mathbb{R}^n$ a force.
///
/// ```
/// use dvi::{Force, Integrator, Lagrangian, Midpoint, State, Variational};
/// use lie::{Cotangent, Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg.
/// struct Particle;
///
/// impl Lagrangian for Particle {
///     type Group = Rn<1>;
///     fn value<S: Scalar>(&self, _: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         v[0] * v[0] * S::from_f64(0.5)
///     }
/// }
///
/// /// A drag of 0.2 kg/s.
/// struct Drag;
///
/// impl Force for Drag {
///     type Group = Rn<1>;
///     fn force<S: Scalar>(&self, _: S, _: &Rn<1, S>, v: &Tangent<1, S>) -> Cotangent<1, S> {
///         Cotangent([v[0] * S::from_f64(-0.2)])
///     }
/// }
///
/// let damped = Particle.discretise::<Midpoint>().with_force(Drag);
/// let (mut state, mut integrator) = (State { t: 0.0, g: Rn([0.0]), mu: Cotangent([1.0]) }, Variational::new(damped));
/// for _ in 0..1000 {
///     integrator.step(&mut state, 0.01)?;
/// }
/// assert!((state.mu[0] - (-2.0_f64).exp()).abs() < 1e-6);
/// # Ok::<(), dvi::StepError>(())
/// ```
pub trait Force {
    /// The configuration group.
    type Group: RealGroup;

    /// $F(t, g, \xi)$.
    fn force<S: Scalar>(
        &self,
        t: S,
        g: &Over<Self::Group, S>,
        xi: &AlgebraOver<Self::Group, S>,
    ) -> DualOver<Self::Group, S>;
}

impl<F: Force> Force for &F {
    type Group = F::Group;

    #[inline(always)]
    fn force<S: Scalar>(
        &self,
        t: S,
        g: &Over<F::Group, S>,
        xi: &AlgebraOver<F::Group, S>,
    ) -> DualOver<F::Group, S> {
        F::force(self, t, g, xi)
    }
}

/// Discrete forces $f_d^\pm(t, g, f) \in \mathfrak g^\ast$: the impulses of a step of size $h$, in N m s.
///
/// Their virtual work over a step is $\langle f_d^-, g_k^{-1} \delta g_k \rangle + \langle f_d^+, g_{k+1}^{-1} \delta g_{k+1} \rangle$
/// (J. E. Marsden, M. West, *Discrete mechanics and variational integrators*, Acta Numerica 2001, § 3.2).
pub trait DiscreteForce {
    /// The configuration group.
    type Group: RealGroup;

    /// The impulses $(f_d^-, f_d^+)$, each left-trivialised at its own end of the step.
    fn impulses<S: Scalar>(
        &self,
        t: S,
        g: &Over<Self::Group, S>,
        f: &Over<Self::Group, S>,
        h: S,
    ) -> [DualOver<Self::Group, S>; 2];

    /// The order of the forces: that of a forced step is at most this.
    fn order(&self) -> u32 {
        1
    }

    /// Whether they are the same read backwards: $f_d^\pm(t, g, f, h) = -f_d^\mp(t + h, g f, f^{-1}, -h)$.
    fn is_symmetric(&self) -> bool {
        false
    }
}

/// The force at the middle acts on both ends by half, each moved there by $\mathrm{Ad}^\ast$; so it keeps every momentum map
/// of a left translation that the continuous force keeps.
impl<F: Force, Q: Quadrature, R: Retraction> DiscreteForce for Discretised<F, Q, R> {
    type Group = F::Group;

    fn impulses<S: Scalar>(
        &self,
        t: S,
        g: &Over<F::Group, S>,
        f: &Over<F::Group, S>,
        h: S,
    ) -> [DualOver<F::Group, S>; 2] {
        let xi = mean_velocity::<R, F::Group, S>(f, h);
        let mut impulses = [g.zero_dual(), g.zero_dual()];
        for &(weight, place) in Q::NODES {
            let (t, g) = at::<F::Group, S>(place, (t, h), (g, f));
            let (force, scale) = (self.system.force(t, &g, &xi), h * S::from_f64(weight));
            let [minus, plus] = &mut impulses;
            match place {
                Place::Start => minus.add_scaled(scale, &force),
                Place::End => plus.add_scaled(scale, &force),
                Place::Middle => {
                    let (root, half) = (f.sqrt(), scale * S::from_f64(0.5));
                    minus.add_scaled(half, &root.inverse().coadjoint(&force));
                    plus.add_scaled(half, &root.coadjoint(&force));
                }
            }
        }
        impulses
    }

    fn order(&self) -> u32 {
        Q::ORDER
    }

    fn is_symmetric(&self) -> bool {
        Q::SYMMETRIC
    }
}

/// A system and a force that acts on it: a discrete Lagrangian with a [`DiscreteForce`], a [`ContinuousSystem`] with a [`Force`].
///
/// Made by [`Discretised::with_force`], which takes the rule of the Lagrangian for the force too, or from its two parts.
///
/// The discrete Lagrange–d'Alembert principle adds $f_d^-$ to the momentum that enters a step and $f_d^+$ to the one that
/// leaves it. In the step's balance that is the same as adding $f_d^- + \mathrm{Ad}^\ast_{f^{-1}} f_d^+$ to
/// $\mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d$ and $f_d^+$ to $\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d$: the
/// carried momentum then contains the impulses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forced<L, F> {
    /// The system without the force.
    pub system: L,
    /// The force.
    pub force: F,
}

impl<L, F> Forced<L, F> {
    /// The system with the force.
    pub fn new(system: L, force: F) -> Self {
        Self { system, force }
    }
}

impl<L, F> DiscreteLagrangian for Forced<L, F>
where
    L: DiscreteLagrangian,
    F: DiscreteForce<Group = L::Group>,
{
    type Group = L::Group;

    fn value<S: Scalar>(&self, g: &Over<L::Group, S>, f: &Over<L::Group, S>, h: S) -> S {
        self.system.value(g, f, h)
    }

    fn value_at<S: Scalar>(&self, t: S, g: &Over<L::Group, S>, f: &Over<L::Group, S>, h: S) -> S {
        self.system.value_at(t, g, f, h)
    }

    fn derivatives<S: Scalar>(
        &self,
        t: S,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
        out: &mut Derivatives<L::Group, S>,
    ) {
        self.system.derivatives(t, g, f, h, out);
        let [minus, plus] = self.force.impulses(t, g, f, h);
        out.d_f.add_scaled(S::one(), &plus);
        out.d_g.add_scaled(S::one(), &minus);
        out.d_g.add_scaled(S::one(), &f.inverse().coadjoint(&plus));
    }

    fn cyclic(&self) -> Range<usize> {
        self.system.cyclic()
    }

    fn fits(&self, g: &L::Group) -> bool {
        self.system.fits(g)
    }

    fn is_defined(&self, t: f64, g: &L::Group) -> bool {
        self.system.is_defined(t, g)
    }

    fn order(&self) -> u32 {
        self.system.order().min(self.force.order())
    }

    fn is_symmetric(&self) -> bool {
        self.system.is_symmetric() && self.force.is_symmetric()
    }

    fn is_symplectic(&self) -> bool {
        false
    }
}

impl<L, F> ContinuousSystem for Forced<L, F>
where
    L: ContinuousSystem,
    F: Force<Group = L::Group>,
{
    type Group = L::Group;
    type Workspace<S: Scalar> = L::Workspace<S>;

    fn workspace<S: Scalar>(&self, g: &Over<L::Group, S>) -> L::Workspace<S> {
        self.system.workspace(g)
    }

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        t: S,
        g: &Over<L::Group, S>,
        mu: &DualOver<L::Group, S>,
        workspace: &mut L::Workspace<S>,
        xi: &mut AlgebraOver<L::Group, S>,
        tau: &mut DualOver<L::Group, S>,
    ) {
        self.system.velocity_and_force(t, g, mu, workspace, xi, tau);
        tau.add_scaled(S::one(), &self.force.force(t, g, xi));
    }

    fn is_symplectic(&self) -> bool {
        false
    }

    fn fits(&self, g: &L::Group) -> bool {
        self.system.fits(g)
    }

    fn is_defined(&self, t: f64, g: &L::Group) -> bool {
        self.system.is_defined(t, g)
    }

    fn without_inertia(&self, t: f64, g: &L::Group) -> Option<usize> {
        self.system.without_inertia(t, g)
    }
}
