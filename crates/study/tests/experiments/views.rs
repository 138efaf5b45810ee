//! Scenes whose motion must not depend on how they drift, fall or are written down, by every method.

use articulated_fluid::{Configuration, Scene};
use dvi::State;
use sim::{Choice, Chosen, Method, Plan};
use study::baseline::{Motion, Pair, Tolerance};
use study::contender::Problem;

fn parse(text: &str) -> Scene {
    Scene::parse(text, "scene.toml").expect("a scene")
}

/// A satellite's bus with an arm.
fn satellite(velocity: [f64; 3], gravity: [f64; 3]) -> Scene {
    parse(&format!(
        "gravity = {gravity:?}
         [fluid]
         density = 0
         [start]
         velocity = {velocity:?}
         [[body]]
         name = 'bus'
         mass = 100
         inertia = [20, 25, 30]
         angular_velocity = [0.3, 0.4, -0.2]
         [[body]]
         name = 'arm'
         mass = 20
         inertia = [0.5, 6, 6]
         angular_velocity = [-0.5, 0.3, 0.8]
         [[joint]]
         parent = 'bus'
         child = 'arm'
         at_parent = [0.8, 0, 0.3]
         at_child = [-1, 0, 0]"
    ))
}

const REST: [f64; 3] = [0.0; 3];
const DRIFT: [f64; 3] = [7600.0, 0.0, 0.0];
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

/// The state after so many steps, and the iterations.
fn run(scene: &Scene, method: Method, (h, steps): (f64, u32)) -> (State<Configuration>, u32) {
    let mut integrator = method.integrator_of_smallest(&scene.smallest().expect("a model"));
    let (mut state, mut iterations) = (scene.initial_state().expect("a state"), 0);
    for _ in 0..steps {
        iterations += integrator.step(&mut state, h).expect("a step").iterations;
    }
    (state, iterations)
}

/// The largest difference of an entry of an attitude.
fn apart(a: &State<Configuration>, b: &State<Configuration>) -> f64 {
    let pairs = a.g.0.iter().zip(b.g.0.iter());
    let differences = pairs.map(|(a, b)| (*a.matrix() - *b.matrix()).frobenius());
    differences.fold(0.0, f64::max)
}

#[test]
fn in_a_vacuum_attitudes_and_iterations_depend_on_neither_drift_nor_fall() {
    for method in Method::all() {
        let steps = (method.default_step(), 40);
        let (still, expected) = run(&satellite(REST, REST), method, steps);
        for (velocity, gravity) in [(DRIFT, REST), (REST, GRAVITY), (DRIFT, GRAVITY)] {
            let (moving, iterations) = run(&satellite(velocity, gravity), method, steps);
            assert!(apart(&moving, &still) <= 1e-11, "{method}");
            assert_eq!(iterations, expected, "{method}");
        }
    }
}

#[test]
fn a_wanted_accuracy_takes_the_same_steps_at_any_speed() {
    let pilot = |velocity, gravity| {
        let plan = Plan {
            choice: Choice::Accuracy(1e-3),
            until: 20.0,
            ..Plan::default()
        };
        let chosen = plan.resolve(&satellite(velocity, gravity));
        chosen.expect("a method")
    };
    // What a check finds differs by rounding.
    let steps = |chosen: &Chosen| {
        (
            chosen.method,
            chosen.step,
            chosen.checked.map(|c| c.tolerance),
        )
    };
    let still = pilot(REST, REST);
    assert_eq!(steps(&pilot(DRIFT, REST)), steps(&still));
    assert_eq!(steps(&pilot(DRIFT, GRAVITY)), steps(&still));
    // And is reached, against another method at rest on the raw model.
    let scene = satellite(DRIFT, GRAVITY);
    let mut integrator = still.integrator_of_smallest(&scene.smallest().expect("a model"));
    let mut state = scene.initial_state().expect("a state");
    for _ in 0..(20.0 / still.step).round() as u32 {
        integrator.step(&mut state, still.step).expect("a step");
    }
    let scene = satellite(REST, REST);
    let (model, start) = (
        scene.model().expect("a model"),
        scene.initial_state().expect("a state"),
    );
    let tolerance = Tolerance::uniform(1e-12);
    let motion = Motion::new(&Pair::DP853, &model, &start, 20.0, tolerance);
    let mut motion = motion.expect("a motion");
    let error = apart(&state, motion.at(20.0).expect("an end"));
    assert!(error < 2e-3, "{error:e}");
}

