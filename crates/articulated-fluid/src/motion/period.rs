//! The period of several laws together.

/// A multiple of the longest period is looked for up to here.
const MOST: u32 = 1000;
/// How far from whole the number of periods may be, of decimal frequencies.
const WHOLE: f64 = 1e-9;

/// From when on all repeat themselves together, and after how long, s; none where they never do.
///
/// Each is told by the time that it repeats from and its period, which is 0 of what is constant.
pub(crate) fn common(all: impl Iterator<Item = Option<[f64; 2]>>) -> Option<[f64; 2]> {
    let all: Vec<[f64; 2]> = all.collect::<Option<_>>()?;
    let largest = |k: usize| all.iter().map(|of| of[k]).fold(0.0, f64::max);
    let (from, longest) = (largest(0), largest(1));
    let periods: Vec<f64> = all.iter().map(|of| of[1]).filter(|of| *of > 0.0).collect();
    let is_common = |multiple: &f64| {
        periods.iter().all(|period| {
            let count = multiple * longest / period;
            (count - count.round()).abs() <= WHOLE * count
        })
    };
    let multiple = (1..=MOST).map(f64::from).find(is_common)?;
    Some([from, multiple * longest])
}

#[cfg(test)]
mod tests {
    use super::common;

    fn of(periods: &[f64]) -> Option<[f64; 2]> {
        common(periods.iter().map(|period| Some([0.5, *period])))
    }

    #[test]
    fn laws_repeat_together_after_a_multiple_of_each() {
        let period = |periods: &[f64]| of(periods).map(|[_, period]| period);
        assert_eq!(period(&[2.0, 3.0, 0.0]), Some(6.0));
        assert_eq!(period(&[0.1, 0.25]), Some(0.5));
        assert_eq!(period(&[0.0]), Some(0.0));
        assert_eq!(period(&[1.0, core::f64::consts::SQRT_2]), None);
        assert_eq!(common([Some([0.0, 1.0]), None].into_iter()), None);
    }
}
