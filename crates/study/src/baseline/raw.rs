//! The continuous model as explicit methods on vectors see it: raw matrix entries, which nothing keeps orthogonal.
//!
//! Layout: $R_0, \dots, R_n$ row by row, $x$, then $p_0, \dots, p_n, p_x$; at the end the angles of hinges and their momenta.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{Context, ContinuousSystem, State};
use lie::{AlgebraOver, Batch, Cotangent, DualOver, Mat3, RealGroup, SO3, Tangent, Vec3};
use lie::{LieGroup, VectorSpace};

/// The state as a vector; `t` is left out.
pub(super) fn pack(state: &State<Configuration>) -> Vec<f64> {
    let mut y = zero(&state.g);
    write(state, &mut y);
    y
}

/// A vector for states of the shape of this one.
pub(super) fn zero((r, x, q): &Configuration) -> Vec<f64> {
    vec![0.0; 12 * r.len() + 6 * x.len() + 2 * q.len()]
}

/// The parts for attitudes and places, for hinge angles, and for their momenta.
#[inline(always)]
fn parts(y: &[f64], hinges: usize) -> (&[[f64; 3]], &[f64], &[f64]) {
    let (main, angles) = y.split_at(y.len() - 2 * hinges);
    let (q, pi) = angles.split_at(hinges);
    (main.as_chunks().0, q, pi)
}

/// [`pack`] into a vector of fitting length.
pub(super) fn write(State { g, mu, .. }: &State<Configuration>, y: &mut [f64]) {
    let (r, x, q) = g;
    let (y, angles) = y.split_at_mut(12 * r.len() + 6 * x.len());
    let (of_q, of_pi) = angles.split_at_mut(q.len());
    for (i, entry) in of_q.iter_mut().enumerate() {
        (*entry, of_pi[i]) = (q[i].0[0], mu.2[i][0]);
    }
    let (of_r, rest) = y.split_at_mut(9 * r.len());
    let (of_x, of_mu) = rest.split_at_mut(3 * x.len());
    for (entries, r) in of_r.chunks_exact_mut(9).zip(r.iter()) {
        entries.copy_from_slice(r.matrix().0.as_flattened());
    }
    for (entries, x) in of_x.chunks_exact_mut(3).zip(x.iter()) {
        entries.copy_from_slice(&x.0);
    }
    mu.0.write(&mut of_mu[..3 * r.len()]);
    mu.1.write(&mut of_mu[3 * r.len()..]);
}

/// The inverse of [`pack`] into a configuration and momentum of fitting size, with the matrices as they are; the same state in all
/// items of `S`.
#[inline(always)]
pub(super) fn read<S: Batch<Item = f64>>(
    y: &[f64],
    (r, x, q): &mut Configuration<S>,
    (p, px, pi): &mut DualOver<Configuration, S>,
) {
    let (triples, of_q, of_pi) = parts(y, q.len());
    for i in 0..q.len() {
        (q[i].0[0], pi[i][0]) = (S::splat(of_q[i]), S::splat(of_pi[i]));
    }
    let (of_r, rest) = triples.split_at(3 * r.len());
    let (of_x, rest) = rest.split_at(x.len());
    let (of_p, of_px) = rest.split_at(p.len());
    for (r, [a, b, c]) in r.iter_mut().zip(of_r.as_chunks().0) {
        *r = rotation([a, b, c]);
    }
    for (x, entries) in x.iter_mut().zip(of_x) {
        x.0 = vector(entries);
    }
    let momenta = p.iter_mut().zip(of_p).chain(px.iter_mut().zip(of_px));
    for (p, entries) in momenta {
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
    workspace: articulated_fluid::Evaluation<S>,
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
            workspace: Default::default(),
            g,
        }
    }

    /// A momentum of the shape of the states.
    pub(super) fn momentum(&self) -> &DualOver<Configuration, S> {
        &self.mu
    }

    /// The rates of `y` at the time `t`, both as [`pack`] lays them out.
    #[inline(never)]
    pub(super) fn evaluate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        S::run(
            #[inline(always)]
            || {
                let (g, mu, xi, tau) = (&mut self.g, &mut self.mu, &mut self.xi, &mut self.tau);
                read(y, g, mu);
                let (at, work) = (Context::new(S::splat(t), &[]), &mut self.workspace);
                self.model.velocity_and_force::<S>(at, g, mu, work, xi, tau);
                self.write(dy);
            },
        );
    }

    #[inline(always)]
    fn write(&self, dy: &mut [f64]) {
        let ((r, x, q), (p, ..)) = (&self.g, &self.mu);
        let ((omega, v, rates), (tau, force, torques)) = (&self.xi, &self.tau);
        let (dy, angles) = dy.split_at_mut(dy.len() - 2 * q.len());
        let (d_q, d_pi) = angles.split_at_mut(q.len());
        for i in 0..q.len() {
            (d_q[i], d_pi[i]) = (first(rates[i][0]), first(torques[i][0]));
        }
        let (triples, _) = dy.as_chunks_mut();
        let (d_r, rest) = triples.split_at_mut(3 * r.len());
        let (d_x, rest) = rest.split_at_mut(x.len());
        let (d_p, d_px) = rest.split_at_mut(p.len());
        for ((r, omega), [a, b, c]) in r.iter().zip(omega.iter()).zip(d_r.as_chunks_mut().0) {
            rotated(r, omega, [a, b, c]);
        }
        for (v, d_x) in v.iter().zip(d_x) {
            store(v.vec3(), d_x);
        }
        for (((tau, p), omega), d_p) in tau.iter().zip(p.iter()).zip(omega.iter()).zip(d_p) {
            turned(tau, p, omega, d_p);
        }
        for (force, d_px) in force.iter().zip(d_px) {
            store(force.vec3(), d_px);
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
        *out = first(*x);
    }
}

#[inline(always)]
fn first<S: Batch<Item = f64>>(x: S) -> f64 {
    S::items(core::slice::from_ref(&x))[0]
}
