//! The motion for editors and viewers of three-dimensional scenes: glTF 2.0 in one binary file.

mod buffer;
mod sphere;

use articulated_fluid::Scene;
use serde_json::{Value, json};

use crate::recording::Recording;
use crate::solid::{Solid, solids};
use buffer::Buffer;

/// A joint's radius, by the middle semi-axis of what hangs on it.
const JOINT: f64 = 0.3;
const JOINT_COLOUR: [f64; 3] = [0.93, 0.94, 0.95];
/// From z upwards to glTF's y upwards.
const UPRIGHT: [f64; 4] = [
    -core::f64::consts::FRAC_1_SQRT_2,
    0.0,
    0.0,
    core::f64::consts::FRAC_1_SQRT_2,
];

/// A run as a binary glTF file: a node for each body, moved by an animation, with its ellipsoid and its joint below it.
///
/// Places are floats, attitudes normalised 16-bit quaternions, less than 1e-4 rad off. Between the frames viewers interpolate.
pub fn glb(scene: &Scene, title: &str, recording: &Recording) -> Vec<u8> {
    let bodies = solids(scene);
    let mut buffer = Buffer::default();
    let sphere = buffer.sphere();
    let mut nodes = vec![json!({ "name": title, "rotation": UPRIGHT, "children": [] })];
    let (mut meshes, mut materials) = (vec![], vec![]);
    let mut add_mesh = |name: &str, colour: [f64; 3]| {
        materials.push(material(name, colour));
        meshes
            .push(json!({ "name": name, "primitives": [primitive(&sphere, materials.len() - 1)] }));
        meshes.len() - 1
    };
    let joint = add_mesh("joint", JOINT_COLOUR);
    let first = recording.stills().next();
    let mut targets = vec![];
    for (i, body) in bodies.iter().enumerate() {
        let mesh = add_mesh(&body.name, body.colour);
        let at = nodes.len();
        targets.push(at);
        let place = first.map_or([0.0; 3], |still| still.centres[i].0);
        let turn = first.map_or([1.0, 0.0, 0.0, 0.0], |still| still.attitudes[i]);
        let children: Vec<usize> = (at + 1..=at + 1 + usize::from(body.joint.is_some())).collect();
        nodes.push(json!({ "name": body.name, "translation": place, "rotation": last_real(turn), "children": children }));
        nodes.push(
            json!({ "name": format!("{} ellipsoid", body.name), "mesh": mesh, "scale": body.axes }),
        );
        nodes.extend(joint_node(body, joint));
    }
    nodes[0]["children"] = json!(targets);
    let animation = animation(&mut buffer, recording, &targets);
    let document = json!({
        "asset": { "version": "2.0", "generator": "lgvi" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "animations": animation,
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{ "byteLength": buffer.bytes.len() }],
    });
    container(&document, buffer.bytes)
}

fn material(name: &str, colour: [f64; 3]) -> Value {
    let [r, g, b] = colour.map(linear);
    json!({
        "name": name,
        "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.5 },
    })
}

/// From sRGB to linear light.
fn linear(x: f64) -> f64 {
    match x <= 0.04045 {
        true => x / 12.92,
        false => ((x + 0.055) / 1.055).powf(2.4),
    }
}

fn primitive(sphere: &[usize; 2], material: usize) -> Value {
    // Of a unit sphere, a point is its own normal.
    let [points, triangles] = *sphere;
    json!({ "attributes": { "POSITION": points, "NORMAL": points }, "indices": triangles, "material": material })
}

fn joint_node(body: &Solid, mesh: usize) -> Option<Value> {
    let joint = body.joint.as_ref()?;
    let mut axes = body.axes;
    axes.sort_by(f64::total_cmp);
    let scale = [JOINT * axes[1]; 3];
    Some(json!({ "name": joint.name, "mesh": mesh, "translation": joint.at_child, "scale": scale }))
}

/// glTF's order: x, y, z, w.
fn last_real([w, x, y, z]: [f64; 4]) -> [f64; 4] {
    [x, y, z, w]
}

/// One animation that moves the nodes of all bodies; none of a single frame.
fn animation(buffer: &mut Buffer, recording: &Recording, targets: &[usize]) -> Vec<Value> {
    let stills = recording.stills();
    if stills.len() < 2 {
        return vec![];
    }
    let times = buffer.times(recording.times());
    let (mut channels, mut samplers) = (vec![], vec![]);
    for (i, node) in targets.iter().enumerate() {
        let places = buffer.places(stills.clone().map(|still| still.centres[i].0));
        let turns = buffer.turns(stills.clone().map(|still| last_real(still.attitudes[i])));
        for (path, output) in [("translation", places), ("rotation", turns)] {
            let sampler = samplers.len();
            channels.push(json!({ "sampler": sampler, "target": { "node": node, "path": path } }));
            samplers.push(json!({ "input": times, "output": output }));
        }
    }
    vec![json!({ "name": "motion", "channels": channels, "samplers": samplers })]
}

/// Header, JSON, bytes; each part padded to four bytes.
fn container(document: &Value, mut bytes: Vec<u8>) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let length = 12 + 8 + text.len() + 8 + bytes.len();
    let number = |x: usize| (x as u32).to_le_bytes();
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend(number(length));
    file.extend(number(text.len()));
    file.extend(b"JSON");
    file.extend(text);
    file.extend(number(bytes.len()));
    file.extend(b"BIN\0");
    file.extend(bytes);
    file
}
