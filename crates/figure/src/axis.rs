//! Ranges, ticks and their labels.

use crate::Scale;

/// Magnitudes beyond are not drawn: their differences would overflow.
const LARGEST: f64 = 1e300;

/// Smallest value a logarithmic axis shows.
const SMALLEST_LOG: f64 = 1e-300;

/// A range of smaller values is drawn as zero: its ticks would underflow.
const SMALLEST: f64 = 1e-280;

/// A range narrower than this, relative to its values, is rounding noise.
const NARROWEST: f64 = 1e-9;

/// One axis: the coordinate interval it shows and its ticks.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    scale: Scale,
    low: f64,
    high: f64,
    /// Labelled ticks.
    pub(crate) major: Vec<Tick>,
    /// Positions of ticks without label, as fractions of the axis.
    pub(crate) minor: Vec<f64>,
    /// Common factor of the labels, such as `×10⁻¹³`.
    pub(crate) factor: Option<String>,
}

/// A labelled tick.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    /// Position as a fraction of the axis.
    pub(crate) at: f64,
    pub(crate) label: String,
}

/// The coordinate of a value before it is scaled to the axis.
pub(crate) fn coordinate(scale: Scale, value: f64) -> Option<f64> {
    match scale {
        Scale::Linear => (value.abs() <= LARGEST).then_some(value),
        Scale::Log => (SMALLEST_LOG..=LARGEST)
            .contains(&value)
            .then(|| value.log10()),
    }
}

impl Axis {
    /// An axis over coordinates `low..=high`, `None` if there is nothing on it.
    /// `margin` is the fraction of the range left free at both linear ends.
    pub(crate) fn new(scale: Scale, range: Option<(f64, f64)>, margin: f64, ticks: usize) -> Self {
        match scale {
            Scale::Linear => linear(range, margin, ticks),
            Scale::Log => logarithmic(range, ticks),
        }
    }

    /// The position of a value as a fraction of the axis.
    pub(crate) fn place(&self, value: f64) -> Option<f64> {
        coordinate(self.scale, value).map(|c| self.fraction(c))
    }

    fn fraction(&self, coordinate: f64) -> f64 {
        (coordinate - self.low) / (self.high - self.low)
    }
}

fn linear(range: Option<(f64, f64)>, margin: f64, ticks: usize) -> Axis {
    let (low, high) = widen(range.unwrap_or((0.0, 1.0)));
    let free = margin * (high - low);
    let mut axis = Axis {
        scale: Scale::Linear,
        low: low - free,
        high: high + free,
        major: Vec::new(),
        minor: Vec::new(),
        factor: None,
    };
    let (step, exponent) = nice_step((axis.high - axis.low) / ticks as f64);
    let first = (axis.low / step - 1e-9).ceil();
    let values: Vec<f64> = (0..=2 * ticks)
        .map(|k| (first + k as f64) * step)
        .take_while(|v| *v <= axis.high + 1e-9 * step)
        .collect();
    let labels;
    (labels, axis.factor) = decimal_labels(&values, step, exponent);
    axis.major = ticks_at(&axis, &values, labels);
    axis
}

fn widen((low, high): (f64, f64)) -> (f64, f64) {
    let size = low.abs().max(high.abs());
    if size < SMALLEST {
        return (-1.0, 1.0);
    }
    let missing = NARROWEST * size - (high - low);
    if missing > 0.0 {
        // A constant gets room to show that it is one.
        let room = if high == low {
            0.1 * size
        } else {
            missing / 2.0
        };
        return (low - room, high + room);
    }
    (low, high)
}

/// The nearest (by ratio) of 1, 2 or 5 times a power of ten, and that power.
fn nice_step(rough: f64) -> (f64, i32) {
    let exponent = rough.log10().floor() as i32;
    let mantissa = rough / power_of_ten(exponent);
    let (nice, carry) = match mantissa {
        m if m * m < 2.0 => (1.0, 0),
        m if m * m < 10.0 => (2.0, 0),
        m if m * m < 50.0 => (5.0, 0),
        _ => (1.0, 1),
    };
    let exponent = exponent + carry;
    (nice * power_of_ten(exponent), exponent)
}

/// Correctly rounded, unlike a power by multiplication.
fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::MIN_POSITIVE)
}

