//! A graph is plain data: each number once, written and read back.

mod common;

use common::*;
use lie::Scalar;
use proptest::prelude::*;
use trace::{Binary, Graph, Traced, Unary, record};

proptest! {
    #[test]
    fn equal_numbers_are_one_node(steps in steps(ALL, 1..40)) {
        let once = graph_of(&steps);
        let twice = record(INPUTS, |x| {
            let again = numbers(&steps, x);
            let mut all = numbers(&steps, x);
            all.extend(again);
            all
        }).unwrap();
        prop_assert_eq!(once.len(), twice.len());
        let (first, second) = twice.outputs().split_at(once.outputs().len());
        prop_assert_eq!(first, second);
    }

    /// A formula of the numbers of another one.
    #[test]
    fn a_graph_called_by_another_is_their_composition(inner in steps(ALL, 4..20), outer in steps(ALL, 1..20), x in points()) {
        let (mut graph, other) = (graph_of(&inner), graph_of(&outer));
        let arguments: Vec<_> = graph.outputs().iter().rev().take(INPUTS).copied().collect();
        let called = graph.call(&other, &arguments, other.outputs());
        let mut inputs = numbers(&inner, &x);
        inputs.reverse();
        let expected = numbers(&outer, &inputs[..INPUTS]);
        for (expected, value) in expected.into_iter().zip(values(&graph, &called, &x)) {
            prop_assert!(same(expected, value), "{expected} {value}");
        }
    }

    #[test]
    fn a_graph_is_read_back_as_it_was(steps in steps(ALL, 1..40)) {
        let graph = graph_of(&steps);
        let text = serde_json::to_string(&graph).unwrap();
        prop_assert_eq!(serde_json::from_str::<Graph>(&text).unwrap(), graph);
    }
}

#[test]
fn factors_and_terms_may_change_places() {
    let graph = record(2, |x| {
        let (x, y) = (x[0], x[1]);
        vec![
            x * y - (x + y),
            y * x - (y + x),
            x.mul_add(y, x),
            y.mul_add(x, x),
        ]
    });
    let graph = graph.unwrap();
    let out = graph.outputs();
    assert_eq!((out[0], out[2]), (out[1], out[3]));
}

/// What changes no bit of any result is left out, and nothing else.
#[test]
fn only_exact_simplifications_are_made() {
    let c = Traced::from_f64;
    let graph = record(1, |x| {
        let x = x[0];
        let same = [
            x * c(1.0),
            x / c(1.0),
            x - c(0.0),
            x + c(-0.0),
            -(-x),
            Traced::select(x.less(c(0.0)), x, x),
        ];
        let others = [x + c(0.0), x * c(0.0), x - x, x / x, c(0.0) - x];
        same.into_iter().chain(others).collect()
    });
    let graph = graph.unwrap();
    let (same, others) = graph.outputs().split_at(6);
    assert!(same.iter().all(|id| *id == graph.input(0)));
    assert!(
        others
            .iter()
            .all(|id| *id != graph.input(0) && graph.as_constant(*id).is_none())
    );
}

#[test]
fn constants_are_computed_at_once() {
    let graph = record(0, |_| {
        vec![Scalar::exp(Traced::from_f64(2.0)) / Traced::from_f64(3.0)]
    })
    .unwrap();
    assert_eq!(graph.len(), 1);
    assert_eq!(
        graph.as_constant(graph.outputs()[0]),
        Some(2.0_f64.exp() / 3.0)
    );
}

#[test]
fn a_graph_built_by_hand_is_that_of_a_recording() {
    let recorded = record(2, |x| vec![(x[0] * x[1]).sqrt()]).unwrap();
    let mut graph = Graph::new(2);
    let product = graph.binary(Binary::Mul, graph.input(0), graph.input(1));
    let root = graph.unary(Unary::Sqrt, product);
    graph.set_outputs(&[root]);
    assert_eq!(graph, recorded);
}

#[test]
fn data_that_are_no_graph_are_refused() {
    for (text, why) in [
        (
            r#"{"inputs":1,"nodes":[{"Unary":["Neg",0]}],"outputs":[]}"#,
            "inputs come first",
        ),
        (
            r#"{"inputs":2,"nodes":[{"Input":0}],"outputs":[]}"#,
            "inputs come first",
        ),
        (
            r#"{"inputs":1,"nodes":[{"Input":0},{"Input":7}],"outputs":[]}"#,
            "inputs come first",
        ),
        (
            r#"{"inputs":1,"nodes":[{"Input":0},{"Unary":["Neg",1]}],"outputs":[]}"#,
            "only read nodes before",
        ),
        (
            r#"{"inputs":1,"nodes":[{"Input":0},{"Unary":["Neg",0]},{"Unary":["Neg",0]}],"outputs":[]}"#,
            "same as node 1",
        ),
        (
            r#"{"inputs":1,"nodes":[{"Input":0}],"outputs":[3]}"#,
            "output 0 is node 3",
        ),
    ] {
        let error = serde_json::from_str::<Graph>(text)
            .expect_err(text)
            .to_string();
        assert!(error.contains(why), "{error}");
    }
}
