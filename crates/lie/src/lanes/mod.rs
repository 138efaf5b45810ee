//! SIMD registers as scalars, with the instruction set chosen at run time.
//!
//! A [`Job`] is written once over any [`Batch`] of doubles; [`run`] calls it with the widest one that this processor has.
//! What it calls must be inlined whole (`#[inline(always)]`) to be compiled for that instruction set. A call that is left
//! over is right as well, but passes registers through memory and costs more than it saves.
//!
//! ```
//! use lie::lanes::{self, InstructionSet, Job};
//! use lie::Batch;
//!
//! /// The norms of (x, 1), all at once.
//! struct Norms<'a>(&'a mut [f64]);
//!
//! impl Job for Norms<'_> {
//!     type Output = ();
//!     fn run<S: Batch<Item = f64>>(self) {
//!         let mut x = vec![S::splat(0.0); self.0.len().div_ceil(S::ITEMS)];
//!         S::items_mut(&mut x)[..self.0.len()].copy_from_slice(self.0);
//!         S::run(#[inline(always)] || x.iter_mut().for_each(|x| *x = (*x * *x + S::one()).sqrt()));
//!         self.0.copy_from_slice(&S::items(&x)[..self.0.len()]);
//!     }
//! }
//!
//! let mut x = [0.0, 3.0_f64.sqrt(), 8.0_f64.sqrt()];
//! lanes::run(InstructionSet::widest(x.len()), Norms(&mut x));
//! assert!((x[2] - 3.0).abs() < 1e-15);
//! ```

mod per_lane;
mod register;

use core::fmt;

use crate::Batch;
pub use per_lane::PerLane;
use register::{Lanes, Problems, Register};

/// Something to compute over any scalar that is made of doubles.
pub trait Job {
    /// What comes out.
    type Output;

    /// Computes it. The parts that are worth it go through [`Batch::run`].
    fn run<S: Batch<Item = f64>>(self) -> Self::Output;
}

/// Something to compute for several problems at once, whatever their number.
pub trait PerLaneJob {
    /// What comes out.
    type Output;

    /// Computes it. The parts that are worth it go through [`Batch::run`].
    fn run<S: PerLane>(self) -> Self::Output;
}

/// The instructions that numbers are computed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum InstructionSet {
    /// What the program was compiled for, one double at a time.
    Baseline,
    /// Two doubles by NEON.
    Neon,
    /// Four doubles by AVX2 and FMA.
    Avx2,
    /// Eight doubles by AVX-512.
    Avx512,
}

impl InstructionSet {
    const ALL: [Self; 4] = [Self::Baseline, Self::Neon, Self::Avx2, Self::Avx512];

    /// Those that this processor has, the baseline first.
    pub fn available() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|set| set.is_available())
    }

    /// The one that computes `items` doubles side by side fastest: no wider than needed, where there is a choice.
    pub fn widest(items: usize) -> Self {
        let wanted: &[Self] = match items {
            0 | 1 => &[],
            2 => &[Self::Neon, Self::Avx2],
            3 | 4 => &[Self::Avx2, Self::Neon],
            _ => &[Self::Avx512, Self::Avx2, Self::Neon],
        };
        let found = wanted.iter().find(|set| set.is_available());
        found.copied().unwrap_or(Self::Baseline)
    }

    /// Whether this processor has it.
    pub fn is_available(self) -> bool {
        match self {
            Self::Baseline => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => register::Avx2::is_available(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => register::Avx512::is_available(),
            #[cfg(target_arch = "aarch64")]
            Self::Neon => register::Neon::is_available(),
            #[allow(unreachable_patterns, reason = "those of other architectures")]
            _ => false,
        }
    }
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Baseline => "baseline",
            Self::Neon => "neon",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        })
    }
}

/// Does the job by these instructions; by the baseline where the processor does not have them.
pub fn run<J: Job>(set: InstructionSet, job: J) -> J::Output {
    match set {
        _ if !set.is_available() => job.run::<f64>(),
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => job.run::<Lanes<register::Avx2>>(),
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => job.run::<Lanes<register::Avx512>>(),
        #[cfg(target_arch = "aarch64")]
        InstructionSet::Neon => job.run::<Lanes<register::Neon>>(),
        _ => job.run::<f64>(),
    }
}

/// Does the job for as many problems as these instructions take side by side; for one where the processor does not have them.
///
/// ```
/// use lie::lanes::{InstructionSet, PerLane, PerLaneJob, run_per_lane};
///
/// /// The root of each number, by a formula for one.
/// struct Roots<'a>(&'a mut [f64]);
///
/// impl PerLaneJob for Roots<'_> {
///     type Output = ();
///     fn run<S: PerLane>(self) {
///         for numbers in self.0.chunks_mut(S::LANES) {
///             let x = S::from_lanes(|lane| numbers.get(lane).copied().unwrap_or(1.0));
///             let roots = S::run(#[inline(always)] || x.sqrt());
///             numbers.copy_from_slice(&roots.lanes()[..numbers.len()]);
///         }
///     }
/// }
///
/// let mut x = [1.0, 4.0, 9.0];
/// run_per_lane(InstructionSet::widest(x.len()), Roots(&mut x));
/// assert_eq!(x, [1.0, 2.0, 3.0]);
/// ```
pub fn run_per_lane<J: PerLaneJob>(set: InstructionSet, job: J) -> J::Output {
    match set {
        _ if !set.is_available() => job.run::<f64>(),
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => job.run::<Lanes<register::Avx2, Problems>>(),
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => job.run::<Lanes<register::Avx512, Problems>>(),
        #[cfg(target_arch = "aarch64")]
        InstructionSet::Neon => job.run::<Lanes<register::Neon, Problems>>(),
        _ => job.run::<f64>(),
    }
}

/// Does a job that has one thing to compute at a time, by the fastest instructions for that. Its scalar may hold several items, which
/// are all to be the same.
pub fn run_single<J: Job>(job: J) -> J::Output {
    #[cfg(target_arch = "x86_64")]
    if register::Fma::is_available() {
        return job.run::<Lanes<register::Fma>>();
    }
    job.run::<f64>()
}
