//! How the net motion of a stroke changes with its coefficients.

use lie::{Exp, LieGroup, SE3, Tangent};

use crate::chain::Chain;
use crate::error::GaitError;
use crate::net::{magnus, magnus_columns, nodes};
use crate::stroke::{Fourier, Stroke};

/// What a node of the quadrature needs.
struct Node {
    /// $\xi = -A \dot q$.
    xi: Tangent<6>,
    /// $\partial \xi / \partial q_j$ and $\partial \xi / \partial \dot q_j = -A_j$.
    slopes: Vec<[Tangent<6>; 2]>,
    /// The basis and its rates.
    bases: [Vec<f64>; 2],
}

impl Node {
    /// All those of a stroke.
    fn all(chain: &Chain, stroke: &Fourier, intervals: usize) -> Result<Vec<Self>, GaitError> {
        let times: Vec<f64> = nodes(stroke.period(), intervals).collect();
        let points = chain.states(stroke, times.iter().copied());
        let mut all = Vec::with_capacity(times.len());
        let formulas = chain.formulas();
        formulas.velocity_slopes.at_each(&points, &mut |n, out| {
            let (columns, _) = out.as_chunks::<6>();
            let slopes = columns[1..].chunks_exact(2);
            all.push(Self {
                xi: Tangent(columns[0]),
                slopes: slopes
                    .map(|pair| [Tangent(pair[0]), Tangent(pair[1])])
                    .collect(),
                bases: [0, 1].map(|k| stroke.basis(times[n], k)),
            });
        })?;
        Ok(all)
    }

    /// Adds what the coefficients change by this node, of whose velocity each coordinate moves the end by a column.
    fn add(&self, ends: &[Tangent<6>; 6], gradient: &mut [Tangent<6>]) {
        let end = |slope: &Tangent<6>| {
            let each = ends.iter().zip(slope.0);
            each.fold(Tangent::zero(), |sum, (end, x)| sum + *end * x)
        };
        let of_one = self.bases[0].len();
        for (slopes, own) in self.slopes.iter().zip(gradient.chunks_exact_mut(of_one)) {
            let [by_shape, by_rate] = [end(&slopes[0]), end(&slopes[1])];
            let bases = self.bases[0].iter().zip(&self.bases[1]);
            for (sum, (phi, rate)) in own.iter_mut().zip(bases) {
                *sum += by_shape * *phi + by_rate * *rate;
            }
        }
    }
}

/// The net motion $g_T$ of a stroke by `intervals` parts of its period, and $g_T^{-1} \partial g_T$ by each coefficient.
///
/// It is the exact derivative of that product of exponentials: its cost does not depend on the number of coefficients, but for a sum.
///
/// # Errors
/// [`GaitError::Shape`].
pub fn net_with_gradient(
    chain: &Chain,
    stroke: &Fourier,
    intervals: usize,
) -> Result<(SE3, Vec<Tangent<6>>), GaitError> {
    let h = stroke.period() / intervals as f64;
    let of_one = stroke.of_one();
    let mut gradient = vec![Tangent::zero(); chain.dim() * of_one];
    // What comes after the interval.
    let mut rest = SE3::identity();
    let all = Node::all(chain, stroke, intervals)?;
    for nodes in all.as_chunks::<3>().0.iter().rev() {
        let xi = nodes.each_ref().map(|node| node.xi);
        let omega = magnus(h, &xi);
        let back = rest.inverse();
        for (node, columns) in nodes.iter().zip(magnus_columns(h, &xi)) {
            let ends = columns.map(|column| back.adjoint(&SE3::d_left::<Exp>(&omega, &column)));
            node.add(&ends, &mut gradient);
        }
        rest = SE3::exp(&omega).compose(&rest);
    }
    Ok((rest, gradient))
}
