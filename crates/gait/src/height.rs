//! Height functions: how much a small loop of two shape coordinates moves the swimmer.

use lie::{LieGroup, SE3, Tangent};

use crate::chain::Chain;
use crate::error::GaitError;
use crate::frame::{Frame, Region, gauss_nodes};
use crate::net::net_motion;
use crate::stroke::Stroke;

/// Points of a map in each coordinate.
const POINTS: usize = 61;
/// Points of the stroke.
const OF_STROKE: usize = 240;
/// A coordinate that moves less, rad, does not move.
const LEAST: f64 = 1e-6;
/// The rectangle of a map is larger than the stroke by so much on each side, relative.
const AROUND: f64 = 0.25;

/// The height functions, or constraint curvatures, around a stroke of two coordinates, without momentum and loads.
///
/// A height is $-F$ with $F = \partial_1 A_2 - \partial_2 A_1 - [A_1, A_2]$, in the body coordinates that make the connection least over the
/// map. A small loop from the first coordinate to the second moves the swimmer by its height times its area. A larger one does so
/// nearly: what does not commute is left out.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMaps {
    /// The first coordinates of the points, rad, ascending.
    pub first: Vec<f64>,
    /// The second ones.
    pub second: Vec<f64>,
    /// The heights, row by row from the lowest second coordinate: turns, 1/rad, and advances, m/rad², each about or along three axes.
    pub heights: [Vec<f64>; 6],
    /// The stroke, rad.
    pub stroke: Vec<[f64; 2]>,
    /// The net motion by the areas, as an exponent: turn, rad, and advance, m.
    pub by_area: Tangent<6>,
    /// The exponent of the net motion, in the same coordinates.
    pub exact: Tangent<6>,
}

impl HeightMaps {
    /// The maps of a chain of two coordinates around a stroke.
    ///
    /// # Errors
    /// [`GaitError::NotTwo`] of another number of coordinates; [`GaitError::Thin`] where one of them does not move.
    pub fn of(chain: &Chain, stroke: &dyn Stroke) -> Result<Self, GaitError> {
        let (region, _) = around(chain, stroke)?;
        let length = chain.tree().gyration(&region.centre);
        Self::in_frame(chain, stroke, &Frame::least(chain, region, length)?)
    }

    /// The same in the coordinates of the first body.
    ///
    /// # Errors
    /// As [`of`](Self::of).
    pub fn of_first_body(chain: &Chain, stroke: &dyn Stroke) -> Result<Self, GaitError> {
        let (region, _) = around(chain, stroke)?;
        Self::in_frame(chain, stroke, &Frame::of_first_body(region))
    }

    fn in_frame(chain: &Chain, stroke: &dyn Stroke, frame: &Frame) -> Result<Self, GaitError> {
        let (region, points) = around(chain, stroke)?;
        let along = |k: usize| {
            let part = |i: usize| 2.0 * i as f64 / (POINTS - 1) as f64 - 1.0;
            (0..POINTS)
                .map(|i| region.centre[k] + region.half[k] * part(i))
                .collect::<Vec<_>>()
        };
        let (first, second) = (along(0), along(1));
        let mut heights: [Vec<f64>; 6] = Default::default();
        for y in &second {
            for x in &first {
                let height = height(chain, frame, [*x, *y])?;
                heights
                    .iter_mut()
                    .zip(height.0)
                    .for_each(|(all, one)| all.push(one));
            }
        }
        let b = frame.at(points[0]);
        let net = b.inverse().compose(&net_motion(chain, stroke)?.compose(&b));
        Ok(Self {
            first,
            second,
            heights,
            by_area: area(chain, frame, stroke, &region)?,
            exact: net.log().unwrap_or_else(|e| e.representative),
            stroke: points,
        })
    }
}

/// The rectangle around a stroke, and the stroke's points.
fn around(chain: &Chain, stroke: &dyn Stroke) -> Result<(Region, Vec<[f64; 2]>), GaitError> {
    let point = |i: usize| {
        let q = stroke.derivative(stroke.period() * i as f64 / OF_STROKE as f64, 0);
        <[f64; 2]>::try_from(q).map_err(|q| GaitError::NotTwo { found: q.len() })
    };
    let points: Vec<[f64; 2]> = (0..OF_STROKE).map(point).collect::<Result<_, _>>()?;
    if chain.dim() != 2 {
        return Err(GaitError::NotTwo { found: chain.dim() });
    }
    let end =
        |k: usize, of: fn(f64, f64) -> f64| points.iter().map(|q| q[k]).reduce(of).unwrap_or(0.0);
    let [low, high] = [f64::min, f64::max].map(|of| [end(0, of), end(1, of)]);
    let half = [0, 1].map(|k| 0.5 * (1.0 + 2.0 * AROUND) * (high[k] - low[k]));
    match half.iter().all(|half| *half > LEAST) {
        true => Ok((
            Region {
                centre: [0, 1].map(|k| 0.5 * (low[k] + high[k])),
                half,
            },
            points,
        )),
        false => Err(GaitError::Thin),
    }
}

/// $-\mathrm{Ad}_{b^{-1}} F$.
fn height(chain: &Chain, frame: &Frame, q: [f64; 2]) -> Result<Tangent<6>, GaitError> {
    let [[a, _, by_second], [b, by_first, _]] = [columns(chain, q, 0)?, columns(chain, q, 1)?];
    let curvature = by_first - by_second - SE3::bracket(&a, &b);
    Ok(-frame.at(q).inverse().adjoint(&curvature))
}

/// $A_j$, $\partial_1 A_j$ and $\partial_2 A_j$.
fn columns(chain: &Chain, q: [f64; 2], j: usize) -> Result<[Tangent<6>; 3], GaitError> {
    let mut state = vec![q[0], q[1], 0.0, 0.0, 0.0, 0.0];
    state[2 + j] = 1.0;
    let out = chain.formulas().velocity_slopes.at(state)?;
    // Of ξ, then of each coordinate by the shape and by the rate.
    let (columns, _) = out.as_chunks::<6>();
    Ok([0, 1, 3].map(|i| -Tangent(columns[i])))
}

/// $-\iint F$ over the inside of the stroke, by Green's theorem.
fn area(
    chain: &Chain,
    frame: &Frame,
    stroke: &dyn Stroke,
    region: &Region,
) -> Result<Tangent<6>, GaitError> {
    let mut sum = Tangent::zero();
    let h = stroke.period() / OF_STROKE as f64;
    for i in 0..OF_STROKE {
        let [q, rates] = [0, 1].map(|k| stroke.derivative(i as f64 * h, k));
        let half = 0.5 * (q[0] - region.centre[0]);
        for (x, weight) in gauss_nodes() {
            let at = [region.centre[0] + half * (1.0 + x), q[1]];
            sum += height(chain, frame, at)? * (h * rates[1] * half * weight);
        }
    }
    Ok(sum)
}
