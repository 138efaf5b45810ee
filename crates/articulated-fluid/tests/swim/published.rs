//! Loads on scenes with a published or a closed answer.

use articulated_fluid::Scene;
use dvi::{Gauss, Integrator, State};
use lie::SO3;

fn end(
    text: &str,
    until: f64,
    h: f64,
) -> (
    articulated_fluid::ArticulatedBody,
    State<articulated_fluid::Configuration>,
) {
    let scene = Scene::parse(text, "scene.toml").unwrap_or_else(|error| panic!("{error}"));
    let (model, mut state) = (
        scene.model().expect("a model"),
        scene.initial_state().expect("a state"),
    );
    let mut integrator = Gauss::new::<4>(model.clone());
    for k in 1..=(until / h).round() as u32 {
        integrator.step(&mut state, h).expect("a step");
        state.t = f64::from(k) * h;
    }
    (model, state)
}

/// The heavy top of M. Géradin, A. Cardona, as in the examples of Exudyn (J. Gerstmayr): its quaternion at 0.2 s is told there as
/// 0.70828, 0.43878, 0.54573, 0.0894.
#[test]
fn the_heavy_top_is_where_exudyn_has_it() {
    let text = "
        gravity = [0, 0, -9.81]
        fluid.density = 0
        body = [{ name = 'top', mass = 15, inertia = [0.234375, 0.46875, 0.234375], angular_velocity = [0, 150, -4.61538] }]
        joint = [{ parent = 'world', child = 'top', at_parent = [0, 0, 0], at_child = [0, -1, 0] }]
    ";
    let (model, state) = end(text, 0.2, 2e-4);
    let attitude = model.attitudes(state.t, &state.g).expect("a state")[0];
    let q = SO3::to_quaternion(&attitude);
    let told = [0.70828, 0.43878, 0.54573, 0.0894];
    // The sign of the vector part is that of the inverse rotation there.
    let inverse = [q[0], -q[1], -q[2], -q[3]];
    let off = inverse.iter().zip(told).map(|(q, told)| (q - told).abs());
    // The digits that are told.
    assert!(off.fold(0.0, f64::max) < 1e-5, "{q:?}");
}

/// Weight less buoyancy is drag: $v = \sqrt{(m - \rho V) g / q}$.
#[test]
fn a_falling_sphere_comes_to_its_terminal_velocity() {
    let text = "
        gravity = [0, 0, -9.81]
        fluid.density = 1000
        body = [{ name = 'ball', semi_axes = [0.1, 0.1, 0.1], mass = 6, drag = { quadratic = [7, 7, 7] } }]
    ";
    let (model, state) = end(text, 20.0, 0.02);
    let volume = 4.0 / 3.0 * core::f64::consts::PI * 1e-3;
    let terminal = ((6.0 - 1000.0 * volume) * 9.81 / 7.0).sqrt();
    let xi = model.velocity(&state).expect("a state");
    let speed = -xi.1[0][2];
    assert!(
        (speed - terminal).abs() < 1e-9 * terminal,
        "{speed} {terminal}"
    );
}

/// N. E. Leonard, *Stability of a bottom-heavy underwater vehicle*, Automatica 33 (1997): a neutral vehicle has its
/// buoyancy above its mass centre, and goes straight along its axis. The fluid would turn it from that. It goes on while the righting moment
/// outweighs the fluid's: with the momentum kept, $m g l > m_1 (m_3 - m_1) U^2 / m_3$.
#[test]
fn a_bottom_heavy_vehicle_is_stable_up_to_its_speed() {
    let scene = |l: f64, speed: f64| {
        format!(
        "
        gravity = [0, 0, -9.81]
        fluid.density = 1000
        start.velocity = [{speed}, 0, 0]
        body = [{{ name = 'vehicle', semi_axes = [0.6, 0.2, 0.15], buoyancy_at = [0, 0, {l}], attitude = {{ axis = [0, 1, 0], angle = 1e-6 }} }}]
        "
    )
    };
    let (l, any) = (
        0.01,
        Scene::parse(&scene(0.01, 1.0), "vehicle.toml").expect("a scene"),
    );
    let body = &any.bodies[0];
    let [m1, m3] = [body.total_mass[0][0], body.total_mass[2][2]];
    let righting = body.mass().expect("known") * 9.81 * l;
    let fastest = (righting * m3 / (m1 * (m3 - m1))).sqrt();
    let turned = |speed: f64| {
        let (model, state) = end(&scene(l, speed), 200.0, 0.05);
        let r = model.attitudes(state.t, &state.g).expect("a state")[0];
        (*r.matrix() - lie::Mat3::identity()).frobenius()
    };
    let (slower, faster) = (turned(0.98 * fastest), turned(1.02 * fastest));
    println!("{fastest} m/s: {slower:e} rad below, {faster:e} rad above");
    assert!(slower < 1e-4 && faster > 1e-2, "{slower:e} {faster:e}");
}
