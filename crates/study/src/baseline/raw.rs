//! The continuous model as explicit methods on vectors see it: raw matrix entries, which nothing keeps orthogonal.
//!
//! Layout: $R_0$ row by row, $x$, $R_1, \dots, R_n$, then $p_0, p_x, p_1, \dots, p_n$.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{ContinuousSystem, State};
use lie::{AlgebraOver, Batch, Cotangent, DualOver, Mat3, RealGroup, SO3, Tangent, Vec3};
use lie::{LieGroup, VectorSpace};

/// The state as a vector; `t` is left out.
pub(super) fn pack(state: &State<Configuration>) -> Vec<f64> {
    let mut y = zero(&state.g);
    write(state, &mut y);
    y
}

/// A vector for states of the shape of this one.
pub(super) fn zero((_, _, r): &Configuration) -> Vec<f64> {
    vec![0.0; 18 + 12 * r.len()]
}

/// [`pack`] into a vector of fitting length.
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
    let (triples, _) = y.as_chunks();
    let [a, b, c, of_x, rest @ ..] = triples else {
        return;
    };
    let (of_r, [of_p0, of_px, of_p @ ..]) = rest.split_at(3 * r.len()) else {
        return;
    };
    *r0 = rotation([a, b, c]);
    x.0 = vector(of_x);
    for (r, [a, b, c]) in r.iter_mut().zip(of_r.as_chunks().0) {
        *r = rotation([a, b, c]);
    }
    *p0 = Cotangent(vector(of_p0));
    *px = Cotangent(vector(of_px));
    for (p, entries) in p.iter_mut().zip(of_p) {
        *p = Cotangent(vector(entries));
    }
}

// Calls of `map` would not be inlined.
#[inline(always)]
fn vector<S: Batch<Item = f64>>([x, y, z]: &[f64; 3]) -> [S; 3] {
    [S::splat(*x), S::splat(*y), S::splat(*z)]
}

#[inline(always)]
fn rotation<S: Batch<Item = f64>>([a, b, c]: [&[f64; 3]; 3]) -> SO3<S> {
    SO3::from_matrix_unchecked(Mat3([vector(a), vector(b), vector(c)]))
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

    /// A configuration and a momentum of the shape of the states.
    pub(super) fn shape(&self) -> (&Configuration<S>, &DualOver<Configuration, S>) {
        (&self.g, &self.mu)
    }

    /// The rates of `y`, both as [`pack`] lays them out.
    #[inline(never)]
    pub(super) fn evaluate(&mut self, y: &[f64], dy: &mut [f64]) {
        S::run(
            #[inline(always)]
            || {
                let (g, mu, xi, tau) = (&mut self.g, &mut self.mu, &mut self.xi, &mut self.tau);
                read(y, g, mu);
                self.model.velocity_and_force::<S>(
                    S::splat(0.0),
                    g,
                    mu,
                    &mut self.workspace,
                    xi,
                    tau,
                );
                self.write(dy);
            },
        );
    }

    #[inline(always)]
    fn write(&self, dy: &mut [f64]) {
        let ((r0, _, r), (p0, _, p)) = (&self.g, &self.mu);
        let ((omega0, v, omega), (tau0, force, tau)) = (&self.xi, &self.tau);
        let (triples, _) = dy.as_chunks_mut();
        let [a, b, c, d_x, rest @ ..] = triples else {
            return;
        };
        let (d_r, [d_p0, d_px, d_p @ ..]) = rest.split_at_mut(3 * r.len()) else {
            return;
        };
        rotated(r0, omega0, [a, b, c]);
        store(v.vec3(), d_x);
        for ((r, omega), [a, b, c]) in r.iter().zip(omega.iter()).zip(d_r.as_chunks_mut().0) {
            rotated(r, omega, [a, b, c]);
        }
        turned(tau0, p0, omega0, d_p0);
        store(force.vec3(), d_px);
        for (((tau, p), omega), d_p) in tau.iter().zip(p.iter()).zip(omega.iter()).zip(d_p) {
            turned(tau, p, omega, d_p);
        }
    }
}

/// $R \hat\Omega$: the rows of $R$, each crossed with $\Omega$.
#[inline(always)]
fn rotated<S: Batch<Item = f64>>(r: &SO3<S>, omega: &Tangent<3, S>, rows: [&mut [f64; 3]; 3]) {
    for (i, out) in rows.into_iter().enumerate() {
        store(r.matrix().row(i).cross(omega.vec3()), out);
    }
}

/// $\tau + p \times \Omega$.
#[inline(always)]
fn turned<S: Batch<Item = f64>>(
    tau: &Cotangent<3, S>,
    p: &Cotangent<3, S>,
    omega: &Tangent<3, S>,
    out: &mut [f64; 3],
) {
    store(tau.vec3() + p.vec3().cross(omega.vec3()), out);
}

#[inline(always)]
fn store<S: Batch<Item = f64>>(x: Vec3<S>, out: &mut [f64; 3]) {
    for (out, x) in out.iter_mut().zip(&x.0) {
        *out = S::items(core::slice::from_ref(x))[0];
    }
}
