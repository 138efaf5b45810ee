//! The bytes of a glTF file, and what is said of them.

use serde_json::{Value, json};

use super::sphere::sphere;

const FLOAT: u32 = 5126;
const SHORT: u32 = 5122;
const UNSIGNED_SHORT: u32 = 5123;
/// What a view is bound to.
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;
const RINGS: u16 = 16;
const SECTORS: u16 = 24;

#[derive(Default)]
pub(super) struct Buffer {
    pub(super) bytes: Vec<u8>,
    pub(super) views: Vec<Value>,
    pub(super) accessors: Vec<Value>,
}

impl Buffer {
    /// The accessor of these bytes: the number of elements, and what else is said of them.
    fn add(&mut self, bytes: Vec<u8>, target: Option<u32>, accessor: Value) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view =
            json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend(bytes);
        let mut accessor = accessor;
        accessor["bufferView"] = json!(self.views.len());
        self.views.push(view);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// The points and the triangles of a unit sphere.
    pub(super) fn sphere(&mut self) -> [usize; 2] {
        let (points, triangles) = sphere(RINGS, SECTORS);
        let bounds = json!({ "count": points.len(), "componentType": FLOAT, "type": "VEC3", "min": least(&points), "max": greatest(&points) });
        let points = points.iter().flatten().flat_map(|x| x.to_le_bytes());
        let points = self.add(points.collect(), Some(VERTICES), bounds);
        let kind =
            json!({ "count": triangles.len(), "componentType": UNSIGNED_SHORT, "type": "SCALAR" });
        let triangles = triangles.into_iter().flat_map(u16::to_le_bytes);
        [points, self.add(triangles.collect(), Some(INDICES), kind)]
    }

    pub(super) fn times(&mut self, times: impl Iterator<Item = f64>) -> usize {
        let times: Vec<[f32; 1]> = times.map(|t| [t as f32]).collect();
        let kind = json!({ "count": times.len(), "componentType": FLOAT, "type": "SCALAR", "min": least(&times), "max": greatest(&times) });
        let bytes = times.iter().flatten().flat_map(|t| t.to_le_bytes());
        self.add(bytes.collect(), None, kind)
    }

    pub(super) fn places(&mut self, places: impl ExactSizeIterator<Item = [f64; 3]>) -> usize {
        let kind = json!({ "count": places.len(), "componentType": FLOAT, "type": "VEC3" });
        let bytes = places.flatten().flat_map(|x| (x as f32).to_le_bytes());
        self.add(bytes.collect(), None, kind)
    }

    pub(super) fn turns(&mut self, turns: impl ExactSizeIterator<Item = [f64; 4]>) -> usize {
        let kind = json!({ "count": turns.len(), "componentType": SHORT, "normalized": true, "type": "VEC4" });
        let short = |x: f64| ((x * f64::from(i16::MAX)).round() as i16).to_le_bytes();
        let bytes = turns.flatten().flat_map(short);
        self.add(bytes.collect(), None, kind)
    }
}

fn least<const N: usize>(all: &[[f32; N]]) -> Vec<f32> {
    let least = |k: usize| all.iter().map(|x| x[k]).fold(f32::INFINITY, f32::min);
    (0..N).map(least).collect()
}

fn greatest<const N: usize>(all: &[[f32; N]]) -> Vec<f32> {
    let greatest = |k: usize| all.iter().map(|x| x[k]).fold(f32::NEG_INFINITY, f32::max);
    (0..N).map(greatest).collect()
}