fn decimal_labels(values: &[f64], step: f64, exponent: i32) -> (Vec<String>, Option<String>) {
    let largest = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let plain = largest == 0.0 || (1e-3..1e5).contains(&largest);
    let shift = if plain {
        0
    } else {
        largest.log10().floor() as i32
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

fn logarithmic(range: Option<(f64, f64)>, ticks: usize) -> Axis {
    let (low, high) = range.unwrap_or((-1.0, 0.0));
    let (low, mut high) = (low.floor(), high.ceil());
    if high <= low {
        high = low + 1.0;
    }
    let decades = (high - low) as usize;
    let stride = decades.div_ceil(ticks.max(1)).max(1);
    let mut axis = Axis {
        scale: Scale::Log,
        low,
        high,
        major: Vec::new(),
        minor: Vec::new(),
        factor: None,
    };
    let exponents: Vec<i32> = (0..=decades).map(|k| low as i32 + k as i32).collect();
    let (labelled, plain): (Vec<i32>, Vec<i32>) = exponents
        .iter()
        .partition(|e| e.rem_euclid(stride as i32) == 0);
    let values: Vec<f64> = labelled.iter().map(|&e| f64::from(e)).collect();
    let labels = labelled.iter().map(|&e| ten_to_the(e)).collect();
    axis.major = ticks_at(&axis, &values, labels);
    axis.minor = plain.iter().map(|&e| axis.fraction(f64::from(e))).collect();
    if decades <= 4 {
        axis.minor.extend(within_decades(&axis, &exponents));
    }
    axis
}

/// Positions of the multiples 2 to 9 of the powers of ten.
fn within_decades(axis: &Axis, exponents: &[i32]) -> Vec<f64> {
    let multiples = |e: &i32| {
        let e = f64::from(*e);
        (2..=9).map(move |m| e + f64::from(m).log10())
    };
    let all = exponents.iter().flat_map(multiples);
    all.filter(|c| *c < axis.high)
        .map(|c| axis.fraction(c))
        .collect()
}

fn ticks_at(axis: &Axis, coordinates: &[f64], labels: Vec<String>) -> Vec<Tick> {
    let at = coordinates.iter().map(|c| axis.fraction(*c));
    at.zip(labels)
        .map(|(at, label)| Tick { at, label })
        .collect()
}

/// `10⁻¹³` and the like.
fn ten_to_the(exponent: i32) -> String {
    let raised = exponent.to_string();
    let raised = raised.chars().map(|c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        _ => '⁰',
    });
    std::iter::once('1').chain(['0']).chain(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.major.iter().map(|t| t.label.as_str()).collect()
    }

    #[test]
    fn linear_ticks_are_round() {
        let axis = Axis::new(Scale::Linear, Some((0.0, 10.0)), 0.0, 6);
        assert_eq!(labels(&axis), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(axis.place(2.5), Some(0.25));
        let axis = Axis::new(Scale::Linear, Some((-0.1, 0.1)), 0.0, 5);
        assert_eq!(labels(&axis), ["−0.10", "−0.05", "0.00", "0.05", "0.10"]);
    }

    #[test]
    fn small_and_large_values_share_a_factor() {
        let axis = Axis::new(Scale::Linear, Some((-1e-13, 2e-13)), 0.0, 4);
        assert_eq!(labels(&axis), ["−1", "0", "1", "2"]);
        assert_eq!(axis.factor.as_deref(), Some("×10⁻¹³"));
        let axis = Axis::new(Scale::Linear, Some((0.0, 3e6)), 0.0, 4);
        assert_eq!(axis.factor.as_deref(), Some("×10⁶"));
    }

    #[test]
    fn decades_are_labelled_sparsely() {
        let axis = Axis::new(Scale::Log, Some((-15.3, -0.2)), 0.0, 5);
        assert_eq!(labels(&axis), ["10⁻¹⁶", "10⁻¹²", "10⁻⁸", "10⁻⁴", "10⁰"]);
        assert_eq!(axis.minor.len(), 12);
        assert_eq!(axis.place(0.0), None);
        assert_eq!(axis.place(-1.0), None);
        assert_eq!(axis.place(1e-8), Some(0.5));
    }

    #[test]
    fn any_range_gives_finite_distinct_ticks() {
        let ends = [
            -1e300, -1e5, -1.0, -1e-13, -1e-299, 0.0, 5e-324, 1e-200, 1.0, 1e300,
        ];
        for (low, high) in ends.iter().flat_map(|a| ends.map(|b| (*a, b))) {
            if low > high {
                continue;
            }
            let axis = Axis::new(Scale::Linear, Some((low, high)), 0.05, 6);
            assert!((1..=13).contains(&axis.major.len()), "{low} {high}");
            assert!(axis.major.iter().all(|t| (-0.01..=1.01).contains(&t.at)));
            assert!(axis.major.iter().all(|t| t.label.len() < 20), "{axis:?}");
            assert!(axis.place(low).is_some_and(f64::is_finite));
        }
    }

    #[test]
    fn a_nearly_constant_series_keeps_short_labels() {
        for high in [1.0, 1.0 + 1e-15, 1.0 + 1e-8] {
            let axis = Axis::new(Scale::Linear, Some((1.0, high)), 0.05, 6);
            let distinct: std::collections::BTreeSet<_> = labels(&axis).into_iter().collect();
            assert_eq!(distinct.len(), axis.major.len(), "{axis:?}");
            assert!(axis.major.iter().all(|t| t.label.len() <= 12), "{axis:?}");
        }
    }
}
