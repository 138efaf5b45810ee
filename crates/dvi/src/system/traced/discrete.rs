//! Discrete Lagrangians and their derivatives, recorded once.

use std::sync::Arc;

use lie::{LieGroup, Over, RealGroup, Scalar};
use trace::{Program, Traced, record};

use super::cache::Cache;
use super::compile::{has_logarithm, poison, side_by_side};

use super::error::TracedError;
use super::part::Part;
use super::translation::Translations;
use crate::numerics::elements;
use crate::system::context::Context;
use crate::system::lifted::Arguments;

/// The program of $\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d$ and $\mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d$, by time, parameters,
/// the numbers of $g$ and of $f$, and $h$.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DiscreteProgram(Program);

impl DiscreteProgram {
    /// That of a value with so many parameters, for configurations of the shape of `g`.
    pub(crate) fn of<G: RealGroup>(
        g: &G,
        parameters: usize,
        value: impl FnOnce(Arguments<'_, G, Traced>) -> Traced,
    ) -> Result<Self, TracedError> {
        let (context, numbers) = (1 + parameters, elements::count(g));
        let (end_g, end_f) = (context + numbers, context + 2 * numbers);
        let mut graph = record(end_f + 1, |x| {
            let at = Context::new(x[0], &x[1..context]);
            let element = |n: &[_]| elements::with_numbers(g, n);
            let (g, f) = (element(&x[context..end_g]), element(&x[end_g..end_f]));
            vec![value((at, (&g, &f), x[end_f]))]
        })?;
        let (root, inputs) = (graph.outputs()[0], graph.inputs());
        let (of_g, of_f) = (&inputs[context..end_g], &inputs[end_g..end_f]);
        let slopes = graph.gradient(root, &[of_f, of_g].concat());
        let (by_f, by_g) = slopes.split_at(numbers);
        let translations = Translations::new(g)?;
        let mut out = translations.trivialise(&mut graph, of_f, by_f);
        let mut d_g = translations.trivialise(&mut graph, of_g, by_g);
        if has_logarithm(&graph) {
            poison(&mut graph, root, &mut out);
            poison(&mut graph, root, &mut d_g);
        }
        out.extend(d_g);
        Ok(Self(Program::in_order(&graph, &out, &side_by_side(&out))))
    }
}

/// What discrete Lagrangians by their value alone have in common in one integrator: what is recorded of theirs, or why nothing is.
pub(crate) type DiscreteCache<G> = Cache<G, Part, DiscreteProgram>;

/// A recorded discrete Lagrangian, with storage to run it.
pub(crate) struct DiscreteRecording<G: RealGroup, S: Scalar> {
    cache: DiscreteCache<G>,
    storage: Option<Storage<G, S>>,
}

struct Storage<G: RealGroup, S: Scalar> {
    part: Part,
    program: Result<Arc<DiscreteProgram>, TracedError>,
    memory: Vec<S>,
    inputs: Vec<S>,
    outputs: Vec<S>,
    scratch: Over<G, S>,
}

impl<G: RealGroup, S: Scalar> DiscreteRecording<G, S> {
    pub(crate) fn new(cache: DiscreteCache<G>) -> Self {
        Self {
            cache,
            storage: None,
        }
    }

    /// $d_f$ and $d_g$, one after the other, of a part of the system; `record` gives the program for a shape.
    ///
    /// # Errors
    /// Why the value is not recorded.
    pub(crate) fn run(
        &mut self,
        part: Part,
        record: impl FnOnce(&G) -> Result<DiscreteProgram, TracedError>,
        arguments: Arguments<'_, G, S>,
    ) -> Result<&[S], TracedError> {
        let (_, (g, _), _) = arguments;
        let fits = |known: &Storage<G, S>| known.part == part && known.scratch.same_shape(g);
        self.storage.take_if(|known| !fits(known));
        let cache = &self.cache;
        let storage = self.storage.get_or_insert_with(|| {
            // The shape alone matters.
            let shape = G::convert::<S, f64>(g, |_| 0.0);
            Storage::new(part, cache.find(&shape, part, || record(&shape)), g)
        });
        let program = storage.program.clone()?;
        storage.run(&program, arguments).ok_or(TracedError::Shape)
    }
}

impl<G: RealGroup, S: Scalar> Storage<G, S> {
    /// The results; none where `f` has another shape than `g`.
    fn run(
        &mut self,
        DiscreteProgram(program): &DiscreteProgram,
        (at, (g, f), h): Arguments<'_, G, S>,
    ) -> Option<&[S]> {
        let Self {
            memory,
            inputs,
            outputs,
            scratch,
            ..
        } = self;
        let (context, elements) = inputs.split_at_mut_checked(1 + at.all.len())?;
        let (last, elements) = elements.split_last_mut()?;
        let (of_g, of_f) = elements.split_at_mut(elements.len() / 2);
        context[0] = at.t;
        context[1..].copy_from_slice(at.all);
        *last = h;
        let fit =
            elements::write::<G, S>(g, scratch, of_g) && elements::write::<G, S>(f, scratch, of_f);
        (fit && program.run(memory, inputs, outputs).is_ok()).then_some(&outputs[..])
    }

    fn new(part: Part, program: Result<Arc<DiscreteProgram>, TracedError>, g: &Over<G, S>) -> Self {
        let (memory, inputs, outputs) = match &program {
            Ok(program) => {
                let DiscreteProgram(program) = &**program;
                let zeros = |n: usize| vec![S::zero(); n];
                (
                    program.memory(),
                    zeros(program.inputs()),
                    zeros(program.outputs()),
                )
            }
            Err(_) => Default::default(),
        };
        Self {
            part,
            program,
            memory,
            inputs,
            outputs,
            scratch: g.clone(),
        }
    }
}
