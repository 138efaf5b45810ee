//! Sizes of things that may be zero or not a number, and powers of two.

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

/// That of the power of two at or below the magnitude; none of zero and of what is no number.
pub(crate) fn exponent(x: f64) -> Option<i32> {
    let biased = (x.to_bits() >> 52) as i32 & 0x7ff;
    (biased != 0 && biased != 0x7ff).then_some(biased - 0x3ff)
}

/// $2^n$, at the ends of the range where `n` is past them.
pub(crate) fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent.clamp(-0x3fe, 0x3ff) + 0x3ff) as u64) << 52)
}
