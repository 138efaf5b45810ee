//! The formulas of a chain, recorded once: connection, metric and torques with exact derivatives, as programs over doubles.

use core::cell::RefCell;

use trace::{Graph, Id, Program, Traced};

use crate::error::GaitError;
use crate::tree::Tree;

/// A program with its memory and its results.
pub(crate) struct Evaluator {
    program: Program,
    memory: RefCell<(Vec<f64>, Vec<f64>)>,
}

impl Evaluator {
    pub(crate) fn new(graph: &Graph, outputs: &[Id]) -> Self {
        let program = Program::new(graph, outputs);
        let memory = (program.memory(), vec![0.0; outputs.len()]);
        Self {
            program,
            memory: RefCell::new(memory),
        }
    }

    /// Computes, and hands the results over.
    pub(crate) fn with<T>(
        &self,
        inputs: &[f64],
        look: impl FnOnce(&[f64]) -> T,
    ) -> Result<T, GaitError> {
        let (memory, out) = &mut *self.memory.borrow_mut();
        let wrong = |_| GaitError::Shape {
            expected: self.program.inputs(),
            found: inputs.len(),
        };
        self.program.run(memory, inputs, out).map_err(wrong)?;
        Ok(look(out))
    }
}

/// The programs of a chain of `m` coordinates; each takes the shape $q$, the rates $\dot q$ and the accelerations $\ddot q$.
pub(crate) struct Formulas {
    /// $\xi$.
    pub(crate) velocity: Evaluator,
    /// $\xi$, then for each coordinate $\partial \xi / \partial q_j$ and $\partial \xi / \partial \dot q_j = -A_j$.
    pub(crate) velocity_slopes: Evaluator,
    /// $\sqrt{\dot q^T G \dot q}$, and its slopes by all inputs.
    pub(crate) speed: [Evaluator; 2],
    /// $\sum_j \max(0, \tau_j \cdot \dot q_j)$ over the joints, and its slopes by all inputs.
    pub(crate) power: [Evaluator; 2],
    /// $\tau$.
    pub(crate) torques: Evaluator,
}

impl Formulas {
    /// Records them.
    ///
    /// # Errors
    /// [`GaitError::Trace`]: it does not happen, as no formula here looks at a value.
    pub(crate) fn new(tree: &Tree) -> Result<Self, GaitError> {
        let m = tree.dim();
        let formula = |x: &[Traced]| {
            let (q, v) = (&x[..m], &x[m..2 * m]);
            let posed = tree.at(q);
            let mut out = posed.velocity(v).0.to_vec();
            out.push(posed.twice_energy(v));
            out.extend(posed.momenta(v));
            out
        };
        let mut graph = trace::record(3 * m, formula).map_err(GaitError::Trace)?;
        let (out, x) = (graph.outputs().to_vec(), graph.inputs());
        let (q, v, a) = (&x[..m], &x[m..2 * m], &x[2 * m..]);
        let (xi, twice_energy, momenta) = (&out[..6], out[6], &out[7..]);

        let slopes = [q, v].map(|by| {
            xi.iter()
                .map(|xi| graph.gradient(*xi, by))
                .collect::<Vec<_>>()
        });
        let of_coordinate = |j: usize| {
            slopes
                .iter()
                .flat_map(move |by| by.iter().map(move |row| row[j]))
        };
        let all: Vec<Id> = xi
            .iter()
            .copied()
            .chain((0..m).flat_map(of_coordinate))
            .collect();

        let speed = graph.unary(trace::Unary::Sqrt, twice_energy);
        let torques = torques(&mut graph, (twice_energy, momenta), [q, v, a]);
        let power = positive_power(&mut graph, tree, &torques, v);
        let mut both = |root: Id| {
            let slopes = graph.gradient(root, &x);
            let with: Vec<Id> = core::iter::once(root).chain(slopes).collect();
            [
                Evaluator::new(&graph, &[root]),
                Evaluator::new(&graph, &with),
            ]
        };
        Ok(Self {
            speed: both(speed),
            power: both(power),
            velocity: Evaluator::new(&graph, xi),
            velocity_slopes: Evaluator::new(&graph, &all),
            torques: Evaluator::new(&graph, &torques),
        })
    }
}

/// $\tau_j = \frac{d}{dt} (G \dot q)_j - \frac12 \partial_j (\dot q^T G \dot q)$.
fn torques(
    graph: &mut Graph,
    (twice_energy, momenta): (Id, &[Id]),
    [q, v, a]: [&[Id]; 3],
) -> Vec<Id> {
    let by: Vec<Id> = q.iter().chain(v).copied().collect();
    let rates: Vec<Id> = v.iter().chain(a).copied().collect();
    let of_energy = graph.gradient(twice_energy, q);
    let torque = |(momentum, of_energy): (&Id, Id)| {
        let slopes = graph.gradient(*momentum, &by);
        let half = graph.constant(-0.5);
        let less = graph.binary(trace::Binary::Mul, half, of_energy);
        let each = slopes.into_iter().zip(&rates);
        each.fold(less, |sum, (slope, rate)| {
            graph.mul_add([slope, *rate, sum])
        })
    };
    momenta.iter().zip(of_energy).map(torque).collect()
}

fn positive_power(graph: &mut Graph, tree: &Tree, torques: &[Id], v: &[Id]) -> Id {
    let zero = graph.constant(0.0);
    tree.joints().iter().fold(zero, |sum, joint| {
        let each = joint.coordinates.clone();
        let power = each.fold(zero, |sum, k| graph.mul_add([torques[k], v[k], sum]));
        let positive = graph.select([power, zero], zero, power);
        graph.binary(trace::Binary::Add, sum, positive)
    })
}
