//! The same beam by its equations, written by hand: what the recorded ones are compared with.
//!
//! With $h = g_i^{-1} g_{i+1} = \mathrm{cay}(c)$ and the stress $s = \partial U / \partial c$, the momentum $m = (\mathrm d\tau_c^{-1})^\ast s$ pulls:
//! the force on node $i + 1$ is $-m$, that on node $i$ is $\mathrm{Ad}^\ast_{h^{-1}} m$.

use lgvi::dvi::{Context, ContinuousSystem, System};
use lgvi::lie::{Cayley, Cotangent, LieGroup, Power, SE3, Scalar, Tangent};

use super::model::{Beam, STIFFNESS};

/// A beam in free flight.
#[derive(Clone, Copy)]
pub struct ByHand(pub Beam);

impl System for ByHand {
    type Group = Power<SE3>;
}

impl ContinuousSystem for ByHand {
    type Workspace<S: Scalar> = ();
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _: Context<S>,
        g: &Power<SE3<S>>,
        mu: &Power<Cotangent<6, S>>,
        (): &mut (),
        xi: &mut Power<Tangent<6, S>>,
        tau: &mut Power<Cotangent<6, S>>,
    ) {
        let masses = self.0.masses();
        for ((xi, mu), tau) in xi.iter_mut().zip(mu.iter()).zip(tau.iter_mut()) {
            for k in 0..6 {
                xi[k] = mu[k].times(1.0 / masses[k]);
            }
            *tau = Cotangent([S::zero(); 6]);
        }
        for i in 1..g.len() {
            let (here, next) = self.pull(&g[i - 1], &g[i]);
            tau[i - 1] += here;
            tau[i] -= next;
        }
    }
}

impl ByHand {
    /// How the strain between two nodes pulls at the first, and at the second the other way.
    #[inline(always)]
    fn pull<S: Scalar>(&self, a: &SE3<S>, b: &SE3<S>) -> (Cotangent<6, S>, Cotangent<6, S>) {
        let apart = self.0.apart(a, b);
        let chart = apart.retract_inverse::<Cayley>();
        let c = chart.unwrap_or(Tangent([S::from_f64(f64::NAN); 6]));
        let mut stress = Cotangent([S::zero(); 6]);
        for k in 0..6 {
            let straight = if k == 3 { self.0.piece } else { 0.0 };
            stress[k] = (c[k] - S::from_f64(straight)).times(STIFFNESS[k] / self.0.piece);
        }
        let (mut h, mut here, mut next) = (apart, stress, stress);
        SE3::<S>::chart_enter_into::<Cayley>(&c, &stress, (&mut h, &mut next));
        apart.inverse_coadjoint_into(&next, &mut here);
        (here, next)
    }
}
