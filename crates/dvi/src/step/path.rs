//! What a step goes through: the states that sums over the step are taken at.

use std::borrow::Cow;

use lie::RealGroup;

use crate::State;

/// What a step, or a part of one, goes through: the states at its ends, and those between that its method solves for.
///
/// What is done over the step, as work, is a sum over them, of the order of the method. A [`Gauss`](crate::Gauss) step has its own
/// quadrature. A step of a discrete Lagrangian has the trapezoidal rule, whose symmetry is what the parts of a composition need.
///
/// ```
/// use dvi::{Context, Gauss, Integrator, Lagrangian, Path, System};
/// use lie::{Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg on a spring of 1 N/m.
/// struct Spring;
///
/// impl System for Spring {
///     type Group = Rn<1>;
/// }
///
/// impl Lagrangian for Spring {
///     fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         (v[0] * v[0] - x.0[0] * x.0[0]) * S::from_f64(0.5)
///     }
/// }
///
/// let mut state = Spring.state(0.0, Rn([1.0]), &Tangent([0.0]))?;
/// let mut integrator = Gauss::new::<4>(Spring.hamiltonian());
/// let mut work = 0.0;
/// integrator.step_along(&mut state, 0.5, &mut |path: Path<Rn<1>>| {
///     let states = path.states();
///     // The force of the spring along the displacement.
///     work += path.line_integral(|i, j| -states[i].g.0[0] * states[j].g.0[0]);
/// })?;
/// assert!((work - 0.5 * 0.5_f64.sin().powi(2)).abs() < 1e-10);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
pub struct Path<'a, G: RealGroup> {
    states: &'a [State<G>],
    h: f64,
    rule: &'a Rule,
}

impl<'a, G: RealGroup> Path<'a, G> {
    pub(crate) fn new(rule: &'a Rule, states: &'a [State<G>], h: f64) -> Self {
        Self { states, h, rule }
    }

    /// The step between two states, of which no more is known.
    pub(crate) fn between(ends: &'a [State<G>; 2], h: f64) -> Self {
        Self::new(&ENDS, ends, h)
    }

    /// The states in the order of time: the first is the start, the last the end.
    pub fn states(&self) -> &'a [State<G>] {
        self.states
    }

    /// How long it takes, s; parts of a composition may go back.
    pub fn h(&self) -> f64 {
        self.h
    }

    /// $\int p\,dt$ of the values at the states.
    pub fn integral(&self, value: impl Fn(usize) -> f64) -> f64 {
        let inner = self.rule.weighted();
        self.h * inner.map(|(i, weight, _)| weight * value(i)).sum::<f64>()
    }

    /// $\int a \cdot dn$ of the products $a_i \cdot n_j$ of the values at the states $i$ and $j$.
    pub fn line_integral(&self, product: impl Fn(usize, usize) -> f64) -> f64 {
        let inner = self.rule.weighted();
        let at = |(i, weight, slopes): (usize, f64, &[f64])| {
            let slope = slopes.iter().enumerate().map(|(j, d)| d * product(i, j));
            weight * slope.sum::<f64>()
        };
        inner.map(at).sum()
    }
}

/// The weights of a quadrature over $[0, 1]$, and at each of its places the slopes of the polynomial through the values at all places.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rule {
    weights: Cow<'static, [f64]>,
    /// Row by row.
    slopes: Cow<'static, [f64]>,
}

/// The trapezoidal rule.
static ENDS: Rule = Rule {
    weights: Cow::Borrowed(&[0.5, 0.5]),
    slopes: Cow::Borrowed(&[-1.0, 1.0, -1.0, 1.0]),
};

impl Rule {
    /// A rule with weights at inner places, which are all different, and none at the ends.
    pub(crate) fn inside(nodes: &[f64], weights: impl Iterator<Item = f64>) -> Self {
        let around = |inner: &mut dyn Iterator<Item = f64>, [a, b]: [f64; 2]| {
            let inner = core::iter::once(a).chain(inner);
            inner.chain([b]).collect::<Vec<_>>()
        };
        let places = around(&mut nodes.iter().copied(), [0.0, 1.0]);
        Self {
            slopes: slopes(&places).into(),
            weights: around(&mut { weights }, [0.0; 2]).into(),
        }
    }

    /// The places that count: which, their weights, and their rows of slopes.
    fn weighted(&self) -> impl Iterator<Item = (usize, f64, &[f64])> {
        let rows = self.slopes.chunks_exact(self.weights.len());
        let all = self.weights.iter().zip(rows).enumerate();
        let all = all.map(|(i, (weight, row))| (i, *weight, row));
        all.filter(|(_, weight, _)| *weight != 0.0)
    }
}

/// The slope at each place of the polynomial that is 1 at another and 0 at the rest.
fn slopes(places: &[f64]) -> Vec<f64> {
    let others = |i: usize| (0..places.len()).filter(move |k| *k != i);
    let product = |i: usize| others(i).map(|k| places[i] - places[k]).product::<f64>();
    let slope = |i: usize, j: usize| match i == j {
        true => others(i).map(|k| 1.0 / (places[i] - places[k])).sum(),
        false => product(i) / product(j) / (places[i] - places[j]),
    };
    let rows = (0..places.len()).flat_map(|i| (0..places.len()).map(move |j| slope(i, j)));
    rows.collect()
}
