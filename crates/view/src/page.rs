//! The page: one file that needs no network.

use articulated_fluid::{DriveKind, Scene};
use serde::Serialize;

use crate::charts::{Chart, charts};
use crate::motion::Motion;
use crate::pack::{Group, Pack, range, smallest_three};
use crate::solid::{Solid, solids};

const PAGE: &str = include_str!("../page/page.html");
const STYLE: &str = include_str!("../page/page.css");
/// In the order in which a browser reads them.
const SCRIPTS: [&str; 12] = [
    include_str!("../page/codec.js"),
    include_str!("../page/vector.js"),
    include_str!("../page/colours.js"),
    include_str!("../page/motion.js"),
    include_str!("../page/camera.js"),
    include_str!("../page/shaders.js"),
    include_str!("../page/gl.js"),
    include_str!("../page/solids.js"),
    include_str!("../page/picture.js"),
    include_str!("../page/charts.js"),
    include_str!("../page/controls.js"),
    include_str!("../page/main.js"),
];

/// Steps of a number of a quaternion from -1 to 1: attitudes are less than 3e-4 rad off.
pub(crate) const ATTITUDE_LEVELS: u32 = 1 << 15;
/// Steps of the head's way, the longest of its three sides.
const PLACE_LEVELS: u32 = 1 << 20;
const TIME_LEVELS: u32 = 1 << 24;

/// What the page's script reads.
#[derive(Serialize)]
struct Run<'a> {
    title: &'a str,
    bodies: Vec<Solid>,
    has_weight: bool,
    motions: Vec<Packed<'a>>,
    charts: Vec<Chart>,
}

#[derive(Serialize)]
struct Packed<'a> {
    name: &'a str,
    facts: &'a str,
    frames: usize,
    groups: Vec<Group>,
    data: String,
}

/// A page with motions of one scene in one picture, the first of them solid and with all charts.
///
/// Attitudes are less than 3e-4 rad off, the head's place half a millionth of its way. Bodies hang on their joints, so that the others
/// are off by as much as the bodies between them and the head are turned.
pub fn page(scene: &Scene, title: &str, motions: &[Motion]) -> String {
    let mut packs: Vec<Pack> = motions.iter().map(packed).collect();
    let charts = charts(motions, &mut packs, &drives(scene, motions));
    let motions = motions.iter().zip(packs).map(|(motion, pack)| {
        let (groups, data) = pack.finish();
        Packed {
            name: motion.name,
            facts: motion.facts,
            frames: motion.recording.times().len(),
            groups,
            data,
        }
    });
    let run = Run {
        title,
        bodies: solids(scene),
        has_weight: scene.gravity != [0.0; 3],
        motions: motions.collect(),
        charts,
    };
    // Strings, numbers and lists of them always have a text; nothing in it may end the script that it stands in.
    let run = serde_json::to_string(&run).unwrap_or_default();
    let run = run.replace('<', "\\u003c");
    filled(|name| match name {
        "title" => Some(escaped(title)),
        "style" => Some(STYLE.to_owned()),
        "run" => Some(run.clone()),
        "script" => Some(SCRIPTS.concat()),
        _ => None,
    })
}

/// The page with the text of each name in double braces.
fn filled(text: impl Fn(&str) -> Option<String>) -> String {
    let mut parts = PAGE.split("{{");
    let mut page = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once("}}").unwrap_or((part, ""));
        page += &text(name).unwrap_or_default();
        page += rest;
    }
    page
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

/// Times, the head's places and the attitudes.
fn packed(motion: &Motion) -> Pack {
    let stills = motion.recording.stills();
    let mut pack = Pack::default();
    let times = motion.recording.times();
    pack.add("t", (range(times.clone()), TIME_LEVELS), [times]);
    let place = |k: usize| stills.clone().map(move |still| still.centres[0][k]);
    for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
        pack.add(name, (range(place(k)), PLACE_LEVELS), [place(k)]);
    }
    let bodies = stills
        .clone()
        .next()
        .map_or(0, |still| still.attitudes.len());
    let (mut attitudes, mut left_out) = (vec![], vec![]);
    for i in 0..bodies {
        let mut before = 0;
        let mut three = [vec![], vec![], vec![]];
        let mut places = vec![];
        for still in stills.clone() {
            let given = smallest_three(still.attitudes[i], &mut before);
            for (column, x) in three.iter_mut().zip(given) {
                column.push(x);
            }
            places.push(before as f64);
        }
        attitudes.extend(three);
        left_out.push(places);
    }
    pack.add("attitudes", ([-1.0, 1.0], ATTITUDE_LEVELS), attitudes);
    pack.add("left_out", ([0.0, 3.0], 3), left_out);
    pack
}

/// The names of the drives, and their numbers in a frame.
fn drives(scene: &Scene, motions: &[Motion]) -> Vec<(String, usize)> {
    let mut joints = scene.driven_joints();
    let kinds = motions
        .first()
        .map(|motion| motion.recording.model().drives());
    let name = |(k, kind): (usize, DriveKind)| {
        let name = match kind {
            DriveKind::Joint { .. } => joints.next().unwrap_or_default(),
            DriveKind::Loads(name) => name,
        };
        (name.to_owned(), k)
    };
    let kinds = kinds.into_iter().flatten().map(|drive| drive.kind);
    kinds.enumerate().map(name).collect()
}
