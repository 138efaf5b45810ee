//! Sizes of vectors whose coordinates have different units: compared block by block, and kind by kind.

use core::ops::Range;

use lie::{LieGroup, Units, VectorSpace};

use crate::numbers::{larger, relative};

/// Digits of a number that may say which way it is moved.
const DIGITS: u32 = 8;
/// The part of the tolerance that a correction may be of the displacement, which is then the solution without it.
const SETTLED: f64 = 0.1;
/// Roundings of an evaluation may add up to so many times what shaking its arguments makes of it.
pub(crate) const NOISE: f64 = 16.0;

/// The kinds of unit of a group's coordinates, and how large numbers of each kind are.
#[derive(Clone)]
pub(crate) struct Kinds {
    /// Coordinates that stand together, and their kind.
    pub(crate) runs: Vec<(Range<usize>, usize)>,
    pub(crate) count: usize,
}

impl Kinds {
    pub(crate) fn of<G: LieGroup>(g: &G) -> Self {
        let units = Units::of(g);
        Self {
            runs: units.runs(),
            count: units.kinds(),
        }
    }

    /// The largest magnitude of each kind into `out`, where that is larger than what is there.
    pub(crate) fn raise(&self, out: &mut [f64], numbers: &[f64]) {
        for (run, kind) in &self.runs {
            out[*kind] = larger(out[*kind], largest(&numbers[run.clone()]));
        }
    }
}

/// Coordinates of a kind whose inertia is looked at, at most.
const SAMPLES: usize = 8;
/// What a kind moves less than this part of what the others do is rounding of theirs.
const BESIDE: f64 = 4.0 * f64::EPSILON;

/// What brings the kinds to one unit: the roots of their inertias, so that sizes of two kinds can be compared at all.
///
/// It is only asked whether one is rounding of another: a body that turns about its mass centre has no momentum to be relative to.
#[derive(Clone)]
pub(crate) struct Weights(Vec<f64>);

impl Weights {
    /// From the inertia along a coordinate; powers of two, which follow the units exactly.
    pub(crate) fn new(kinds: &Kinds, mut inertia: impl FnMut(usize) -> f64) -> Self {
        let mut largest = vec![0.0_f64; kinds.count];
        for (kind, largest) in largest.iter_mut().enumerate() {
            let of_kind = kinds.runs.iter().filter(|(_, of)| *of == kind);
            let coordinates: Vec<usize> = of_kind.flat_map(|(run, _)| run.clone()).collect();
            let every = coordinates.len().div_ceil(SAMPLES).max(1);
            let sampled = coordinates.into_iter().step_by(every).map(&mut inertia);
            *largest = sampled.filter(|x| x.is_finite()).fold(0.0, f64::max);
        }
        let first = largest.iter().find_map(|x| exponent(*x)).unwrap_or(0);
        let weight =
            |x: &f64| exponent(*x).map_or(1.0, |e| power_of_two((e - first).div_euclid(2)));
        Self(largest.iter().map(weight).collect())
    }

    /// Gives a kind without any velocity the size of the others'.
    pub(crate) fn fill_velocities(&self, sizes: &mut [f64]) {
        let all = sizes.iter().zip(&self.0);
        let largest = all.fold(0.0, |max, (size, weight)| larger(max, size * weight));
        for (size, weight) in sizes.iter_mut().zip(&self.0) {
            *size = if *size == 0.0 {
                largest / weight
            } else {
                *size
            };
        }
    }

    /// The same of momenta.
    pub(crate) fn fill_momenta(&self, sizes: &mut [f64]) {
        let all = sizes.iter().zip(&self.0);
        let largest = all.fold(0.0, |max, (size, weight)| larger(max, size / weight));
        for (size, weight) in sizes.iter_mut().zip(&self.0) {
            *size = if *size == 0.0 {
                largest * weight
            } else {
                *size
            };
        }
    }

    /// What is rounding, for each kind of velocities beside all.
    pub(crate) fn beside_velocities(&self, sizes: impl Fn(usize) -> f64, kind: usize) -> f64 {
        let all = self.0.iter().enumerate();
        let largest = all.fold(0.0, |max, (k, weight)| larger(max, sizes(k) * weight));
        BESIDE * largest / self.0[kind]
    }

    /// The same of momenta.
    pub(crate) fn beside_momenta(&self, sizes: impl Fn(usize) -> f64, kind: usize) -> f64 {
        let all = self.0.iter().enumerate();
        let largest = all.fold(0.0, |max, (k, weight)| larger(max, sizes(k) / weight));
        BESIDE * largest * self.0[kind]
    }
}

/// A size relative to another, which is at least what is rounding; none where it is rounding itself.
pub(crate) fn relative_beside(size: f64, scale: f64, rounding: f64) -> f64 {
    if size <= rounding {
        return 0.0;
    }
    relative(size, larger(scale, rounding))
}

/// The blocks of a group's coordinates, and how large a vector is in each.
pub(crate) struct Sizes {
    blocks: Vec<Block>,
    kinds: Vec<Kind>,
    weights: Weights,
    numbers: Vec<f64>,
}

/// The largest of the blocks of a kind.
#[derive(Clone, Copy, Default)]
struct Kind {
    size: f64,
    scale: f64,
    /// What is rounding of the other kinds' scales.
    rounding: f64,
}

/// Coordinates of one unit that belong together.
struct Block {
    coordinates: Range<usize>,
    kind: usize,
    /// What is relative to [`scale`](Block::scale).
    size: f64,
    scale: f64,
    /// What rounding makes of nothing.
    noise: f64,
}

