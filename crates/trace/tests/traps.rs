//! What a recording must not get wrong in silence.

mod common;

use common::values;
use lie::{Jet, LieGroup, SO2, SO3, Scalar, Tangent, Vec3};
use num_traits::Zero;
use trace::{Graph, TraceError, Traced, record};

/// Records a formula of one number that is expected to be refused.
fn refused(formula: impl Fn(Traced) -> Traced) -> TraceError {
    record(1, |x| vec![formula(x[0])]).expect_err("it is to be refused")
}

fn branch(formula: impl Fn(Traced) -> Traced) -> &'static str {
    match refused(formula) {
        TraceError::Branch { operation, at } => {
            assert!(at.line() > 1);
            operation
        }
        other => panic!("{other}"),
    }
}

#[test]
fn branches_on_values_are_refused_and_not_frozen() {
    assert_eq!(
        branch(|x| if x == Traced::from_f64(0.0) { x } else { -x }),
        "=="
    );
    assert_eq!(branch(|x| if x.is_zero() { x } else { -x }), "is_zero");
    assert_eq!(
        branch(|x| if x.magnitude() < 1e-3 { x } else { -x }),
        "magnitude"
    );
    // Also where nothing hangs on it.
    assert_eq!(branch(|x| x.times(f64::from(u8::from(x == x)))), "==");
}

#[test]
fn a_loop_that_waits_for_a_value_ends() {
    let loops: [&dyn Fn(Traced) -> Traced; 5] = [
        &|mut x| {
            loop {
                x = x.times(0.5);
                if x.magnitude() < 1e-9 {
                    return x;
                }
            }
        },
        &|mut x| {
            loop {
                x = x.times(2.0);
                if x.magnitude() > 1e9 {
                    return x;
                }
            }
        },
        &|mut x| {
            while !x.is_zero() {
                x -= Traced::from_f64(1.0);
            }
            x
        },
        &|mut x| {
            let mut last = x.times(0.5);
            while x != last {
                (last, x) = (x, x.sqrt());
            }
            x
        },
        &|mut x| {
            loop {
                x = x.times(0.5);
                if x.magnitude() < 1.0 && x.magnitude() > 0.25 {
                    return x;
                }
            }
        },
    ];
    for formula in loops {
        assert!(matches!(refused(formula), TraceError::Branch { .. }));
    }
}

#[test]
fn the_place_of_a_branch_is_told() {
    let error = refused(|x| if x.magnitude() > 1.0 { x } else { -x });
    assert!(error.at().file().ends_with("traps.rs"));
    assert!(error.to_string().contains("traps.rs"), "{error}");
}

#[test]
fn guards_in_group_code_are_domains_that_are_looked_at_when_it_runs() {
    let turn = |x: Traced| SO3::exp(&Tangent([x, Traced::zero(), Traced::zero()]));
    let plane = |x: Traced| SO2::exp(&Tangent([x]));
    let formulas: [&dyn Fn(Traced) -> Traced; 4] = [
        &|x| turn(x).cayley_inverse().map_or(x, |xi| xi[0]),
        &|x| turn(x).log().map_or(x, |xi| xi[0]),
        &|x| plane(x).cayley_inverse().map_or(x, |xi| xi[0]),
        &|x| plane(x).log().map_or(x, |xi| xi[0]),
    ];
    for formula in formulas {
        let mut graph = record(1, |x| vec![formula(x[0])]).unwrap();
        let (value, inputs) = (graph.outputs()[0], graph.inputs());
        let slope = graph.gradient(value, &inputs)[0];
        let at = |x: f64| values(&graph, &[value, slope], &[x]);
        assert!(at(1.0).iter().all(|y| y.is_finite()));
        assert!(at(core::f64::consts::PI)[0].is_nan());
    }
}

#[test]
fn a_question_whether_numbers_are_finite_is_refused() {
    let finite = branch(|x| if Vec3([x, x, x]).is_finite() { x } else { -x });
    assert_eq!(finite, "magnitude");
}

#[test]
fn branches_on_constants_are_none() {
    let graph = record(1, |x| {
        let three = Traced::from_f64(1.0) + Traced::from_f64(2.0);
        let chosen = Traced::select(three.less(Traced::from_f64(4.0)), x[0], -x[0]);
        vec![if three == Traced::from_f64(3.0) {
            chosen
        } else {
            three
        }]
    });
    assert_eq!(
        values(&graph.unwrap(), &[Graph::new(1).input(0)], &[5.0]),
        [5.0]
    );
}

