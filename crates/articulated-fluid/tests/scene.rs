//! Scene files: what is read, and what each mistake is told.

use std::path::{Path, PathBuf};

use articulated_fluid::ellipsoid::Ellipsoid;
use articulated_fluid::scene::{EXAMPLE, KEYS, Scene, SceneError};
use proptest::prelude::*;

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
"#;

/// One mistake: the text to be replaced in [`GOOD`], the replacement, and the whole message.
type Mistake = (&'static str, &'static str, &'static str);

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
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
    let scene = Scene::parse(GOOD, "f.toml").expect("a scene");
    assert_eq!(scene.title.as_deref(), Some("a head and two tails"));
    assert_eq!(scene.density, 1000.0);
    assert_eq!(scene.position, [1.0, 2.0, 3.0]);
    assert_eq!(scene.velocity, [0.5, 0.0, -1.0]);
    let [head, tail_1, tail_2] = &scene.bodies[..] else {
        panic!("three bodies");
    };
    assert_eq!(head.name, "head");
    assert_eq!(head.semi_axes, Some([0.8, 0.15, 0.2]));
    assert_eq!(head.attitude, [0.0, 1.0, 0.0, 0.0]);
    assert_eq!(head.angular_velocity, [1.0, 2.0, 3.0]);
    assert_eq!(tail_1.semi_axes, None);
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
fn the_totals_of_an_ellipsoid_are_its_own_and_the_added_inertia() {
    let scene = Scene::parse(GOOD, "f.toml").expect("a scene");
    for (index, mass) in [(0, Some(90.0)), (2, None)] {
        let body = &scene.bodies[index];
        let shape = Ellipsoid::new(body.semi_axes.expect("semi-axes")).expect("an ellipsoid");
        let mass = mass.unwrap_or(shape.neutral_mass(1000.0));
        let (dry, added) = (shape.dry_inertia(mass), shape.added_inertia(1000.0));
        let masses = shape.added_mass(1000.0).map(|added| mass + added);
        assert_eq!(diagonal(body.total_mass), masses);
        assert_eq!(
            diagonal(body.total_inertia),
            [0, 1, 2].map(|i| dry[i] + added[i])
        );
    }
}

#[test]
fn a_body_alone_in_a_vacuum_starts_at_rest_at_the_origin() {
    let text = "fluid.density = 0\nbody = [{name = 'a', semi_axes = [1, 1, 1], mass = 5}]";
    let scene = Scene::parse(text, "f.toml").expect("a scene");
    assert_eq!(scene.title, None);
    assert_eq!(scene.joints, []);
    assert_eq!((scene.position, scene.velocity), ([0.0; 3], [0.0; 3]));
    assert_eq!(diagonal(scene.bodies[0].total_mass), [5.0; 3]);
    assert_eq!(diagonal(scene.bodies[0].total_inertia), [2.0; 3]);
}

#[test]
fn an_attitude_is_normalised() {
    let text = GOOD.replace("[0, 1, 0, 0]", "[0.6, 0, 0, 0.8000005]");
    let scene = Scene::parse(&text, "f.toml").expect("a scene");
    let attitude = scene.bodies[0].attitude;
    let length = attitude.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!((length - 1.0).abs() < 4.0 * f64::EPSILON);
    assert!((attitude[0] - 0.6).abs() < 1e-6);
}

#[test]
fn a_matrix_symmetric_but_for_rounding_becomes_symmetric() {
    let text = GOOD.replace("[0.5, 2, 0]", "[0.5000000000000001, 2, 0]");
    let scene = Scene::parse(&text, "f.toml").expect("a scene");
    let inertia = scene.bodies[1].total_inertia;
    assert_eq!(inertia[0][1], inertia[1][0]);
}

#[test]
fn broken_syntax_is_refused() {
    assert_refused(&[
        (
            "mass = 90",
            "mass = ",
            "f.toml:10:8: mass: TOML syntax: string values must be quoted; expected literal string",
        ),
        (
            "mass = 90",
            "mass = 90 kg",
            "f.toml:10:8: mass: TOML syntax: string values must be quoted; expected literal string",
        ),
        (
            "mass = 90",
            "mass = 90\nmass = 91",
            "f.toml:11:1: mass: TOML syntax: duplicate key",
        ),
        (
            "[start]",
            "[fluid]",
            "f.toml:4:2: [fluid]: TOML syntax: duplicate key",
        ),
    ]);
    let error = refusal("[fluid").to_string();
    assert!(error.starts_with("f.toml:1:"), "{error}");
}

#[test]
fn unknown_keys_are_refused_with_the_allowed_ones() {
    assert_refused(&[
        (
            "mass = 90",
            "mas = 90",
            "f.toml:10:1: body.mas: unknown key; expected one of `name`, `semi_axes`, `mass`, \
             `total_mass`, `total_inertia`, `attitude`, `angular_velocity`",
        ),
        (
            "density = 1000",
            "density = 1000\n  viscosity = 1",
            "f.toml:4:3: fluid.viscosity: unknown key; expected `density`",
        ),
        (
            "[start]",
            "[begin]",
            "f.toml:4:1: begin: unknown key; expected one of `title`, `fluid`, `start`, `body`, \
             `joint`",
        ),
    ]);
}

#[test]
fn the_documented_keys_are_those_that_are_read() {
    for table in ["", "fluid.", "start.", "body.", "joint."] {
        let text = match table {
            "" => "x = 0".to_owned(),
            "fluid." | "start." => format!("{table}x = 0"),
            _ => format!("[[{}]]\nx = 0", table.trim_end_matches('.')),
        };
        let message = refusal(&text).to_string();
        let (_, listed) = message.split_once("expected ").expect("a list");
        let listed: Vec<&str> = listed.split('`').skip(1).step_by(2).collect();
        let documented: Vec<&str> = KEYS
            .iter()
            .filter_map(|key| key.path.strip_prefix(table))
            .filter(|key| !key.contains('.'))
            .collect();
        assert_eq!(listed, documented);
    }
}

#[test]
fn wrong_types_are_refused() {
    assert_refused(&[
        (
            "density = 1000",
            "density = \"water\"",
            "f.toml:3:1: fluid.density: wrong type: string \"water\"; \
             expected a finite number >= 0, in kg/m^3",
        ),
        (
            "\"a head and two tails\"",
            "3",
            "f.toml:1:1: title: wrong type: integer `3`; expected a string",
        ),
        (
            "position = [1, 2, 3]",
            "position = 1",
            "f.toml:5:1: start.position: wrong type: integer `1`; \
             expected an array of 3 finite numbers, in m",
        ),
        (
            "position = [1, 2, 3]",
            "position = [\n1,\ntrue,\n3]",
            "f.toml:5:1: start.position: wrong type: boolean `true`; \
             expected an array of 3 finite numbers, in m",
        ),
        (
            "position = [1, 2, 3]",
            "position = {x = 1}",
            "f.toml:5:1: start.position: wrong type: table; \
             expected an array of 3 finite numbers, in m",
        ),
        (
            "position = [1, 2, 3]",
            "position = 1979-05-27",
            "f.toml:5:1: start.position: wrong type: date or time; \
             expected an array of 3 finite numbers, in m",
        ),
        (
            "total_mass = [1, 2, 3]",
            "total_mass = [1, 'x', 3]",
            "f.toml:15:1: body.total_mass: wrong type; \
             expected an array of 3 numbers > 0 (diagonal) or of 3 rows of 3 numbers \
             (symmetric, positive definite), in kg",
        ),
    ]);
}

#[test]
fn tables_of_the_wrong_kind_are_refused() {
    for (text, expected) in [
        (
            "\nfluid = [1]",
            "f.toml:2:1: fluid: wrong type: array; expected one table [fluid]",
        ),
        (
            "fluid = 1979-05-27",
            "f.toml:1:1: fluid: wrong type: date or time; expected one table [fluid]",
        ),
        (
            "[[fluid]]",
            "f.toml:1:1: fluid: wrong type: array; expected one table [fluid]",
        ),
        (
            "[fluid]\n[body]",
            "f.toml:2:1: body: wrong type: table; expected one table [[body]] for each body",
        ),
        (
            "joint = [['head', 'tail', [1, 0, 0], [1, 0, 0]]]",
            "f.toml:1:1: joint: wrong type: array; \
             expected one table [[joint]] for each body but the first",
        ),
    ] {
        assert_eq!(refusal(text).to_string(), expected);
    }
}

#[test]
fn wrong_numbers_of_elements_are_refused() {
    assert_refused(&[
        (
            "position = [1, 2, 3]",
            "position = [1, 2, 3, 4]",
            "f.toml:5:1: start.position: has 4 elements; \
             expected an array of 3 finite numbers, in m",
        ),
        (
            "semi_axes = [1, 2, 3]",
            "semi_axes = [1]",
            "f.toml:19:1: body.semi_axes: has 1 element; \
             expected an array of 3 finite numbers > 0, in m",
        ),
        (
            "attitude = [0, 1, 0, 0]",
            "attitude = [0, 1, 0]",
            "f.toml:11:1: body.attitude: has 3 elements; expected an array of 4 numbers \
             w, x, y, z: a quaternion of length 1 (to 1e-6)",
        ),
        (
            "total_mass = [1, 2, 3]",
            "total_mass = []",
            "f.toml:15:1: body.total_mass: has 0 elements; expected an array of 3 numbers > 0 \
             (diagonal) or of 3 rows of 3 numbers (symmetric, positive definite), in kg",
        ),
        (
            "[0.5, 2, 0]",
            "[0.5, 2]",
            "f.toml:16:1: body.total_inertia: row 2 has 2 elements; expected an array of \
             3 numbers > 0 (diagonal) or of 3 rows of 3 numbers (symmetric, positive definite), \
             in kg m^2",
        ),
        (
            "[0.5, 2, 0]",
            "2",
            "f.toml:16:1: body.total_inertia: mixes numbers and rows; expected an array of \
             3 numbers > 0 (diagonal) or of 3 rows of 3 numbers (symmetric, positive definite), \
             in kg m^2",
        ),
    ]);
}

#[test]
fn what_is_not_finite_is_refused() {
    assert_refused(&[
        (
            "density = 1000",
            "density = nan",
            "f.toml:3:1: fluid.density: is NaN; expected a finite number >= 0, in kg/m^3",
        ),
        (
            "density = 1000",
            "density = inf",
            "f.toml:3:1: fluid.density: is inf; expected a finite number >= 0, in kg/m^3",
        ),
        (
            "density = 1000",
            "density = 1e999",
            "f.toml:3:1: fluid.density: floating-point number overflowed; \
             expected a finite number >= 0, in kg/m^3",
        ),
        (
            "position = [1, 2, 3]",
            "position = [1, nan, 3]",
            "f.toml:5:1: start.position: element 2 is NaN; \
             expected an array of 3 finite numbers, in m",
        ),
        (
            "velocity = [0.5, 0, -1]",
            "velocity = [0.5, 0, -inf]",
            "f.toml:6:1: start.velocity: element 3 is -inf; \
             expected an array of 3 finite numbers, in m/s",
        ),
        (
            "mass = 90",
            "mass = inf",
            "f.toml:10:1: body.mass: is inf; expected a finite number > 0, in kg",
        ),
        (
            "at_child = [2, 0, 0]",
            "at_child = [nan, 0, 0]",
            "f.toml:24:1: joint.at_child: element 1 is NaN; \
             expected an array of 3 finite numbers, in m",
        ),
        (
            "attitude = [0, 1, 0, 0]",
            "attitude = [0, nan, 0, 0]",
            "f.toml:11:1: body.attitude: element 2 is NaN; expected an array of 4 numbers \
             w, x, y, z: a quaternion of length 1 (to 1e-6)",
        ),
        (
            "total_mass = [1, 2, 3]",
            "total_mass = [1, 2, inf]",
            "f.toml:15:1: body.total_mass: element 3 is inf; expected an array of 3 numbers > 0 \
             (diagonal) or of 3 rows of 3 numbers (symmetric, positive definite), in kg",
        ),
    ]);
}

#[test]
fn values_out_of_range_are_refused() {
    assert_refused(&[
        (
            "density = 1000",
            "density = -1",
            "f.toml:3:1: fluid.density: is -1.0; expected a finite number >= 0, in kg/m^3",
        ),
        (
            "mass = 90",
            "mass = 0",
            "f.toml:10:1: body.mass: is 0.0; expected a finite number > 0, in kg",
        ),
        (
            "semi_axes = [0.8, 0.15, 0.2]",
            "semi_axes = [0.8, -0.15, 0.2]",
            "f.toml:9:1: body.semi_axes: the semi-axis along y is -0.15; \
             expected a finite number > 0, in m",
        ),
        (
            "semi_axes = [1, 2, 3]",
            "semi_axes = [1e200, 2, 3]",
            "f.toml:19:1: body.semi_axes: the volume of semi-axes [1e200, 2.0, 3.0] is out of \
             range; expected lengths between about 1e-60 and 1e60, in m",
        ),
        (
            "density = 1000",
            "density = 1e308",
            "f.toml:19:1: body.semi_axes: the body's mass or inertia is out of range; \
             expected less extreme numbers",
        ),
        (
            "attitude = [0, 1, 0, 0]",
            "attitude = [0, 1.5, 0, 0]",
            "f.toml:11:1: body.attitude: has length 1.5; expected an array of 4 numbers \
             w, x, y, z: a quaternion of length 1 (to 1e-6)",
        ),
        (
            "total_mass = [1, 2, 3]",
            "total_mass = [1, -2, 3]",
            "f.toml:15:1: body.total_mass: element 2 is -2.0; expected an array of 3 numbers > 0 \
             (diagonal) or of 3 rows of 3 numbers (symmetric, positive definite), in kg",
        ),
        (
            "[0.5, 2, 0]",
            "[0.6, 2, 0]",
            "f.toml:16:1: body.total_inertia: not symmetric: row 1 has 0.5 in column 2, row 2 has \
             0.6 in column 1; expected an array of 3 numbers > 0 (diagonal) or of 3 rows of \
             3 numbers (symmetric, positive definite), in kg m^2",
        ),
        (
            "[0.5, 2, 0]",
            "[0.5, 0.125, 0]",
            "f.toml:16:1: body.total_inertia: not positive definite: pivot 2 is 0.0; expected \
             an array of 3 numbers > 0 (diagonal) or of 3 rows of 3 numbers (symmetric, positive \
             definite), in kg m^2",
        ),
    ]);
}

#[test]
fn names_that_are_no_names_or_no_longer_free_are_refused() {
    assert_refused(&[
        (
            "name = \"tail-1\"",
            "name = \"\"",
            "f.toml:14:1: body.name: is \"\"; \
             expected a unique name of letters a-z A-Z, digits, - and _",
        ),
        (
            "name = \"tail-1\"",
            "name = \"tail,1\\n\"",
            "f.toml:14:1: body.name: is \"tail,1\\n\"; \
             expected a unique name of letters a-z A-Z, digits, - and _",
        ),
        (
            "name = \"tail-1\"",
            "name = \"head\"",
            "f.toml:14:1: body.name: \"head\" is the body in line 8; \
             expected a unique name of letters a-z A-Z, digits, - and _",
        ),
    ]);
}

#[test]
fn missing_keys_are_reported_at_their_table() {
    assert_refused(&[
        (
            "density = 1000\n",
            "",
            "f.toml:2:1: fluid.density: missing; expected a finite number >= 0, in kg/m^3",
        ),
        (
            "[fluid]\ndensity = 1000\n",
            "",
            "f.toml:1:1: fluid: missing; expected one table [fluid]",
        ),
        (
            "name = \"tail-1\"\n",
            "",
            "f.toml:13:1: body.name: missing; \
             expected a unique name of letters a-z A-Z, digits, - and _",
        ),
        (
            "total_mass = [1, 2, 3]\n",
            "",
            "f.toml:13:1: body.total_mass: missing; expected an array of 3 numbers > 0 \
             (diagonal) or of 3 rows of 3 numbers (symmetric, positive definite), in kg",
        ),
        (
            "semi_axes = [1, 2, 3]\n",
            "",
            "f.toml:17:1: body: no inertia; \
             expected the key semi_axes, or total_mass and total_inertia",
        ),
        (
            "density = 1000",
            "density = 0",
            "f.toml:17:1: body: no mass, and no neutral buoyancy at density 0; expected the key mass",
        ),
        (
            "parent = \"head\"\nchild = \"tail-1\"",
            "parent = \"head\"",
            "f.toml:25:1: joint.child: missing; expected the name of a body other than the first",
        ),
        (
            "at_parent = [1, 0, 0]\n",
            "",
            "f.toml:25:1: joint.at_parent: missing; expected an array of 3 finite numbers, in m",
        ),
    ]);
    let message = refusal("[fluid]\ndensity = 1\n").to_string();
    assert_eq!(
        message,
        "f.toml:1:1: body: missing; expected one table [[body]] for each body"
    );
}

#[test]
fn two_ways_to_give_the_inertia_are_refused() {
    assert_refused(&[
        (
            "mass = 90",
            "total_inertia = [1, 1, 1]",
            "f.toml:10:1: body.total_inertia: given together with semi_axes; \
             expected either semi_axes, or total_mass and total_inertia",
        ),
        (
            "total_mass = [1, 2, 3]",
            "mass = 3",
            "f.toml:15:1: body.mass: a mass without semi-axes; expected the key semi_axes as \
             well, or total_mass and total_inertia instead",
        ),
    ]);
}

#[test]
fn joints_that_make_no_star_are_refused() {
    assert_refused(&[
        (
            "child = \"tail-1\"",
            "child = \"tail-3\"",
            "f.toml:27:1: joint.child: no body is named \"tail-3\"; \
             expected one of head, tail-1, tail_2",
        ),
        (
            "parent = \"head\"\nchild = \"tail-1\"",
            "parent = \"nose\"\nchild = \"tail-1\"",
            "f.toml:26:1: joint.parent: no body is named \"nose\"; \
             expected one of head, tail-1, tail_2",
        ),
        (
            "parent = \"head\"\nchild = \"tail-1\"",
            "parent = \"tail_2\"\nchild = \"tail-1\"",
            "f.toml:26:1: joint.parent: a tail on a tail, i.e. a tree, is not supported by this \
             version; expected the first body, \"head\"",
        ),
        (
            "child = \"tail-1\"",
            "child = \"head\"",
            "f.toml:27:1: joint.child: \"head\" is the first body, on which the others hang; \
             expected the name of a body other than the first",
        ),
        (
            "child = \"tail-1\"",
            "child = \"tail_2\"",
            "f.toml:27:1: joint.child: the child of the joint in line 22 already; \
             expected one joint for each body but the first",
        ),
        (
            "[[joint]]\nparent = \"head\"\nchild = \"tail-1\"\nat_parent = [1, 0, 0]\n\
             at_child = [-2, 0, 0.5]\n",
            "",
            "f.toml:14:1: body.name: \"tail-1\" is the child of no joint; \
             expected a [[joint]] with child = \"tail-1\"",
        ),
    ]);
}

#[test]
fn the_place_is_counted_in_characters_after_windows_line_ends_too() {
    let text = "\u{feff}title = 'ω'\r\nfluid = { 'ρρ' = 1 }\r\n";
    let SceneError::Invalid {
        file,
        line,
        column,
        key,
        message,
    } = refusal(text)
    else {
        panic!("an invalid scene");
    };
    assert_eq!((file.as_str(), line, column), ("f.toml", 2, 11));
    assert_eq!(key, "fluid.ρρ");
    assert_eq!(message, "unknown key; expected `density`");
}

#[test]
fn a_message_stays_on_one_short_line() {
    let key = "x".repeat(10_000);
    for text in [
        format!("\"a\\nb\\u001b{key}\" = 1"),
        format!("title = 1\n{key}"),
        format!("fluid.density = \"{key}\\n\""),
    ] {
        let message = refusal(&text).to_string();
        assert!(message.chars().count() < 500, "{message}");
        assert!(!message.contains(char::is_control), "{message:?}");
    }
}

#[test]
fn deep_nesting_is_refused() {
    for (open, close) in [("[", "]"), ("{a=", "}"), ("a.", "a = 1"), ("[a.", "a]")] {
        for depth in [10, 1000, 100_000] {
            let (open, close) = (open.repeat(depth), close.repeat(depth));
            check(&format!("title = {open}1{close}")).expect("an error");
            check(&format!("{open}{close}")).expect("an error");
        }
        check(&format!("{}a = 1", open.repeat(100_000))).expect("an error");
    }
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    let path = Path::new("no-such-directory/no-such-scene.toml");
    let error = Scene::load(path).expect_err("no file");
    let SceneError::Io { file, source } = &error else {
        panic!("{error}");
    };
    assert_eq!(file, "no-such-directory/no-such-scene.toml");
    assert_eq!(source.kind(), std::io::ErrorKind::NotFound);
    let message = error.to_string();
    assert!(message.contains("no-such-scene.toml: cannot be read: "));
    assert!(message.contains(&source.to_string()));
}

#[test]
fn every_scene_of_the_collection_is_read() {
    let mut count = 0;
    for entry in std::fs::read_dir(scenes()).expect("the scenes") {
        let path = entry.expect("an entry").path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let scene = Scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
            assert!(scene.title.is_some(), "{}", path.display());
            count += 1;
        }
    }
    assert!(count >= 3);
}

