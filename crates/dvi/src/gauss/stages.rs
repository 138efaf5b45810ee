//! Vectors and coefficients of the stages, as many of them side by side as the scalar has items.

use lie::{Batch, Scalar};

use super::tableau::{Split, Tableau};

/// A vector for each stage. A *block* holds the same coordinates of `S::ITEMS` stages side by side; where the last block has more
/// items than stages are left, it repeats the last stage.
#[derive(Clone)]
pub(super) struct Stages<S> {
    dim: usize,
    values: Vec<S>,
}

impl<S: Batch> Stages<S> {
    pub(super) fn new(stages: usize, dim: usize) -> Self {
        Self {
            dim,
            values: vec![S::zero(); blocks::<S>(stages) * dim],
        }
    }

    #[inline(always)]
    pub(super) fn blocks(&self) -> usize {
        self.values.len() / self.dim.max(1)
    }

    #[inline(always)]
    pub(super) fn block(&self, k: usize) -> &[S] {
        &self.values[k * self.dim..][..self.dim]
    }

    #[inline(always)]
    pub(super) fn block_mut(&mut self, k: usize) -> &mut [S] {
        &mut self.values[k * self.dim..][..self.dim]
    }

    /// Coordinate `d` at stage `i`.
    #[inline(always)]
    pub(super) fn get(&self, i: usize, d: usize) -> S::Item {
        S::items(self.block(i / S::ITEMS))[d * S::ITEMS + i % S::ITEMS]
    }

    /// Sets coordinate `d` at stage `i` of `stages`, and at those that repeat it.
    pub(super) fn set(&mut self, stages: usize, i: usize, d: usize, value: S::Item) {
        let repeats = if i + 1 == stages {
            self.blocks() * S::ITEMS
        } else {
            i + 1
        };
        for i in i..repeats {
            S::items_mut(self.block_mut(i / S::ITEMS))[d * S::ITEMS + i % S::ITEMS] = value;
        }
    }

    #[inline(always)]
    pub(super) fn set_zero(&mut self) {
        self.values.fill(S::zero());
    }

    #[inline(always)]
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.values.copy_from_slice(&other.values);
    }

    #[inline(always)]
    pub(super) fn values(&self) -> &[S] {
        &self.values
    }

    pub(super) fn items_mut(&mut self) -> impl Iterator<Item = &mut S::Item> {
        S::items_mut(&mut self.values).iter_mut()
    }
}

fn blocks<S: Batch>(stages: usize) -> usize {
    stages.div_ceil(S::ITEMS)
}

/// A row of coefficients for each stage, a column for each stage.
pub(super) struct Matrix<S> {
    /// Columns, filled up with zeros.
    columns: usize,
    values: Vec<S>,
}

impl<S: Batch> Matrix<S> {
    pub(super) fn new(stages: usize) -> Self {
        let columns = blocks::<S>(stages) * S::ITEMS;
        Self {
            columns,
            values: vec![S::zero(); blocks::<S>(stages) * columns],
        }
    }

    fn with(stages: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut matrix = Self::new(stages);
        matrix.set(stages, entry);
        matrix
    }

    pub(super) fn set(&mut self, stages: usize, entry: impl Fn(usize, usize) -> f64) {
        for k in 0..blocks::<S>(stages) {
            for j in 0..stages {
                self.values[k * self.columns + j] =
                    side_by_side(k, |i| entry(i.min(stages - 1), j));
            }
        }
    }

    /// $o_i = s + h (e_i + \sum_j m_{ij} v_j)$ for the stages of block `k`.
    #[inline(always)]
    pub(super) fn combine(
        &self,
        k: usize,
        out: &mut Stages<S>,
        (h, extra): (S::Item, &Stages<S>),
        values: &Stages<S>,
        start: &[S::Item],
    ) {
        let (extra, h) = (extra.block(k), S::splat(h));
        let end = |d: usize, sum| h.mul_add(sum, S::splat(start[d]));
        self.sum_products(k, out.block_mut(k), values, (|d: usize, _| extra[d], end));
    }

    /// Adds $\sum_j m_{ij} v_j$.
    #[inline(always)]
    pub(super) fn add(&self, out: &mut Stages<S>, values: &Stages<S>) {
        for k in 0..out.blocks() {
            let as_is = |_: usize, value| value;
            self.sum_products(k, out.block_mut(k), values, (as_is, as_is));
        }
    }

    /// $o_i \leftarrow e(b(o_i) + \sum_j m_{ij} v_j)$ for the stages of block `k`, in one pass where all stages are of it.
    #[inline(always)]
    fn sum_products(
        &self,
        k: usize,
        out: &mut [S],
        values: &Stages<S>,
        (begin, end): (impl Fn(usize, S) -> S, impl Fn(usize, S) -> S),
    ) {
        let row = &self.values[k * self.columns..][..self.columns];
        if S::ITEMS == 1 {
            return one_stage(out, row, &values.values, (begin, end));
        }
        let last = values.blocks() - 1;
        for (l, weights) in row.chunks_exact(S::ITEMS).enumerate() {
            let items = S::items(values.block(l));
            let before = |d, value| if l == 0 { begin(d, value) } else { value };
            let after = |d, sum| if l == last { end(d, sum) } else { sum };
            match S::ITEMS {
                2 => columns::<S, 2>(out, weights, items, (before, after)),
                4 => columns::<S, 4>(out, weights, items, (before, after)),
                _ => columns::<S, 8>(out, weights, items, (before, after)),
            }
        }
    }
}