#[test]
fn no_value_is_taken_from_a_sample() {
    let formula = |x: &[Traced]| vec![Traced::select(x[0].less(x[1]), x[0].sin(), x[1].exp())];
    let graph = record(2, formula).unwrap();
    for x in [[0.1, 0.2], [0.2, 0.1], [0.0, 0.0], [-1.0, f64::NAN]] {
        let expected = if x[0] < x[1] { x[0].sin() } else { x[1].exp() };
        let value = values(&graph, graph.outputs(), &x)[0];
        assert!(common::same(value, expected));
    }
}

/// Time is an input: a system that starts at zero is not taken to stay there.
#[test]
fn time_is_not_folded() {
    fn shaken<S: Scalar>(t: S, x: S) -> S {
        x * x - x * t.sin()
    }
    let graph = record(2, |x| vec![shaken(x[0], x[1])]).unwrap();
    assert_eq!(
        graph.pattern(graph.outputs(), &graph.inputs()).row(0),
        [0, 1]
    );
    for t in [0.0, 0.7] {
        assert_eq!(values(&graph, graph.outputs(), &[t, 2.0]), [shaken(t, 2.0)]);
    }
}

#[test]
fn the_branch_not_taken_does_not_spoil_a_gradient() {
    /// The square root beside its tangent: at x <= 0 the root has no slope.
    fn root<S: Scalar>(x: S) -> S {
        let far = Scalar::ln(x).sqrt() + S::one() / x;
        S::select(S::one().less(x), far * far, x * S::from_f64(3.0))
    }
    let mut graph = record(1, |x| vec![root(x[0])]).unwrap();
    let slope = graph.gradient(graph.outputs()[0], &graph.inputs());
    let second = graph.gradient(slope[0], &graph.inputs());
    for x in [0.0, -1.0, 1.0] {
        assert_eq!(values(&graph, &[slope[0], second[0]], &[x]), [3.0, 0.0]);
    }
    let dual = root(<f64 as Scalar>::Jet::variable(2.0, 0)).partial(0);
    assert!((values(&graph, &slope, &[2.0])[0] - dual).abs() < 1e-15 * dual.abs() * 8.0);
}

/// One number in the branches of two choices, none of them taken, and in a nested one.
#[test]
fn branches_that_share_a_number_do_not_spoil_a_gradient() {
    let mut graph = record(2, |x| {
        let (x, y) = (x[0], x[1]);
        let root = x.sqrt();
        let [one, two] = [1.0, 2.0].map(Traced::from_f64);
        let inner = Traced::select(two.less(y), root * y, x);
        vec![
            Traced::select(one.less(y), root, y)
                + Traced::select(y.less(-one), root * root, y)
                + Traced::select(one.less(x), inner, x),
        ]
    })
    .unwrap();
    let slopes = graph.gradient(graph.outputs()[0], &graph.inputs());
    for (at, expected) in [
        ([0.0, 0.0], [1.0, 2.0]),
        ([4.0, 0.0], [1.0, 2.0]),
        ([4.0, -2.0], [2.0, 1.0]),
        ([4.0, 1.5], [1.25, 1.0]),
        ([4.0, 3.0], [0.25 + 0.75, 1.0 + 2.0]),
    ] {
        assert_eq!(values(&graph, &slopes, &at), expected, "{at:?}");
    }
}

/// The rotation's exponential chooses between a series and a quotient: at rest the quotient is 0/0.
#[test]
fn the_exponential_is_differentiated_at_rest() {
    fn height<S: Scalar>(w: [S; 3]) -> S {
        SO3::exp(&Tangent(w)).rotate(Vec3([1.0, 0.0, 0.0]).lift())[2]
    }
    let mut graph = record(3, |x| vec![height([x[0], x[1], x[2]])]).unwrap();
    let slopes = graph.gradient(graph.outputs()[0], &graph.inputs());
    assert_eq!(values(&graph, &slopes, &[0.0; 3]), [0.0, -1.0, 0.0]);
    let w = [1.2, -0.4, 0.8];
    let dual = height(std::array::from_fn(|k| {
        <f64 as Scalar>::Jet::variable(w[k], k)
    }));
    for (k, slope) in values(&graph, &slopes, &w).into_iter().enumerate() {
        // A dozen operations on numbers of size one.
        assert!((slope - dual.partial(k)).abs() < 1e-14);
    }
}

