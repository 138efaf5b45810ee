//! Hamilton's equations on raw entries, inlined for the instructions of the scalar.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{ContinuousSystem, State};
use lie::{AlgebraOver, Batch, DualOver, LieGroup, RealGroup, SO3, Tangent, Vec3, VectorSpace};

use super::rotation;

/// (18)–(20) with $\dot R_i = R_i \hat\Omega_i$, (15); one state in all items of `S`.
pub(crate) struct RightHandSide<S: Batch<Item = f64>> {
    model: ArticulatedBody,
    g: Configuration<S>,
    mu: DualOver<Configuration, S>,
    xi: AlgebraOver<Configuration, S>,
    tau: DualOver<Configuration, S>,
    workspace: articulated_fluid::Elimination<S>,
    momenta: Vec<S>,
    pub(crate) evaluations: usize,
}

impl<S: Batch<Item = f64>> RightHandSide<S> {
    pub(crate) fn new(model: &ArticulatedBody, start: &State<Configuration>) -> Self {
        let g = start.g.lift::<S>();
        Self {
            model: model.clone(),
            mu: g.zero_dual(),
            xi: g.zero_algebra(),
            tau: g.zero_dual(),
            workspace: ContinuousSystem::workspace::<S>(model, &g),
            momenta: vec![S::splat(0.0); start.mu.dim()],
            g,
            evaluations: 0,
        }
    }

    /// The rates of `y`, both as [`pack`](crate::raw::pack) lays them out.
    #[inline(never)]
    pub(crate) fn evaluate(&mut self, y: &[f64], dy: &mut [f64]) {
        self.evaluations += 1;
        S::run(
            #[inline(always)]
            || {
                self.read(y);
                let (g, mu, xi, tau) = (&self.g, &self.mu, &mut self.xi, &mut self.tau);
                let work = &mut self.workspace;
                self.model
                    .velocity_and_force::<S>(S::splat(0.0), g, mu, work, xi, tau);
                self.write(dy);
            },
        );
    }

    #[inline(always)]
    fn read(&mut self, y: &[f64]) {
        let (r0, rest) = y.split_at(9);
        let (x, rest) = rest.split_at(3);
        let (r, mu) = rest.split_at(9 * self.g.2.len());
        self.g.0 = rotation(r0);
        self.g.1.0 = [S::splat(x[0]), S::splat(x[1]), S::splat(x[2])];
        for (out, r) in self.g.2.iter_mut().zip(r.chunks_exact(9)) {
            *out = rotation(r);
        }
        for (out, mu) in self.momenta.iter_mut().zip(mu) {
            *out = S::splat(*mu);
        }
        self.mu.read(&self.momenta);
    }

    #[inline(always)]
    fn write(&mut self, dy: &mut [f64]) {
        let (d_r0, rest) = dy.split_at_mut(9);
        let (d_x, rest) = rest.split_at_mut(3);
        let (d_r, d_mu) = rest.split_at_mut(9 * self.g.2.len());
        rate(&self.g.0, &self.xi.0, d_r0);
        store(&self.xi.1.0, d_x);
        turned(
            self.tau.0.vec3(),
            self.mu.0.vec3(),
            &self.xi.0,
            &mut d_mu[..3],
        );
        store(&self.tau.1.0, &mut d_mu[3..6]);
        let tails = self
            .g
            .2
            .iter()
            .zip(self.xi.2.iter())
            .zip(d_r.chunks_exact_mut(9));
        for ((r, omega), d_r) in tails {
            rate(r, omega, d_r);
        }
        let tails = self
            .tau
            .2
            .iter()
            .zip(self.mu.2.iter())
            .zip(self.xi.2.iter());
        for (((tau, mu), omega), d_mu) in tails.zip(d_mu[6..].chunks_exact_mut(3)) {
            turned(tau.vec3(), mu.vec3(), omega, d_mu);
        }
    }
}

/// $R \hat\Omega$: the rows of $R$, each crossed with $\Omega$.
#[inline(always)]
fn rate<S: Batch<Item = f64>>(r: &SO3<S>, omega: &Tangent<3, S>, out: &mut [f64]) {
    for (i, out) in out.chunks_exact_mut(3).enumerate() {
        store(&r.matrix().row(i).cross(omega.vec3()).0, out);
    }
}

/// $\tau + \mu \times \Omega$.
#[inline(always)]
fn turned<S: Batch<Item = f64>>(tau: Vec3<S>, mu: Vec3<S>, omega: &Tangent<3, S>, out: &mut [f64]) {
    store(&(tau + mu.cross(omega.vec3())).0, out);
}

#[inline(always)]
fn store<S: Batch<Item = f64>>(x: &[S; 3], out: &mut [f64]) {
    for (out, x) in out.iter_mut().zip(x) {
        *out = S::items(core::slice::from_ref(x))[0];
    }
}