/// Adds $\sum_j w_j v_j$ for a block of one stage.
#[inline(always)]
fn one_stage<S: Scalar>(
    out: &mut [S],
    weights: &[S],
    values: &[S],
    (begin, end): (impl Fn(usize, S) -> S, impl Fn(usize, S) -> S),
) {
    const SOME: usize = 4;
    let dim = out.len();
    for (d, out) in out.iter_mut().enumerate() {
        *out = begin(d, *out);
    }
    let (some, rest) = weights.as_chunks::<SOME>();
    let (of_some, of_rest) = values.split_at(dim * SOME * some.len());
    for (weights, stages) in some.iter().zip(of_some.chunks_exact(dim * SOME)) {
        let stage: [&[S]; SOME] = core::array::from_fn(|j| &stages[j * dim..][..dim]);
        for (d, out) in out.iter_mut().enumerate() {
            let add = |sum, j: usize| stage[j][d].mul_add(weights[j], sum);
            *out = (0..SOME).fold(*out, add);
        }
    }
    for (weight, stage) in rest.iter().zip(of_rest.chunks_exact(dim)) {
        for (out, value) in out.iter_mut().zip(stage) {
            *out = value.mul_add(*weight, *out);
        }
    }
    for (d, out) in out.iter_mut().enumerate() {
        *out = end(d, *out);
    }
}

/// Adds $\sum_j w_j v_j$ for the `N` stages of a block, its weights held in registers.
#[inline(always)]
fn columns<S: Batch, const N: usize>(
    out: &mut [S],
    weights: &[S],
    items: &[S::Item],
    (before, after): (impl Fn(usize, S) -> S, impl Fn(usize, S) -> S),
) {
    let mut held = [S::zero(); N];
    held.copy_from_slice(weights);
    for (d, (out, items)) in out.iter_mut().zip(items.as_chunks::<N>().0).enumerate() {
        let mut sum = before(d, *out);
        for j in 0..N {
            sum = S::splat(items[j]).mul_add(held[j], sum);
        }
        *out = after(d, sum);
    }
}

/// An entry for each place of block `k`, those past the last stage too.
fn side_by_side<S: Batch>(k: usize, entry: impl Fn(usize) -> f64) -> S {
    let mut values = [S::zero()];
    for (lane, item) in S::items_mut(&mut values).iter_mut().enumerate() {
        *item = S::Item::from_f64(entry(k * S::ITEMS + lane));
    }
    values[0]
}

/// A matrix of coefficients, and what rounding leaves out of it.
pub(super) struct SplitMatrix<S> {
    pub(super) high: Matrix<S>,
    pub(super) low: Matrix<S>,
}

impl<S: Batch> SplitMatrix<S> {
    fn new(rows: &[Vec<Split>]) -> Self {
        Self {
            high: Matrix::with(rows.len(), |i, j| rows[i][j].high),
            low: Matrix::with(rows.len(), |i, j| rows[i][j].low),
        }
    }
}

/// A coefficient for each stage.
pub(super) struct Row<S> {
    high: Vec<S>,
    low: Vec<S>,
}

impl<S: Batch> Row<S> {
    fn new(row: &[Split]) -> Self {
        let stages = row.len();
        // Repeated stages do not count twice.
        let once = |part: fn(&Split) -> f64| {
            let weight = |i| row.get(i).map_or(0.0, part);
            (0..blocks::<S>(stages))
                .map(|k| side_by_side(k, weight))
                .collect()
        };
        Self {
            high: once(|x| x.high),
            low: once(|x| x.low),
        }
    }

    /// $h \sum_i b_i v_i$, with `sums` to add up in.
    #[inline(always)]
    pub(super) fn combine(
        &self,
        (out, sums): (&mut [S::Item], &mut [S]),
        h: S::Item,
        values: &Stages<S>,
    ) {
        for (k, (high, low)) in self.high.iter().zip(&self.low).enumerate() {
            for (sum, value) in sums.iter_mut().zip(values.block(k)) {
                let before = if k == 0 { S::zero() } else { *sum };
                *sum = high.mul_add(*value, low.mul_add(*value, before));
            }
        }
        for (out, sum) in out.iter_mut().zip(sums) {
            *out = h * sum.sum();
        }
    }
}

/// The coefficients of collocation for stages side by side.
pub(super) struct Coefficients<S> {
    /// $c_i$, block by block.
    pub(super) nodes: Vec<S>,
    /// $b_i$.
    pub(super) weights: Row<S>,
    /// $a_{ij}$.
    pub(super) forward: SplitMatrix<S>,
    /// $b_j - a_{ij}$.
    pub(super) backward: SplitMatrix<S>,
}

impl<S: Batch> Coefficients<S> {
    pub(super) fn new(tableau: &Tableau) -> Self {
        let stages = tableau.nodes.len();
        let node = |k| side_by_side(k, |i: usize| tableau.nodes[i.min(stages - 1)]);
        Self {
            nodes: (0..blocks::<S>(stages)).map(node).collect(),
            weights: Row::new(&tableau.weights),
            forward: SplitMatrix::new(&tableau.forward),
            backward: SplitMatrix::new(&tableau.backward),
        }
    }
}
