//! Whatever the text is, nothing panics.

use std::path::Path;

use articulated_fluid::scene::{EXAMPLE, KEYS, Scene, SceneError, StartVelocity};
use lie::{LieGroup, VectorSpace};
use proptest::prelude::*;
use proptest::sample::{Index, select};

use crate::GOOD;

/// Pieces of scene files, to be put together at random.
fn piece() -> impl Strategy<Value = String> {
    prop_oneof![
        select(GOOD.lines().collect::<Vec<_>>()).prop_map(|line| line.to_owned()),
        select(KEYS.iter().map(|key| key.path).collect::<Vec<_>>())
            .prop_flat_map(|path| value().prop_map(move |value| format!("{path} = {value}"))),
        ".{0,12}",
    ]
}

fn value() -> impl Strategy<Value = String> {
    prop_oneof![
        any::<f64>().prop_map(|x| format!("{x:?}")),
        prop::collection::vec(any::<f64>(), 0..5).prop_map(|x| format!("{x:?}")),
        select(vec![
            "nan", "inf", "-1", "[[]]", "[[1]]", "{}", "[{}]", "''", "true", "07:32:00", "[[[1]]]",
        ])
        .prop_map(str::to_owned),
    ]
}

/// Whatever the text is, it is a finite scene or an error with a place in the text.
pub fn check(text: &str) -> Result<(), TestCaseError> {
    match Scene::parse(text, "f.toml") {
        Ok(scene) => check_scene(&scene),
        Err(SceneError::Invalid {
            line,
            column,
            key,
            message,
            ..
        }) => {
            prop_assert!(1 <= line && line <= text.matches('\n').count() + 1);
            prop_assert!(column >= 1 && !key.is_empty() && !message.is_empty());
            Ok(())
        }
        Err(error) => Err(TestCaseError::fail(error.to_string())),
    }
}

/// A scene that was read is finite, a tree, and has a model and a state, or an error.
fn check_scene(scene: &Scene) -> Result<(), TestCaseError> {
    prop_assert!(is_finite(scene), "{scene:?}");
    prop_assert!(scene.joints.iter().all(|joint| joint.parent < joint.child));
    prop_assert_eq!(scene.joints.len() + 1, scene.bodies.len());
    if let Ok(state) = scene.initial_state() {
        prop_assert!(state.g.is_finite() && state.mu.max_magnitude().is_finite());
    }
    if let Ok(smallest) = scene.smallest() {
        let start = smallest.start;
        prop_assert!(start.g.is_finite() && start.mu.max_magnitude().is_finite());
        prop_assert_eq!(smallest.account.reductions.len(), 6);
    }
    prop_assert!(
        scene
            .overlaps(usize::MAX)
            .first
            .iter()
            .all(|overlap| overlap.depth > 0.0)
    );
    Ok(())
}

fn is_finite(scene: &Scene) -> bool {
    let bodies = scene.bodies.iter().flat_map(|body| {
        let matrices = body.total_mass.iter().chain(&body.total_inertia).flatten();
        let motion = body.attitude.iter().chain(&body.angular_velocity);
        matrices.chain(motion).chain([&body.net_mass])
    });
    let points = scene.joints.iter();
    let points = points.flat_map(|joint| joint.at_parent.iter().chain(&joint.at_child));
    let velocity = match scene.velocity {
        StartVelocity::Given(velocity) => velocity,
        StartVelocity::ZeroMomentum | StartVelocity::NoMomentum => [0.0; 3],
    };
    let start = scene.position.iter().chain(&velocity).chain(&scene.gravity);
    let stiffnesses = scene.joints.iter().map(|joint| &joint.mobility.stiffness);
    let all = bodies.chain(points).chain(stiffnesses).chain(start);
    let mut all = all.chain([&scene.density]);
    all.all(|x| x.is_finite())
}

/// The scenes of the collection and those of the documentation and of these tests.
fn scene_text() -> impl Strategy<Value = String> {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let folders = [scenes.join("hard"), scenes];
    let entries = folders
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).expect("the scenes"));
    let paths = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_file());
    let texts = paths.map(|path| std::fs::read_to_string(path).expect("a scene"));
    let own = [GOOD, EXAMPLE].map(str::to_owned);
    select(texts.chain(own).collect::<Vec<_>>())
}

/// A change of a text.
#[derive(Clone, Debug)]
enum Mutation {
    Delete(Index),
    Duplicate(Index),
    Swap(Index, Index),
    Number(Index, &'static str),
    Character(Index, char),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let index = any::<Index>;
    let numbers = vec![
        "nan",
        "inf",
        "0",
        "-1",
        "1e308",
        "1e-308",
        "'x'",
        "\"aligned\"",
        "[1, 0, 0]",
        "{}",
    ];
    // Numbers lead furthest into the checks.
    prop_oneof![
        1 => index().prop_map(Mutation::Delete),
        1 => index().prop_map(Mutation::Duplicate),
        1 => (index(), index()).prop_map(|(i, j)| Mutation::Swap(i, j)),
        4 => (index(), select(numbers)).prop_map(|(i, x)| Mutation::Number(i, x)),
        1 => (index(), any::<char>()).prop_map(|(i, c)| Mutation::Character(i, c)),
    ]
}

impl Mutation {
    fn apply(&self, text: &str) -> String {
        let mut lines: Vec<&str> = text.lines().collect();
        let line = |index: &Index| index.index(text.lines().count().max(1));
        match self {
            Self::Number(index, number) => return replace_number(text, index, number),
            Self::Character(index, c) => return replace_character(text, index, *c),
            _ if lines.is_empty() => {}
            Self::Delete(i) => drop(lines.remove(line(i))),
            Self::Duplicate(i) => lines.insert(line(i), lines[line(i)]),
            Self::Swap(i, j) => lines.swap(line(i), line(j)),
        }
        lines.join("\n")
    }
}

fn replace_number(text: &str, index: &Index, number: &str) -> String {
    let starts = |(i, c): &(usize, char)| {
        c.is_ascii_digit()
            && !text[..*i].ends_with(|c: char| c.is_ascii_alphanumeric() || "-._".contains(c))
    };
    let starts: Vec<usize> = text.char_indices().filter(starts).map(|(i, _)| i).collect();
    let Some(&start) = starts.get(index.index(starts.len().max(1))) else {
        return text.to_owned();
    };
    let end = text[start..].find(|c: char| !(c.is_ascii_digit() || c == '.'));
    let end = end.map_or(text.len(), |length| start + length);
    [&text[..start], number, &text[end..]].concat()
}

fn replace_character(text: &str, index: &Index, c: char) -> String {
    let mut characters: Vec<char> = text.chars().collect();
    if !characters.is_empty() {
        let index = index.index(characters.len());
        characters[index] = c;
    }
    characters.into_iter().collect()
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
    fn no_mutated_scene_makes_it_panic(
        text in scene_text(),
        mutations in prop::collection::vec(mutation(), 1..4),
    ) {
        let mutated = mutations.iter().fold(text, |text, mutation| mutation.apply(&text));
        check(&mutated)?;
    }
}