#[test]
fn a_number_kept_from_a_recording_is_refused() {
    let mut kept = None;
    record(1, |x| {
        kept = Some(x[0]);
        vec![x[0]]
    })
    .unwrap();
    let kept = kept.unwrap();
    let foreign =
        |result: Result<Graph, TraceError>| matches!(result, Err(TraceError::Foreign { .. }));
    assert!(foreign(record(1, |x| vec![x[0] + kept])));
    assert!(foreign(record(1, |_| vec![kept])));
    assert!(foreign(record(1, |_| vec![kept * Traced::from_f64(2.0)])));
    assert!(foreign(record(1, |x| vec![if kept == x[0] {
        x[0]
    } else {
        -x[0]
    }])));
    assert!(foreign(record(1, |x| vec![Traced::select(
        kept.less(kept),
        x[0],
        -x[0]
    )])));
    // Outside a recording there is nothing to spoil; the number stays refused.
    let product = kept * kept;
    assert!(foreign(record(1, |_| vec![product])));
    // The next recording is none the worse.
    assert!(record(1, |x| vec![x[0]]).is_ok());
}

#[test]
fn a_number_of_another_thread_is_refused() {
    let result = record(1, |x| {
        let x = x[0];
        let other = std::thread::spawn(move || record(1, |y| vec![y[0] * x]));
        assert!(matches!(other.join(), Ok(Err(TraceError::Foreign { .. }))));
        vec![x]
    });
    assert!(result.is_ok());
}

#[test]
fn a_recording_inside_another_keeps_to_itself() {
    let outer = record(1, |x| {
        let inner = record(1, |y| vec![y[0] * y[0]]);
        assert_eq!(inner.map(|graph| graph.len()), Ok(2));
        assert!(record(1, |y| vec![y[0] * x[0]]).is_err());
        vec![-x[0]]
    });
    assert_eq!(outer.map(|graph| graph.len()), Ok(2));
}

#[test]
fn a_panic_in_a_formula_ends_its_recording() {
    let mut kept = None;
    let panicked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        record(1, |x| {
            kept = Some(x[0]);
            std::panic::resume_unwind(Box::new("a fault of the formula"))
        })
    }));
    assert!(panicked.is_err());
    let kept = kept.unwrap();
    assert!(matches!(
        record(1, |_| vec![kept]),
        Err(TraceError::Foreign { .. })
    ));
}

#[test]
fn smooth_functions_are_refused_but_at_constants() {
    let sine = |x: f64, k: u32| [(x + f64::from(k) * std::f64::consts::FRAC_PI_2).sin()];
    assert!(matches!(
        refused(|x| x.smooth(&sine)[0]),
        TraceError::Smooth { .. }
    ));
    let graph = record(0, |_| Traced::from_f64(0.5).smooth(&sine).to_vec()).unwrap();
    assert_eq!(values::<f64>(&graph, graph.outputs(), &[]), [0.5_f64.sin()]);
}

/// A factor of zero is no zero where the other is not finite: the caller is to see it.
#[test]
fn zero_times_a_number_is_not_folded() {
    let mut graph = record(1, |x| vec![Traced::zero() * Scalar::ln(x[0])]).unwrap();
    assert!(values::<f64>(&graph, graph.outputs(), &[-1.0])[0].is_nan());
    // By it nothing changes, as far as derivatives tell.
    let root = graph.outputs()[0];
    let slope = graph.gradient(root, &graph.inputs());
    assert_eq!(graph.as_constant(slope[0]), Some(0.0));
    assert_eq!(graph.pattern(&[root], &graph.inputs()).entries(), 0);
}

/// As over dual numbers, where real parts have no derivative.
#[test]
fn real_parts_are_constants_under_differentiation() {
    fn formula<S: Scalar>(x: S) -> S {
        x * S::from_real(x.real())
    }
    let mut graph = record(1, |x| vec![formula(x[0])]).unwrap();
    let slope = graph.gradient(graph.outputs()[0], &graph.inputs());
    let dual = formula(<f64 as Scalar>::Jet::variable(3.0, 0)).partial(0);
    assert_eq!(values(&graph, &slope, &[3.0]), [dual]);
    assert_eq!(dual, 3.0);
}