#[test]
fn the_printed_fish_follows_from_its_semi_axes() {
    let load = |file: &str| Scene::load(&scenes().join(file)).unwrap_or_else(|e| panic!("{e}"));
    let (printed, computed) = (
        load("fish-chain.toml"),
        load("fish-chain-from-semi-axes.toml"),
    );
    assert_eq!(printed.joints, computed.joints);
    assert_eq!(printed.velocity, computed.velocity);
    assert_eq!(printed.density, 1.0 / (32.0 * std::f64::consts::PI));
    assert_eq!(printed.density, computed.density);
    for (printed, computed) in printed.bodies.iter().zip(&computed.bodies) {
        assert_eq!(printed.name, computed.name);
        assert_eq!(printed.angular_velocity, computed.angular_velocity);
        for (table, value) in [
            (printed.total_mass, computed.total_mass),
            (printed.total_inertia, computed.total_inertia),
        ] {
            for (table, value) in diagonal(table).into_iter().zip(diagonal(value)) {
                assert_eq!(table, (value * 1e4).round() / 1e4);
            }
        }
    }
}

#[test]
fn the_printed_fish_has_no_linear_momentum() {
    let fish = Scene::load(&scenes().join("fish-chain.toml")).unwrap_or_else(|e| panic!("{e}"));
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [[1, 2], [2, 0], [0, 1]].map(|[i, j]: [usize; 2]| a[i] * b[j] - a[j] * b[i])
    };
    let head = &fish.bodies[0];
    let mass = diagonal(head.total_mass);
    let mut momentum = [0, 1, 2].map(|i| mass[i] * fish.velocity[i]);
    for joint in &fish.joints {
        let tail = &fish.bodies[joint.child];
        let mass = diagonal(tail.total_mass);
        let before = cross(head.angular_velocity, joint.at_parent);
        let behind = cross(tail.angular_velocity, joint.at_child);
        for i in 0..3 {
            momentum[i] += mass[i] * (fish.velocity[i] + before[i] - behind[i]);
        }
    }
    // The velocity is printed to 5e-5, for a total mass of about 3.5 kg.
    assert!(momentum.iter().all(|p| p.abs() < 2e-4), "{momentum:?}");
}

