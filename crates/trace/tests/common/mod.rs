//! Random formulas, which run over any scalar.
#![allow(dead_code, reason = "each test uses a part")]

use lie::Scalar;
use proptest::prelude::*;
use trace::{Graph, Id, Program};

/// How many inputs a random formula has.
pub const INPUTS: usize = 4;

/// One operation of a random formula, on earlier numbers.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    pub op: u8,
    pub from: [u16; 4],
    pub constant: f64,
}

/// Smooth operations with values and slopes of moderate size.
pub const TAME: std::ops::Range<u8> = 0..12;
/// These, and a choice.
pub const CHOOSING: std::ops::Range<u8> = 0..13;
/// All operations, outside their domains as well.
pub const ALL: std::ops::Range<u8> = 0..25;

pub fn steps(
    ops: std::ops::Range<u8>,
    count: std::ops::Range<usize>,
) -> impl Strategy<Value = Vec<Step>> {
    let constant = prop_oneof![
        4 => -2.0..2.0,
        1 => prop_oneof![Just(0.0), Just(-0.0), Just(1.0), Just(-1.0), Just(0.5)],
    ];
    let step = (ops, any::<[u16; 4]>(), constant).prop_map(|(op, from, constant)| Step {
        op,
        from,
        constant,
    });
    prop::collection::vec(step, count)
}

pub fn points() -> impl Strategy<Value = [f64; INPUTS]> {
    [-2.0..2.0, -2.0..2.0, -2.0..2.0, -2.0..2.0]
}

/// Every number that a random formula makes.
pub fn numbers<S: Scalar>(steps: &[Step], inputs: &[S]) -> Vec<S> {
    let mut all = inputs.to_vec();
    for step in steps {
        let [x, y, z, w] = step.from.map(|i| all[usize::from(i) % all.len()]);
        let c = S::from_f64(step.constant);
        let (one, two) = (S::one(), S::from_f64(2.0));
        let bounded = Scalar::tanh(x);
        all.push(match step.op {
            0 => (x + y) * S::from_f64(0.5),
            1 => x - bounded.times(0.5),
            2 => bounded * Scalar::sin(y),
            3 => x.sin_cos().1,
            4 => x / (two + Scalar::cos(y)),
            5 => (one + x * x).sqrt() - one,
            6 => Scalar::exp(bounded) - one,
            7 => Scalar::ln(two + bounded),
            8 => x.atan2(two + Scalar::sin(y)),
            9 => bounded.mul_add(Scalar::cos(y), -z) * S::from_f64(0.5),
            10 => bounded.neg_mul_add(c, y),
            11 => Scalar::sin(x * c),
            12 => S::select(x.less(y), z, w),
            13 => x + c,
            14 => x * c,
            15 => c - x,
            16 => x * y,
            17 => x / y,
            18 => x % y,
            19 => x.sqrt(),
            20 => Scalar::ln(x),
            21 => Scalar::exp(x),
            22 => x.atan2(y),
            23 => -x,
            _ => S::from_real((x + c).real()),
        });
    }
    all
}

/// The last number.
pub fn last<S: Scalar>(steps: &[Step], inputs: &[S]) -> S {
    *numbers(steps, inputs).last().expect("there are inputs")
}

/// The graph of all numbers.
pub fn graph_of(steps: &[Step]) -> Graph {
    trace::record(INPUTS, |x| numbers(steps, x)).expect("no step looks at a value")
}

/// The values of some nodes.
pub fn values<S: Scalar>(graph: &Graph, out: &[Id], inputs: &[S]) -> Vec<S> {
    let program = Program::new(graph, out);
    let (mut memory, mut values) = (program.memory(), vec![S::zero(); out.len()]);
    program
        .run(&mut memory, inputs, &mut values)
        .expect("the slices are as long as the program tells");
    values
}

/// Equal to the bit, or both no number.
pub fn same(x: f64, y: f64) -> bool {
    x.to_bits() == y.to_bits() || (x.is_nan() && y.is_nan())
}
