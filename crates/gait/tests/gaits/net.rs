//! The net motion of a stroke.

use core::f64::consts::{FRAC_PI_2, TAU};

use articulated_fluid::Scene;
use dvi::{Gauss, Integrator};
use gait::{Chain, Effort, Screw, Told, net_motion};
use lie::{LieGroup, SE3};
use proptest::prelude::*;

use crate::swimmers::{Plain, published, three_links, trees};

fn net(scene: &Scene) -> SE3 {
    let chain = Chain::new(scene).expect("a chain");
    let told = Told::new(&scene.model().expect("a model")).expect("a stroke");
    net_motion(&chain, &told).expect("a motion")
}

/// The numbers were found with code independent of this project, in three ways that agree.
#[test]
fn published_strokes_move_as_far_as_published() {
    let fish = net(&published("fish-prescribed.toml"));
    let d = [-0.817121604267662, 0.278730715615067, 0.37592548117326935];
    for (found, known) in fish.translation.0.iter().zip(d) {
        assert!((found - known).abs() < 1e-11, "{found} {known}");
    }
    let screw = Screw::of(&fish);
    assert!((screw.turn - 0.5142342949316699).abs() < 1e-11, "{screw:?}");
    assert!(
        (screw.advance - 0.8403999176669679).abs() < 1e-11,
        "{screw:?}"
    );
    let eel = net(&published("eel-wave.toml"));
    let d = [0.15587520969516888, -0.06227599050861666, 0.0];
    for (found, known) in eel.translation.0.iter().zip(d) {
        assert!((found - known).abs() < 1e-11, "{found} {known}");
    }
}

#[test]
fn circles_of_three_links_move_as_far_as_published() {
    let circle = |[c1, c2, r]: [f64; 3]| {
        let motion = |bias: f64, phase: f64| {
            format!(
                "{{ bias = {bias:?}, amplitude = {r:?}, frequency = {:?}, phase = {phase:?} }}",
                1.0 / TAU
            )
        };
        net(&three_links([&motion(c1, FRAC_PI_2), &motion(c2, 0.0)]))
    };
    let known = [
        (
            [0.0, 0.0, 0.25],
            [-0.10614225115272018, 0.006807087351860303, 0.0],
        ),
        (
            [0.0, 0.0, 0.5],
            [-0.3629769741544636, 0.04824836432107826, 0.0],
        ),
        (
            [0.5, 0.5, 0.5],
            [
                -0.40508197226409987,
                0.09987877256629114,
                -0.1914563161795589,
            ],
        ),
    ];
    for (parts, [x, y, theta]) in known {
        let g = circle(parts);
        let m = g.rotation.matrix();
        let found = [
            g.translation[0],
            g.translation[1],
            m[(1, 0)].atan2(m[(0, 0)]),
        ];
        for (found, known) in found.iter().zip([x, y, theta]) {
            assert!((found - known).abs() < 1e-11, "{parts:?}: {found} {known}");
        }
    }
}

/// Steps a period by Gauss's method of eight stages: the same motion from the model's own equations.
fn stepped(scene: &Scene, steps: u32) -> (SE3, f64, f64) {
    let model = scene.model().expect("a model");
    let mut state = scene.initial_state().expect("a state");
    let at = |g: &articulated_fluid::Configuration| SE3::new(g.0[0], g.1[0].vec3());
    let start = at(&state.g);
    let (mut integrator, mut work) = (Gauss::new::<8>(Plain(model.clone())), Default::default());
    let (mut drives, mut positive) = (model.drives(), 0.0);
    for k in 0..steps {
        state.t = f64::from(k) / f64::from(steps);
        let before: Vec<f64> = drives.iter().map(|drive| drive.work).collect();
        let see = &mut |path: dvi::Path<_>| model.add_drives(path, &mut work, &mut drives);
        integrator
            .step_along(&mut state, 1.0 / f64::from(steps), see)
            .expect("a step");
        let gains = drives
            .iter()
            .zip(before)
            .map(|(drive, before)| drive.work - before);
        positive += gains.filter(|gain| *gain > 0.0).sum::<f64>();
    }
    (
        start.inverse().compose(&at(&state.g)),
        positive,
        drives.iter().map(|drive| drive.work).sum(),
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    /// Both are of high order, and 40 steps of the one err by less than 1e-9 here.
    #[test]
    fn random_trees_move_as_they_are_stepped(scene in trees()) {
        let known = net(&scene);
        let (found, ..) = stepped(&scene, 40);
        let apart = known.inverse().compose(&found);
        prop_assert!((apart.translation.norm() + apart.rotation.matrix().skew_vee().norm()) < 1e-8, "{known:?} {found:?}");
    }

    /// A stroke forwards and then backwards leads nowhere, and how fast it is done does not matter.
    #[test]
    fn the_work_of_random_trees_is_that_of_the_drives(scene in trees()) {
        let chain = Chain::new(&scene).expect("a chain");
        let told = Told::new(&scene.model().expect("a model")).expect("a stroke");
        let work = Effort::Work.of(&chain, &told, 400).expect("work");
        let (_, positive, net) = stepped(&scene, 400);
        // A step in which the power changes its sign counts by its sum alone: two in a stroke of each joint, of 1/400 each.
        prop_assert!((work - positive).abs() < 1e-3 * (1.0 + positive), "{work} {positive}");
        prop_assert!(net.abs() < 1e-6 * (1.0 + positive), "no work is left of a stroke: {net}");
    }
}
