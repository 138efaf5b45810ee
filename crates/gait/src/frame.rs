//! Body coordinates in which the area rule holds best.

use faer::Mat;
use faer::linalg::solvers::Solve;
use lie::{Exp, Jet, LieGroup, SE3, Scalar, Tangent};

use crate::chain::Chain;
use crate::error::GaitError;

type J = <f64 as Scalar>::Jet;

/// The total degree of the polynomials.
const DEGREE: usize = 6;
/// Corrections of the coefficients: they converge quadratically, and begin near.
const CORRECTIONS: usize = 6;
/// What keeps combinations that change nothing from growing, relative to the largest entry of the matrix.
const RIDGE: f64 = 1e-10;
/// Nodes of the quadrature in each coordinate.
pub(crate) const NODES: usize = 12;

/// A rectangle of shapes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Region {
    pub(crate) centre: [f64; 2],
    pub(crate) half: [f64; 2],
}

/// Minimum-perturbation coordinates: a frame of the swimmer that moves with its shape, $g' = g\, b(q)$ with $b = \exp \sum_k \beta_k \varphi_k(q)$.
///
/// Its connection is $A'_j = \mathrm{Ad}_{b^{-1}} A_j - b^{-1} \partial_j b$. The coefficients make $\int |A'|^2$ over the region least, in which a
/// turn counts by the radius of gyration. Little is then left that does not commute, which is what the area rule leaves out.
/// After R. L. Hatton and H. Choset, *Geometric motion planning: the local connection, Stokes' theorem, and the importance of coordinate choice*
/// (2011), whose coordinates make rotation and translation small one after the other.
pub(crate) struct Frame {
    region: Region,
    coefficients: Vec<Tangent<6>>,
}

impl Frame {
    /// The frame of the first body.
    pub(crate) fn of_first_body(region: Region) -> Self {
        let count = basis(&region, region.centre)[0].len();
        Self {
            region,
            coefficients: vec![Tangent::zero(); count],
        }
    }

    /// The frame in which the connection is least over the region; a turn counts by the length.
    pub(crate) fn least(chain: &Chain, region: Region, length: f64) -> Result<Self, GaitError> {
        let mut frame = Self::of_first_body(region);
        for _ in 0..CORRECTIONS {
            frame.correct(chain, length)?;
        }
        Ok(frame)
    }

    /// $\beta$ and its derivatives at a shape.
    fn exponent(&self, q: [f64; 2]) -> [Tangent<6>; 3] {
        basis(&self.region, q).map(|values| {
            let each = self.coefficients.iter().zip(values);
            each.fold(Tangent::zero(), |sum, (c, phi)| sum + *c * phi)
        })
    }

    /// $b(q)$.
    pub(crate) fn at(&self, q: [f64; 2]) -> SE3 {
        SE3::exp(&self.exponent(q)[0])
    }

    /// A step of Gauss and Newton's method.
    fn correct(&mut self, chain: &Chain, length: f64) -> Result<(), GaitError> {
        let count = self.coefficients.len();
        let n = 6 * count;
        let (mut matrix, mut right) = (Mat::<f64>::zeros(n, n), Mat::<f64>::zeros(n, 1));
        let scale = |row: usize| if row < 3 { length } else { 1.0 };
        for (q, weight) in nodes(&self.region) {
            let a = chain.connection(&q)?;
            let values = basis(&self.region, q);
            let [beta, by_first, by_second] = self.exponent(q);
            for (j, slope) in [by_first, by_second].iter().enumerate() {
                let (residual, by_beta, by_slope) = residual(&a[j], &beta, slope);
                // Of each row of the residual, the derivatives by all coefficients.
                for row in 0..6 {
                    let scale = scale(row);
                    let entry = |k: usize| {
                        let (of, axis) = (k / 6, k % 6);
                        let own = by_beta[axis][row] * values[0][of];
                        scale * (own + by_slope[axis][row] * values[1 + j][of])
                    };
                    let line: Vec<f64> = (0..n).map(entry).collect();
                    for (k, x) in line.iter().enumerate().filter(|(_, x)| **x != 0.0) {
                        right[(k, 0)] -= weight * x * scale * residual[row];
                        for (l, y) in line.iter().enumerate() {
                            matrix[(k, l)] += weight * x * y;
                        }
                    }
                }
            }
        }
        let largest = (0..n).map(|k| matrix[(k, k)]).fold(0.0, f64::max);
        (0..n).for_each(|k| matrix[(k, k)] += RIDGE * largest.max(f64::MIN_POSITIVE));
        let change = matrix.partial_piv_lu().solve(&right);
        for (of, coefficient) in self.coefficients.iter_mut().enumerate() {
            for axis in 0..6 {
                coefficient[axis] += change[(6 * of + axis, 0)];
            }
        }
        Ok(())
    }
}

