//! A geometrically exact beam (Simo–Reissner) of rigid nodes on SE(3), by its Lagrangian alone, and what its steps cost.
//!
//! `cargo run --release --example beam`
//!
//! The strain between neighbours is $\epsilon = \mathrm{cay}^{-1}(g_i^{-1} g_{i+1}) / \ell - e$: torsion and bending, extension and shear.
//! Only the value of $L$ is written. The integrators record it once and differentiate what was recorded.

use std::time::Instant;

use lgvi::dvi::{
    Context, DualSystem, Gauss, Integrator, Lagrangian, Means, Quadrature, State, StepError,
    System, TracedSystem, Variational,
};
use lgvi::lie::{Cayley, LieGroup, Power, SE3, Scalar, Tangent};

/// A beam of rubber, 2 cm thick, cut into pieces of 10 cm.
#[derive(Clone, Copy)]
struct Beam;

/// m.
const PIECE: f64 = 0.1;
/// kg.
const MASS: f64 = 0.044;
/// kg m², about the axes of a node; the first is along the beam.
const INERTIA: [f64; 3] = [2.9e-6, 3.8e-5, 3.8e-5];
/// Against torsion and bending, N m²; against extension and shear, N.
const STIFFNESS: [f64; 6] = [8.9e-3, 1.3e-2, 1.3e-2, 400.0, 133.0, 133.0];

impl System for Beam {
    type Group = Power<SE3>;
}

impl Lagrangian for Beam {
    fn value<S: Scalar>(&self, _: Context<S>, g: &Power<SE3<S>>, xi: &Power<Tangent<6, S>>) -> S {
        let square = |x: S| x * x;
        let kinetic = xi.iter().fold(S::zero(), |sum, xi| {
            let inertia = |k: usize| if k < 3 { INERTIA[k] } else { MASS };
            (0..6).fold(sum, |sum, k| sum + square(xi[k]).times(inertia(k)))
        });
        let elastic = g.windows(2).fold(S::zero(), |sum, pair| {
            // The difference first: far from the origin a product of the two would lose digits.
            let (turn, along) = (&pair[0].rotation, pair[1].translation - pair[0].translation);
            let apart = SE3::new(
                turn.inverse().compose(&pair[1].rotation),
                turn.inverse_rotate(along),
            );
            // Outside the chart, a bend by half a turn, there is no energy.
            let strain = apart.retract_inverse::<Cayley>();
            let strain = strain.map_or(Tangent([S::from_f64(f64::NAN); 6]), |c| {
                c * S::from_f64(1.0 / PIECE)
            });
            (0..6).fold(sum, |sum, k| {
                let straight = if k == 3 { S::one() } else { S::zero() };
                sum + square(strain[k] - straight).times(STIFFNESS[k] * PIECE)
            })
        });
        (kinetic - elastic).times(0.5)
    }
}

/// Bent by one radian along its length, and turning.
fn start(nodes: usize) -> State<Power<SE3>> {
    let step = SE3::cayley(&Tangent([0.0, 0.0, 1.0 / nodes as f64, PIECE, 0.0, 0.0]));
    let mut g = vec![SE3::identity()];
    for i in 1..nodes {
        g.push(g[i - 1].compose(&step));
    }
    let g = Power::new(g);
    let mut xi = g.zero_algebra();
    for (i, xi) in xi.iter_mut().enumerate() {
        xi[4] = 0.2 * (0.3 * i as f64).cos();
    }
    Beam.state(0.0, g, &xi).expect("one velocity a node")
}

/// Seconds of the first step, and of a later one; and how often the system is evaluated in that.
struct Cost {
    first: f64,
    later: f64,
    evaluations: f64,
    means: Means,
}

fn cost<I: Integrator<Group = Power<SE3>>>(
    mut integrator: I,
    nodes: usize,
    (h, steps): (f64, u32),
) -> Result<Cost, StepError> {
    let mut state = start(nodes);
    let clock = Instant::now();
    let means = integrator.step(&mut state, h)?.means;
    let first = clock.elapsed().as_secs_f64();
    // The first steps find their guesses.
    for _ in 0..8 {
        integrator.step(&mut state, h)?;
    }
    let (clock, mut evaluations) = (Instant::now(), 0);
    for _ in 0..steps {
        evaluations += integrator.step(&mut state, h)?.evaluations;
    }
    let later = clock.elapsed().as_secs_f64() / f64::from(steps);
    Ok(Cost {
        first,
        later,
        evaluations: f64::from(evaluations) / f64::from(steps),
        means,
    })
}

fn main() -> Result<(), Box<dyn core::error::Error>> {
    const H: f64 = 5e-4;
    let midpoint = || Beam.discretise(Quadrature::Midpoint);
    println!("a beam of N nodes, steps of {H} s; times in microseconds");
    println!(
        "     N  method     recording  first step  later step  a node  evaluations  derivatives"
    );
    let print = |nodes: usize, method: &str, recording: f64, cost: &Cost| {
        let [recording, first, later] = [recording, cost.first, cost.later].map(|t| t * 1e6);
        let each = later / nodes as f64;
        println!(
            "{nodes:6}  {method:9}  {recording:9.0}  {first:10.0}  {later:10.1}  {each:6.2}  {:11.1}  {}",
            cost.evaluations, cost.means
        );
    };
    for nodes in [5, 20, 80, 320] {
        let clock = Instant::now();
        let system = TracedSystem::new(&Beam, &start(nodes).g)?;
        let recording = clock.elapsed().as_secs_f64();
        let steps = (4000 / nodes) as u32;
        print(
            nodes,
            "gauss-8",
            recording,
            &cost(Gauss::new::<4>(system), nodes, (H, steps))?,
        );
        let gauss = Gauss::new::<4>(Beam.hamiltonian());
        print(nodes, "gauss-8", 0.0, &cost(gauss, nodes, (H, steps))?);
        let variational = Variational::new(midpoint());
        print(
            nodes,
            "midpoint",
            0.0,
            &cost(variational, nodes, (H, steps))?,
        );
    }
    let by_duals = Gauss::new::<4>(DualSystem(Beam));
    print(5, "gauss-8", 0.0, &cost(by_duals, 5, (H, 10))?);
    Ok(())
}
