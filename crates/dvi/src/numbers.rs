//! Sizes of things that may be zero or not a number.

/// The larger of the two, not a number where one is not.
#[inline(always)]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

/// A system at rest has no scale, and no residual or change either.
#[inline(always)]
pub(crate) fn relative(size: f64, scale: f64) -> f64 {
    if size == 0.0 { 0.0 } else { size / scale }
}

/// A displacement in coordinates beside which there is no other root to be mistaken for.
const SMALL: f64 = 0.05;

/// How far a root is `apart` from where it was expected, relative to the `size` of that, where it is more than the share `near`: then it
/// is another root than the motion's.
pub(crate) fn astray(apart: f64, size: f64, near: f64) -> Option<f64> {
    let bound = larger(near * size, SMALL);
    (apart > bound).then(|| apart / larger(size, SMALL))
}
