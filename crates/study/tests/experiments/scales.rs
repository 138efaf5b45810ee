//! Bodies of very different sizes and masses: what is light or short is solved as well as what is not.

use articulated_fluid::Scene;
use lie::SO3;
use sim::Method;

use crate::laws::law::{self, apart};

/// The attitudes after each step of a method.
fn run(text: &str, method: Method, h: f64, steps: usize) -> Vec<Vec<SO3>> {
    let scene = Scene::parse(text, "scales.toml").unwrap();
    let states = law::run(&scene, method, h, steps);
    assert_eq!(states.len(), steps, "{method}: a step was refused");
    states
}

/// Masses 1, m and m / 2.
fn chain(m: f64) -> String {
    format!(
        r#"
fluid.density = 0
body = [
  {{ name = "a", mass = 1, inertia = [0.1, 0.2, 0.25], angular_velocity = [0.3, 0.4, -0.2] }},
  {{ name = "b", mass = {m:e}, inertia = [{:e}, {:e}, {:e}], angular_velocity = [0.5, -0.6, 0.9] }},
  {{ name = "c", mass = {:e}, inertia = [{:e}, {:e}, {:e}], angular_velocity = [-0.4, 0.8, 0.3] }},
]
joint = [
  {{ parent = "a", child = "b", at_parent = [0.5, 0, 0.1], at_child = [-0.5, 0, 0] }},
  {{ parent = "b", child = "c", at_parent = [0.5, 0.1, 0], at_child = [-0.4, 0, 0] }},
]
"#,
        0.1 * m,
        0.2 * m,
        0.25 * m,
        0.5 * m,
        0.05 * m,
        0.1 * m,
        0.12 * m
    )
}

/// Two methods agree whatever the ratio: 20 s of the motion multiply 1e-12 by some hundred.
#[test]
fn a_light_chain_is_solved_as_well_as_a_heavy_one() {
    for m in [1.0, 1e-3, 1e-9, 1e-12] {
        let text = chain(m);
        let composed = run(&text, "composition-8".parse().unwrap(), 0.02, 1000);
        let collocated = run(&text, Method::gauss(8).unwrap(), 0.02, 1000);
        let apart = apart(&composed, &collocated);
        println!("{m:e}: {apart:e}");
        assert!(apart < 1e-8, "{m:e}: {apart:e}");
    }
}

/// Ellipsoids of half a metre, times k.
fn pair(k: f64) -> String {
    let triple = |x: [f64; 3]| {
        let [a, b, c] = x.map(|x| k * x);
        format!("[{a:e}, {b:e}, {c:e}]")
    };
    format!(
        r#"
fluid.density = 1000
start.velocity = {}
body = [
  {{ name = "a", semi_axes = {}, angular_velocity = [0.1, 1.5, 0.2] }},
  {{ name = "b", semi_axes = {}, angular_velocity = [0.5, -1, 0.7] }},
]
joint = [{{ parent = "a", child = "b", at_parent = {}, at_child = {} }}]
"#,
        triple([0.3, 0.02, 0.05]),
        triple([0.5, 0.2, 0.3]),
        triple([0.3, 0.1, 0.15]),
        triple([-0.55, 0.0, 0.0]),
        triple([0.35, 0.0, 0.0])
    )
}

/// In a perfect fluid all lengths and velocities may be multiplied by the same: rounding is all that differs.
#[test]
fn a_millimetre_is_solved_as_well_as_a_kilometre() {
    for (method, h, steps) in [(4, 0.1, 100), (8, 0.2, 50)] {
        let method = Method::gauss(method).unwrap();
        let expected = run(&pair(1.0), method, h, steps);
        for k in [1e-6, 1e-3, 1e3] {
            let apart = apart(&run(&pair(k), method, h, steps), &expected);
            println!("{method}, k = {k:e}: {apart:e}");
            assert!(apart < 1e-11, "{method}, k = {k:e}: {apart:e}");
        }
    }
}
