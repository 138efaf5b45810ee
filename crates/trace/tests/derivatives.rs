//! Gradients, Hessians, patterns and degrees, against dual numbers and differences.

mod common;

use common::*;
use lie::{Jet, Scalar};
use proptest::prelude::*;
use trace::{Degree, Graph};

type Dual = <f64 as Scalar>::Jet;

/// The gradient by dual numbers.
fn by_duals(steps: &[Step], x: &[f64; INPUTS]) -> [f64; INPUTS] {
    let inputs: [Dual; INPUTS] = std::array::from_fn(|k| Dual::variable(x[k], k));
    let y = last(steps, &inputs);
    std::array::from_fn(|k| y.partial(k))
}

/// The graph of the last number, with the nodes of its gradient.
fn gradient_of(steps: &[Step]) -> (Graph, Vec<trace::Id>) {
    let mut graph = trace::record(INPUTS, |x| vec![last(steps, x)]).unwrap();
    let (root, inputs) = (graph.outputs()[0], graph.inputs());
    let slopes = graph.gradient(root, &inputs);
    (graph, slopes)
}

fn moved(x: &[f64; INPUTS], k: usize, by: f64) -> [f64; INPUTS] {
    let mut moved = *x;
    moved[k] += by;
    moved
}

/// Sums in another order: the terms are larger than the sum by as many paths as there are, 2^10 say in a formula of this length.
const ROUNDING: f64 = 1e-12;

