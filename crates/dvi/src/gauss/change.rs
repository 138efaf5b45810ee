//! How much a sweep changes the rates, and what of that is rounding.

use lie::Batch;
use num_traits::Zero;

use crate::numerics::numbers::larger;
use crate::numerics::sizes::{Kinds, NOISE, Weights, relative_beside};

/// Sweeps for which it holds what is rounding.
const ROUNDING_HOLDS: u32 = 4;
/// Noise above this part of the rates or momenta is none: the motion is lost anyway.
const LOUDEST: f64 = 1e-4;

/// How much a sweep changes the rates: the largest magnitudes of each kind of coordinates, item by item.
pub(super) struct Change<S> {
    /// Of $\dot c$ and of $\dot\pi$.
    kinds: Vec<[Largest<S>; 2]>,
    /// Zero, unless a rate is not finite.
    pub(super) poison: S,
}

/// Of the changes, and of what they are relative to.
#[derive(Clone, Copy)]
struct Largest<S> {
    change: S,
    size: S,
}

impl<S: Zero> Largest<S> {
    fn none() -> Self {
        Self {
            change: S::zero(),
            size: S::zero(),
        }
    }
}

impl<S: Batch> Change<S> {
    pub(super) fn new(kinds: usize) -> Self {
        Self {
            kinds: vec![[Largest::none(); 2]; kinds],
            poison: S::zero(),
        }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.kinds.fill([Largest::none(); 2]);
        self.poison = S::zero();
    }

    /// Takes over new rates, the first or the second, and how they differ from the old ones.
    #[inline(always)]
    pub(super) fn replace(
        &mut self,
        (kinds, which): (&Kinds, usize),
        old: &mut [S],
        new: &[S],
        sizes: &[S],
    ) {
        let mut poison = self.poison;
        for (run, kind) in &kinds.runs {
            let Largest {
                mut change,
                mut size,
            } = self.kinds[*kind][which];
            let (old, run) = (&mut old[run.clone()], run.clone());
            for ((old, new), of) in old.iter_mut().zip(&new[run.clone()]).zip(&sizes[run]) {
                change = change.max((*new - *old).abs());
                size = size.max(of.abs());
                poison = new.mul_add(S::zero(), poison);
                *old = *new;
            }
            self.kinds[*kind][which] = Largest { change, size };
        }
        self.poison = poison;
    }
}

/// Judges by the changes of one step whether they are rounding.
#[derive(Clone)]
pub(super) struct Judge {
    /// The largest changes of each kind, at the last look.
    largest: Vec<[Largest<f64>; 2]>,
    /// Made at the first step.
    weights: Option<Weights>,
    driven: bool,
    /// What rounding makes of no change, in the rates of each kind; zero where that has not been looked at.
    noise: Vec<[f64; 2]>,
    /// What is rounding in each kind, of the rates and of the momenta, and for how many sweeps that holds.
    rounding: Vec<[f64; 2]>,
    rounding_holds: u32,
}

impl Judge {
    pub(super) fn new(kinds: usize) -> Self {
        Self {
            largest: vec![[Largest::none(); 2]; kinds],
            weights: None,
            driven: false,
            noise: vec![[0.0; 2]; kinds],
            rounding: vec![[0.0; 2]; kinds],
            rounding_holds: 0,
        }
    }

    pub(super) fn is_weighed(&self) -> bool {
        self.weights.is_some()
    }

    /// Sets what brings the kinds to one unit, and whether a part of the system moves as told.
    pub(super) fn weigh(&mut self, weights: Option<Weights>, driven: bool) {
        (self.weights, self.driven) = (weights, driven);
    }

    pub(super) fn weights(&self) -> Option<&Weights> {
        self.weights.as_ref()
    }

    pub(super) fn is_driven(&self) -> bool {
        self.driven
    }

    /// Takes over what the last sweep has changed, of what `read` picks.
    pub(super) fn look<S: Batch>(&mut self, change: &Change<S>, read: impl Fn(&S) -> f64) {
        for (largest, kind) in self.largest.iter_mut().zip(&change.kinds) {
            *largest = [0, 1].map(|which| Largest {
                change: read(&kind[which].change),
                size: read(&kind[which].size),
            });
        }
    }

    /// The largest change at the last look, in the kind of coordinates where it is largest: of $\dot c$ relative to it, of
    /// $h \dot\pi$ to the momentum. A change that noise explains is none.
    pub(super) fn change(&mut self, h: f64) -> f64 {
        if self.rounding_holds == 0 {
            self.rounding_holds = ROUNDING_HOLDS;
            self.find_rounding(h);
        }
        self.rounding_holds -= 1;
        let kinds = self.largest.iter().zip(&self.rounding).enumerate();
        kinds.fold(0.0, |found, (kind, ([c, pi], rounding))| {
            let c = relative_beside(c.change, c.size, rounding[0]);
            let size = larger(pi.size, self.least_momentum(kind));
            let pi = relative_beside(pi.change * h.abs(), size, rounding[1]);
            larger(found, larger(c, pi))
        })
    }

    /// What a momentum of a kind is to be compared with at least: where the system is driven, that of the velocities.
    pub(super) fn least_momentum(&self, kind: usize) -> f64 {
        match &self.weights {
            Some(weights) if self.driven => {
                let rates = self.largest.iter().map(|[c, _]| c.size);
                weights.momentum_of(rates, kind)
            }
            _ => 0.0,
        }
    }

    /// How much of a momentum of a kind is rounding in a step, as far as that is known.
    pub(super) fn rounding_of_momentum(&self, kind: usize) -> f64 {
        self.rounding[kind][1]
    }

    /// Looks anew at what is rounding in the next sweep.
    pub(super) fn forget_rounding(&mut self) {
        self.rounding_holds = 0;
    }

    /// What is rounding in each kind, of the rates and of the momenta: noise, or rounding of the other kinds.
    fn find_rounding(&mut self, h: f64) {
        for kind in 0..self.noise.len() {
            let ([c, pi], beside) = (self.noise[kind], self.beside(kind));
            self.rounding[kind] = [
                larger(NOISE * c, beside[0]),
                larger(NOISE * h.abs() * pi, beside[1]),
            ];
        }
    }

    /// What is rounding beside the other kinds, of the rates $\dot c$ and of the momenta.
    fn beside(&self, kind: usize) -> [f64; 2] {
        let Some(weights) = &self.weights else {
            return [0.0; 2];
        };
        let size = |which: usize| move |kind: usize| self.largest[kind][which].size;
        [
            weights.velocities.beside(size(0), kind),
            weights.momenta.beside(size(1), kind),
        ]
    }

    /// Takes the changes at the last look for noise: so many times rounding has made them.
    pub(super) fn hear(&mut self, times: f64) {
        self.forget_rounding();
        for (noise, largest) in self.noise.iter_mut().zip(&self.largest) {
            // What is not small beside the rates is no rounding.
            for (noise, of) in noise.iter_mut().zip(largest) {
                if of.change <= LOUDEST * of.size {
                    *noise = larger(*noise, of.change / times);
                }
            }
        }
    }

    /// Forgets what rounding makes.
    pub(super) fn forget_noise(&mut self) {
        self.noise.fill([0.0; 2]);
    }
}