/// Pieces of scene files, to be put together at random.
fn piece() -> impl Strategy<Value = String> {
    prop_oneof![
        prop::sample::select(GOOD.lines().collect::<Vec<_>>()).prop_map(|line| line.to_owned()),
        prop::sample::select(KEYS.iter().map(|key| key.path).collect::<Vec<_>>())
            .prop_flat_map(|path| value().prop_map(move |value| format!("{path} = {value}"))),
        ".{0,12}",
    ]
}

fn value() -> impl Strategy<Value = String> {
    prop_oneof![
        any::<f64>().prop_map(|x| format!("{x:?}")),
        prop::collection::vec(any::<f64>(), 0..5).prop_map(|x| format!("{x:?}")),
        prop::sample::select(vec![
            "nan", "inf", "-1", "[[]]", "[[1]]", "{}", "[{}]", "''", "true", "07:32:00", "[[[1]]]",
        ])
        .prop_map(str::to_owned),
    ]
}

/// Whatever the text is, it is a finite scene or an error with a place in the text.
fn check(text: &str) -> Result<(), TestCaseError> {
    match Scene::parse(text, "f.toml") {
        Ok(scene) => prop_assert!(is_finite(&scene), "{scene:?}"),
        Err(SceneError::Invalid {
            line,
            column,
            key,
            message,
            ..
        }) => {
            prop_assert!(1 <= line && line <= text.matches('\n').count() + 1);
            prop_assert!(column >= 1 && !key.is_empty() && !message.is_empty());
        }
        Err(error) => prop_assert!(false, "{error}"),
    }
    Ok(())
}

