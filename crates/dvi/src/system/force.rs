//! Forces that are no gradient of the Lagrangian: drag, control, thrust. Discrete Lagrange–d'Alembert.

use lie::{AlgebraOver, DualOver, LieGroup, Over, RealGroup, Retraction, Scalar, VectorSpace};

use super::context::Context;
use super::discretised::{Between, DiscretisedWorkspace};
use super::lagrangian::Discretised;
use super::quadrature::Place;

/// A force $F(t, g, \xi) \in \mathfrak g^\ast$, left-trivialised: its virtual work is $\langle F, g^{-1} \delta g \rangle$.
///
/// On a rotation that is a torque in the body's frame, on $\mathbb{R}^n$ a force.
///
/// ```
/// use dvi::{Context, Force, Integrator, Lagrangian, Quadrature, State, System, Variational};
/// use lie::{Cotangent, Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg.
/// struct Particle;
///
/// impl System for Particle {
///     type Group = Rn<1>;
/// }
///
/// impl Lagrangian for Particle {
///     fn value<S: Scalar>(&self, _: Context<S>, _: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         v[0] * v[0] * S::from_f64(0.5)
///     }
/// }
///
/// /// A drag of 0.2 kg/s.
/// struct Drag;
///
/// impl Force for Drag {
///     type Group = Rn<1>;
///     fn force<S: Scalar>(&self, _: Context<S>, _: &Rn<1, S>, v: &Tangent<1, S>, out: &mut Cotangent<1, S>) {
///         out[0] = v[0] * S::from_f64(-0.2);
///     }
/// }
///
/// let damped = Particle.discretise(Quadrature::Midpoint).with_force(Drag);
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

    /// Whether [`force`](Self::force) and all that it calls is `#[inline(always)]`; see [`ContinuousSystem::INLINE`](crate::ContinuousSystem::INLINE).
    const INLINE: bool = false;

    /// $F(t, g, \xi)$, into `out`, which comes in as zero.
    ///
    /// The parameters in the context are those of the system that the force acts on.
    fn force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<Self::Group, S>,
        xi: &AlgebraOver<Self::Group, S>,
        out: &mut DualOver<Self::Group, S>,
    );
}

/// Discrete forces $f_d^\pm(t, g, f) \in \mathfrak g^\ast$: the impulses of a step of size $h$, in N m s.
///
/// Their virtual work over a step is $\langle f_d^-, g_k^{-1} \delta g_k \rangle + \langle f_d^+, g_{k+1}^{-1} \delta g_{k+1} \rangle$
/// (J. E. Marsden, M. West, *Discrete mechanics and variational integrators*, Acta Numerica 2001, § 3.2).
pub trait DiscreteForce {
    /// The configuration group.
    type Group: RealGroup;

    /// Storage of the force's own, empty at first and kept from call to call; `()` where none is needed.
    type Workspace<S: Scalar>: Default + Send + Sync;

    /// The impulses $f_d^-$ and $f_d^+$, each left-trivialised at its own end of the step, into two vectors that come in as zero.
    fn impulses<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<Self::Group, S>,
        f: &Over<Self::Group, S>,
        h: S,
        work: &mut Self::Workspace<S>,
        out: [&mut DualOver<Self::Group, S>; 2],
    );

    /// The order of the forces: that of a forced step is at most this.
    fn order(&self) -> u32 {
        1
    }

    /// Whether they are the same read backwards: $f_d^\pm(t, g, f, h) = -f_d^\mp(t + h, g f, f^{-1}, -h)$.
    fn is_symmetric(&self) -> bool {
        false
    }
}

/// The force at the middle acts on both ends by half, each moved there by $\mathrm{Ad}^\ast$. So it keeps every momentum map
/// of a left translation that the continuous force keeps.
impl<F: Force, R: Retraction> DiscreteForce for Discretised<F, R> {
    type Group = F::Group;
    type Workspace<S: Scalar> = DiscretisedWorkspace<F::Group, S>;

    fn impulses<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<F::Group, S>,
        f: &Over<F::Group, S>,
        h: S,
        work: &mut Self::Workspace<S>,
        [minus, plus]: [&mut DualOver<F::Group, S>; 2],
    ) {
        let between = work.for_shape_of(g);
        between.set_velocity::<R>(f, h);
        for &(weight, place) in self.rule.nodes() {
            let at = between.go(place, at, (g, f), h);
            let Between {
                xi,
                root,
                place: there,
                force: [force, moved],
            } = between;
            force.set_zero();
            self.system.force(at, there, xi, force);
            let scale = h * S::from_f64(weight);
            match place {
                Place::Start => minus.add_scaled(scale, force),
                Place::End => plus.add_scaled(scale, force),
                Place::Middle => {
                    let half = scale * S::from_f64(0.5);
                    root.inverse_coadjoint_into(force, moved);
                    minus.add_scaled(half, moved);
                    root.coadjoint_into(force, moved);
                    plus.add_scaled(half, moved);
                }
            }
        }
    }

    fn order(&self) -> u32 {
        self.rule.order()
    }

    fn is_symmetric(&self) -> bool {
        self.rule.is_symmetric()
    }
}
