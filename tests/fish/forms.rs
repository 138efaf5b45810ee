//! The same method in its several forms: one step to rounding, 10 s within 1e-9 (the motion is chaotic).

use articulated_fluid::Configuration;
use dvi::{State, Variational};
use lgvi::{articulated_fluid, dvi, lie};
use lie::{LieGroup, VectorSpace};

use crate::by_duals::ByDuals;
use crate::common::{attitude_error, paper, run};
use crate::on_se3::OnSe3;

const H: f64 = 1e-3;
/// Steps in 10 s.
const STEPS: u32 = 10_000;
/// A step's own rounding: the tolerance of its equation, 1e-13 of the momentum, divided by the lightest inertia.
const ONE_STEP: f64 = 2e-13;
const TEN_SECONDS: f64 = 1e-9;

fn difference(a: &State<Configuration>, b: &State<Configuration>) -> f64 {
    let position = (a.g.1[0].vec3() - b.g.1[0].vec3()).norm();
    let mut momentum = a.mu.clone();
    momentum.add_scaled(-1.0, &b.mu);
    let scale = a.mu.norm_squared().sqrt();
    attitude_error(a, b)
        .max(position)
        .max(momentum.norm_squared().sqrt() / scale)
}

fn carried(steps: u32) -> State<Configuration> {
    let (model, start) = paper();
    run(Variational::new(model), &start, f64::from(steps) * H, steps)
}

fn compare(name: &str, other: impl Fn(u32) -> State<Configuration>) {
    for (steps, bound) in [(1, ONE_STEP), (STEPS, TEN_SECONDS)] {
        let difference = difference(&carried(steps), &other(steps));
        println!("{name}, {steps} steps: {difference:.1e}");
        assert!(difference < bound, "{name}, {steps} steps: {difference:e}");
    }
}

/// (34)–(38) against (39)–(46).
#[test]
fn the_lagrangian_form_is_the_hamiltonian_form() {
    compare("Lagrangian form", |steps| {
        let (model, start) = paper();
        let mut integrator = Variational::new(model);
        let mut pair = integrator.pair(&start, H).unwrap();
        for _ in 1..steps {
            integrator.step_pair(&mut pair).unwrap();
        }
        let mu = dvi::legendre_plus(integrator.lagrangian(), pair.t, &pair.g, &pair.f, H);
        State {
            t: f64::from(steps) * H,
            g: pair.g.compose(&pair.f),
            mu,
        }
    });
}

#[test]
fn the_semidirect_trivialisation_is_the_direct_one() {
    compare("SE(3) x SO(3) x SO(3), value only", |steps| {
        let (model, start) = paper();
        let integrator = Variational::new(OnSe3(model));
        let start = OnSe3::from_direct(&start);
        OnSe3::to_direct(&run(integrator, &start, f64::from(steps) * H, steps))
    });
}

#[test]
fn the_solver_does_not_enter_the_solution() {
    compare("Newton by duals", |steps| {
        let (model, start) = paper();
        let integrator = Variational::new(ByDuals(model));
        run(integrator, &start, f64::from(steps) * H, steps)
    });
}
