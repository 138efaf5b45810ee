//! What may be changed of a scene without a change of its motion.

use articulated_fluid::Scene;
use articulated_fluid::scene::{Form, SceneJoint, StartVelocity};
use lie::{LieGroup, SO3, Vec3};

/// Factors of the units of length, mass and time.
#[derive(Clone, Copy)]
pub struct Units {
    pub length: f64,
    pub mass: f64,
    pub time: f64,
}

fn scaled<const N: usize>(x: [f64; N], factor: f64) -> [f64; N] {
    x.map(|x| x * factor)
}

impl Units {
    /// The same scene with other numbers.
    pub fn of(self, scene: &Scene) -> Scene {
        let Self { length, mass, time } = self;
        let mut scene = scene.clone();
        let inertia = mass * length * length;
        scene.gravity = scaled(scene.gravity, length / (time * time));
        scene.density *= mass / (length * length * length);
        scene.position = scaled(scene.position, length);
        scene.velocity = velocity(&scene, |v| v * (length / time));
        for body in &mut scene.bodies {
            body.form = match body.form {
                Form::Ellipsoid {
                    semi_axes,
                    mass: own,
                } => Form::Ellipsoid {
                    semi_axes: scaled(semi_axes, length),
                    mass: own * mass,
                },
                Form::Given {
                    shape,
                    mass: own,
                    inertia: about,
                } => Form::Given {
                    shape: shape.map(|axes| scaled(axes, length)),
                    mass: own.map(|own| own * mass),
                    inertia: about.map(|about| about.map(|row| scaled(row, inertia))),
                },
            };
            body.total_mass = body.total_mass.map(|row| scaled(row, mass));
            body.total_inertia = body.total_inertia.map(|row| scaled(row, inertia));
            body.net_mass *= mass;
            body.angular_velocity = scaled(body.angular_velocity, 1.0 / time);
        }
        for joint in &mut scene.joints {
            joint.at_parent = scaled(joint.at_parent, length);
            joint.at_child = scaled(joint.at_child, length);
            joint.mobility.stiffness *= inertia / (time * time);
        }
        scene
    }
}

fn velocity(scene: &Scene, change: impl Fn(Vec3) -> Vec3) -> StartVelocity {
    match scene.velocity {
        StartVelocity::Given(v) => StartVelocity::Given(change(Vec3(v)).0),
        floats => floats,
    }
}

/// Somewhere else.
pub fn moved(scene: &Scene, by: Vec3) -> Scene {
    let mut scene = scene.clone();
    scene.position = (Vec3(scene.position) + by).0;
    scene
}

/// In a frame that moves.
pub fn drifting(scene: &Scene, by: Vec3) -> Scene {
    let mut scene = scene.clone();
    scene.velocity = velocity(&scene, |v| v + by);
    scene
}

/// The whole, and gravity, turned.
pub fn turned(scene: &Scene, by: &SO3) -> Scene {
    let mut scene = scene.clone();
    let turn = |x: [f64; 3]| by.rotate(Vec3(x)).0;
    scene.gravity = turn(scene.gravity);
    scene.position = turn(scene.position);
    scene.velocity = velocity(&scene, |v| by.rotate(v));
    for body in &mut scene.bodies {
        let attitude = by.compose(&SO3::from_quaternion(body.attitude));
        body.attitude = attitude.to_quaternion();
    }
    scene
}

/// The bodies in the order `order`, in which a parent may follow its child: the joint is hung the other way then.
///
/// The head's position and velocity are those of the new first body.
pub fn reordered(scene: &Scene, order: &[usize]) -> Scene {
    let mut place = vec![0; order.len()];
    for (now, before) in order.iter().enumerate() {
        place[*before] = now;
    }
    let mut other = scene.clone();
    other.bodies = order.iter().map(|i| scene.bodies[*i].clone()).collect();
    other.joints = scene
        .joints
        .iter()
        .map(|joint| hung(joint, &place))
        .collect();
    let (position, velocity) = motion_of(scene, order[0]);
    (other.position, other.velocity) = (position.0, StartVelocity::Given(velocity.0));
    other
}

fn hung(joint: &SceneJoint, place: &[usize]) -> SceneJoint {
    let (parent, child) = (place[joint.parent], place[joint.child]);
    let same = SceneJoint {
        parent,
        child,
        ..joint.clone()
    };
    match parent < child {
        true => same,
        false => SceneJoint {
            parent: child,
            child: parent,
            at_parent: joint.at_child,
            at_child: joint.at_parent,
            ..joint.clone()
        },
    }
}

/// Where the mass centre of a body is, and how fast it moves; the head's velocity is given.
fn motion_of(scene: &Scene, body: usize) -> (Vec3, Vec3) {
    let on = scene.joints.iter().find(|joint| joint.child == body);
    let StartVelocity::Given(v) = scene.velocity else {
        panic!("a random scene has a velocity");
    };
    let Some(joint) = on else {
        return (Vec3(scene.position), Vec3(v));
    };
    let (x, v) = motion_of(scene, joint.parent);
    let lever = |body: usize, at: [f64; 3]| {
        let body = &scene.bodies[body];
        let r: SO3 = SO3::from_quaternion(body.attitude);
        let swept = Vec3(body.angular_velocity).cross(Vec3(at));
        (r.rotate(Vec3(at)), r.rotate(swept))
    };
    let ((a, va), (b, vb)) = (
        lever(joint.parent, joint.at_parent),
        lever(body, joint.at_child),
    );
    (x + a - b, v + va - vb)
}

/// An order that begins with `first`, each further body next to one before it: another root where `first` is not 0, other siblings else.
pub fn order_from(scene: &Scene, first: usize) -> Vec<usize> {
    let neighbours = |body: usize| {
        let joints = scene.joints.iter().rev();
        joints.filter_map(move |joint| match (joint.parent, joint.child) {
            (parent, child) if parent == body => Some(child),
            (parent, child) if child == body => Some(parent),
            _ => None,
        })
    };
    let mut order = vec![first];
    let mut next = 0;
    while next < order.len() {
        let more: Vec<_> = neighbours(order[next])
            .filter(|body| !order.contains(body))
            .collect();
        order.extend(more);
        next += 1;
    }
    order
}
