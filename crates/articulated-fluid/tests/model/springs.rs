//! Elastic joints: their torques, what the motion on them keeps, a frequency, and the plane of the motion.

use articulated_fluid::planar::{NotPlanarCause, Plane};
use articulated_fluid::{ArticulatedBody, Body, Configuration, Joint, Scene};
use dvi::{Gauss, Integrator, Lagrangian, State, Variational};
use lie::{LieGroup, Mat3, SO3, Tangent, Vec3, VectorSpace};
use proptest::prelude::*;

use crate::common::*;
use crate::flat_trees::{self, elastic, turn_of_axes};

type Stepper = Box<dyn Integrator<Group = Configuration>>;

/// The torques are all the force there is at rest without a weight.
fn at_rest(mut sample: Sample) -> Sample {
    sample.weight = None;
    sample.xi.set_zero();
    sample.rebuilt()
}

proptest! {
    #[test]
    fn the_torques_are_the_slopes_of_the_potential(sample in any_sample()) {
        /// The step of the difference: truncation 1e-11, rounding 1e-16 / 1e-5, times stiffnesses up to 3.
        const STEP: f64 = 1e-5;
        let sample = at_rest(sample);
        let Sample { model, g, .. } = &sample;
        let (_, tau) = velocity_and_force::<f64>(model, g, &sample.mu());
        let slope = |i: usize| {
            let [ahead, back] = [STEP, -STEP].map(|size| {
                let mut step = g.zero_algebra();
                step.set(i, size);
                sample.potential(&g.compose(&LieGroup::exp(&step)))
            });
            (ahead - back) / (2.0 * STEP)
        };
        let slopes: Vec<f64> = (0..tau.dim()).map(|i| -slope(i)).collect();
        assert_close(&tau.coordinates(), &slopes, 1e-9);
        prop_assert_eq!(tau.1[0].vec3(), Vec3::zero());
    }

    #[test]
    fn the_torques_balance(sample in any_sample()) {
        let sample = at_rest(sample);
        let (_, tau) = velocity_and_force::<f64>(&sample.model, &sample.g, &sample.mu());
        let turned = sample.g.0.iter().zip(tau.0.iter());
        let sum = turned.fold(Vec3::zero(), |sum, (r, tau)| sum + r.rotate(tau.vec3()));
        // Rounding of stiffnesses up to 3.
        assert_close(&sum.0, &[0.0; 3], 1e-14);
    }
}

/// Two bodies joined at both their mass centres, in a vacuum.
fn pair(inertias: [[f64; 3]; 2], stiffness: f64) -> ArticulatedBody {
    let bodies =
        inertias.map(|inertia| Body::new(Mat3::diagonal([1.0; 3]), Mat3::diagonal(inertia)));
    let joint = Joint {
        parent: 0,
        child: 1,
        at_parent: Vec3::zero(),
        at_child: Vec3::zero(),
        kind: Default::default(),
    };
    let free = ArticulatedBody::new(&bodies, &[joint]).expect("a model");
    free.with_stiffness(&[stiffness]).expect("springs")
}

#[test]
fn the_energy_of_a_small_turn_keeps_its_digits() {
    let model = pair([[1.0; 3], [2.0; 3]], 8.0);
    for angle in [1e-9, 1e-5, 0.1, 3.0, core::f64::consts::PI] {
        let mut g = model.aligned();
        g.0[1] = SO3::exp(&Tangent([0.6 * angle, 0.0, 0.8 * angle]));
        let mu = g.zero_dual();
        let energy = model
            .conserved(&State { t: 0.0, g, mu })
            .expect("a state")
            .energy;
        let expected = 16.0 * (0.5 * angle).sin().powi(2);
        assert!((energy / expected - 1.0).abs() < 1e-14, "{angle}: {energy}");
    }
}

