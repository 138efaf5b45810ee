//! The net motion of a stroke without momentum: $\dot g = g\,\xi$ with $\xi = -A(q) \dot q$.

use lie::{Jet, LieGroup, SE3, Scalar, Tangent};

use crate::chain::Chain;
use crate::error::GaitError;
use crate::stroke::Stroke;

/// The times of Gauss's nodes, three in each of so many equal parts of a period.
pub(crate) fn nodes(period: f64, intervals: usize) -> impl Iterator<Item = f64> {
    let (h, offset) = (period / intervals as f64, 0.15_f64.sqrt());
    let of = move |n: usize| [0.5 - offset, 0.5, 0.5 + offset].map(|c| (n as f64 + c) * h);
    (0..intervals).flat_map(of)
}

/// The exponent of an interval, $g_{n+1} = g_n \exp \Omega$, of order 6 by the velocities at Gauss's nodes.
///
/// S. Blanes and F. Casas, *A Concise Introduction to Geometric Numerical Integration* (2016), sec. 4.4.2. It is told there for
/// $\dot Y = A Y$; on the right of $g$ the brackets change their sign.
pub(crate) fn magnus<S: Scalar>(h: f64, xi: &[Tangent<6, S>; 3]) -> Tangent<6, S> {
    let bracket = |a: &Tangent<6, S>, b: &Tangent<6, S>| SE3::<S>::bracket(b, a);
    let c = S::from_f64;
    let a1 = xi[1] * c(h);
    let a2 = (xi[2] - xi[0]) * c(15.0_f64.sqrt() * h / 3.0);
    let a3 = (xi[2] - xi[1] * c(2.0) + xi[0]) * c(10.0 * h / 3.0);
    let c1 = bracket(&a1, &a2);
    let c2 = bracket(&a1, &(a3 * c(2.0) + c1)) * c(-1.0 / 60.0);
    let last = bracket(&(c1 - a1 * c(20.0) - a3), &(a2 + c2));
    a1 + a3 * c(1.0 / 12.0) + last * c(1.0 / 240.0)
}

/// How $\Omega$ changes with a unit of each coordinate of the velocity at each node.
pub(crate) fn magnus_columns(h: f64, xi: &[Tangent<6>; 3]) -> [[Tangent<6>; 6]; 3] {
    type J = <f64 as Scalar>::Jet;
    let mut columns = [[Tangent::zero(); 6]; 3];
    for (i, of_node) in columns.iter_mut().enumerate() {
        let mut seeded = xi.map(|xi| Tangent(xi.0.map(J::constant)));
        for k in 0..6 {
            seeded[i][k] = J::variable(xi[i][k], k);
        }
        let omega = magnus(h, &seeded);
        for (k, column) in of_node.iter_mut().enumerate() {
            *column = Tangent(omega.0.map(|x| x.partial(k)));
        }
    }
    columns
}

/// The motion of the first body along a stroke, as it is at the ends of `intervals` equal parts of the period.
///
/// # Errors
/// [`GaitError::Shape`].
pub fn path(chain: &Chain, stroke: &dyn Stroke, intervals: usize) -> Result<Vec<SE3>, GaitError> {
    let h = stroke.period() / intervals as f64;
    let points = chain.states(stroke, nodes(stroke.period(), intervals));
    let mut velocities = Vec::with_capacity(points.len());
    chain.formulas().velocity.at_each(&points, &mut |_, out| {
        velocities.push(Tangent([0, 1, 2, 3, 4, 5].map(|i| out[i])));
    })?;
    let mut path = vec![SE3::identity()];
    let mut g = SE3::identity();
    for xi in velocities.as_chunks().0 {
        g = g.compose(&SE3::exp(&magnus(h, xi)));
        path.push(g);
    }
    Ok(path)
}

/// The net motion of a period, of a stroke without momentum.
///
/// The parts of the period are halved until the motion changes by less than `1e-13`: in rad, and in m or, of longer ways, of their length.
/// A spline does not come so far; then the last is given.
///
/// # Errors
/// [`GaitError::Shape`].
pub fn net_motion(chain: &Chain, stroke: &dyn Stroke) -> Result<SE3, GaitError> {
    const FIRST: usize = 32;
    const MOST: usize = 4096;
    let end = |intervals: usize| path(chain, stroke, intervals).map(|path| path[intervals]);
    let (mut intervals, mut g) = (FIRST, end(FIRST)?);
    while intervals < MOST {
        intervals *= 2;
        let finer: SE3 = end(intervals)?;
        let change = distance(&g, &finer, 1.0);
        g = finer;
        if change < 1e-13 * (1.0 + g.translation.norm()) {
            break;
        }
    }
    Ok(g)
}

/// How far two motions are apart, rad and lengths.
pub(crate) fn distance(a: &SE3, b: &SE3, length: f64) -> f64 {
    let change = a.inverse().compose(b);
    let turned = change.rotation.matrix().skew_vee().norm();
    (change.translation.norm() / length).max(turned)
}
