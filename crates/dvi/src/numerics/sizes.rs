//! Sizes of vectors whose coordinates have different units: compared block by block, and kind by kind.

use core::cell::Cell;
use core::ops::Range;

use lie::{LieGroup, Units, VectorSpace};

use super::numbers::{exponent, larger, power_of_two, relative};

/// The last digits of a number choose the direction of its shake.
const DIGITS: u32 = 8;
/// How much further numbers move where each goes its own way.
const FAR: f64 = 32.0;
/// A correction of this part of the tolerance, relative to the displacement, is not made.
const SETTLED: f64 = 0.1;
/// Roundings of an evaluation may add up to so many times what shaking its arguments makes of it …
pub(crate) const NOISE: f64 = 16.0;
/// … and once more for so many terms: along a chain of hinges the attitudes are products, and the moments are sums, over all before.
const CHAIN: f64 = 32.0;

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
    #[inline]
    pub(crate) fn raise(&self, out: &mut [f64], numbers: &[f64]) {
        for (run, kind) in &self.runs {
            out[*kind] = larger(out[*kind], largest(&numbers[run.clone()]));
        }
    }
}

/// Coordinates of a kind whose inertia is looked at, at most.
const SAMPLES: usize = 64;
/// A change smaller than this fraction of the other kinds' is their rounding.
const BESIDE: f64 = 4.0 * f64::EPSILON;

/// What brings the kinds to one unit: the roots of their inertias.
///
/// With them it can be said whether one kind's size is rounding beside the others'. A body that turns about its mass centre has no
/// linear momentum to be relative to.
#[derive(Clone)]
pub(crate) struct Weights {
    pub(crate) velocities: Factors,
    pub(crate) momenta: Factors,
    /// The inertia of the first kind.
    inertia: f64,
}

/// A factor for each kind; powers of two, which follow the units exactly.
#[derive(Clone)]
pub(crate) struct Factors(Vec<f64>);

impl Weights {
    /// From the inertia of a kind along one of its coordinates; none where a kind has no finite one.
    pub(crate) fn new(kinds: &Kinds, mut inertia: impl FnMut(usize, usize) -> f64) -> Option<Self> {
        /// Inertias that are powers of two are far from where the exponent changes.
        const BETWEEN: f64 = core::f64::consts::SQRT_2;
        let mut exponents = Vec::with_capacity(kinds.count);
        for kind in 0..kinds.count {
            let of_kind = kinds.runs.iter().filter(|(_, of)| *of == kind);
            let coordinates: Vec<usize> = of_kind.flat_map(|(run, _)| run.clone()).collect();
            if coordinates.is_empty() {
                exponents.push(None);
                continue;
            }
            let every = coordinates.len().div_ceil(SAMPLES).max(1);
            let sampled = coordinates.into_iter().step_by(every);
            let sampled = sampled.map(|i| BETWEEN * inertia(kind, i));
            exponents.push(Some(exponent(sampled.fold(0.0, larger))?));
        }
        // A kind without coordinates is none.
        let first = exponents.iter().flatten().next().copied().unwrap_or(0);
        let exponents = exponents.iter().map(|e| e.unwrap_or(first));
        let halves = || exponents.clone().map(|e| (e - first).div_euclid(2));
        Some(Self {
            velocities: Factors(halves().map(power_of_two).collect()),
            momenta: Factors(halves().map(|half| power_of_two(-half)).collect()),
            inertia: power_of_two(first),
        })
    }

    /// The momentum of a kind that velocities of these sizes, one for each kind, may have.
    pub(crate) fn momentum_of(&self, velocities: impl Iterator<Item = f64>, kind: usize) -> f64 {
        self.inertia * self.velocities.largest(velocities) / self.momenta.of(kind)
    }
}

impl Factors {
    pub(crate) fn of(&self, kind: usize) -> f64 {
        self.0[kind]
    }

    /// The largest of sizes, one for each kind, in the unit of the first.
    fn largest(&self, sizes: impl Iterator<Item = f64>) -> f64 {
        let all = sizes.zip(&self.0);
        all.fold(0.0, |max, (size, factor)| larger(max, size * factor))
    }

    /// Gives a kind without any size that of the others.
    pub(crate) fn fill(&self, sizes: &mut [f64]) {
        let largest = self.largest(sizes.iter().copied());
        for (size, factor) in sizes.iter_mut().zip(&self.0) {
            if *size == 0.0 {
                *size = largest / factor;
            }
        }
    }

