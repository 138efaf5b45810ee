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
