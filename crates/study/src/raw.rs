//! The continuous model as explicit methods see it: a vector of raw matrix entries, which nothing keeps orthogonal.
//!
//! Layout: $R_0$ row by row, $x$, $R_1, \dots, R_n$, then $p_0, p_x, p_1, \dots, p_n$.

mod right_hand_side;

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::State;
use lie::{Batch, LieGroup, Mat3, Rn, SO3, VectorSpace};

pub(crate) use right_hand_side::RightHandSide;

/// The state as a vector; `t` is left out.
pub fn pack(state: &State<Configuration>) -> Vec<f64> {
    let mut y = vec![0.0; length(state)];
    write(state, &mut y);
    y
}

/// The inverse of [`pack`], with the matrices as they are; `None` where the length fits no number of tails.
pub fn unpack(t: f64, y: &[f64]) -> Option<State<Configuration>> {
    let tails = y.len().checked_sub(18)? / 12;
    if y.len() != 18 + 12 * tails {
        return None;
    }
    let zero = SO3::from_matrix_unchecked(Mat3::zero());
    let g = (zero, Rn([0.0; 3]), vec![zero; tails].into_iter().collect());
    let mut state = State {
        t,
        mu: LieGroup::zero_dual(&g),
        g,
    };
    fill(&mut state, y);
    Some(state)
}

/// The length of [`pack`]'s vector.
pub(crate) fn length(state: &State<Configuration>) -> usize {
    12 + 9 * state.g.2.len() + state.mu.dim()
}

/// [`pack`] into a vector of its length.
pub(crate) fn write(state: &State<Configuration>, y: &mut [f64]) {
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

/// Sets a state of fitting size to the vector, its matrices as they are.
pub(crate) fn fill(state: &mut State<Configuration>, y: &[f64]) {
    let (r0, rest) = y.split_at(9);
    let (x, rest) = rest.split_at(3);
    let (r, mu) = rest.split_at(9 * state.g.2.len());
    state.g.0 = rotation(r0);
    state.g.1.0.copy_from_slice(x);
    for (out, r) in state.g.2.iter_mut().zip(r.chunks_exact(9)) {
        *out = rotation(r);
    }
    state.mu.read(mu);
}

#[inline(always)]
fn rotation<S: Batch<Item = f64>>(entries: &[f64]) -> SO3<S> {
    let entry = |i: usize, j: usize| S::splat(entries[3 * i + j]);
    let row = |i: usize| [entry(i, 0), entry(i, 1), entry(i, 2)];
    SO3::from_matrix_unchecked(Mat3([row(0), row(1), row(2)]))
}

/// Hamilton's equations (18)–(20) with $\dot R_i = R_i \hat\Omega_i$, (15), on raw entries.
///
/// The closure takes `t`, on which nothing depends, the vector and where to put its derivative, both as long as [`pack`] makes them.
pub fn right_hand_side(
    model: &ArticulatedBody,
    start: &State<Configuration>,
) -> impl FnMut(f64, &[f64], &mut [f64]) + use<> {
    let mut rates = RightHandSide::<f64>::new(model, start);
    move |_, y, dy| rates.evaluate(y, dy)
}
