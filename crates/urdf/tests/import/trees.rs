//! Masses, mass centres, inertias and joints of random trees in the zero pose.

use articulated_fluid::{JointKind, Scene};
use lie::{Mat3, SO3, Vec3};
use proptest::prelude::*;
use urdf::{Base, Note, Options, import};

use crate::robot::{Frame, Link, Origin, frames, origin, robot, sum, totals, xml};

/// Numbers of size 1 to 10, some tens of operations.
const ROUNDING: f64 = 1e-13;

const WORLD: Frame = Frame {
    turn: Mat3([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    at: Vec3([0.0; 3]),
};

fn scene(text: &str) -> Scene {
    import(text, &Options::default()).unwrap().scene
}

fn turn(attitude: [f64; 4]) -> Mat3 {
    *SO3::from_quaternion(attitude).matrix()
}

/// Where the bodies' mass centres are at the start.
fn centres(scene: &Scene) -> Vec<Vec3> {
    let (model, start) = (scene.model().unwrap(), scene.initial_state().unwrap());
    model.centre_positions(0.0, &start.g).unwrap()
}

fn totals_of(scene: &Scene) -> (f64, Vec3, Mat3) {
    let bodies = scene.bodies.iter().zip(centres(scene));
    let placed = bodies.map(|(body, at)| {
        let r = turn(body.attitude);
        let inertia = r * Mat3(body.total_inertia) * r.transpose();
        (body.mass().unwrap(), at, inertia)
    });
    sum(&placed.collect::<Vec<_>>())
}

/// The frames that the joints of a scene make: place and axis in the world, by name.
fn joints(scene: &Scene) -> Vec<(String, Vec3, Option<Vec3>)> {
    let centres = centres(scene);
    let joints = scene.joints.iter().map(|joint| {
        let (parent, child) = (&scene.bodies[joint.parent], &scene.bodies[joint.child]);
        let place = centres[joint.parent] + turn(parent.attitude) * Vec3(joint.at_parent);
        let again = centres[joint.child] + turn(child.attitude) * Vec3(joint.at_child);
        assert!((place - again).norm() < ROUNDING);
        let axis = match &joint.mobility.kind {
            JointKind::Hinge(hinge) => Some(turn(child.attitude) * hinge.axis),
            _ => None,
        };
        (joint.name.clone(), place, axis)
    });
    joints.collect()
}

fn assert_same(scene: &Scene, links: &[Link], frames: &[Frame]) -> Result<(), TestCaseError> {
    let (mass, centre, inertia) = totals(links, frames);
    let (own_mass, own_centre, own_inertia) = totals_of(scene);
    prop_assert!((own_mass - mass).abs() < ROUNDING * mass);
    prop_assert!(
        (own_centre - centre).norm() < ROUNDING,
        "{own_centre:?} {centre:?}"
    );
    let size = inertia.frobenius();
    prop_assert!((own_inertia - inertia).frobenius() < ROUNDING * size);
    Ok(())
}

/// One body for all links that are fixed to each other.
fn moving(links: &[Link]) -> impl Iterator<Item = (usize, &Link)> {
    links
        .iter()
        .enumerate()
        .skip(1)
        .filter(|(_, link)| link.kind != "fixed")
}

proptest! {
    #[test]
    fn the_scene_has_the_mass_and_the_inertia_of_the_robot(links in robot()) {
        let scene = scene(&xml(&links, ""));
        prop_assert_eq!(scene.bodies.len(), 1 + moving(&links).count());
        assert_same(&scene, &links, &frames(&links, WORLD))?;
    }

    #[test]
    fn joints_are_where_the_robot_has_them(links in robot()) {
        let (scene, frames) = (scene(&xml(&links, "")), frames(&links, WORLD));
        let joints = joints(&scene);
        prop_assert_eq!(joints.len(), moving(&links).count());
        for (i, link) in moving(&links) {
            let name = format!("j{i}");
            let (_, place, axis) = joints.iter().find(|(n, ..)| *n == name).unwrap();
            prop_assert!((*place - frames[i].at).norm() < ROUNDING);
            let is_ball = link.kind == "spherical";
            prop_assert_eq!(axis.is_none(), is_ball);
            if let Some(axis) = axis {
                let own = Vec3(link.axis);
                let own = frames[i].turn * (own * (1.0 / own.norm()));
                prop_assert!((*axis - own).norm() < ROUNDING);
            }
        }
    }

    #[test]
    fn dampers_stay_and_limits_are_noted(links in robot()) {
        let imported = import(&xml(&links, ""), &Options::default()).unwrap();
        for (i, link) in moving(&links) {
            let joints = &imported.scene.joints;
            let joint = joints.iter().find(|joint| joint.name == format!("j{i}")).unwrap();
            prop_assert_eq!(joint.mobility.load.damping, link.damping);
        }
        let limited = imported.notes.iter().find_map(|note| match note {
            Note::Limits { joints } => Some(joints.len()),
            _ => None,
        });
        prop_assert_eq!(limited.unwrap_or(0), moving(&links).count());
    }

    /// All that tells where the robot is are the start and the attitudes of what does not hang on a hinge.
    #[test]
    fn a_robot_that_stands_elsewhere_is_the_same(links in robot(), place in origin()) {
        let floating = format!(
            r#"<link name="world"/><joint name="f" type="floating">{}<parent link="world"/><child link="l0"/></joint>"#,
            place.xml()
        );
        let (here, there) = (scene(&xml(&links, "")), scene(&xml(&links, &floating)));
        prop_assert_eq!(&here.joints, &there.joints);
        assert_same(&there, &links, &frames(&links, place.frame()))?;
        for (mut a, b) in here.bodies.into_iter().zip(there.bodies) {
            let turned = place.frame().turn * turn(a.attitude);
            prop_assert!((turned - turn(b.attitude)).frobenius() < ROUNDING);
            a.attitude = b.attitude;
            prop_assert_eq!(a, b);
        }
    }

    /// On a base of its own, or held by the root link.
    #[test]
    fn a_robot_on_the_world_is_the_same(links in robot(), place in origin()) {
        let free = scene(&xml(&links, ""));
        let held = Options { base: Some(Base::World), ..Options::default() };
        let held = import(&xml(&links, ""), &held).unwrap().scene;
        prop_assert_eq!(&held.bodies, &free.bodies);
        prop_assert_eq!(&held.joints, &free.joints);
        prop_assert!(held.mount.is_some());
        assert_same(&held, &links, &frames(&links, WORLD))?;
        let on_world = format!(
            r#"<link name="world"/><joint name="f" type="continuous">{}<parent link="world"/><child link="l0"/><axis xyz="0 1 0"/></joint>"#,
            place.xml()
        );
        let hung = scene(&xml(&links, &on_world));
        prop_assert_eq!(&hung.joints, &free.joints);
        assert_same(&hung, &links, &frames(&links, place.frame()))?;
    }

    /// The order of a file means nothing.
    #[test]
    fn the_order_of_the_file_does_not_matter(links in robot()) {
        let text = xml(&links, "");
        let mut lines: Vec<&str> = text.lines().collect();
        let end = lines.len() - 1;
        lines[1..end].reverse();
        let (one, other) = (scene(&text), scene(&lines.join("\n")));
        assert_same(&other, &links, &frames(&links, WORLD))?;
        for body in &one.bodies {
            let same = other.bodies.iter().find(|b| b.name == body.name).unwrap();
            let apart = Mat3(body.total_inertia) - Mat3(same.total_inertia);
            prop_assert!(apart.frobenius() < ROUNDING);
        }
    }
}

#[test]
fn a_massless_root_with_several_joints_is_held_in_place_of_the_world() {
    let link = Link {
        parent: 0,
        kind: "continuous",
        origin: Origin {
            xyz: [0.0, 0.3, 0.0],
            rpy: [0.0; 3],
        },
        axis: [0.0, 0.0, 1.0],
        damping: 0.0,
        mass: 1.0,
        centre: Origin {
            xyz: [0.1, 0.0, 0.0],
            rpy: [0.0; 3],
        },
        semi_axes: [0.1; 3],
    };
    let root = Link {
        mass: 0.0,
        ..link.clone()
    };
    let scene = scene(&xml(&[root, link.clone(), link], ""));
    assert_eq!((scene.bodies.len(), scene.free_hinges().count()), (3, 2));
    assert!(scene.mount.is_some());
    let start = scene.initial_state().unwrap();
    assert_eq!(
        (start.g.0.len(), start.g.1.len(), start.g.2.len()),
        (0, 0, 2)
    );
}
