//! How far two configurations are apart.

use articulated_fluid::Configuration;
use lie::SO3;

/// How far two configurations are apart: the largest of three numbers, infinite where one is not a number.
///
/// They are the largest angle between two attitudes, rad, the distance of the first mass centres, m, and the sum of the differences of
/// hinge angles, rad.
pub fn distance(a: &Configuration, b: &Configuration) -> f64 {
    let angles = a.0.iter().zip(b.0.iter()).map(|(a, b)| angle(a, b));
    let distances = a.1.iter().zip(b.1.iter());
    let distances = distances.map(|(a, b)| (a.vec3() - b.vec3()).norm());
    let hinges = a.2.iter().zip(b.2.iter());
    let turned = hinges.map(|(a, b)| (a.0[0] - b.0[0]).abs()).sum::<f64>();
    let number = |x: f64| if x.is_nan() { f64::INFINITY } else { x };
    angles
        .chain(distances)
        .chain([turned])
        .map(number)
        .fold(0.0, f64::max)
}

/// By $\lVert R_a - R_b \rVert_F = 2 \sqrt 2 \sin(\theta / 2)$.
fn angle(a: &SO3, b: &SO3) -> f64 {
    let chord = (*a.matrix() - *b.matrix()).frobenius();
    let sine = chord / 8.0_f64.sqrt();
    2.0 * if sine > 1.0 { 1.0 } else { sine }.asin()
}
