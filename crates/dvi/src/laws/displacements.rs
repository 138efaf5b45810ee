//! The displacements that formulas are tried on: those of the motion, for which alone $L_d$ need be defined.

use lie::{LieGroup, Over, RealGroup, Scalar, Units, VectorSpace};

use super::compare::logarithm;
use crate::{Context, DiscreteLagrangian, State, System, Variational};

/// A coordinate that hardly moves is moved by this share of the largest of its kind, so that none is zero.
const SHARE: f64 = 1e-2;
/// What nothing moves is moved at this speed, in the coordinate's own unit per second.
const SLOW: f64 = 1e-3;
/// The second displacement, against the motion.
const BACK: f64 = -0.6;

/// Displacements from a state, and the size of the first.
pub(super) struct Displacements<G> {
    /// A generic part of the motion's displacement in a step, and one against it where $L_d$ has a value there.
    pub(super) each: Vec<G>,
    /// The largest coordinate.
    pub(super) size: f64,
}

pub(super) fn displacements<L: DiscreteLagrangian>(
    lagrangian: &L,
    state: &State<L::Group>,
    h: f64,
) -> Displacements<L::Group> {
    let State { t, g, .. } = state;
    let at = Context::new(*t, lagrangian.parameters());
    let mut c = part_of_motion(lagrangian, state, h);
    let (size, forth) = (c.max_magnitude(), L::Group::exp(&c));
    c.scale(BACK);
    let back = L::Group::exp(&c);
    let mut each = vec![forth];
    if lagrangian.value(at, g, &back, h).is_finite() {
        each.push(back);
    }
    Displacements { each, size }
}

/// The logarithm of the motion's displacement, each coordinate shortened by a share of its own: a domain that holds the motion holds
/// what is shorter.
fn part_of_motion<L: DiscreteLagrangian>(
    lagrangian: &L,
    state: &State<L::Group>,
    h: f64,
) -> <L::Group as LieGroup>::Algebra {
    let motion = Variational::new(ByValue(lagrangian)).displacement(state, h);
    // A step that is refused is reported by the laws of the step.
    let mut c = motion.map_or_else(|_| state.g.zero_algebra(), |f| logarithm(&f));
    let units = Units::of(&state.g);
    let mut largest = vec![0.0_f64; units.kinds()];
    for (block, kind) in units.blocks() {
        largest[kind] = block.fold(largest[kind], |max, i| max.max(c.get(i).abs()));
    }
    for (block, kind) in units.blocks() {
        let least = least(largest[kind], h);
        for i in block {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            let moved = match c.get(i) {
                x if x.abs() < least => sign * least,
                x => x,
            };
            c.set(i, share(i) * moved);
        }
    }
    c
}

/// The size of a displacement `f` in a step of size `h`, never zero.
pub(super) fn size<G: RealGroup>(f: &G, h: f64) -> f64 {
    let largest = logarithm(f).max_magnitude();
    largest.max(least(largest, h))
}

fn least(largest: f64, h: f64) -> f64 {
    (SHARE * largest).max(SLOW * h.abs())
}

/// From 0.5 to 0.9, no two alike: multiples of the golden ratio, modulo one.
fn share(i: usize) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    0.5 + 0.4 * ((i + 1) as f64 * GOLDEN).fract()
}

/// A discrete Lagrangian by its value alone: its motion feels no mistake in what else is given.
struct ByValue<'a, L>(&'a L);

impl<L: DiscreteLagrangian> System for ByValue<'_, L> {
    type Group = L::Group;

    fn parameters(&self) -> &[f64] {
        self.0.parameters()
    }
    fn fits(&self, g: &L::Group) -> bool {
        self.0.fits(g)
    }
}

impl<L: DiscreteLagrangian> DiscreteLagrangian for ByValue<'_, L> {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        f: &Over<L::Group, S>,
        h: S,
    ) -> S {
        self.0.value(at, g, f, h)
    }
}