/// $A' = \mathrm{Ad}_{b^{-1}} A - b^{-1} \partial b$ of a column, and its derivatives by the coordinates of $\beta$ and of $\partial \beta$.
fn residual(
    a: &Tangent<6>,
    beta: &Tangent<6>,
    slope: &Tangent<6>,
) -> (Tangent<6>, [Tangent<6>; 6], [Tangent<6>; 6]) {
    let lift = |x: &Tangent<6>| Tangent(x.0.map(J::constant));
    let seeded = Tangent([0, 1, 2, 3, 4, 5].map(|k| J::variable(beta[k], k)));
    let back = SE3::exp(&seeded).inverse();
    let moved = back.adjoint(&lift(a)) - SE3::d_left::<Exp>(&seeded, &lift(slope));
    let by_beta = [0, 1, 2, 3, 4, 5].map(|k| Tangent(moved.0.map(|x| x.partial(k))));
    let by_slope = [0, 1, 2, 3, 4, 5].map(|k| {
        let mut unit = Tangent::zero();
        unit[k] = 1.0;
        -SE3::d_left::<Exp>(beta, &unit)
    });
    (Tangent(moved.0.map(Jet::value)), by_beta, by_slope)
}

/// Products of Legendre's polynomials up to the total degree, and their derivatives by both coordinates.
fn basis(region: &Region, q: [f64; 2]) -> [Vec<f64>; 3] {
    let [x, y] = [0, 1].map(|k| legendre((q[k] - region.centre[k]) / region.half[k]));
    let mut all = [vec![], vec![], vec![]];
    for (i, [p, slope]) in x.iter().enumerate() {
        for [r, rise] in &y[..=DEGREE - i] {
            all[0].push(p * r);
            all[1].push(slope * r / region.half[0]);
            all[2].push(p * rise / region.half[1]);
        }
    }
    all
}

/// $P_k$ and $P_k'$, by Bonnet's recursion.
fn legendre(x: f64) -> [[f64; 2]; DEGREE + 1] {
    let mut p = [
        [1.0, 0.0],
        [x, 1.0],
        [0.0; 2],
        [0.0; 2],
        [0.0; 2],
        [0.0; 2],
        [0.0; 2],
    ];
    for k in 1..DEGREE {
        let n = k as f64;
        p[k + 1][0] = ((2.0 * n + 1.0) * x * p[k][0] - n * p[k - 1][0]) / (n + 1.0);
        p[k + 1][1] = (2.0 * n + 1.0) * p[k][0] + p[k - 1][1];
    }
    p
}

/// Gauss's nodes of an interval from -1 to 1, and their weights.
pub(crate) fn gauss_nodes() -> [(f64, f64); NODES] {
    core::array::from_fn(|i| {
        // From Chebyshev's nodes by Newton's method.
        let mut x = (core::f64::consts::PI * (i as f64 + 0.75) / (NODES as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..20 {
            let (mut before, mut value) = (1.0, x);
            for k in 1..NODES {
                let n = k as f64;
                (before, value) = (
                    value,
                    ((2.0 * n + 1.0) * x * value - n * before) / (n + 1.0),
                );
            }
            slope = NODES as f64 * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    })
}

fn nodes(region: &Region) -> Vec<([f64; 2], f64)> {
    let one = gauss_nodes();
    let place = |k: usize, x: f64| region.centre[k] + region.half[k] * x;
    let both = one
        .iter()
        .flat_map(|(x, u)| one.iter().map(move |(y, v)| ([*x, *y], u * v)));
    both.map(|([x, y], weight)| ([place(0, x), place(1, y)], weight))
        .collect()
}
