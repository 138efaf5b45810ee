//! Syntax, keys and types, and the place and form of a message.

use std::path::Path;

use articulated_fluid::scene::{KEYS, Scene, SceneError};

use crate::random::check;
use crate::{assert_refused, refusal};

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
    let of_body = KEYS.iter().filter_map(|key| key.path.strip_prefix("body."));
    let of_body: Vec<_> = of_body.filter(|key| !key.contains('.')).collect();
    assert!(
        ["name", "mass", "drag"]
            .iter()
            .all(|key| of_body.contains(key))
    );
    let of_body = of_body.join("`, `");
    let message = format!("f.toml:10:1: body.mas: unknown key; expected one of `{of_body}`");
    assert_refused(&[
        ("mass = 90", "mas = 90", &message[..]),
        (
            "density = 1000",
            "density = 1000\n  viscosity = 1",
            "f.toml:4:3: fluid.viscosity: unknown key; expected `density`",
        ),
        (
            "[start]",
            "[begin]",
            "f.toml:4:1: begin: unknown key; expected one of `title`, `gravity`, `fluid`, `start`, \
             `body`, `joint`, `gait`",
        ),
    ]);
}

#[test]
fn the_documented_keys_are_those_that_are_read() {
    for table in [
        "",
        "fluid.",
        "start.",
        "body.",
        "body.attitude.",
        "joint.",
        "gait.",
    ] {
        let text = match table {
            "" => "x = 0".to_owned(),
            "fluid." | "start." => format!("{table}x = 0"),
            "body.attitude." => "[[body]]\nattitude.x = 0".to_owned(),
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
            "stiffness = 2.5",
            "stiffness = [1, 2, 3]",
            "f.toml:30:1: joint.stiffness: wrong type: array; expected a finite number >= 0, in N m",
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
             (symmetric to 1e-3 of the largest, positive definite), in kg",
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
