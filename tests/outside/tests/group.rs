//! The unit quaternions are a group, and cover the rotations twice.

use lgvi::lie::{LieGroup, SO3, Tangent, laws};
use outside::UnitQuaternion;

const VELOCITIES: [Tangent<3>; 5] = [
    Tangent([0.3, -0.4, 1.2]),
    Tangent([-1.5, 0.2, 0.1]),
    Tangent([1e-8, 2e-8, 0.0]),
    Tangent([0.0, 3.1, 0.0]),
    // A rotation of more than half a turn: its matrix has a shorter logarithm, its quaternion has not.
    Tangent([0.0, 2.0, 3.0]),
];

#[test]
fn the_laws_of_a_group_hold() {
    let elements = VELOCITIES.map(|xi| UnitQuaternion::<f64>::exp(&xi));
    let report = laws::check(&elements, &VELOCITIES).unwrap_or_else(|e| panic!("{e}"));
    assert!(report.comparisons > 500, "{report:?}");
}

#[test]
fn the_cover_is_a_homomorphism() {
    for xi in VELOCITIES {
        for eta in VELOCITIES {
            let (p, q) = (UnitQuaternion::exp(&xi), UnitQuaternion::exp(&eta));
            let apart = *p.compose(&q).rotation().matrix()
                - *SO3::exp(&xi).compose(&SO3::exp(&eta)).matrix();
            assert!(apart.frobenius() < 1e-14, "{xi:?}, {eta:?}");
        }
    }
}

#[test]
fn a_full_turn_is_minus_one() {
    let half_turn = UnitQuaternion::exp(&Tangent([0.0, core::f64::consts::PI, 0.0]));
    let full_turn = half_turn.compose(&half_turn);
    assert!((full_turn.real() + 1.0).abs() < 1e-15);
    // Every axis would do.
    let answer = full_turn.log().unwrap_err().representative;
    assert!((UnitQuaternion::exp(&answer).real() + 1.0).abs() < 1e-15);
}