/// A body that spins about its intermediate axis, but for 2e-12.
fn tumbling() -> Scene {
    parse(
        "[fluid]
         density = 0
         [[body]]
         name = 'nut'
         mass = 1
         inertia = [1, 2, 2.5]
         angular_velocity = [2e-12, 1, 2e-12]",
    )
}

#[test]
fn a_spin_about_the_intermediate_axis_flips_when_it_does() {
    let scene = tumbling();
    let (model, start) = (
        scene.model().expect("a model"),
        scene.initial_state().expect("a state"),
    );
    let method: Method = "gauss-8".parse().expect("a method");
    let mut integrator = method.integrator_of_smallest(&scene.smallest().expect("a model"));
    let spin = |state: &State<Configuration>| model.velocity(state).expect("a state").0[0][1];
    let (mut state, mut before) = (start.clone(), start.clone());
    while spin(&state) > 0.0 {
        before = state.clone();
        integrator.step(&mut state, 0.5).expect("a step");
        assert!(state.t < 100.0);
    }
    // On the way out Omega_2 = -tanh(lambda (t - T)), lambda^2 = (I_3 - I_2) (I_2 - I_1) / (I_1 I_3), to the square of 2e-12.
    let rate = 0.2_f64.sqrt();
    let flips = |state: &State<Configuration>| state.t + spin(state).atanh() / rate;
    // At the start Omega_1' = -a Omega_3 and Omega_3' = -b Omega_1: the part with Omega_3 = -sqrt(b / a) Omega_1 grows.
    let (a, b) = (0.5_f64, 0.4_f64);
    let growing = 0.5 * 2e-12 * (1.0 - (a / b).sqrt());
    // Leaving as Omega_1 = A sech(lambda (t - T)) with A^2 = I_2 (I_3 - I_2) / (I_1 (I_3 - I_1)), so 2 A exp(-lambda T) = growing.
    let amplitude = (2.0 * 0.5 / 1.5_f64).sqrt();
    let exact = (2.0 * amplitude / growing.abs()).ln() / rate;
    // Rounding of 1e-16 beside 2e-12.
    for found in [flips(&before), flips(&state)] {
        assert!((found - exact).abs() < 1e-2, "{found} {exact}");
    }
    assert!((exact - 68.0).abs() < 2.0, "{exact}");
}

/// A body of 10 mg and a hull of a tonne, either listed first.
fn bug_and_hull(bug_first: bool) -> Scene {
    let bug = "[[body]]
         name = 'bug'
         mass = 1e-5
         inertia = [2e-6, 3e-6, 4e-6]
         angular_velocity = [0.3, 0.5, -0.4]\n";
    let hull = "[[body]]
         name = 'hull'
         mass = 1000
         inertia = [100, 200, 250]
         angular_velocity = [0.1, 0.2, 0.3]\n";
    let ([first, second], parent, child, at_parent, at_child) = match bug_first {
        true => ([bug, hull], "bug", "hull", "[0.02, 0, 0]", "[1, 0.3, 0.2]"),
        false => ([hull, bug], "hull", "bug", "[1, 0.3, 0.2]", "[0.02, 0, 0]"),
    };
    parse(&format!(
        "[fluid]
         density = 0
         [start]
         velocity = 'zero-momentum'
         {first}{second}[[joint]]
         parent = '{parent}'
         child = '{child}'
         at_parent = {at_parent}
         at_child = {at_child}"
    ))
}

#[test]
fn which_body_is_listed_first_does_not_matter() {
    let method: Method = "gauss-8".parse().expect("a method");
    for h in [0.1, 0.02, 2e-4, 2e-5] {
        let (a, iterations) = run(&bug_and_hull(true), method, (h, 20));
        let (b, expected) = run(&bug_and_hull(false), method, (h, 20));
        let (bug, hull) = (
            *a.g.0[0].matrix() - *b.g.0[1].matrix(),
            *a.g.0[1].matrix() - *b.g.0[0].matrix(),
        );
        // The inertia of the bug next to the hull's lever: 1e9 units of rounding in its rate.
        assert!(
            bug.frobenius() < 1e-9 && hull.frobenius() < 1e-12,
            "{bug:?} {hull:?}"
        );
        assert_eq!(iterations, expected, "{h}");
    }
}

#[test]
fn a_problem_of_a_scene_starts_at_rest_where_that_is_exact() {
    let problem =
        |velocity, gravity| Problem::of(&satellite(velocity, gravity), 1.0).expect("a problem");
    let still = problem(REST, REST);
    assert_eq!(still.start.mu.1[0].0, REST);
    assert_eq!(problem(DRIFT, GRAVITY), still);
}
