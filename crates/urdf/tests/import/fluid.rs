//! What the fluid adds, against the energy of each ellipsoid on its own.

use std::f64::consts::PI;

use articulated_fluid::Ellipsoid;
use articulated_fluid::scene::SceneBody;
use lie::{Mat3, Vec3};
use proptest::prelude::*;
use urdf::{Note, Options, ShapeFrom, import};

use crate::robot::{Origin, origin, robot, xml};

const DENSITY: f64 = 1000.0;

/// Twice the kinetic energy of a body with its fluid, at a velocity and a rate in its frame.
fn energy(body: &SceneBody, v: Vec3, w: Vec3) -> f64 {
    let (m, j, c) = (
        Mat3(body.total_mass),
        Mat3(body.total_inertia),
        Mat3(body.coupling),
    );
    v.dot(m * v) + w.dot(j * w) + 2.0 * v.dot(c * w)
}

/// The same of what an ellipsoid adds at `at`, with this mass centre.
fn added(axes: [f64; 3], at: &Origin, centre: Vec3, [v, w]: [Vec3; 2]) -> f64 {
    let (ellipsoid, frame) = (Ellipsoid::new(axes).unwrap(), at.frame());
    let velocity = v + w.cross(frame.at - centre);
    let [v, w] = [velocity, w].map(|x| frame.turn.transpose() * x);
    let pair = |diagonal, x: Vec3| x.dot(Mat3::diagonal(diagonal) * x);
    pair(ellipsoid.added_mass(DENSITY), v) + pair(ellipsoid.added_inertia(DENSITY), w)
}

/// A collision shape with the semi-axes of its ellipsoid: of the same volume, with the same ratios of the mean squares.
fn shape() -> impl Strategy<Value = (String, [f64; 3])> {
    let length = || 0.05..0.5;
    let cuboid = [length(), length(), length()].prop_map(|l| {
        let [x, y, z] = l;
        let axes = l.map(|x| 0.5 * x * (6.0 / PI).cbrt());
        (format!(r#"<box size="{x:?} {y:?} {z:?}"/>"#), axes)
    });
    let cylinder = (length(), length()).prop_map(|(r, l)| {
        let scale = (3.0 * 12.0_f64.sqrt()).cbrt();
        let axes = [r / 2.0, r / 2.0, l / 12.0_f64.sqrt()].map(|x| x * scale);
        (
            format!(r#"<cylinder radius="{r:?}" length="{l:?}"/>"#),
            axes,
        )
    });
    let ball = length().prop_map(|r| (format!(r#"<sphere radius="{r:?}"/>"#), [r; 3]));
    // Of no length it is a ball.
    let capsule =
        length().prop_map(|r| (format!(r#"<capsule radius="{r:?}" length="0"/>"#), [r; 3]));
    prop_oneof![cuboid, cylinder, ball, capsule]
}

fn robot_of(collisions: &str) -> String {
    format!(
        r#"<robot name="r"><link name="l"><inertial><origin xyz="0.1 0.2 -0.1" rpy="1 2 3"/><mass value="2"/>
        <inertia ixx="0.2" iyy="0.3" izz="0.4" ixy="0.01" ixz="0.02" iyz="0.03"/></inertial>{collisions}</link></robot>"#
    )
}

fn options(shape_from: ShapeFrom) -> Options {
    Options {
        density: DENSITY,
        shape_from,
        ..Options::default()
    }
}

proptest! {
    #[test]
    fn each_collision_shape_adds_its_energy(
        shapes in prop::collection::vec((shape(), origin()), 1..4),
        v in [-1.0..1.0, -1.0..1.0, -1.0..1.0],
        w in [-1.0..1.0, -1.0..1.0, -1.0..1.0],
    ) {
        let collision = |((shape, _), at): &((String, _), Origin)| {
            format!("<collision>{}<geometry>{shape}</geometry></collision>", at.xml())
        };
        let text = robot_of(&shapes.iter().map(collision).collect::<String>());
        let dry = import(&text, &Options::default()).unwrap().scene;
        let wet = import(&text, &options(ShapeFrom::Collision)).unwrap();
        prop_assert!(wet.notes.is_empty());
        let (centre, motion) = (Vec3([0.1, 0.2, -0.1]), [Vec3(v), Vec3(w)]);
        let own = energy(&dry.bodies[0], motion[0], motion[1]);
        let of = |((_, axes), at): &((_, [f64; 3]), Origin)| added(*axes, at, centre, motion);
        let expected = own + shapes.iter().map(of).sum::<f64>();
        let found = energy(&wet.scene.bodies[0], motion[0], motion[1]);
        prop_assert!((found - expected).abs() < 1e-12 * expected.max(1.0), "{found} {expected}");

        // Buoyancy: what is displaced, where it is.
        let body = &wet.scene.bodies[0];
        let volume = |(_, [a, b, c]): &(_, [f64; 3])| 4.0 / 3.0 * PI * a * b * c;
        let displaced: f64 = shapes.iter().map(|(shape, _)| DENSITY * volume(shape)).sum();
        prop_assert!((2.0 - body.net_mass - displaced).abs() < 1e-12 * displaced.max(1.0));
        let moment = |sum, (shape, at): &(_, Origin)| sum + (Vec3(at.xyz) - centre) * (DENSITY * volume(shape));
        let moment = shapes.iter().fold(Vec3::zero(), moment);
        prop_assert!((Vec3(body.buoyancy_at) * displaced - moment).norm() < 1e-12 * displaced.max(1.0));
    }

    /// The inertias of random robots are those of ellipsoids.
    #[test]
    fn an_inertia_gives_its_ellipsoid(links in robot(), is_asked: bool) {
        let link = &links[..1];
        let shape_from = if is_asked { ShapeFrom::Inertia } else { ShapeFrom::Collision };
        let dry = import(&xml(link, ""), &Options::default()).unwrap().scene;
        let wet = import(&xml(link, ""), &options(shape_from)).unwrap().scene;
        let (centre, motion) = (Vec3(link[0].centre.xyz), [Vec3([1.0, -0.5, 0.3]), Vec3([0.2, 0.4, -0.7])]);
        let own = energy(&dry.bodies[0], motion[0], motion[1]);
        let expected = own + added(link[0].semi_axes, &link[0].centre, centre, motion);
        let found = energy(&wet.bodies[0], motion[0], motion[1]);
        // The added inertia of a nearly round section loses digits of its own.
        prop_assert!((found - expected).abs() < 1e-9 * expected, "{found} {expected}");
    }
}

#[test]
fn what_is_not_a_shape_is_noted() {
    let mesh = r#"<collision><geometry><mesh filename="m.stl"/></geometry></collision>"#;
    let notes = |text: &str| import(text, &options(ShapeFrom::Collision)).unwrap().notes;
    let links = vec!["l".to_owned()];
    assert_eq!(
        notes(&robot_of(mesh)),
        [Note::Meshes {
            links: links.clone()
        }]
    );
    let sphere = r#"<collision><geometry><sphere radius="0.1"/></geometry></collision>"#;
    assert_eq!(notes(&robot_of(&(mesh.to_owned() + sphere))), []);
    let sheet = r#"<robot name="r"><link name="l"><inertial><mass value="1"/>
        <inertia ixx="1" iyy="1" izz="2" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"#;
    assert_eq!(notes(sheet), [Note::Thin { links }]);
}
