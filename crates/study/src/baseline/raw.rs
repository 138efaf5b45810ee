//! The continuous model as explicit methods on vectors see it: raw matrix entries, which nothing keeps orthogonal.
//!
//! Layout: $R_0$ row by row, $x$, $R_1, \dots, R_n$, then $p_0, p_x, p_1, \dots, p_n$.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{ContinuousSystem, State};
use lie::{AlgebraOver, Batch, Cotangent, DualOver, Mat3, RealGroup, SO3, Tangent, Vec3};
use lie::{LieGroup, VectorSpace};

/// The state as a vector; `t` is left out.
pub(super) fn pack(state: &State<Configuration>) -> Vec<f64> {
    let mut y = vec![0.0; length(state)];
    write(state, &mut y);
    y
}

/// The length of [`pack`]'s vector.
pub(super) fn length(state: &State<Configuration>) -> usize {
    12 + 9 * state.g.2.len() + state.mu.dim()
}

/// [`pack`] into a vector of its length.
pub(super) fn write(state: &State<Configuration>, y: &mut [f64]) {
    let (r0, rest) = y.split_at_mut(9);
    let (x, rest) = rest.split_at_mut(3);
    let (r, mu) = rest.split_at_mut(9 * state.g.2.len());
    r0.copy_from_slice(state.g.0.matrix().0.as_flattened());
    x.copy_from_slice(&state.g.1.0);
    for (entries, r) in r.chunks_exact_mut(9).zip(state.g.2.iter()) {
        entries.copy_from_slice(r.matrix().0.as_flattened());
    }
    state.mu.write(mu);
}

/// The inverse of [`pack`] into a configuration and momentum of fitting size, with the matrices as they are; the same state in all
/// items of `S`.
#[inline(always)]
pub(super) fn read<S: Batch<Item = f64>>(
    y: &[f64],
    (r0, x, r): &mut Configuration<S>,
    (p0, px, p): &mut DualOver<Configuration, S>,
) {
    let (of_r0, rest) = y.split_at(9);
    let (of_x, rest) = rest.split_at(3);
    let (of_r, rest) = rest.split_at(9 * r.len());
    let (of_p0, rest) = rest.split_at(3);
    let (of_px, of_p) = rest.split_at(3);
    *r0 = rotation(of_r0);
    x.0 = vector(of_x);
    for (r, entries) in r.iter_mut().zip(of_r.chunks_exact(9)) {
        *r = rotation(entries);
    }
    *p0 = Cotangent(vector(of_p0));
    *px = Cotangent(vector(of_px));
    for (p, entries) in p.iter_mut().zip(of_p.chunks_exact(3)) {
        *p = Cotangent(vector(entries));
    }
}

#[inline(always)]
fn vector<S: Batch<Item = f64>>(entries: &[f64]) -> [S; 3] {
    [0, 1, 2].map(|i| S::splat(entries[i]))
}

#[inline(always)]
fn rotation<S: Batch<Item = f64>>(entries: &[f64]) -> SO3<S> {
    SO3::from_matrix_unchecked(Mat3([0, 3, 6].map(|row| vector(&entries[row..]))))
}

/// Hamilton's equations (18)–(20) with $\dot R_i = R_i \hat\Omega_i$, (15), inlined for the instructions of `S`.
pub(super) struct Rates<S: Batch<Item = f64>> {
    model: ArticulatedBody,
    g: Configuration<S>,
    mu: DualOver<Configuration, S>,
    xi: AlgebraOver<Configuration, S>,
    tau: DualOver<Configuration, S>,
    workspace: articulated_fluid::Elimination<S>,
}

impl<S: Batch<Item = f64>> Rates<S> {
    /// The rates of states of the shape of this one.
    pub(super) fn new(model: &ArticulatedBody, g: &Configuration) -> Self {
        let g = g.lift::<S>();
        Self {
            model: model.clone(),
            mu: g.zero_dual(),
            xi: g.zero_algebra(),
            tau: g.zero_dual(),
            workspace: ContinuousSystem::workspace::<S>(model, &g),
            g,
        }
    }

    /// The rates of `y`, both as [`pack`] lays them out.
    #[inline(never)]
    pub(super) fn evaluate(&mut self, y: &[f64], dy: &mut [f64]) {
        S::run(
            #[inline(always)]
            || {
                let (g, mu, xi, tau) = (&mut self.g, &mut self.mu, &mut self.xi, &mut self.tau);
                read(y, g, mu);
                self.model
                    .velocity_and_force::<S>(S::splat(0.0), g, mu, &mut self.workspace, xi, tau);
                self.write(dy);
            },
        );
    }

    #[inline(always)]
    fn write(&self, dy: &mut [f64]) {
        let (d_r0, rest) = dy.split_at_mut(9);
        let (d_x, rest) = rest.split_at_mut(3);
        let (d_r, rest) = rest.split_at_mut(9 * self.g.2.len());
        let (d_p0, rest) = rest.split_at_mut(3);
        let (d_px, d_p) = rest.split_at_mut(3);
        let ((r0, _, r), (p0, _, p)) = (&self.g, &self.mu);
        let ((omega0, v, omega), (tau0, force, tau)) = (&self.xi, &self.tau);
        rotated(r0, omega0, d_r0);
        store(&v.0, d_x);
        turned(tau0, p0, omega0, d_p0);
        store(&force.0, d_px);
        for ((r, omega), out) in r.iter().zip(omega.iter()).zip(d_r.chunks_exact_mut(9)) {
            rotated(r, omega, out);
        }
        let tails = tau.iter().zip(p.iter()).zip(omega.iter());
        for (((tau, p), omega), out) in tails.zip(d_p.chunks_exact_mut(3)) {
            turned(tau, p, omega, out);
        }
    }
}

/// $R \hat\Omega$: the rows of $R$, each crossed with $\Omega$.
#[inline(always)]
fn rotated<S: Batch<Item = f64>>(r: &SO3<S>, omega: &Tangent<3, S>, out: &mut [f64]) {
    for (i, out) in out.chunks_exact_mut(3).enumerate() {
        store(&r.matrix().row(i).cross(omega.vec3()).0, out);
    }
}

/// $\tau + p \times \Omega$.
#[inline(always)]
fn turned<S: Batch<Item = f64>>(
    tau: &Cotangent<3, S>,
    p: &Cotangent<3, S>,
    omega: &Tangent<3, S>,
    out: &mut [f64],
) {
    let sum: Vec3<S> = tau.vec3() + p.vec3().cross(omega.vec3());
    store(&sum.0, out);
}

#[inline(always)]
fn store<S: Batch<Item = f64>>(x: &[S; 3], out: &mut [f64]) {
    for (out, x) in out.iter_mut().zip(x) {
        *out = S::items(core::slice::from_ref(x))[0];
    }
}
