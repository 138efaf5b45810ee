//! How far ellipsoids are apart.

use articulated_fluid::Scene;
use lie::{Mat3, Scalar, Sym3, Vec3};

use crate::error::GaitError;
use crate::formulas::Evaluator;
use crate::tree::Tree;

/// Halvings of the interval of the contact function's maximum, at which the function is flat.
const HALVINGS: usize = 30;

/// The pairs of a scene's bodies that have semi-axes: how much they overlap, recorded once.
///
/// Left out are discs, bodies that are welded together, and pairs that overlap where all coordinates are zero.
pub(crate) struct Clearance {
    pairs: Vec<Pair>,
}

/// How much two bodies overlap, and the derivatives by the shape.
type Overlap = (f64, Vec<f64>);

/// The contact function of two bodies by shape and $\lambda$: its slope in $\lambda$, and value and gradient.
struct Pair {
    slope: Evaluator,
    gradient: Evaluator,
}

impl Clearance {
    pub(crate) fn of(scene: &Scene, tree: &Tree) -> Result<Self, GaitError> {
        let shapes = scene.bodies.iter().enumerate().filter_map(|(i, body)| {
            let axes = body
                .semi_axes()
                .filter(|axes| axes.iter().all(|a| *a > 0.0))?;
            Some((i, axes))
        });
        let shapes: Vec<(usize, [f64; 3])> = shapes.collect();
        let each = shapes.iter().enumerate();
        let pairs = each.flat_map(|(k, b)| shapes[..k].iter().map(move |a| [*a, *b]));
        let moves = pairs.filter(|[a, b]| tree.cluster(a.0) != tree.cluster(b.0));
        let mut pairs: Vec<Pair> = moves
            .map(|pair| Pair::new(tree, pair))
            .collect::<Result<_, _>>()?;
        let rest = vec![0.0; tree.dim()];
        let mut apart = Vec::with_capacity(pairs.len());
        for pair in pairs.drain(..) {
            if pair.overlaps(core::slice::from_ref(&rest))?[0].0 < 0.0 {
                apart.push(pair);
            }
        }
        Ok(Self { pairs: apart })
    }

    /// $1 - F$ of each pair at each shape, which is positive where the two overlap, and its derivatives by the shape.
    pub(crate) fn overlaps(&self, shapes: &[Vec<f64>]) -> Result<Vec<Vec<Overlap>>, GaitError> {
        let each = self.pairs.iter();
        each.map(|pair| pair.overlaps(shapes)).collect()
    }
}

impl Pair {
    fn new(tree: &Tree, pair: [(usize, [f64; 3]); 2]) -> Result<Self, GaitError> {
        let m = tree.dim();
        let formula = |x: &[trace::Traced]| vec![contact(tree, pair, &x[..m], x[m])];
        let mut graph = trace::record(m + 1, formula).map_err(GaitError::Trace)?;
        let (value, x) = (graph.outputs()[0], graph.inputs());
        let slope = graph.gradient(value, &x[m..]);
        let mut gradient = vec![value];
        gradient.extend(graph.gradient(value, &x[..m]));
        Ok(Self {
            slope: Evaluator::new(&graph, &slope),
            gradient: Evaluator::new(&graph, &gradient),
        })
    }

    fn overlaps(&self, shapes: &[Vec<f64>]) -> Result<Vec<Overlap>, GaitError> {
        let mut lambdas = vec![0.5; shapes.len()];
        let points = |lambdas: &[f64]| {
            let each = shapes.iter().zip(lambdas);
            let point = |(q, lambda): (&Vec<f64>, &f64)| [&q[..], &[*lambda]].concat();
            each.map(point).collect::<Vec<_>>()
        };
        // The function is concave in λ; at its maximum, λ may be held.
        let mut half = 0.25;
        for _ in 0..HALVINGS {
            self.slope.at_each(&points(&lambdas), &mut |i, out| {
                lambdas[i] += if out[0] > 0.0 { half } else { -half };
            })?;
            half *= 0.5;
        }
        let mut found = Vec::with_capacity(shapes.len());
        self.gradient.at_each(&points(&lambdas), &mut |_, out| {
            found.push((1.0 - out[0], out[1..].iter().map(|slope| -slope).collect()));
        })?;
        Ok(found)
    }
}

/// $\lambda (1 - \lambda) r^T ((1 - \lambda) A + \lambda B)^{-1} r$: at its maximum over $\lambda$ the contact function of J. W. Perram and
/// M. S. Wertheim (1985), the square of the distance over that at which the ellipsoids touch.
fn contact<S: Scalar>(tree: &Tree, [a, b]: [(usize, [f64; 3]); 2], q: &[S], lambda: S) -> S {
    let bodies = tree.bodies(q);
    let shape = |(body, axes): (usize, [f64; 3])| {
        let squares = Mat3::diagonal(axes.map(|a| a * a));
        Sym3::upper(&squares.lift::<S>()).turned(bodies[body].0.matrix())
    };
    let apart: Vec3<S> = bodies[b.0].1 - bodies[a.0].1;
    let rest = S::one() - lambda;
    let x = (shape(a) * rest + shape(b) * lambda).ldl().solve(apart);
    lambda * rest * apart.dot(x)
}