impl Sizes {
    /// For vectors of the shape of `g`, without the coordinates in `left_out`.
    pub(crate) fn new<G: LieGroup>(g: &G, left_out: Range<usize>, weights: Weights) -> Self {
        let units = Units::of(g);
        let (before, after) = (0..left_out.start, left_out.end..usize::MAX);
        let parts = units.blocks().flat_map(|(block, kind)| {
            [&before, &after].map(|kept| {
                let start = block.start.max(kept.start);
                (start..block.end.min(kept.end).max(start), kind)
            })
        });
        let block = |(coordinates, kind)| Block {
            coordinates,
            kind,
            size: 0.0,
            scale: 0.0,
            noise: 0.0,
        };
        Self {
            blocks: parts
                .filter(|(part, _)| !part.is_empty())
                .map(block)
                .collect(),
            kinds: vec![Kind::default(); units.kinds()],
            weights,
            numbers: vec![0.0; g.zero_dual().dim()],
        }
    }

    /// Takes the largest of these vectors for the scale of each block, and forgets the noise.
    pub(crate) fn set_scales<V: VectorSpace<Scalar = f64>>(&mut self, terms: [&V; 3]) {
        for block in &mut self.blocks {
            (block.scale, block.noise) = (0.0, 0.0);
        }
        for term in terms {
            self.measure(term);
            for block in &mut self.blocks {
                block.scale = larger(block.scale, block.size);
            }
        }
        for (kind, of_kind) in self.kinds.iter_mut().enumerate() {
            let blocks = self.blocks.iter().filter(|block| block.kind == kind);
            of_kind.scale = blocks.fold(0.0, |max, block| larger(max, block.scale));
        }
        for kind in 0..self.kinds.len() {
            let scale = |kind: usize| self.kinds[kind].scale;
            self.kinds[kind].rounding = self.weights.beside_momenta(scale, kind);
        }
    }

    /// Whether all scales are zero.
    pub(crate) fn have_no_scale(&self) -> bool {
        self.blocks.iter().all(|block| block.scale == 0.0)
    }

    /// Takes the size of a vector in each block.
    #[inline(always)]
    fn measure<V: VectorSpace<Scalar = f64>>(&mut self, x: &V) {
        x.write(&mut self.numbers);
        for block in &mut self.blocks {
            block.size = largest(&self.numbers[block.coordinates.clone()]);
        }
    }

    /// How large a vector is relative to the scales: in each kind as a whole, and block by block; the largest of either.
    #[inline(always)]
    pub(crate) fn relative<V: VectorSpace<Scalar = f64>>(&mut self, x: &V) -> Relative {
        self.measure(x);
        self.kinds.iter_mut().for_each(|kind| kind.size = 0.0);
        let mut found = Relative::default();
        for block in &self.blocks {
            let kind = &mut self.kinds[block.kind];
            kind.size = larger(kind.size, block.size);
            found.by_block = larger(found.by_block, relative(block.size, block.scale));
        }
        for kind in &self.kinds {
            let by_kind = relative_beside(kind.size, kind.scale, kind.rounding);
            found.by_kind = larger(found.by_kind, by_kind);
        }
        found
    }

    /// Takes the difference of two evaluations that are the same but for rounding for the noise of each block, where it is larger than before.
    pub(crate) fn raise_noise<V: VectorSpace<Scalar = f64>>(&mut self, difference: &V) {
        self.measure(difference);
        for block in &mut self.blocks {
            block.noise = larger(block.noise, block.size);
        }
    }

    /// Whether each block of the vector that was [measured](Self::relative) last is within the tolerance, or is noise, or asks for a correction
    /// that is no more than that of the whole displacement.
    pub(crate) fn are_settled<V: VectorSpace<Scalar = f64>>(
        &self,
        (correction, whole): (&V, &V),
        tolerance: f64,
    ) -> bool {
        let settled = |block: &Block| {
            block.size <= larger(tolerance * block.scale, NOISE * block.noise) || {
                let [part, all] = [correction, whole].map(|x| {
                    let numbers = block.coordinates.clone().map(|i| x.get(i).abs());
                    numbers.fold(0.0, larger)
                });
                part < SETTLED * tolerance * all
            }
        };
        self.blocks.iter().all(settled)
    }
}

/// Of a vector.
#[derive(Clone, Copy, Default)]
pub(crate) struct Relative {
    pub(crate) by_kind: f64,
    pub(crate) by_block: f64,
}

impl Relative {
    /// Of nothing known yet.
    pub(crate) const NONE: Self = Self {
        by_kind: f64::INFINITY,
        by_block: f64::INFINITY,
    };
}

#[inline(always)]
fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |max, x| larger(max, x.abs()))
}

/// Moves a number by two units of its last place, up or down as one of its digits says, every other time up: what cannot be told from it.
///
/// What the moved numbers do may cancel: the next time they are moved otherwise.
#[inline(always)]
pub(crate) fn shaken(x: f64, time: u32) -> f64 {
    let digit = x.to_bits() >> (time / 2 % DIGITS) & 1;
    let up = digit == 0 || time.is_multiple_of(2);
    let sign = if up { 1.0 } else { -1.0 };
    x + sign * 2.0 * f64::EPSILON * x
}

/// Shakes every coordinate.
pub(crate) fn shake<V: VectorSpace<Scalar = f64>>(x: &mut V, time: u32) {
    (0..x.dim()).for_each(|i| x.set(i, shaken(x.get(i), time)));
}

/// That of the power of two at or below the magnitude; none of zero and of what is no number.
pub(crate) fn exponent(x: f64) -> Option<i32> {
    let biased = (x.to_bits() >> 52) as i32 & 0x7ff;
    (biased != 0 && biased != 0x7ff).then_some(biased - 0x3ff)
}

pub(crate) fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent.clamp(-0x3fe, 0x3ff) + 0x3ff) as u64) << 52)
}
