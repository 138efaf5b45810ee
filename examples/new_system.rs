//! A system of your own, from nothing: the heavy top, its integrator, and the proof that both are right.
//!
//! `cargo run --release --example new_system`

use lgvi::dvi::{
    Context, Integrator, Lagrangian, LeftTranslation, Quadrature, RightTranslation, System,
    Variational, laws,
};
use lgvi::lie::{LieGroup, Mat3, SO3, Scalar, Tangent, Vec3};

/// A symmetric top on a fixed point.
struct HeavyTop {
    /// Inertia about the fixed point in the body's frame, kg m².
    inertia: Mat3,
    /// Weight times the mass centre in the body's frame, N m.
    lever: Vec3,
}

impl System for HeavyTop {
    type Group = SO3;
}

impl Lagrangian for HeavyTop {
    /// Kinetic minus potential energy.
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
        let omega = omega.vec3();
        let kinetic = omega.dot(self.inertia.lift() * omega) * S::from_f64(0.5);
        let height = r.rotate(self.lever.lift())[2];
        kinetic - height
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let inertia = Mat3::diagonal([1.0, 1.0, 0.5]);
    let top = HeavyTop {
        inertia,
        lever: Vec3([0.0, 0.0, 1.0]),
    };
    let leaning = SO3::exp(&Tangent([0.3, 0.0, 0.0]));
    let start = top.state(0.0, leaning, &Tangent([0.0, 0.0, 10.0]))?;

    // The proof: derivatives, symplecticity, reversibility; the value; the symmetries; the order.
    let discrete = (&top).discretise(Quadrature::Midpoint);
    let (states, e3) = ([start.clone()], Tangent([0.0, 0.0, 1.0]));
    laws::check(&discrete, &states, 0.01)?;
    laws::check_consistency(&discrete, &top, &states)?;
    laws::check_symmetry(&discrete, &LeftTranslation(e3), &states, 0.01)?;
    laws::check_symmetry(&discrete, &RightTranslation(e3), &states, 0.01)?;
    let order = laws::check_order(|| Variational::new(&discrete), &start, 1.0, &[50, 100, 200])?;
    println!("observed order {:.3}", order.slope);

    // The simulation: a thousand seconds.
    let (mut state, mut integrator) = (start.clone(), Variational::new(&discrete));
    let (energy, mut worst) = (
        top.energy(0.0, &start.g, &Tangent([0.0, 0.0, 10.0]))?,
        0.0_f64,
    );
    let system = (&top).hamiltonian();
    for step in 1..=100_000 {
        integrator.step(&mut state, 0.01)?;
        if step % 100 == 0 {
            worst = worst.max((system.energy(&state) / energy - 1.0).abs());
        }
    }
    println!(
        "energy within {worst:.1e} of its value for {:.0} s",
        state.t
    );
    println!(
        "spin about the body's axis {:+.1e}",
        state.mu[2] - start.mu[2]
    );
    let vertical = |s: &lgvi::dvi::State<SO3>| s.g.rotate(s.mu.vec3())[2];
    println!(
        "momentum about the vertical {:+.1e}",
        vertical(&state) - vertical(&start)
    );
    Ok(())
}
