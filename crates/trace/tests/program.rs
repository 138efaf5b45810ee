//! A program gives what the formula gives.

mod common;

use common::*;
use lie::lanes::{self, InstructionSet, Job};
use lie::{Batch, Jet, Scalar};
use proptest::prelude::*;
use trace::{Binary, Graph, Program, Unary, WrongLength};

type Dual = <f64 as Scalar>::Jet;

/// The numbers of a formula at several points side by side: by the formula and by its program.
struct Compared<'a> {
    steps: &'a [Step],
    points: &'a [[f64; INPUTS]; 8],
}

impl Job for Compared<'_> {
    type Output = Vec<(f64, f64)>;

    fn run<S: Batch<Item = f64>>(self) -> Self::Output {
        let inputs: [S; INPUTS] = std::array::from_fn(|k| {
            let mut batch = [S::zero()];
            let items = S::items_mut(&mut batch).iter_mut().enumerate();
            items.for_each(|(lane, x)| *x = self.points[lane][k]);
            batch[0]
        });
        let direct = numbers(self.steps, &inputs);
        let graph = graph_of(self.steps);
        let run = values(&graph, graph.outputs(), &inputs);
        let pairs = S::items(&direct).iter().zip(S::items(&run));
        pairs.map(|(x, y)| (*x, *y)).collect()
    }
}

proptest! {
    #[test]
    fn over_doubles_it_is_the_formula_to_the_bit(steps in steps(ALL, 1..60), x in points()) {
        let graph = graph_of(&steps);
        let run = values(&graph, graph.outputs(), &x);
        for (direct, run) in numbers(&steps, &x).into_iter().zip(run) {
            prop_assert!(same(direct, run), "{direct} {run}");
        }
    }

    /// Lane by lane as the formula over the same lanes; these fuse products with sums, and so differ from doubles by rounding.
    #[test]
    fn over_lanes_it_is_the_formula_to_the_bit(steps in steps(ALL, 1..60), points in prop::array::uniform8(points())) {
        for set in InstructionSet::available() {
            let compared = Compared { steps: &steps, points: &points };
            for (direct, run) in lanes::run(set, compared) {
                prop_assert!(same(direct, run), "{set}: {direct} {run}");
            }
        }
    }

    /// Without fused products lanes are doubles side by side.
    #[test]
    fn lanes_without_fused_products_are_doubles_to_the_bit(steps in steps(ALL, 1..60), points in prop::array::uniform8(points())) {
        let unfused: Vec<Step> = steps.into_iter().filter(|s| !matches!(s.op, 9 | 10)).collect();
        let numbers = numbers(&unfused, &points[0]);
        for set in InstructionSet::available() {
            let pairs = lanes::run(set, Compared { steps: &unfused, points: &points });
            let lanes = pairs.len() / numbers.len();
            for (double, (_, lane)) in numbers.iter().zip(pairs.into_iter().step_by(lanes)) {
                prop_assert!(same(*double, lane), "{set}: {double} {lane}");
            }
        }
    }

    /// A product with a constant leaves out what a dual number adds to it: zero times the other value.
    #[test]
    fn over_dual_numbers_it_is_the_formula(steps in steps(CHOOSING, 1..40), x in points()) {
        let inputs: [Dual; INPUTS] = std::array::from_fn(|k| Dual::variable(x[k], k));
        let graph = graph_of(&steps);
        let run = values(&graph, graph.outputs(), &inputs);
        for (direct, run) in numbers(&steps, &inputs).into_iter().zip(run) {
            prop_assert_eq!(direct, run);
        }
    }

    #[test]
    fn single_numbers_are_as_all_together(steps in steps(ALL, 1..40), x in points()) {
        let graph = graph_of(&steps);
        let all = values(&graph, graph.outputs(), &x);
        for (id, expected) in graph.outputs().iter().zip(all) {
            prop_assert!(same(values(&graph, &[*id], &x)[0], expected));
        }
    }
}