/// $\omega^2 = k (1/J_1 + 1/J_2)$ about each principal axis.
#[test]
fn a_small_oscillation_has_the_frequency_worked_out_by_hand() {
    const AMPLITUDE: f64 = 1e-4;
    let (inertias, k) = ([[0.5, 0.8, 1.0], [2.0, 1.5, 0.9]], 3.0_f64);
    for axis in 0..3 {
        let [j1, j2] = inertias.map(|j| j[axis]);
        let omega = (k * (1.0 / j1 + 1.0 / j2)).sqrt();
        let model = pair(inertias, k);
        let mut rate = model.aligned().zero_algebra();
        rate.0[1][axis] = AMPLITUDE * omega;
        let mut state = model.state(0.0, model.aligned(), &rate).expect("a state");
        let mut integrator = Gauss::new::<4>(model);
        let (h, mut worst) = (0.1 / omega, 0.0_f64);
        for n in 1..=600 {
            integrator.step(&mut state, h).expect("a step");
            let turn = state.g.0[0].inverse().compose(&state.g.0[1]).log();
            let turn = turn.expect("a small turn").vec3();
            let exact = AMPLITUDE * (0.1 * f64::from(n)).sin();
            worst = worst.max((turn[axis] - exact).abs() / AMPLITUDE);
        }
        println!("axis {axis}: {worst:.1e} of the amplitude");
        // The pendulum's frequency is lower by the square of its amplitude over 16: 4e-8 after 60 radians.
        assert!(worst < 5e-8, "axis {axis}: {worst:e}");
    }
}

/// A chain of four in water, twisted by up to a radian at each joint.
fn chain() -> (ArticulatedBody, State<Configuration>) {
    let body = Body::new(
        Mat3([[1.0, 0.1, 0.0], [0.1, 2.0, 0.2], [0.0, 0.2, 2.5]]),
        Mat3::diagonal([0.2, 0.4, 0.5]),
    );
    let joint = |child: usize| Joint {
        parent: child - 1,
        child,
        at_parent: Vec3([0.6, 0.1, 0.0]),
        at_child: Vec3([-0.6, 0.0, 0.1]),
        kind: Default::default(),
    };
    let joints: Vec<_> = (1..4).map(joint).collect();
    let free = ArticulatedBody::new(&[body; 4], &joints).expect("a model");
    let model = free.with_stiffness(&[4.0, 0.0, 2.0]).expect("springs");
    let mut g = model.aligned();
    let twists = [[0.8, 0.3, -0.2], [0.2, 0.9, 0.5], [-0.4, 0.1, 0.6]];
    for (r, twist) in g.0[1..].iter_mut().zip(twists) {
        *r = SO3::exp(&Tangent(twist));
    }
    let rates = [
        [0.2, 0.1, -0.3],
        [0.1, -0.2, 0.3],
        [0.0, 0.4, -0.1],
        [-0.3, 0.1, 0.2],
    ];
    let xi = (
        rates.into_iter().map(Tangent).collect(),
        alone(Tangent([0.3, -0.1, 0.2])),
        none(),
    );
    let start = model.state(0.0, g, &xi).expect("a state");
    (model, start)
}

#[test]
fn momenta_are_kept_and_the_energy_does_not_drift() {
    let (model, start) = chain();
    let lgvi: Stepper = Box::new(Variational::new(model.clone()));
    let gauss: Stepper = Box::new(Gauss::new::<4>(model.clone()));
    let kept = |state: &State<Configuration>| model.conserved(state).expect("the model's state");
    let before = kept(&start);
    for (name, mut integrator, h, bound) in
        [("lgvi", lgvi, 5e-3, 2e-2), ("gauss-4", gauss, 5e-2, 1e-10)]
    {
        let (mut state, mut errors, mut moved) = (start.clone(), vec![], 0.0_f64);
        for _ in 0..1000 {
            integrator.step(&mut state, h).expect("a step");
            let now = kept(&state);
            let linear = (now.linear - before.linear).norm() / before.linear.norm();
            let angular = (now.angular - before.angular).norm() / before.angular.norm();
            errors.push((now.energy - before.energy).abs() / before.energy);
            moved = moved.max(linear.max(angular));
        }
        let [early, late] = [&errors[..500], &errors[500..]].map(largest);
        println!("{name}: momenta {moved:.1e}, energy {early:.1e}, later {late:.1e}");
        // A random walk of rounding.
        assert!(moved < 1e-13, "{name}: {moved:e}");
        assert!(
            early.max(late) < bound && late < 2.0 * early,
            "{name}: {early:e} {late:e}"
        );
    }
}

