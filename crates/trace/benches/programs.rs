//! What programs of two Lagrangians cost: instructions, slots, and time for each instruction.

use std::hint::black_box;
use std::time::Instant;

use lie::lanes::{self, InstructionSet, Job};
use lie::{Batch, SO3, Scalar, Vec3};
use trace::{Graph, Program, Traced};

/// A heavy top, by its matrix, row by row, and its velocity.
fn top<S: Scalar>(x: &[S]) -> Vec<S> {
    let (r, [a, b, c]) = (rotation(x), [x[9], x[10], x[11]]);
    let half = S::from_f64(0.5);
    let kinetic = (a * a + b * b + c * c * half) * half;
    vec![kinetic - r.rotate(Vec3([0.0, 0.0, 1.0]).lift())[2]]
}

/// Three ellipsoids on two ball joints, by matrices, angular velocities and the first one's velocity.
fn fish<S: Scalar>(x: &[S]) -> Vec<S> {
    let (masses, inertias) = ([1.2, 1.9, 2.1], [0.1, 0.4, 0.3]);
    let mut v = Vec3([x[36], x[37], x[38]]);
    let mut twice = S::zero();
    for i in 0..3 {
        let (r, w) = (
            rotation(&x[9 * i..]),
            Vec3([x[27 + 3 * i], x[28 + 3 * i], x[29 + 3 * i]]),
        );
        let joint = |at: f64| r.rotate(w.cross(Vec3([at, 0.0, 0.0]).lift()));
        let centre = if i == 0 { v } else { v + joint(-0.4) };
        let u = r.inverse_rotate(centre);
        twice += Vec3([
            u[0].times(masses[0]),
            u[1].times(masses[1]),
            u[2].times(masses[2]),
        ])
        .dot(u);
        twice += Vec3([
            w[0].times(inertias[0]),
            w[1].times(inertias[1]),
            w[2].times(inertias[2]),
        ])
        .dot(w);
        v = centre + joint(0.4);
    }
    vec![twice.times(0.5)]
}

fn rotation<S: Scalar>(x: &[S]) -> SO3<S> {
    let row = |i: usize| [x[3 * i], x[3 * i + 1], x[3 * i + 2]];
    SO3::from_matrix_unchecked(lie::Mat3([row(0), row(1), row(2)]))
}

/// Nanoseconds of a run.
struct Time<'a>(&'a Program);

impl Job for Time<'_> {
    type Output = f64;

    fn run<S: Batch<Item = f64>>(self) -> f64 {
        const RUNS: u32 = 20_000;
        let program = self.0;
        let inputs = vec![S::from_f64(0.3); program.inputs()];
        let (mut memory, mut out) = (program.memory(), vec![S::zero(); program.outputs()]);
        let mut best = f64::INFINITY;
        for _ in 0..5 {
            let start = Instant::now();
            for _ in 0..RUNS {
                let done = S::run(
                    #[inline(always)]
                    || program.run(&mut memory, black_box(&inputs), &mut out),
                );
                done.expect("the slices are as long as the program tells");
                black_box(&out);
            }
            best = best.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(RUNS));
        }
        best
    }
}

fn report(name: &str, program: &Program) {
    let count = program.instructions();
    print!("{name:16}{count:6} instructions{:6} slots", program.slots());
    for set in InstructionSet::available() {
        let time = lanes::run(set, Time(program));
        print!(
            "{:>12} {:7.1} ns {:5.2} each",
            set.to_string(),
            time,
            time / count as f64
        );
    }
    println!();
}

fn main() {
    type Formula = fn(&[Traced]) -> Vec<Traced>;
    for (name, inputs, formula) in [("top", 12, top as Formula), ("fish", 39, fish as Formula)] {
        let start = Instant::now();
        let mut graph: Graph = trace::record(inputs, formula).expect("it looks at no value");
        let value = Program::new(&graph, graph.outputs());
        let slopes = graph.gradient(graph.outputs()[0], &graph.inputs());
        let gradient = Program::new(&graph, &slopes);
        let traced = start.elapsed().as_secs_f64() * 1e3;
        report(&format!("{name}: value"), &value);
        report(&format!("{name}: gradient"), &gradient);
        println!(
            "{name}: recorded, differentiated and compiled in {traced:.2} ms, {} nodes",
            graph.len()
        );
    }
}
