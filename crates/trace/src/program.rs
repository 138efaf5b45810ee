//! Programs: what a graph computes, as instructions in a row.

use lie::Scalar;

use crate::error::WrongLength;
use crate::graph::Graph;
use crate::instruction::Op;
use crate::lower::{Lowered, lower};
use crate::node::Id;
use crate::schedule::schedule;
use crate::slots::Slots;

/// Some numbers of a graph, ready to be computed over any [`Scalar`].
///
/// It has the instructions that they need, each once, in a memory of as many slots as numbers are alive at a time. Over doubles it gives
/// what the formula gives, to the bit; products with a constant go through [`Scalar::times`].
///
/// ```
/// use lie::{Jet, Scalar};
/// use trace::Program;
///
/// let graph = trace::record(1, |x| vec![x[0].sqrt() * x[0]])?;
/// let program = Program::new(&graph, graph.outputs());
/// // Over dual numbers: the value with its derivative.
/// let x = <f64 as Scalar>::Jet::variable(4.0, 0);
/// let (mut memory, mut out) = (program.memory(), [x]);
/// program.run(&mut memory, &[x], &mut out)?;
/// assert_eq!((out[0].value(), out[0].partial(0)), (8.0, 3.0));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Runs of one operation: how many instructions each has.
    runs: Vec<(Op, usize)>,
    /// The places that instructions name, one after the other; as many for each as its operation says.
    places: Vec<u32>,
    instructions: usize,
    factors: Vec<f64>,
    /// Slots that hold constants at first.
    constants: Vec<(u32, f64)>,
    outputs: usize,
    inputs: usize,
    slots: usize,
}

impl Program {
    /// The program that computes these nodes.
    ///
    /// # Panics
    /// Where one is not of this graph.
    pub fn new(graph: &Graph, outputs: &[Id]) -> Self {
        Self::in_order(graph, outputs, outputs)
    }

    /// The same, where what each of `first` needs is computed one after the other.
    ///
    /// The order makes no difference but in time: a long program is faster where neighbours use the same numbers, which are near then.
    ///
    /// # Panics
    /// Where a node is not of this graph.
    pub fn in_order(graph: &Graph, outputs: &[Id], first: &[Id]) -> Self {
        let Lowered {
            instructions,
            factors,
            constants,
            ..
        } = lower(graph, outputs, first);
        let instructions = schedule(&instructions);
        let mut slots = Slots::new(&instructions);
        // The factor of `Op::Times` needs no slot.
        let read = constants.into_iter().filter(|id| slots.is_read(id.0));
        let read: Vec<Id> = read.collect();
        let constants = read
            .into_iter()
            .filter_map(|id| Some((slots.place(id.0), graph.as_constant(id)?)))
            .collect();
        let (mut runs, mut places) = (Vec::<(Op, usize)>::new(), Vec::new());
        for instruction in &instructions {
            let placed = slots.assign(*instruction);
            match runs.last_mut() {
                Some((op, count)) if *op == placed.op => *count += 1,
                _ => runs.push((placed.op, 1)),
            }
            places.extend(placed.places());
        }
        Self {
            runs,
            places,
            instructions: instructions.iter().filter(|i| i.computes()).count(),
            factors,
            constants,
            outputs: outputs.len(),
            inputs: graph.inputs().len(),
            slots: slots.count(),
        }
    }

    /// How many numbers it takes: all inputs of the graph, those not needed included.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// How many numbers it gives.
    pub fn outputs(&self) -> usize {
        self.outputs
    }

    /// How many instructions it has.
    pub fn instructions(&self) -> usize {
        self.instructions
    }

    /// How many numbers its memory holds.
    pub fn slots(&self) -> usize {
        self.slots
    }

    /// A memory for [`run`](Self::run); what is in it between runs does not matter.
    pub fn memory<S: Scalar>(&self) -> Vec<S> {
        vec![S::zero(); self.slots]
    }

