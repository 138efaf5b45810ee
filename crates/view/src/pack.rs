//! Numbers in few bytes: quantised columns, their second differences as variable-length integers, deflated, in base 64.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use miniz_oxide::deflate::compress_to_vec_zlib;
use serde::Serialize;

/// The best that deflating does.
const LEVEL: u8 = 9;

/// Columns of one range that follow each other.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Group {
    pub(crate) name: String,
    count: usize,
    low: f64,
    high: f64,
    /// Steps from low to high.
    levels: u32,
}

/// Columns on their way to a text.
#[derive(Default)]
pub(crate) struct Pack {
    groups: Vec<Group>,
    bytes: Vec<u8>,
}

impl Pack {
    /// Adds columns whose numbers are between `low` and `high`; each is then at most $(high - low) / (2\, levels)$ off.
    pub(crate) fn add<C: IntoIterator<Item = f64>>(
        &mut self,
        name: impl Into<String>,
        ([low, high], levels): ([f64; 2], u32),
        columns: impl IntoIterator<Item = C>,
    ) {
        let step = (high - low) / f64::from(levels);
        let mut count = 0;
        for column in columns {
            count += 1;
            let (mut value, mut slope) = (0, 0);
            for x in column {
                // A range of no size has the level 0 alone.
                let level = ((x - low) / step).round() as i64;
                let change = level - value;
                self.integer(change - slope);
                (value, slope) = (level, change);
            }
        }
        let name = name.into();
        self.groups.push(Group {
            name,
            count,
            low,
            high,
            levels,
        });
    }

    /// Seven bits a byte, the lowest first; signs in the lowest bit.
    fn integer(&mut self, x: i64) {
        let mut rest = ((x << 1) ^ (x >> 63)) as u64;
        while rest > 127 {
            self.bytes.push((rest & 127) as u8 | 128);
            rest >>= 7;
        }
        self.bytes.push(rest as u8);
    }

    pub(crate) fn finish(self) -> (Vec<Group>, String) {
        let bytes = compress_to_vec_zlib(&self.bytes, LEVEL);
        (self.groups, STANDARD.encode(bytes))
    }
}

/// The smallest range that has all of the numbers.
pub(crate) fn range(numbers: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let empty = [f64::INFINITY, f64::NEG_INFINITY];
    let widen = |[low, high]: [f64; 2], x: f64| [low.min(x), high.max(x)];
    match numbers.into_iter().fold(empty, widen) {
        [low, high] if low <= high => [low, high],
        _ => [0.0; 2],
    }
}

/// Three of a unit quaternion's four numbers, and which is left out: one that is not small, and is made positive. It is the one of
/// before as long as it may be, so that the others are smooth.
pub(crate) fn smallest_three(q: [f64; 4], before: &mut usize) -> [f64; 3] {
    if q[*before].abs() < SMALL {
        let largest = |best: usize, k: usize| match q[k].abs() > q[best].abs() {
            true => k,
            false => best,
        };
        *before = (0..4).fold(0, largest);
    }
    let sign = q[*before].signum();
    let mut others = (0..4).filter(|k| k != before).map(|k| q[k] * sign);
    [0; 3].map(|_| others.next().unwrap_or_default())
}

/// Below this a number of a quaternion is not left out.
const SMALL: f64 = 0.4;

#[cfg(test)]
mod tests {
    use miniz_oxide::inflate::decompress_to_vec_zlib;
    use proptest::prelude::*;

    use super::*;

    /// As the page does it.
    fn unpacked(pack: Pack, frames: usize) -> Vec<Vec<f64>> {
        let (groups, text) = pack.finish();
        let bytes = decompress_to_vec_zlib(&STANDARD.decode(text).unwrap()).unwrap();
        let mut bytes = bytes.into_iter();
        let mut integer = || {
            let (mut value, mut shift) = (0_u64, 0);
            loop {
                let byte = bytes.next().unwrap();
                value |= u64::from(byte & 127) << shift;
                shift += 7;
                if byte < 128 {
                    return (value >> 1) as i64 ^ -((value & 1) as i64);
                }
            }
        };
        let mut columns = vec![];
        for group in groups {
            let step = (group.high - group.low) / f64::from(group.levels);
            for _ in 0..group.count {
                let (mut value, mut slope) = (0, 0);
                let mut next = |_| {
                    slope += integer();
                    value += slope;
                    group.low + value as f64 * step
                };
                columns.push((0..frames).map(&mut next).collect());
            }
        }
        columns
    }

    proptest! {
        #[test]
        fn a_number_is_off_by_half_a_step_at_most(
            columns in prop::collection::vec(prop::collection::vec(-1e3..1e3_f64, 7), 1..5),
            levels in 1_u32..1 << 20,
        ) {
            let (low, high) = (-1e3, 1e3);
            let mut pack = Pack::default();
            pack.add("x", ([low, high], levels), columns.clone());
            let half = (high - low) / f64::from(levels) / 2.0;
            for (column, got) in columns.iter().zip(unpacked(pack, 7)) {
                for (x, y) in column.iter().zip(got) {
                    // The rounding of the sum is beyond.
                    prop_assert!((x - y).abs() <= half * (1.0 + 1e-9));
                }
            }
        }

        /// The three numbers are at most $\delta$ off, half a step. The fourth one is $w \ge 0.4$, so at most $\sqrt 3 \delta / w$ off, and
        /// an angle twice the distance of the quaternions.
        #[test]
        fn an_attitude_is_off_by_little(q in prop::array::uniform4(-1.0..1.0_f64), before in 0_usize..4) {
            let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
            prop_assume!(norm > 1e-3);
            let q = q.map(|x| x / norm);
            let mut left_out = before;
            let three = smallest_three(q, &mut left_out);
            let levels = crate::page::ATTITUDE_LEVELS;
            let mut pack = Pack::default();
            pack.add("q", ([-1.0, 1.0], levels), three.map(|x| [x]));
            let got: Vec<f64> = unpacked(pack, 1).into_iter().map(|column| column[0]).collect();
            let mut back = got.clone();
            back.insert(left_out, (1.0 - got.iter().map(|x| x * x).sum::<f64>()).max(0.0).sqrt());
            let dot: f64 = q.iter().zip(&back).map(|(a, b)| a * b).sum();
            let apart: f64 = q.iter().zip(&back).map(|(a, b)| (a - b * dot.signum()).powi(2)).sum();
            let delta = 1.0 / f64::from(levels);
            let bound = 2.0 * delta * (3.0 + 3.0 / (SMALL * SMALL)).sqrt();
            prop_assert!(2.0 * apart.sqrt() <= 1.01 * bound, "{} {bound}", 2.0 * apart.sqrt());
            prop_assert!(bound < 3e-4);
        }
    }
}
