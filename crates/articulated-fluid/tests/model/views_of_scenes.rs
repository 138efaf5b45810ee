//! Scenes by their smallest models: what is left out is exactly nothing, and what is left depends on neither drift, fall nor order.

use articulated_fluid::scene::{Form, Mobility, SceneBody, SceneJoint, StartVelocity};
use articulated_fluid::{Configuration, Scene, Smallest};
use dvi::{Composition, Gauss, Integrator, State, Variational};
use lie::Vec3;
use proptest::prelude::*;

use crate::common::*;

type Stepper = Box<dyn Integrator<Group = Configuration> + Send>;

/// The scene of a sample, at rest as a whole or not.
fn scene(sample: &Sample, velocity: StartVelocity) -> Scene {
    let (gravity, net) = sample.weights();
    let bodies = sample
        .bodies
        .iter()
        .zip(sample.g.0.iter())
        .zip(sample.xi.0.iter())
        .zip(net);
    let bodies = bodies
        .enumerate()
        .map(|(i, (((body, r), rate), net_mass))| SceneBody {
            name: format!("body-{i}"),
            form: Form::Given {
                shape: None,
                mass: None,
                inertia: None,
            },
            total_mass: body.mass.0,
            total_inertia: body.inertia.0,
            net_mass,
            coupling: [[0.0; 3]; 3],
            buoyancy_at: [0.0; 3],
            loads: vec![],
            attitude: r.to_quaternion(),
            angular_velocity: rate.0,
        });
    let joints = sample.joints.iter().zip(&sample.stiffnesses);
    let joints = joints.map(|(joint, stiffness)| SceneJoint {
        name: format!("body-{}", joint.child),
        parent: joint.parent,
        child: joint.child,
        at_parent: joint.at_parent.0,
        at_child: joint.at_child.0,
        mobility: Mobility {
            stiffness: *stiffness,
            ..Mobility::default()
        },
    });
    Scene {
        title: None,
        gravity: gravity.0,
        density: 0.0,
        bodies: bodies.collect(),
        mount: None,
        joints: joints.collect(),
        position: sample.g.1[0].0,
        velocity,
        notes: vec![],
    }
}

/// Trees in a vacuum without gravity, any body the heaviest.
fn dry() -> impl Strategy<Value = Sample> {
    let sample = (0..=5_usize).prop_flat_map(|others| sample_of(Shape::Any, others, 0.1));
    sample.prop_map(|sample| {
        let mut dry = sample.dry();
        dry.weight = None;
        dry.rebuilt()
    })
}

/// The integrators of a few kinds for a scene.
fn steppers(smallest: &Smallest) -> [Stepper; 4] {
    [
        smallest.integrator(
            |model| Box::new(Variational::new(model)),
            |model| Box::new(Variational::new(model)),
        ),
        smallest.integrator(
            |model| Box::new(Composition::new::<4>(model)),
            |model| Box::new(Composition::new::<4>(model)),
        ),
        smallest.integrator(
            |model| Box::new(Gauss::new::<4>(model)),
            |model| Box::new(Gauss::new::<4>(model)),
        ),
        smallest.integrator(
            |model| Box::new(Gauss::new::<8>(model)),
            |model| Box::new(Gauss::new::<8>(model)),
        ),
    ]
}

/// The states and the iterations of 20 steps of each integrator.
fn runs(scene: &Scene) -> Vec<(State<Configuration>, u32)> {
    let smallest = scene.smallest().expect("a model");
    let start = scene.initial_state().expect("a state");
    let run = |mut stepper: Stepper| {
        let (mut state, mut iterations) = (start.clone(), 0);
        for _ in 0..20 {
            iterations += stepper.step(&mut state, 0.01).expect("a step").iterations;
        }
        (state, iterations)
    };
    steppers(&smallest).into_iter().map(run).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn in_a_vacuum_no_digit_of_an_attitude_depends_on_drift_or_fall(sample in dry(), gravity in vector(10.0)) {
        let still = runs(&scene(&sample, StartVelocity::Given([0.0; 3])));
        let mut heavy = sample.clone();
        heavy.weight = Some((gravity, heavy.bodies.iter().map(|body| body.mass[(0, 0)]).collect()));
        let mass: f64 = heavy.bodies.iter().map(|body| body.mass[(0, 0)]).sum();
        let (rest, drift) = ([0.0; 3], [7600.0, 0.0, -20.0]);
        for (sample, velocity) in [(&sample, drift), (&heavy, rest), (&heavy, drift)] {
            let moving = runs(&scene(sample, StartVelocity::Given(velocity)));
            let model = &sample.model;
            for ((a, iterations), (b, expected)) in moving.iter().zip(&still) {
                prop_assert_eq!(&a.g.0, &b.g.0);
                prop_assert_eq!(iterations, expected);
                // Places differ by the drift and the fall; rounding of what the drift is.
                let fall = heavy.weight.as_ref().filter(|_| sample.weight.is_some()).map_or(Vec3::zero(), |w| w.0);
                let way = Vec3(velocity) * a.t + fall * (0.5 * a.t * a.t);
                assert_close(&(a.g.1[0].vec3() - b.g.1[0].vec3()).0, &way.0, 1e-12 + 1e-14 * way.norm() * mass.max(1.0));
                prop_assert!(model.conserved(a).is_ok());
            }
        }
    }

    #[test]
    fn a_scene_in_another_order_moves_alike(sample in dry(), place in any::<prop::sample::Index>(), wet in any::<bool>()) {
        let bodies = sample.bodies.len();
        let mut sample = sample;
        let heaviest = place.index(bodies);
        sample.bodies[heaviest].mass = sample.bodies[heaviest].mass * 20.0;
        if wet {
            sample.bodies.iter_mut().for_each(|body| body.mass[(1, 1)] *= 1.5);
        }
        let sample = sample.rebuilt();
        let listed = scene(&sample, StartVelocity::Given(sample.xi.1[0].0));
        for first in 0..bodies {
            let (turned, order) = hung_on(&listed, &sample, first);
            for ((a, _), (b, _)) in runs(&turned).iter().zip(&runs(&listed)) {
                for (r, i) in a.g.0.iter().zip(&order) {
                    assert_close(&r.matrix().0.concat(), &b.g.0[*i].matrix().0.concat(), 1e-11);
                }
                let centres = sample.centres(&b.g);
                assert_close(&a.g.1[0].0, &centres[first].0, 1e-10);
            }
        }
    }
}

