//! Numbers with the digits that publications give: corrected within 1e-3, with a note, and refused beyond.

use articulated_fluid::scene::{Correction, Note};
use proptest::prelude::*;

use crate::{GOOD, parse, refusal};

/// [`GOOD`] with another total inertia of its second body, in line 16.
fn with_inertia(rows: [[f64; 3]; 3]) -> String {
    GOOD.replace(
        "[[2, 0.5, 0], [0.5, 2, 0], [0, 0, 1]]",
        &format!("{rows:?}"),
    )
}

/// [`GOOD`] with another attitude of its first body, in line 11.
fn with_attitude(quaternion: [f64; 4]) -> String {
    GOOD.replace("[0, 1, 0, 0]", &format!("{quaternion:?}"))
}

fn only(notes: &[Note]) -> &Note {
    match notes {
        [note] => note,
        _ => panic!("{notes:?}"),
    }
}

/// The boundary is met to the rounding of a difference of numbers near 1: 1e-13 of 1e-3.
const INSIDE: f64 = 1e-3 * (1.0 - 1e-12);
const OUTSIDE: f64 = 1e-3 * (1.0 + 1e-12);

#[test]
fn a_matrix_is_symmetrised_within_a_thousandth_of_its_largest_element() {
    // The largest element is 2.
    let off = |by: f64| [[2.0, 0.5 + 2.0 * by, 0.0], [0.5, 2.0, 0.0], [0.0, 0.0, 1.0]];
    let scene = parse(&with_inertia(off(INSIDE)));
    let inertia = scene.bodies[1].total_inertia;
    assert_eq!(inertia[0][1], inertia[1][0]);
    assert_eq!(inertia[0][1], 0.5 * (0.5 + 2.0 * INSIDE) + 0.5 * 0.5);
    let note = only(&scene.notes);
    assert_eq!(note.correction, Correction::Symmetrised);
    assert_eq!(
        note.to_string(),
        "line 16: body.total_inertia of \"tail-1\" was symmetrised: mirrored entries differed by up \
         to 1.0e-3 of the largest entry"
    );
    let refused = refusal(&with_inertia(off(OUTSIDE))).to_string();
    let (upper, lower) = (0.5 + 2.0 * OUTSIDE, 0.5);
    let expected = format!(
        "f.toml:16:1: body.total_inertia: not symmetric: row 1 has {upper:?} in column 2, row 2 has \
         {lower:?} in column 1; expected "
    );
    assert!(refused.starts_with(&expected), "{refused}");
}

#[test]
fn a_quaternion_is_normalised_within_a_thousandth() {
    for sign in [1.0, -1.0] {
        let long = |by: f64| with_attitude([0.0, 0.6, 0.0, 0.8].map(|x| x * (1.0 + sign * by)));
        let scene = parse(&long(INSIDE));
        let length = scene.bodies[0].attitude.map(|x| x * x).iter().sum::<f64>();
        assert!((length - 1.0).abs() < 4.0 * f64::EPSILON);
        assert_eq!(
            only(&scene.notes).to_string(),
            "line 11: body.attitude of \"head\" was normalised: its length differed from 1 by 1.0e-3"
        );
        let length = 1.0 + sign * OUTSIDE;
        let refused = refusal(&with_attitude([length, 0.0, 0.0, 0.0])).to_string();
        let expected = format!("f.toml:11:1: body.attitude: has length {length:?}; expected ");
        assert!(refused.starts_with(&expected), "{refused}");
    }
}

#[test]
fn rounding_gives_no_note() {
    let rounded = [[2.0, 0.5, 0.0], [0.5 + 1e-12, 2.0, 0.0], [0.0, 0.0, 1.0]];
    let scene = parse(&with_inertia(rounded));
    let inertia = scene.bodies[1].total_inertia;
    assert_eq!(inertia[0][1], inertia[1][0]);
    assert_eq!(scene.notes, []);
    assert_eq!(
        parse(&with_attitude([0.0, 0.6, 0.0, 0.8 - 1e-12])).notes,
        []
    );
    assert_eq!(parse(GOOD).notes, []);
}

/// Every matrix of a body is told of, by its own key and body, whichever way its table is written; zero is symmetric.
#[test]
fn notes_name_the_key_the_body_and_the_line() {
    let text = "fluid.density = 1
body = [
  { name = 'a', semi_axes = [1, 1, 1], attitude = [1.0004, 0, 0, 0] },
  { name = 'b', mass = 1,
    inertia = [[1, 1e-4, 0], [0, 1, 0], [0, 0, 1]],
    added_mass = [[2, 0, 0], [1e-4, 2, 0], [0, 0, 2]], added_inertia = [[0, 0, 0], [0, 0, 0], [0, 0, 0]] },
]
joint = [{ parent = 'a', child = 'b', at_parent = [0, 0, 0], at_child = [0, 0, 0] }]";
    let notes = parse(text).notes;
    let told = notes
        .iter()
        .map(|n| (n.line, n.key.as_str(), n.body.as_str(), n.correction));
    let expected = [
        (3, "body.attitude", "a", Correction::Normalised),
        (5, "body.inertia", "b", Correction::Symmetrised),
        (6, "body.added_mass", "b", Correction::Symmetrised),
    ];
    assert_eq!(told.collect::<Vec<_>>(), expected);
    for (note, off) in notes.iter().zip([4e-4, 1e-4, 5e-5]) {
        assert!((note.off - off).abs() < 1e-12, "{note}");
    }
}

proptest! {
    /// The result is the symmetric part to the last bit, and the note has the largest relative difference.
    #[test]
    fn the_symmetric_part_of_a_rounded_matrix(
        diagonal in prop::array::uniform3(1.0..3.0),
        above in prop::array::uniform3(-0.2..0.2),
        changes in prop::array::uniform3(-0.9e-3..0.9e-3),
    ) {
        let [[a, b, c], [x, y, z]] = [diagonal, above];
        let [p, q, r] = [0, 1, 2].map(|i| above[i] + changes[i]);
        let rows = [[a, x, y], [p, b, z], [q, r, c]];
        let scene = parse(&with_inertia(rows));
        let inertia = scene.bodies[1].total_inertia;
        for (i, row) in inertia.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                prop_assert_eq!(*entry, 0.5 * (rows[i][j] + rows[j][i]));
            }
        }
        let largest = a.max(b).max(c);
        let differences = [(x - p).abs(), (y - q).abs(), (z - r).abs()];
        let off = differences.iter().fold(0.0_f64, |m, d| m.max(*d)) / largest;
        prop_assert_eq!(only(&scene.notes).off, off);
    }
}
