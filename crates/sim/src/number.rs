//! Numbers as a person reads them.

/// All digits of a number, with an exponent where there would be many zeros.
///
/// ```
/// use sim::number::decimal;
///
/// assert_eq!([0.001, 1e12, 0.0].map(decimal), ["0.001", "1e12", "0"]);
/// ```
pub fn decimal(x: f64) -> String {
    let is_moderate = x == 0.0 || (1e-6..1e12).contains(&x.abs());
    if is_moderate {
        x.to_string()
    } else {
        format!("{x:e}")
    }
}

/// The nearest number of so many significant digits, at least one.
///
/// ```
/// assert_eq!(sim::number::rounded(0.012345, 3), 0.0123);
/// ```
pub fn rounded(x: f64, digits: usize) -> f64 {
    let places = digits.saturating_sub(1);
    format!("{x:.places$e}").parse().unwrap_or(x)
}

/// The [`decimal`] of three digits.
pub fn three_digits(x: f64) -> String {
    decimal(rounded(x, 3))
}

/// An error: four digits and an exponent, or a plain zero.
///
/// ```
/// use sim::number::scientific;
///
/// assert_eq!([1.23456e-9, 0.0].map(scientific), ["1.235e-9", "0"]);
/// ```
pub fn scientific(x: f64) -> String {
    match x {
        0.0 => "0".to_owned(),
        _ => format!("{x:.3e}"),
    }
}
