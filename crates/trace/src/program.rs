//! Programs: what a graph computes, as instructions in a row.

use lie::Scalar;

use crate::error::WrongLength;
use crate::graph::Graph;
use crate::instruction::{Instruction, Op};
use crate::lower::{Lowered, lower};
use crate::node::{Id, Node};
use crate::slots::Slots;

/// Some numbers of a graph, ready to be computed over any [`Scalar`].
///
/// It has the instructions that they need, each once, in a memory of as many slots as numbers are alive at a time. Over doubles it gives
/// what the formula gives, to the bit; products with a constant go through [`Scalar::times`].
///
/// Over [lanes](lie::lanes), call [`run`](Self::run) inside [`Batch::run`](lie::Batch::run): it is inlined there.
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
    instructions: Vec<Instruction>,
    factors: Vec<f64>,
    /// Slots that hold constants at first.
    constants: Vec<(u32, f64)>,
    /// Slots that hold inputs at first, with the indices of these.
    loads: Vec<(u32, u32)>,
    outputs: Vec<u32>,
    inputs: usize,
    slots: usize,
}

impl Program {
    /// The program that computes these nodes.
    ///
    /// # Panics
    /// Where one is not of this graph.
    pub fn new(graph: &Graph, outputs: &[Id]) -> Self {
        let Lowered {
            mut instructions,
            factors,
            leaves,
        } = lower(graph, outputs);
        let kept = outputs.iter().map(|id| id.0);
        let mut slots = Slots::new(&instructions, kept);
        let (mut constants, mut loads) = (Vec::new(), Vec::new());
        for id in leaves {
            // The factor of `Op::Times` needs no slot.
            if slots.is_read(id.0) {
                match graph.node(id) {
                    Node::Constant(c) => constants.push((slots.place(id.0), c.number())),
                    Node::Input(k) => loads.push((slots.place(id.0), k)),
                    _ => {}
                }
            }
        }
        for instruction in &mut instructions {
            *instruction = slots.assign(*instruction);
        }
        Self {
            instructions,
            factors,
            constants,
            loads,
            outputs: outputs.iter().map(|id| slots.of(id.0)).collect(),
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
        self.outputs.len()
    }

    /// How many instructions it has.
    pub fn instructions(&self) -> usize {
        self.instructions.len()
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
    #[inline(always)]
    pub fn run<S: Scalar>(
        &self,
        memory: &mut [S],
        inputs: &[S],
        outputs: &mut [S],
    ) -> Result<(), WrongLength> {
        expect("slots of memory", self.slots, memory.len())?;
        expect("inputs", self.inputs, inputs.len())?;
        expect("outputs", self.outputs.len(), outputs.len())?;
        for (slot, c) in &self.constants {
            memory[*slot as usize] = S::from_f64(*c);
        }
        for (slot, k) in &self.loads {
            memory[*slot as usize] = inputs[*k as usize];
        }
        for instruction in &self.instructions {
            self.step(instruction, memory);
        }
        for (out, slot) in outputs.iter_mut().zip(&self.outputs) {
            *out = memory[*slot as usize];
        }
        Ok(())
    }

    #[inline(always)]
    fn step<S: Scalar>(&self, instruction: &Instruction, memory: &mut [S]) {
        let Instruction { op, to, args } = instruction;
        let at = |k: usize| memory[args[k] as usize];
        let value = match op {
            Op::Add => at(0) + at(1),
            Op::Sub => at(0) - at(1),
            Op::Mul => at(0) * at(1),
            Op::Div => at(0) / at(1),
            Op::Neg => -at(0),
            Op::MulAdd => at(0).mul_add(at(1), at(2)),
            Op::NegMulAdd => at(0).neg_mul_add(at(1), at(2)),
            Op::Select => S::select(at(0).less(at(1)), at(2), at(3)),
            Op::Times => at(0).times(self.factors[args[1] as usize]),
            Op::SinCos => {
                let (sin, cos) = at(0).sin_cos();
                memory[args[1] as usize] = cos;
                sin
            }
            Op::Unary(op) => op.apply(at(0)),
            Op::Binary(op) => op.apply(at(0), at(1)),
        };
        memory[*to as usize] = value;
    }
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
