//! What a stroke does: momentum to rounding, periods that add up, and strokes without a way.

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::{Composition, Gauss, Integrator, State, Variational};
use lie::{LieGroup, SO3, Vec3};

use crate::vectors::scene;

fn start(scene: &Scene) -> (ArticulatedBody, State<Configuration>) {
    (
        scene.model().expect("a model"),
        scene.initial_state().expect("a state"),
    )
}

fn run<I: Integrator<Group = Configuration>>(
    mut integrator: I,
    state: &mut State<Configuration>,
    (steps, h): (u32, f64),
) {
    let t = state.t;
    for k in 0..steps {
        // No drift of the time, which the motions are read by.
        state.t = t + f64::from(k) * h;
        integrator.step(state, h).expect("a step");
    }
    state.t = t + f64::from(steps) * h;
}

/// The rigid motion of the first body: its attitude and its mass centre.
fn placed(state: &State<Configuration>) -> (SO3, Vec3) {
    (state.g.0[0], state.g.1[0].vec3())
}

fn apart(a: (SO3, Vec3), b: (SO3, Vec3)) -> f64 {
    (*a.0.matrix() - *b.0.matrix()).frobenius() + (a.1 - b.1).norm()
}

#[test]
fn the_momentum_of_a_driven_fish_is_kept_whatever_the_tolerance() {
    let (model, first) = start(&scene("fish-prescribed"));
    for tolerance in [None, Some(1e-6)] {
        let mut integrator = Variational::new(model.clone());
        if let Some(tolerance) = tolerance {
            integrator = integrator.with_tolerance(tolerance);
        }
        let mut state = first.clone();
        run(integrator, &mut state, (100_000, 0.005));
        let end = model.conserved(&state).expect("finite");
        // Of a zero sum, beside single momenta of 100 kg m²/s: rounding of 1e5 steps.
        assert!(
            end.angular.norm() < 1e-10,
            "{tolerance:?}: {:?}",
            end.angular
        );
        assert!(state.mu.1[0].vec3().norm() < 1e-12, "{tolerance:?}");
    }
}

#[test]
fn ten_strokes_are_the_tenth_power_of_one() {
    let (model, mut state) = start(&scene("fish-prescribed"));
    let mut integrator = Composition::new::<2>(model);
    run(&mut integrator, &mut state, (100, 0.01));
    let (r, x) = placed(&state);
    let (mut power, mut way) = (SO3::identity(), Vec3::zero());
    for _ in 0..10 {
        way += power.rotate(x);
        power = power.compose(&r);
    }
    run(&mut integrator, &mut state, (900, 0.01));
    let off = apart(placed(&state), (power, way));
    // Rounding of 1000 steps of a path of 8 m.
    assert!(off < 1e-11, "{off:e}");
}

/// One hinge that waves.
fn clapper(frequency: f64, phase: f64) -> Scene {
    let text = format!(
        "
        [fluid]
        density = 1000
        [start]
        momentum = 'zero'
        [[body]]
        name = 'head'
        semi_axes = [0.3, 0.05, 0.1]
        [[body]]
        name = 'tail'
        semi_axes = [0.2, 0.03, 0.1]
        [[joint]]
        parent = 'head'
        child = 'tail'
        at_parent = [-0.32, 0, 0]
        at_child = [0.22, 0, 0]
        type = 'hinge'
        axis = [0, 0.2, 1]
        motion = {{ bias = 0.3, amplitude = 0.8, frequency = {frequency}, phase = {phase} }}
        "
    );
    Scene::parse(&text, "clapper.toml").expect("a scene")
}

#[test]
fn a_scallop_goes_nowhere_by_a_symmetric_method() {
    // From a turning point, so that the grid is symmetric about both.
    let (model, first) = start(&clapper(1.0, core::f64::consts::FRAC_PI_2));
    let mut state = first.clone();
    run(
        Composition::new::<2>(model.clone()),
        &mut state,
        (40, 0.025),
    );
    let symmetric = apart(placed(&state), placed(&first));
    assert!(symmetric < 1e-12, "{symmetric:e}");
    let mut state = first.clone();
    run(Gauss::new::<4>(model.clone()), &mut state, (40, 0.025));
    let gauss = apart(placed(&state), placed(&first));
    // Its own error.
    assert!(gauss < 1e-10, "{gauss:e}");
    let mut state = first.clone();
    run(Variational::new(model), &mut state, (40, 0.025));
    let false_way = apart(placed(&state), placed(&first));
    assert!(
        false_way > 1e-3,
        "the method of order 1 swims, falsely: {false_way:e}"
    );
}

#[test]
fn a_faster_stroke_has_the_same_poses() {
    let poses = |speed: f64| {
        let (model, mut state) = start(&clapper(speed, 0.4));
        let mut integrator = Composition::new::<2>(model);
        let mut poses = vec![];
        for _ in 0..10 {
            run(&mut integrator, &mut state, (5, 0.02 / speed));
            poses.push(placed(&state));
        }
        poses
    };
    for (a, b) in poses(1.0).into_iter().zip(poses(3.0)) {
        let off = apart(a, b);
        assert!(off < 1e-12, "{off:e}");
    }
}