    /// What is rounding of the other kinds, in one kind.
    pub(crate) fn beside(&self, sizes: impl Fn(usize) -> f64, kind: usize) -> f64 {
        let others = (0..self.0.len()).map(|k| if k == kind { 0.0 } else { sizes(k) });
        BESIDE * self.largest(others) / self.0[kind]
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
    numbers: Vec<f64>,
    /// The largest scale of all, in one unit.
    scale: f64,
    /// How many things an evaluation adds up.
    terms: usize,
}

/// Coordinates of one unit that belong together.
struct Block {
    coordinates: Range<usize>,
    kind: usize,
    /// What brings its momenta to one unit with the others'.
    weight: f64,
    size: f64,
    /// What the size is relative to, and its inverse.
    scale: f64,
    inverse_scale: f64,
    /// What rounding makes of nothing.
    noise: f64,
}

impl Sizes {
    /// For vectors of the shape of `g`, without the coordinates in `left_out`.
    pub(crate) fn new<G: LieGroup>(
        g: &G,
        left_out: Range<usize>,
        weights: Option<&Weights>,
    ) -> Self {
        let units = Units::of(g);
        let (before, after) = (0..left_out.start, left_out.end..usize::MAX);
        let parts = units.blocks().flat_map(|(block, kind)| {
            [&before, &after].map(|kept| {
                let start = block.start.max(kept.start);
                (start..block.end.min(kept.end).max(start), kind)
            })
        });
        let block = |(coordinates, kind): (Range<usize>, usize)| Block {
            coordinates,
            kind,
            weight: weights.map_or(1.0, |weights| weights.momenta.of(kind)),
            size: 0.0,
            scale: 0.0,
            inverse_scale: f64::INFINITY,
            noise: 0.0,
        };
        let parts = parts.filter(|(part, _)| !part.is_empty());
        Self {
            blocks: parts.map(block).collect(),
            numbers: vec![0.0; g.zero_dual().dim()],
            scale: 0.0,
            terms: 0,
        }
    }

    /// For evaluations that add up so many things, where these are more than the blocks.
    pub(crate) fn with_terms(self, terms: usize) -> Self {
        Self { terms, ..self }
    }

    /// Takes the largest of these momenta for the scale of each block, and forgets the noise.
    #[inline]
    pub(crate) fn set_scales<V: VectorSpace<Scalar = f64>>(&mut self, terms: &[&V]) {
        for block in &mut self.blocks {
            (block.scale, block.noise) = (0.0, 0.0);
        }
        for term in terms {
            self.measure(*term);
            for block in &mut self.blocks {
                block.scale = larger(block.scale, block.size);
            }
        }
        self.scale = 0.0;
        for block in &mut self.blocks {
            block.inverse_scale = 1.0 / block.scale;
            self.scale = larger(self.scale, block.scale * block.weight);
        }
        // What has no momentum may come to rest by rounding alone: its correction is never small beside nothing.
        let rounding = f64::EPSILON * self.scale;
        for block in self.blocks.iter_mut().filter(|block| block.scale == 0.0) {
            block.scale = rounding / block.weight;
            block.inverse_scale = 1.0 / block.scale;
        }
    }

    /// Makes the scale of each block at least that of its kind.
    pub(crate) fn raise_scales(&mut self, least: impl Fn(usize) -> f64) {
        for block in &mut self.blocks {
            block.scale = larger(block.scale, least(block.kind));
            block.inverse_scale = 1.0 / block.scale;
            self.scale = larger(self.scale, block.scale * block.weight);
        }
    }

    /// Whether all scales are zero.
    pub(crate) fn have_no_scale(&self) -> bool {
        self.scale == 0.0
    }

    /// Takes the size of a vector in each block.
    #[inline(always)]
    fn measure<V: VectorSpace<Scalar = f64>>(&mut self, x: &V) {
        x.write(&mut self.numbers);
        for block in &mut self.blocks {
            block.size = largest(&self.numbers[block.coordinates.clone()]);
        }
    }

    /// How large momenta are relative to the scales, as a whole and block by block.
    #[inline(always)]
    pub(crate) fn relative<V: VectorSpace<Scalar = f64>>(&mut self, x: &V) -> Relative {
        self.measure(x);
        let (mut size, mut by_block) = (0.0, 0.0);
        for block in &self.blocks {
            size = larger(size, block.size * block.weight);
            let relative = if block.size == 0.0 {
                0.0
            } else {
                block.size * block.inverse_scale
            };
            by_block = larger(by_block, relative);
        }
        Relative {
            overall: relative(size, self.scale),
            by_block,
        }
    }

    /// The largest size relative to the scale of its block, of sizes above what is rounding in a kind.
    pub(crate) fn relative_above<V: VectorSpace<Scalar = f64>>(
        &mut self,
        x: &V,
        rounding: impl Fn(usize) -> f64,
    ) -> f64 {
        self.measure(x);
        let blocks = self.blocks.iter();
        let sizes = blocks.map(|b| relative_beside(b.size, b.scale, rounding(b.kind)));
        sizes.fold(0.0, larger)
    }

