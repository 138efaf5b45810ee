//! Net motions of a three-link swimmer whose connection a published code agrees with to twelve digits.

use articulated_fluid::Scene;
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use dvi::{Gauss, Integrator};
use serde_json::Value;

/// The gait $(c_1, c_2) + r (\cos t, \sin t)$ of three equal ellipses in a plane, of the density 1.
fn swimmer(setup: &Value, [c1, c2, r]: [f64; 3]) -> Scene {
    let number = |key: &str| setup[key].as_f64().expect("a number");
    let (a, b, gap) = (number("a"), number("b"), number("gap"));
    let mass = PI * a * b;
    let total = [mass + PI * b * b, mass + PI * a * a, 1.0];
    let turning = mass * (a * a + b * b) / 4.0 + PI * (a * a - b * b).powi(2) / 8.0;
    let body = |name: &str| {
        format!(
            "{{ name = '{name}', total_mass = {total:?}, total_inertia = [1, 1, {turning:?}] }}"
        )
    };
    let at = a + gap / 2.0;
    let joint = |child: &str, side: f64, bias: f64, phase: f64| {
        format!(
            "{{ parent = 'middle', child = '{child}', at_parent = [{}, 0, 0], at_child = [{}, 0, 0], type = 'hinge', axis = [0, 0, {side}],
              motion = {{ bias = {bias:?}, amplitude = {r:?}, frequency = {:?}, phase = {phase:?} }} }}",
            side * at,
            -side * at,
            1.0 / TAU
        )
    };
    // The left link turns by -q1, the right one by q2.
    let text = format!(
        "fluid.density = 1\nstart.momentum = 'zero'\nbody = [{}, {}, {}]\njoint = [{}, {}]",
        body("middle"),
        body("left"),
        body("right"),
        joint("left", -1.0, c1, FRAC_PI_2),
        joint("right", 1.0, c2, 0.0),
    );
    Scene::parse(&text, "three-links.toml").expect("a scene")
}

#[test]
fn three_links_move_as_the_connection_says() {
    let told: Value = serde_json::from_str(include_str!("planar.json")).expect("JSON");
    let gaits = told["gaits"].as_array().expect("gaits");
    for (gait, parts) in gaits
        .iter()
        .zip([[0.0, 0.0, 0.25], [0.0, 0.0, 0.5], [0.5, 0.5, 0.5]])
    {
        let scene = swimmer(&told["setup"], parts);
        let (model, mut state) = (
            scene.model().expect("a model"),
            scene.initial_state().expect("a state"),
        );
        let mut integrator = Gauss::new::<8>(model);
        const STEPS: u32 = 60;
        for k in 0..STEPS {
            state.t = TAU * f64::from(k) / f64::from(STEPS);
            integrator
                .step(&mut state, TAU / f64::from(STEPS))
                .expect("a step");
        }
        let (r, x) = (state.g.0[0], state.g.1[0].vec3());
        let theta = r.matrix()[(1, 0)].atan2(r.matrix()[(0, 0)]);
        let decoupled = gait["decoupled"].as_array().expect("numbers");
        for (found, told) in [x[0], x[1], theta].iter().zip(decoupled) {
            let told = told.as_f64().expect("a number");
            assert!(
                (found - told).abs() < 1e-9,
                "{}: {found} {told}",
                gait["gait"]
            );
        }
    }
}
