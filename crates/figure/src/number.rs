//! Numbers beside ticks.

/// Labels of round `values`, of which `step`, of order `10^exponent`, is the distance, and the factor common to them.
pub(crate) fn decimals(values: &[f64], step: f64, exponent: i32) -> (Vec<String>, Option<String>) {
    let largest = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let plain = largest == 0.0 || (1e-3..1e5).contains(&largest);
    let shift = match plain {
        true => 0,
        false => largest.log10().floor() as i32,
    };
    let decimals = usize::try_from(shift - exponent).unwrap_or(0);
    let label = |v: &f64| {
        let shown = if v.abs() < 0.5 * step { 0.0 } else { *v };
        let scaled = shown / power_of_ten(shift);
        format!("{scaled:.decimals$}").replace('-', "−")
    };
    let factor = (shift != 0).then(|| format!("×{}", ten_to_the(shift)));
    (values.iter().map(label).collect(), factor)
}

/// Correctly rounded, unlike a power by multiplication.
pub(crate) fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::MIN_POSITIVE)
}

/// `10⁻¹³` and the like.
pub(crate) fn ten_to_the(exponent: i32) -> String {
    let raised = |c: char| match c.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    };
    let exponent = exponent.to_string();
    "10".chars().chain(exponent.chars().map(raised)).collect()
}