/// Register allocation is tried where it has much to do: memory is used again, and none of it too early.
#[test]
fn long_programs_share_slots() {
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (seed >> 48) as u16
    };
    let mut steps = Vec::new();
    for i in 0..42_000_u32 {
        // Near ones, and now and then one from long ago.
        let recent = |r: u16| (i + 4).saturating_sub(u32::from(r % 64) + 1);
        let from = std::array::from_fn(|k| {
            if k == 3 {
                random()
            } else {
                recent(random()) as u16
            }
        });
        let op = (random() % 13) as u8;
        steps.push(Step {
            op,
            from,
            constant: 0.7,
        });
    }
    let x = [0.3, -0.4, 1.2, 0.9];
    let graph = trace::record(INPUTS, |x| vec![last(&steps, x)]).unwrap();
    let program = Program::new(&graph, graph.outputs());
    let all = graph_of(&steps);
    let kept = Program::new(&all, all.outputs());
    assert!(kept.instructions() > 100_000, "{}", kept.instructions());
    assert!(
        program.slots() * 4 < program.instructions(),
        "{} {}",
        program.slots(),
        program.instructions()
    );
    assert!(same(
        values(&graph, graph.outputs(), &x)[0],
        last(&steps, &x)
    ));
    let direct = numbers(&steps, &x);
    assert!(
        direct
            .into_iter()
            .zip(values(&all, all.outputs(), &x))
            .all(|(x, y)| same(x, y))
    );
}

#[test]
fn dead_code_is_left_out() {
    let graph = trace::record(2, |x| {
        let _ = x[0].exp() * x[1];
        vec![x[0] * x[0]]
    });
    let graph = graph.unwrap();
    let program = Program::new(&graph, graph.outputs());
    assert_eq!((program.instructions(), program.slots()), (1, 1));
}

#[test]
fn sine_and_cosine_of_an_angle_are_one_instruction() {
    let graph = trace::record(1, |x| vec![Scalar::cos(x[0]), Scalar::sin(x[0])]).unwrap();
    let program = Program::new(&graph, graph.outputs());
    assert_eq!(program.instructions(), 1);
    assert_eq!(
        values(&graph, graph.outputs(), &[0.3]),
        [0.3_f64.cos(), 0.3_f64.sin()]
    );
}

#[test]
fn a_run_allocates_nothing() {
    let steps: Vec<Step> = (0..13)
        .map(|op| Step {
            op,
            from: [u16::from(op), 1, 2, 3],
            constant: 0.3,
        })
        .collect();
    let graph = graph_of(&steps);
    let program = Program::new(&graph, graph.outputs());
    let (mut memory, mut out) = (program.memory::<f64>(), vec![0.0; program.outputs()]);
    let counted = allocation_counter::measure(|| {
        program
            .run(&mut memory, &[0.1, 0.2, 0.3, 0.4], &mut out)
            .unwrap();
    });
    assert_eq!(counted.count_total, 0);
}

/// A program is for one size: another is refused, with the memory and the outputs as they were.
#[test]
fn another_size_is_refused() {
    let graph = trace::record(2, |x| vec![x[0] + x[1]]).unwrap();
    let program = Program::new(&graph, graph.outputs());
    let (mut memory, mut out) = (program.memory(), [7.0]);
    let refused = program.run(&mut memory, &[1.0, 2.0, 3.0], &mut out);
    assert_eq!(
        refused,
        Err(WrongLength {
            what: "inputs",
            expected: 2,
            found: 3
        })
    );
    assert!(program.run(&mut memory, &[1.0, 2.0], &mut []).is_err());
    assert!(program.run(&mut [], &[1.0, 2.0], &mut out).is_err());
    assert_eq!(out, [7.0]);
}

/// Outside a domain the caller sees that the result is not finite, also by the derivatives.
#[test]
fn outside_their_domain_functions_are_not_finite() {
    for (op, x) in [(Unary::Ln, -1.0), (Unary::Sqrt, -1.0), (Unary::Ln, 0.0)] {
        let mut graph = Graph::new(1);
        let y = graph.unary(op, graph.input(0));
        assert!(!values::<f64>(&graph, &[y], &[x])[0].is_finite(), "{op:?}");
    }
    let mut graph = Graph::new(1);
    let (one, x) = (graph.constant(1.0), graph.input(0));
    let y = graph.binary(Binary::Div, one, x);
    let slope = graph.gradient(y, &[x]);
    assert!(
        values::<f64>(&graph, &[y, slope[0]], &[0.0])
            .iter()
            .all(|v| !v.is_finite())
    );
}