    /// Computes the outputs at these inputs. It allocates nothing.
    ///
    /// Outside the domain of a function the result is not finite, as with any formula.
    ///
    /// # Errors
    /// [`WrongLength`] where a slice is not as long as [`slots`](Self::slots), [`inputs`](Self::inputs) and [`outputs`](Self::outputs) tell;
    /// then nothing is computed.
    #[inline(never)]
    pub fn run<S: Scalar>(
        &self,
        memory: &mut [S],
        inputs: &[S],
        outputs: &mut [S],
    ) -> Result<(), WrongLength> {
        expect("slots of memory", self.slots, memory.len())?;
        expect("inputs", self.inputs, inputs.len())?;
        expect("outputs", self.outputs, outputs.len())?;
        S::compiled(
            #[inline(always)]
            || {
                for (slot, c) in &self.constants {
                    memory[*slot as usize] = S::from_f64(*c);
                }
                self.compute(memory, inputs, outputs);
            },
        );
        Ok(())
    }

    #[inline(always)]
    fn compute<S: Scalar>(&self, memory: &mut [S], inputs: &[S], outputs: &mut [S]) {
        let mut rest = &self.places[..];
        for (op, count) in &self.runs {
            let done = match op {
                Op::Load => {
                    for [to, k] in rest.as_chunks().0.iter().take(*count) {
                        memory[*to as usize] = inputs[*k as usize];
                    }
                    2 * count
                }
                Op::Store => {
                    for [k, x] in rest.as_chunks().0.iter().take(*count) {
                        outputs[*k as usize] = memory[*x as usize];
                    }
                    2 * count
                }
                Op::Add => each(rest, *count, memory, |[x, y]| x + y),
                Op::Sub => each(rest, *count, memory, |[x, y]| x - y),
                Op::Mul => each(rest, *count, memory, |[x, y]| x * y),
                Op::Div => each(rest, *count, memory, |[x, y]| x / y),
                Op::Neg => each(rest, *count, memory, |[x]| -x),
                Op::MulAdd => each(rest, *count, memory, |[x, a, b]| x.mul_add(a, b)),
                Op::NegMulAdd => each(rest, *count, memory, |[x, a, b]| x.neg_mul_add(a, b)),
                Op::Select => each(rest, *count, memory, |[l, r, yes, no]| {
                    S::select(l.less(r), yes, no)
                }),
                Op::Times => {
                    for [to, x, factor] in rest.as_chunks().0.iter().take(*count) {
                        memory[*to as usize] =
                            memory[*x as usize].times(self.factors[*factor as usize]);
                    }
                    3 * count
                }
                Op::SinCos => {
                    for [to, x, cosine] in rest.as_chunks().0.iter().take(*count) {
                        let (sin, cos) = memory[*x as usize].sin_cos();
                        memory[*to as usize] = sin;
                        memory[*cosine as usize] = cos;
                    }
                    3 * count
                }
                Op::Unary(op) => each(rest, *count, memory, |[x]| op.apply(x)),
                Op::Binary(op) => each(rest, *count, memory, |[x, y]| op.apply(x, y)),
            };
            rest = &rest[done..];
        }
    }
}

/// Runs one operation `count` times; how many places it has named.
#[inline(always)]
fn each<S: Scalar, const N: usize>(
    places: &[u32],
    count: usize,
    memory: &mut [S],
    op: impl Fn([S; N]) -> S,
) -> usize {
    for named in places.chunks_exact(1 + N).take(count) {
        let args = core::array::from_fn(|k| memory[named[1 + k] as usize]);
        memory[named[0] as usize] = op(args);
    }
    (1 + N) * count
}

#[inline(always)]
fn expect(what: &'static str, expected: usize, found: usize) -> Result<(), WrongLength> {
    if expected == found {
        return Ok(());
    }
    Err(WrongLength {
        what,
        expected,
        found,
    })
}
