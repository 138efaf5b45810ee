//! Scene files: what is read, and what each mistake is told.

mod bodies;
mod joints;
mod overlaps;
mod published;
mod random;
mod start;
mod text;
mod values;

use articulated_fluid::scene::{EXAMPLE, KEYS, Scene, SceneError, StartVelocity};

const GOOD: &str = r#"title = "a head and two tails"
[fluid]
density = 1000
[start]
position = [1, 2, 3]
velocity = [0.5, 0, -1]
[[body]]
name = "head"
semi_axes = [0.8, 0.15, 0.2]
mass = 90
attitude = [0, 1, 0, 0]
angular_velocity = [1, 2, 3]
[[body]]
name = "tail-1"
total_mass = [1, 2, 3]
total_inertia = [[2, 0.5, 0], [0.5, 2, 0], [0, 0, 1]]
[[body]]
name = "tail_2"
semi_axes = [1, 2, 3]
[[joint]]
parent = "head"
child = "tail_2"
at_parent = [-1, 0, 0]
at_child = [2, 0, 0]
[[joint]]
parent = "head"
child = "tail-1"
at_parent = [1, 0, 0]
at_child = [-2, 0, 0.5]
stiffness = 2.5
"#;

/// One mistake: the text to be replaced in [`GOOD`], the replacement, and the whole message.
type Mistake<'a> = (&'a str, &'a str, &'a str);

/// The scene of a `text` without mistake.
#[track_caller]
fn parse(text: &str) -> Scene {
    Scene::parse(text, "f.toml").unwrap_or_else(|error| panic!("{error}"))
}

fn refusal(text: &str) -> SceneError {
    Scene::parse(text, "f.toml").expect_err("a mistake")
}

#[track_caller]
fn assert_refused(mistakes: &[Mistake]) {
    for (old, new, expected) in mistakes {
        assert_eq!(GOOD.matches(old).count(), 1, "{old:?} is not unique");
        let message = refusal(&GOOD.replace(old, new)).to_string();
        assert_eq!(message, *expected, "after {old:?} -> {new:?}");
    }
}

fn diagonal(matrix: [[f64; 3]; 3]) -> [f64; 3] {
    [matrix[0][0], matrix[1][1], matrix[2][2]]
}

#[test]
fn every_key_is_read() {
    let scene = parse(GOOD);
    assert_eq!(scene.title.as_deref(), Some("a head and two tails"));
    assert_eq!(scene.density, 1000.0);
    assert_eq!(scene.position, [1.0, 2.0, 3.0]);
    assert_eq!(scene.velocity, StartVelocity::Given([0.5, 0.0, -1.0]));
    let [head, tail_1, tail_2] = &scene.bodies[..] else {
        panic!("three bodies");
    };
    assert_eq!(head.name, "head");
    assert_eq!(head.semi_axes(), Some([0.8, 0.15, 0.2]));
    assert_eq!(head.attitude, [0.0, 1.0, 0.0, 0.0]);
    assert_eq!(head.angular_velocity, [1.0, 2.0, 3.0]);
    assert_eq!(tail_1.semi_axes(), None);
    assert_eq!(diagonal(tail_1.total_mass), [1.0, 2.0, 3.0]);
    let inertia = [[2.0, 0.5, 0.0], [0.5, 2.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(tail_1.total_inertia, inertia);
    assert_eq!(tail_2.attitude, [1.0, 0.0, 0.0, 0.0]);
    assert_eq!(tail_2.angular_velocity, [0.0; 3]);
    let [first, second] = &scene.joints[..] else {
        panic!("two joints");
    };
    assert_eq!((first.parent, first.child), (0, 2));
    assert_eq!((second.parent, second.child), (0, 1));
    assert_eq!(second.at_parent, [1.0, 0.0, 0.0]);
    assert_eq!(second.at_child, [-2.0, 0.0, 0.5]);
    assert_eq!(
        (first.mobility.stiffness, second.mobility.stiffness),
        (0.0, 2.5)
    );
}

#[test]
fn the_example_is_a_scene_with_every_key() {
    Scene::parse(EXAMPLE, "example.toml").unwrap_or_else(|error| panic!("{error}"));
    for key in KEYS {
        let name = key.path.rsplit('.').next().expect("a name");
        assert!(EXAMPLE.contains(name), "{name}");
    }
}

#[test]
fn a_body_alone_in_a_vacuum_starts_at_rest_at_the_origin() {
    let text = "fluid.density = 0\nbody = [{name = 'a', semi_axes = [1, 1, 1], mass = 5}]";
    let scene = parse(text);
    assert_eq!(scene.title, None);
    assert_eq!(scene.joints, []);
    assert_eq!(scene.gravity, [0.0; 3]);
    assert_eq!(scene.position, [0.0; 3]);
    assert_eq!(scene.velocity, StartVelocity::Given([0.0; 3]));
    assert_eq!(scene.bodies[0].net_mass, 5.0);
    assert_eq!(diagonal(scene.bodies[0].total_mass), [5.0; 3]);
    assert_eq!(diagonal(scene.bodies[0].total_inertia), [2.0; 3]);
}