proptest! {
    #[test]
    fn gradients_are_those_of_dual_numbers(steps in steps(CHOOSING, 1..30), x in points()) {
        let (graph, slopes) = gradient_of(&steps);
        let slopes = values(&graph, &slopes, &x);
        let expected = by_duals(&steps, &x);
        let size = expected.iter().fold(1.0_f64, |max, d| max.max(d.abs()));
        for (slope, expected) in slopes.iter().zip(expected) {
            prop_assert!((slope - expected).abs() <= ROUNDING * size, "{slope} {expected}");
        }
    }

    #[test]
    fn gradients_are_those_of_central_differences(steps in steps(TAME, 1..10), x in points()) {
        let (graph, slopes) = gradient_of(&steps);
        let slopes = values(&graph, &slopes, &x);
        for (k, slope) in slopes.iter().enumerate() {
            let difference = |w: f64| (last(&steps, &moved(&x, k, w)) - last(&steps, &moved(&x, k, -w))) / (2.0 * w);
            let (fine, coarse) = (difference(1e-4), difference(2e-4));
            // The truncation is a third of what doubling the width changes; the rest is rounding over the width.
            let tolerance = (fine - coarse).abs() + 1e-10;
            prop_assert!((slope - fine).abs() <= tolerance, "{k}: {slope} {fine}");
        }
    }

    #[test]
    fn products_with_the_hessian_are_differences_of_gradients(steps in steps(TAME, 1..10), x in points(), d in points()) {
        let (mut graph, slopes) = gradient_of(&steps);
        let inputs = graph.inputs();
        let direction = d.map(|d| graph.constant(d));
        let product = graph.hessian_vector(&slopes, &direction, &inputs);
        let product = values(&graph, &product, &x);
        let along = |w: f64| {
            let at = |w: f64| std::array::from_fn(|k| w.mul_add(d[k], x[k]));
            let [forth, back] = [w, -w].map(|w| by_duals(&steps, &at(w)));
            std::array::from_fn::<f64, INPUTS, _>(|k| (forth[k] - back[k]) / (2.0 * w))
        };
        let (fine, coarse) = (along(1e-4), along(2e-4));
        for k in 0..INPUTS {
            let tolerance = (fine[k] - coarse[k]).abs() + 1e-9;
            prop_assert!((product[k] - fine[k]).abs() <= tolerance, "{k}: {} {}", product[k], fine[k]);
        }
    }

    #[test]
    fn jacobians_are_the_gradients_of_their_rows(steps in steps(CHOOSING, 1..20), x in points()) {
        let mut graph = graph_of(&steps);
        let (out, inputs) = (graph.outputs().to_vec(), graph.inputs());
        let (pattern, entries) = graph.jacobian(&out, &inputs);
        let mut entries = values(&graph, &entries, &x).into_iter();
        for (i, y) in out.iter().enumerate() {
            let row = graph.gradient(*y, &inputs);
            let row = values(&graph, &row, &x);
            for (j, expected) in row.into_iter().enumerate() {
                let entry = if pattern.row(i).contains(&j) { entries.next().unwrap() } else { 0.0 };
                prop_assert!((entry - expected).abs() <= ROUNDING * expected.abs().max(1.0));
            }
        }
        prop_assert_eq!(entries.next(), None);
    }

    /// What is not in the pattern does not change the result, to the bit.
    #[test]
    fn results_depend_on_nothing_outside_their_pattern(steps in steps(CHOOSING, 1..12), x in points(), other in points()) {
        let graph = graph_of(&steps);
        let pattern = graph.pattern(graph.outputs(), &graph.inputs());
        let before = numbers(&steps, &x);
        for (k, by) in other.into_iter().enumerate() {
            let after = numbers(&steps, &moved(&x, k, by));
            for (i, (before, after)) in before.iter().zip(after).enumerate() {
                prop_assert!(pattern.row(i).contains(&k) || *before == after);
            }
        }
    }

    /// What is in the pattern does, somewhere: in formulas without choices and with constants that do not cancel.
    #[test]
    fn results_depend_on_all_of_their_pattern(steps in steps(TAME, 1..4), x in points()) {
        let steps: Vec<Step> = steps.into_iter().enumerate().map(|(i, s)| Step { op: [0, 2, 4, 9][usize::from(s.op) % 4], from: [i as u16 + 3, s.from[1] % 3, s.from[2] % 3, 0], ..s }).collect();
        let graph = graph_of(&steps);
        let pattern = graph.pattern(graph.outputs(), &graph.inputs());
        let before = numbers(&steps, &x);
        let changes = |i: usize, k: usize| [0.1, 0.3, 0.7].iter().any(|w| numbers(&steps, &moved(&x, k, *w))[i] != before[i]);
        for i in 0..before.len() {
            for k in pattern.row(i) {
                prop_assert!(changes(i, *k), "{i} {k}");
            }
        }
    }

    /// Differences of a polynomial vanish above its degree.
    #[test]
    fn degrees_bound_those_of_differences(steps in steps(0..17, 1..12), x in points()) {
        let polynomial: Vec<Step> = steps.into_iter().filter(|s| matches!(s.op, 0 | 4 | 13..=16)).collect();
        let graph = trace::record(INPUTS, |x| vec![last(&polynomial, x)]).unwrap();
        for k in 0..INPUTS {
            let along: Vec<f64> = (0..4).map(|i| last(&polynomial, &moved(&x, k, f64::from(i)))).collect();
            let vanishing = match graph.degree(graph.outputs()[0], &[graph.input(k)]) {
                Degree::Constant => along[1] - along[0],
                Degree::Linear => along[2] - 2.0 * along[1] + along[0],
                Degree::Quadratic => along[3] - 3.0 * along[2] + 3.0 * along[1] - along[0],
                _ => 0.0,
            };
            // Rounding of what is subtracted, and of the terms that it is made of.
            let size = along.iter().fold(1.0_f64, |max, y| max.max(y.abs()));
            prop_assert!(vanishing.abs() <= 1e-12 * size, "{vanishing} {size}");
        }
    }
}

#[test]
fn degrees_are_as_on_paper() {
    let graph = trace::record(2, |x| {
        let [x, v] = [x[0], x[1]];
        vec![
            x.cos() * x,
            v * x.sin() + x,
            v * v / x - v,
            v * v * v,
            v.sqrt(),
            lie::Scalar::select(x.less(v), x, x + x),
            v * v - v,
        ]
    });
    let graph = graph.unwrap();
    let degrees: Vec<Degree> = graph
        .outputs()
        .iter()
        .map(|y| graph.degree(*y, &[graph.input(1)]))
        .collect();
    use Degree::{Constant, Linear, More, Quadratic};
    assert_eq!(
        degrees,
        [Constant, Linear, Quadratic, More, More, More, Quadratic]
    );
}
