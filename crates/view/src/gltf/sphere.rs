//! A sphere of triangles.

use core::f64::consts::PI;

/// The points of a unit sphere with its poles on the x axis, and the triangles between them, seen from outside.
pub(super) fn sphere(rings: u16, sectors: u16) -> (Vec<[f32; 3]>, Vec<u16>) {
    let (mut points, mut triangles) = (vec![], vec![]);
    for i in 0..=rings {
        let latitude = PI * (f64::from(i) / f64::from(rings) - 0.5);
        for j in 0..=sectors {
            let longitude = 2.0 * PI * f64::from(j) / f64::from(sectors);
            let radius = latitude.cos();
            let point = [
                latitude.sin(),
                radius * longitude.cos(),
                radius * longitude.sin(),
            ];
            points.push(point.map(|x| x as f32));
        }
    }
    for i in 0..rings {
        for j in 0..sectors {
            let a = i * (sectors + 1) + j;
            let b = a + sectors + 1;
            // At a pole one of the two has no area.
            if i > 0 {
                triangles.extend([a, a + 1, b]);
            }
            if i + 1 < rings {
                triangles.extend([b, a + 1, b + 1]);
            }
        }
    }
    (points, triangles)
}