/// The scene with `first` listed first and the others in the order of a walk from there, and the order.
fn hung_on(listed: &Scene, sample: &Sample, first: usize) -> (Scene, Vec<usize>) {
    let (mut order, mut joints) = (vec![first], vec![]);
    let mut next = 0;
    while next < order.len() {
        let at = order[next];
        for joint in &listed.joints {
            let reversed = SceneJoint {
                parent: joint.child,
                child: joint.parent,
                at_parent: joint.at_child,
                at_child: joint.at_parent,
                ..joint.clone()
            };
            for joint in [joint.clone(), reversed] {
                if joint.parent == at && !order.contains(&joint.child) {
                    order.push(joint.child);
                    let child = order.len() - 1;
                    joints.push(SceneJoint {
                        parent: next,
                        child,
                        ..joint
                    });
                }
            }
        }
        next += 1;
    }
    let turned = Scene {
        bodies: order.iter().map(|i| listed.bodies[*i].clone()).collect(),
        joints,
        position: sample.centres(&sample.g)[first].0,
        velocity: StartVelocity::Given(sample.centre_velocities()[first].0),
        ..listed.clone()
    };
    (turned, order)
}

fn parse(text: &str) -> Scene {
    Scene::parse(text, "scene.toml").expect("a scene")
}

#[test]
fn a_drift_along_the_normal_is_no_violation_in_a_vacuum() {
    let text = |density: f64| {
        format!(
            "gravity = [0, 1, -9.81]
             [fluid]
             density = {density:?}
             [start]
             velocity = [1, 2, 7600]
             [[body]]
             name = 'stone'
             semi_axes = [3, 2, 1]
             mass = 5
             angular_velocity = [0, 0, 1]"
        )
    };
    let plane = |density: f64| parse(&text(density)).smallest().expect("a model").plane;
    assert_eq!(plane(0.0).expect("a plane").normal(), Vec3([0.0, 0.0, 1.0]));
    assert!(plane(1e-3).is_none());
}

#[test]
fn a_trace_of_spin_out_of_the_plane_is_stepped_in_space() {
    let scene = |wx: f64| {
        parse(&format!(
            "[fluid]
             density = 1000
             [[body]]
             name = 'a'
             semi_axes = [0.3, 0.1, 0.2]
             angular_velocity = [{wx:e}, 0, 1]
             [[body]]
             name = 'b'
             semi_axes = [0.2, 0.1, 0.1]
             [[joint]]
             parent = 'a'
             child = 'b'
             at_parent = [0.35, 0, 0]
             at_child = [-0.25, 0, 0]"
        ))
    };
    assert!(scene(0.0).smallest().expect("a model").plane.is_some());
    let smallest = scene(1e-12).smallest().expect("a model");
    assert!(smallest.plane.is_none());
    let told = smallest
        .account
        .reductions
        .iter()
        .find(|r| r.name == "plane")
        .expect("a plane");
    assert!(
        !told.taken && told.why.contains("angular velocity"),
        "{}",
        told.why
    );
}

#[test]
fn neutral_is_what_the_numbers_of_the_file_make_neutral() {
    let net = |mass: &str| {
        let text = format!(
            "gravity = [0, 0, -9.81]
             [fluid]
             density = 1000
             [[body]]
             name = 'float'
             mass = {mass}
             inertia = [1, 1, 1]
             volume = 0.0123"
        );
        let scene = parse(&text);
        (
            scene.bodies[0].net_mass,
            scene.model().expect("a model").gravity(),
        )
    };
    assert_eq!(net("12.3"), (0.0, None));
    let (mass, gravity) = net("12.3000000000123");
    assert!((mass / 12.3e-12 - 1.0).abs() < 1e-3, "{mass:e}");
    assert!(gravity.is_some());
}
