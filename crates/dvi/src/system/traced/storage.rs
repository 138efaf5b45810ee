//! What an evaluation writes to.

use std::sync::{Arc, Mutex, PoisonError};

use lie::{DualOver, LieGroup, Over, RealGroup, Scalar, VectorSpace};
use trace::Program;

use super::compile::Programs;

use crate::numerics::elements;
use crate::system::context::Context;

/// Storage of an evaluation, made when first needed.
pub struct TracedWorkspace<G: RealGroup, S: Scalar>(Option<Storage<G, S>>);

impl<G: RealGroup, S: Scalar> Default for TracedWorkspace<G, S> {
    fn default() -> Self {
        Self(None)
    }
}

impl<G: RealGroup, S: Scalar> TracedWorkspace<G, S> {
    /// The velocity and the force, one after the other, for configurations of the shape of `g`; none where nothing is recorded for that shape.
    ///
    /// `find` gives what is recorded for a shape.
    #[inline(always)]
    pub(crate) fn run(
        &mut self,
        find: impl FnOnce() -> Option<Arc<Programs>>,
        at: Context<S>,
        g: &Over<G, S>,
        mu: &DualOver<G, S>,
    ) -> Option<&[S]> {
        self.0.take_if(|known| !known.scratch.same_shape(g));
        let storage = self.0.get_or_insert_with(
            #[cold]
            || Storage::new(find(), g),
        );
        let programs = storage.programs.as_ref()?;
        let of = (&mut storage.numbers, &mut storage.scratch);
        run::<G, S>(&programs.rates, of, at, g, mu)
    }
}

/// Storage for configurations of one shape.
struct Storage<G: RealGroup, S: Scalar> {
    programs: Option<Arc<Programs>>,
    numbers: Numbers<S>,
    scratch: Over<G, S>,
}

impl<G: RealGroup, S: Scalar> Storage<G, S> {
    #[inline(never)]
    fn new(programs: Option<Arc<Programs>>, g: &Over<G, S>) -> Self {
        Self {
            numbers: programs
                .as_ref()
                .map_or_else(Numbers::default, |programs| Numbers::of(&programs.rates)),
            programs,
            scratch: g.clone(),
        }
    }
}

/// What a program reads and writes.
struct Numbers<S> {
    memory: Vec<S>,
    inputs: Vec<S>,
    outputs: Vec<S>,
}

impl<S> Default for Numbers<S> {
    fn default() -> Self {
        Self {
            memory: Vec::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
        }
    }
}

impl<S: Scalar> Numbers<S> {
    fn of(program: &Program) -> Self {
        Self {
            memory: program.memory(),
            inputs: vec![S::zero(); program.inputs()],
            outputs: vec![S::zero(); program.outputs()],
        }
    }
}

/// Storage for a program of the configuration alone, kept from call to call and shared by threads.
pub(super) struct Shared<G: RealGroup>(Mutex<Option<Place<G>>>);

/// Storage for configurations of one shape, without a momentum.
struct Place<G: RealGroup> {
    numbers: Numbers<f64>,
    scratch: G,
    mu: G::Dual,
}

impl<G: RealGroup> core::fmt::Debug for Shared<G> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Shared").finish_non_exhaustive()
    }
}

impl<G: RealGroup> Default for Shared<G> {
    fn default() -> Self {
        Self(Mutex::new(None))
    }
}

/// Each has its own.
impl<G: RealGroup> Clone for Shared<G> {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl<G: RealGroup> Shared<G> {
    /// The program's result; none where it was recorded for another shape.
    pub(super) fn run(&self, program: &Program, at: Context<f64>, g: &G) -> Option<f64> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.take_if(|known| !known.scratch.same_shape(g));
        let Place {
            numbers,
            scratch,
            mu,
        } = kept.get_or_insert_with(|| Place {
            numbers: Numbers::of(program),
            scratch: g.clone(),
            mu: g.zero_dual(),
        });
        run::<G, f64>(program, (numbers, scratch), at, g, mu).map(|out| out[0])
    }
}

/// What a program gives for one state; none where it was recorded for another shape.
pub(super) fn once<G: RealGroup>(
    program: &Program,
    at: Context<f64>,
    g: &G,
    mu: &G::Dual,
) -> Option<Vec<f64>> {
    let (mut numbers, mut scratch) = (Numbers::of(program), g.clone());
    let out = run::<G, f64>(program, (&mut numbers, &mut scratch), at, g, mu);
    out.map(<[f64]>::to_vec)
}

/// The outputs of the program; none where it was recorded for another shape.
#[inline(always)]
fn run<'a, G: RealGroup, S: Scalar>(
    program: &Program,
    (numbers, scratch): (&'a mut Numbers<S>, &mut Over<G, S>),
    at: Context<S>,
    g: &Over<G, S>,
    mu: &DualOver<G, S>,
) -> Option<&'a [S]> {
    let before = numbers.inputs.len().checked_sub(mu.dim())?;
    let (head, momentum) = numbers.inputs.split_at_mut(before);
    let (context, of_g) = head.split_at_mut_checked(1 + at.all.len())?;
    context[0] = at.t;
    context[1..].copy_from_slice(at.all);
    mu.write(momentum);
    if !elements::write::<G, S>(g, scratch, of_g) {
        return None;
    }
    let Numbers {
        memory,
        inputs,
        outputs,
    } = numbers;
    program.run(memory, inputs, outputs).ok()?;
    Some(outputs)
}
