//! The formulas of a chain, recorded once: connection, metric and torques with exact derivatives, as programs over doubles.

use lie::Batch;
use lie::lanes::{self, InstructionSet, Job};
use trace::{Graph, Id, Program, Traced, WrongLength};

use crate::error::GaitError;
use crate::tree::Tree;

/// A program, at many points side by side in SIMD lanes.
pub(crate) struct Evaluator(Program);

impl Evaluator {
    pub(crate) fn new(graph: &Graph, outputs: &[Id]) -> Self {
        Self(Program::new(graph, outputs))
    }

    /// Computes at one point.
    pub(crate) fn at(&self, point: Vec<f64>) -> Result<Vec<f64>, GaitError> {
        let mut found = Vec::new();
        self.at_each(&[point], &mut |_, out| found = out.to_vec())?;
        Ok(found)
    }

    /// Computes at each point, and hands the results over, one after the other.
    pub(crate) fn at_each(
        &self,
        points: &[Vec<f64>],
        look: &mut dyn FnMut(usize, &[f64]),
    ) -> Result<(), GaitError> {
        let Self(program) = self;
        let expected = program.inputs();
        if let Some(point) = points.iter().find(|point| point.len() != expected) {
            let found = point.len();
            return Err(GaitError::Shape { expected, found });
        }
        let at_each = AtEach {
            program,
            points,
            look,
        };
        let done = lanes::run(InstructionSet::widest(points.len()), at_each);
        done.map_err(|_| GaitError::Shape {
            expected,
            found: expected,
        })
    }
}

struct AtEach<'a> {
    program: &'a Program,
    points: &'a [Vec<f64>],
    look: &'a mut dyn FnMut(usize, &[f64]),
}

impl Job for AtEach<'_> {
    type Output = Result<(), WrongLength>;

    fn run<S: Batch<Item = f64>>(self) -> Self::Output {
        let Self {
            program,
            points,
            look,
        } = self;
        let mut memory = program.memory::<S>();
        let mut inputs = vec![S::zero(); program.inputs()];
        let mut outputs = vec![S::zero(); program.outputs()];
        let mut one = vec![0.0; program.outputs()];
        for (n, points) in points.chunks(S::ITEMS).enumerate() {
            let numbers = S::items_mut(&mut inputs);
            // The first again where there are fewer than lanes.
            for lane in 0..S::ITEMS {
                let point = points.get(lane).unwrap_or(&points[0]);
                let own = numbers[lane..].iter_mut().step_by(S::ITEMS);
                own.zip(point).for_each(|(to, x)| *to = *x);
            }
            program.run(&mut memory, &inputs, &mut outputs)?;
            let numbers = S::items(&outputs);
            for lane in 0..points.len() {
                let own = numbers[lane..].iter().step_by(S::ITEMS);
                one.iter_mut().zip(own).for_each(|(to, x)| *to = *x);
                look(n * S::ITEMS + lane, &one);
            }
        }
        Ok(())
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
