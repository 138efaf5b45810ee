//! The range of an axis, and its ticks.

use crate::number::{decimals, power_of_ten, ten_to_the};

/// Magnitudes beyond are not drawn: their differences would overflow.
const LARGEST: f64 = 1e300;

/// Smallest value a logarithmic axis shows.
const SMALLEST_LOG: f64 = 1e-300;

/// A range of smaller values is drawn as zero: its ticks would underflow.
const SMALLEST: f64 = 1e-280;

/// A range narrower than this, relative to its values, is rounding noise.
const NARROWEST: f64 = 1e-9;

/// How values of an axis are placed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Scale {
    /// Proportionally.
    #[default]
    Linear,
    /// By their logarithm; values that are not positive are left out.
    Log,
}

impl Scale {
    /// What is proportional to the place of a value, if it has one.
    pub(crate) fn coordinate(self, value: f64) -> Option<f64> {
        match self {
            Self::Linear => (value.abs() <= LARGEST).then_some(value),
            Self::Log => (SMALLEST_LOG..=LARGEST)
                .contains(&value)
                .then(|| value.log10()),
        }
    }
}

/// The smallest and the largest coordinate of some.
pub(crate) fn range(coordinates: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let both = coordinates.into_iter().map(|c| (c, c));
    both.reduce(|(low, high), (c, _)| (low.min(c), high.max(c)))
}

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

impl Axis {
    /// An axis over coordinates `low..=high`, `None` if there is nothing on it, with about so many `ticks`.
    /// `margin` is the fraction of the range left free at both linear ends.
    pub(crate) fn new(scale: Scale, range: Option<(f64, f64)>, margin: f64, ticks: usize) -> Self {
        match scale {
            Scale::Linear => linear(range.unwrap_or((0.0, 1.0)), margin, ticks),
            Scale::Log => logarithmic(range.unwrap_or((-1.0, 0.0)), ticks),
        }
    }

    fn bare(scale: Scale, (low, high): (f64, f64)) -> Self {
        Self {
            scale,
            low,
            high,
            major: vec![],
            minor: vec![],
            factor: None,
        }
    }

    /// The position of a value as a fraction of the axis.
    pub(crate) fn place(&self, value: f64) -> Option<f64> {
        self.scale.coordinate(value).map(|c| self.fraction(c))
    }

    pub(crate) fn labels(&self) -> impl Iterator<Item = &str> {
        self.major.iter().map(|tick| tick.label.as_str())
    }

    fn fraction(&self, coordinate: f64) -> f64 {
        (coordinate - self.low) / (self.high - self.low)
    }

    fn tick(&self, coordinate: f64, label: String) -> Tick {
        Tick {
            at: self.fraction(coordinate),
            label,
        }
    }
}

fn linear(range: (f64, f64), margin: f64, ticks: usize) -> Axis {
    let (low, high) = widened(range);
    let free = margin * (high - low);
    let mut axis = Axis::bare(Scale::Linear, (low - free, high + free));
    let (step, exponent) = nice_step((axis.high - axis.low) / ticks as f64);
    let first = (axis.low / step - 1e-9).ceil();
    let values: Vec<f64> = (0..=2 * ticks)
        .map(|k| (first + k as f64) * step)
        .take_while(|v| *v <= axis.high + 1e-9 * step)
        .collect();
    let (labels, factor) = decimals(&values, step, exponent);
    let ticks = values.iter().zip(labels);
    axis.major = ticks.map(|(v, label)| axis.tick(*v, label)).collect();
    axis.factor = factor;
    axis
}

/// A range with room for ticks that differ.
fn widened((low, high): (f64, f64)) -> (f64, f64) {
    let size = low.abs().max(high.abs());
    let missing = NARROWEST * size - (high - low);
    if size < SMALLEST {
        (-1.0, 1.0)
    } else if high == low {
        // A constant gets room to show that it is one.
        (low - 0.1 * size, high + 0.1 * size)
    } else if missing > 0.0 {
        (low - missing / 2.0, high + missing / 2.0)
    } else {
        (low, high)
    }
}

/// The nearest (by ratio) of 1, 2 or 5 times a power of ten, and that power.
fn nice_step(rough: f64) -> (f64, i32) {
    let exponent = rough.log10().floor() as i32;
    let mantissa = rough / power_of_ten(exponent);
    let (nice, carry) = match mantissa * mantissa {
        square if square < 2.0 => (1.0, 0),
        square if square < 10.0 => (2.0, 0),
        square if square < 50.0 => (5.0, 0),
        _ => (1.0, 1),
    };
    let exponent = exponent + carry;
    (nice * power_of_ten(exponent), exponent)
}

/// Whole decades, of which as many are labelled as there are to be ticks.
fn logarithmic((low, high): (f64, f64), ticks: usize) -> Axis {
    let low = low.floor();
    let high = high.ceil().max(low + 1.0);
    let mut axis = Axis::bare(Scale::Log, (low, high));
    let decades = low as i32..=high as i32;
    let count = (high - low) as usize;
    let stride = count.div_ceil(ticks.max(1)) as i32;
    let (labelled, plain): (Vec<i32>, Vec<i32>) =
        decades.clone().partition(|e| e.rem_euclid(stride) == 0);
    let tick = |e: i32| axis.tick(f64::from(e), ten_to_the(e));
    let major = labelled.into_iter().map(tick).collect();
    let mut minor: Vec<f64> = plain.into_iter().map(f64::from).collect();
    if count <= 4 {
        let multiples = |e: i32| (2..=9).map(move |m| f64::from(e) + f64::from(m).log10());
        minor.extend(decades.flat_map(multiples).filter(|c| *c < high));
    }
    axis.minor = minor.into_iter().map(|c| axis.fraction(c)).collect();
    axis.major = major;
    axis
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.labels().collect()
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