    /// The largest of displacements, in one unit.
    pub(crate) fn displacement<V: VectorSpace<Scalar = f64>>(&mut self, x: &V) -> f64 {
        self.measure(x);
        let sizes = self.blocks.iter().map(|block| block.size / block.weight);
        sizes.fold(0.0, larger)
    }

    /// Takes the difference of two evaluations whose arguments differ by so many times rounding: the noise of each block, where it is larger than before.
    pub(crate) fn raise_noise<V: VectorSpace<Scalar = f64>>(&mut self, difference: &V, times: f64) {
        self.measure(difference);
        for block in &mut self.blocks {
            block.noise = larger(block.noise, block.size / times);
        }
    }

    /// Whether each block of the vector that was [measured](Self::relative) last is solved.
    ///
    /// It is where it is within the tolerance, or is noise. It is too where the correction that it asks for is small beside the displacement.
    pub(crate) fn are_settled<V: VectorSpace<Scalar = f64>>(
        &self,
        (correction, whole): (&V, &V),
        tolerance: f64,
    ) -> bool {
        let terms = self.blocks.len().max(self.terms);
        let noise = NOISE * (1.0 + terms as f64 / CHAIN);
        let settled = |block: &Block| {
            block.size <= larger(tolerance * block.scale, noise * block.noise) || {
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

/// Of momenta.
#[derive(Clone, Copy)]
pub(crate) struct Relative {
    pub(crate) overall: f64,
    pub(crate) by_block: f64,
}

impl Relative {
    /// Of nothing known yet.
    pub(crate) const NONE: Self = Self {
        overall: f64::INFINITY,
        by_block: f64::INFINITY,
    };
}

/// The largest magnitude; not a number where one is not finite.
#[inline(always)]
fn largest(numbers: &[f64]) -> f64 {
    let (mut max, mut poison) = (0.0, 0.0);
    for x in numbers {
        // One instruction, where `larger` takes three.
        max = if x.abs() > max { x.abs() } else { max };
        poison += 0.0 * x;
    }
    max + poison
}

/// Moves numbers so little that they cannot be told from what they were: by two units of the last place, up or down.
///
/// Every other time one of its digits says whether a number goes up, else its place in the row of numbers. Otherwise equal numbers
/// would move together, and what they do would cancel.
pub(crate) struct Shaker {
    time: u32,
    is_far: bool,
    next: Cell<u32>,
}

impl Shaker {
    pub(crate) fn new(time: u32) -> Self {
        Self {
            time,
            is_far: false,
            next: Cell::new(time),
        }
    }

    /// One that moves each number its own way, [further](Self::times): what a few of them do never cancels. It tells of the arguments' rounding,
    /// and the other ones of the evaluation's too.
    pub(crate) fn far(time: u32) -> Self {
        let is_far = true;
        Self {
            is_far,
            ..Self::new(time)
        }
    }

    /// How many times two units of the last place the numbers move, on average.
    pub(crate) fn times(&self) -> f64 {
        if self.is_far { FAR } else { 1.0 }
    }

    /// The next number, moved.
    #[inline]
    pub(crate) fn shake(&self, x: f64) -> f64 {
        let place = self.next.replace(self.next.get().wrapping_add(1));
        let up = match self.time.is_multiple_of(2) {
            true => place.wrapping_mul(0x9e37_79b9) >> 31 == 0,
            false => x.to_bits() >> (self.time / 2 % DIGITS) & 1 == 0,
        };
        let by = match (self.is_far, up) {
            (true, _) => 2.0 * FAR * spread(place),
            (false, true) => 1.0,
            (false, false) => -1.0,
        };
        x + by * 2.0 * f64::EPSILON * x
    }
}

/// A number between -1 and 1 for each place, evenly spread whatever the distance of the places.
fn spread(place: u32) -> f64 {
    let mut bits = place.wrapping_add(1).wrapping_mul(0x9e37_79b9);
    bits = (bits ^ bits >> 15).wrapping_mul(0x85eb_ca6b);
    bits = (bits ^ bits >> 13).wrapping_mul(0xc2b2_ae35);
    f64::from((bits ^ bits >> 16) as i32) / f64::from(1_u32 << 31)
}

/// Shakes every coordinate.
pub(crate) fn shake<V: VectorSpace<Scalar = f64>>(x: &mut V, shaker: &Shaker) {
    (0..x.dim()).for_each(|i| x.set(i, shaker.shake(x.get(i))));
}
