//! The paper's scene, its motion by an independent method, and how far two states are apart.

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::{Integrator, State};
use lgvi::{articulated_fluid, dvi, lie};
use lie::{LieGroup, SO3};
use study::baseline::{Motion, Pair, Tolerance};

pub fn paper() -> (ArticulatedBody, State<Configuration>) {
    let text = include_str!("../../scenes/fish-chain.toml");
    let scene = Scene::parse(text, "fish-chain.toml").unwrap();
    (scene.model().unwrap(), scene.initial_state().unwrap())
}

/// The paper's scene by an explicit method of order 8 at a tight tolerance.
pub fn reference(until: f64) -> State<Configuration> {
    let (model, start) = paper();
    let tolerance = Tolerance::uniform(1e-13);
    let mut motion = Motion::new(&Pair::DP853, &model, &start, until, tolerance).unwrap();
    motion.at(until).unwrap().clone()
}

/// The largest geodesic attitude error of the bodies, rad.
pub fn attitude_error(a: &State<Configuration>, b: &State<Configuration>) -> f64 {
    let one = |a: &SO3, b: &SO3| {
        let log = a.inverse().compose(b).log();
        log.unwrap_or_else(|e| e.representative).vec3().norm()
    };
    let bodies = a.g.0.iter().zip(b.g.0.iter());
    bodies.map(|(a, b)| one(a, b)).fold(0.0, f64::max)
}

/// Takes `steps` equal steps of an integrator over `until` seconds.
pub fn run<I: Integrator>(
    mut integrator: I,
    start: &State<I::Group>,
    until: f64,
    steps: u32,
) -> State<I::Group> {
    let (mut state, h) = (start.clone(), until / f64::from(steps));
    for _ in 0..steps {
        integrator.step(&mut state, h).unwrap();
    }
    state
}