/// Two ellipsoids in water, the tail turned by 0.5 rad about `axis` and beating about z.
fn fish(axis: &str, stiffness: f64) -> Scene {
    let text = format!(
        "[fluid]
         density = 1000
         [[body]]
         name = 'head'
         semi_axes = [0.8, 0.2, 0.3]
         [[body]]
         name = 'tail'
         semi_axes = [0.5, 0.1, 0.2]
         attitude = {{ axis = {axis}, angle = 0.5 }}
         angular_velocity = [0, 0, 1]
         [[joint]]
         parent = 'head'
         child = 'tail'
         at_parent = [-0.9, 0, 0]
         at_child = [0.6, 0, 0]
         stiffness = {stiffness:?}"
    );
    Scene::parse(&text, "fish.toml").expect("a scene")
}

#[test]
fn a_spring_that_turns_about_the_normal_leaves_the_plane() {
    for stiffness in [0.0, 20.0] {
        let smallest = fish("[0, 0, 1]", stiffness).smallest().expect("a model");
        assert!(smallest.plane.is_some());
    }
}

/// A tail that is upside down is symmetric under the mirror, and so is its motion on a free joint: not where it is at rest right side up.
#[test]
fn a_spring_that_turns_out_of_the_plane_is_no_planar_motion() {
    let find = |stiffness: f64| {
        let mut scene = fish("[0, 0, 1]", stiffness);
        // Half a turn about x, and then 0.5 rad about z.
        let (sin, cos) = 0.25_f64.sin_cos();
        scene.bodies[1].attitude = [0.0, cos, sin, 0.0];
        Plane::find(
            &scene.model().expect("a model"),
            &scene.initial_state().expect("a state"),
        )
    };
    assert!(find(0.0).is_ok());
    let refused = find(20.0).expect_err("no plane");
    assert_eq!(
        (refused.what, refused.body),
        (NotPlanarCause::SpringOffPlane, 1)
    );
    assert!((refused.defect - 2.0).abs() < 1e-15);
}

#[test]
fn a_normal_that_is_another_axis_of_the_parent_is_named_and_measured() {
    let mut flat = elastic(flat_trees::fish(), &[2.0, 0.5]);
    assert!(Plane::find(&flat.model(), &flat.state()).is_ok());
    flat.parts[1].frame = turn_of_axes(1);
    let refused = Plane::find(&flat.model(), &flat.state()).expect_err("no plane");
    let cause = (refused.what, refused.body);
    assert_eq!(cause, (NotPlanarCause::SpringOffPlane, 1), "{refused}");
    assert!((refused.defect - 2.0_f64.sqrt()).abs() < 1e-15, "{refused}");
    assert!(refused.torque > 0.0 && refused.torque < 3.0, "{refused}");
    // On free joints the frames do not matter.
    let free = elastic(flat, &[0.0, 0.5]);
    assert!(Plane::find(&free.model(), &free.state()).is_ok());
}

/// Balls joined at their centres, at rest but for the twist of the spring: nothing else tells the plane.
#[test]
fn the_plane_of_a_twist_is_found() {
    let model = pair([[1.0; 3], [2.0; 3]], 5.0);
    let twisted = |axis: Vec3| {
        let mut g = model.aligned();
        g.0[1] = SO3::exp(&(axis * 0.3).into());
        let mu = g.zero_dual();
        Plane::find(&model, &State { t: 0.0, g, mu })
    };
    for axis in Mat3::identity().0.map(Vec3) {
        assert_eq!(twisted(axis).expect("a plane").normal(), axis);
    }
    let refused = twisted(Vec3([1.0, -2.0, 0.5])).expect_err("no coordinate axis");
    assert_eq!(refused.what, NotPlanarCause::AttitudeOffPlane);
}
