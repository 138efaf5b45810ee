//! The numbers that loads are made of.

/// Whether a number is finite and not negative.
pub(super) fn is_size(x: f64) -> bool {
    x.is_finite() && x >= 0.0
}
