//! What steps of the beam cost.

use std::time::Instant;

use lgvi::dvi::{
    DualSystem, Gauss, Integrator, Lagrangian, Means, Quadrature, State, StepError, TracedSystem,
    Variational,
};
use lgvi::lie::{LieGroup, Power, SE3, VectorSpace};

use super::by_hand::ByHand;
use super::flight::{BEAM, start};

/// Seconds of the first step, and of a later one; and how often the system is evaluated in that.
struct Cost {
    first: f64,
    later: f64,
    evaluations: f64,
    means: Means,
    end: State<Power<SE3>>,
}

fn cost<I: Integrator<Group = Power<SE3>>>(
    mut integrator: I,
    (nodes, (h, steps)): (usize, (f64, u32)),
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
        end: state,
    })
}

pub fn print() -> Result<(), Box<dyn core::error::Error>> {
    const H: f64 = 5e-4;
    let midpoint = || BEAM.discretise(Quadrature::Midpoint);
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
        TracedSystem::new(&BEAM, &start(nodes).g)?;
        let recording = clock.elapsed().as_secs_f64();
        let of = (nodes, (H, (4000 / nodes) as u32));
        let by_hand = cost(Gauss::new::<4>(ByHand(BEAM)), of)?;
        let gauss = cost(Gauss::new::<4>(BEAM.hamiltonian()), of)?;
        print(nodes, "gauss-8", 0.0, &by_hand);
        print(nodes, "gauss-8", recording, &gauss);
        print(
            nodes,
            "midpoint",
            0.0,
            &cost(Variational::new(midpoint()), of)?,
        );
        println!(
            "        recorded over by hand {:.2}; after the same steps {:.1e} apart",
            gauss.later / by_hand.later,
            distance(&gauss.end, &by_hand.end)
        );
    }
    let by_duals = Gauss::new::<4>(DualSystem(BEAM));
    print(5, "gauss-8", 0.0, &cost(by_duals, (5, (H, 10)))?);
    Ok(())
}

/// Of the nodes, m and rad.
fn distance(a: &State<Power<SE3>>, b: &State<Power<SE3>>) -> f64 {
    let apart = a.g.inverse().compose(&b.g).cayley_inverse();
    apart.map_or(f64::NAN, |c| c.max_magnitude())
}