fn is_finite(scene: &Scene) -> bool {
    let bodies = scene.bodies.iter().all(|body| {
        let matrices = body.total_mass.iter().chain(&body.total_inertia);
        matrices.flatten().all(|x| x.is_finite())
            && body.attitude.iter().all(|x| x.is_finite())
            && body.angular_velocity.iter().all(|x| x.is_finite())
    });
    let joints = scene.joints.iter().all(|joint| {
        let points = joint.at_parent.iter().chain(&joint.at_child);
        joint.child < scene.bodies.len() && points.into_iter().all(|x| x.is_finite())
    });
    let start = scene.position.iter().chain(&scene.velocity);
    bodies && joints && scene.density.is_finite() && start.into_iter().all(|x| x.is_finite())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn no_text_makes_it_panic(text in any::<String>()) {
        check(&text)?;
    }

    #[test]
    fn no_lines_make_it_panic(lines in prop::collection::vec(piece(), 0..20)) {
        check(&lines.join("\n"))?;
    }

    #[test]
    fn no_mutated_line_makes_it_panic(index in 0..30_usize, piece in piece()) {
        let mut lines: Vec<&str> = GOOD.lines().collect();
        let index = index % lines.len();
        lines[index] = &piece;
        check(&lines.join("\n"))?;
    }

    #[test]
    fn no_mutated_value_makes_it_panic(index in 0..30_usize, value in value()) {
        let mut lines: Vec<String> = GOOD.lines().map(str::to_owned).collect();
        let index = index % lines.len();
        if let Some((key, _)) = lines[index].clone().split_once('=') {
            lines[index] = format!("{key}= {value}");
        }
        check(&lines.join("\n"))?;
    }

    #[test]
    fn no_mutated_character_makes_it_panic(index in any::<prop::sample::Index>(), c in any::<char>()) {
        let mut text: Vec<char> = GOOD.chars().collect();
        let index = index.index(text.len());
        text[index] = c;
        check(&text.iter().collect::<String>())?;
    }
}
