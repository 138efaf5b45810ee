//! SO(3) where it is easily wrong: at zero, at pi, after many products.

use core::f64::consts::PI;

use approx::assert_abs_diff_eq;
use lie::{Cayley, Exp, Jet, LieGroup, Mat3, NotUnique, OutsideChart, SO3, Scalar, Tangent, Vec3};
use proptest::prelude::*;

type Dual = <f64 as Scalar>::Jet;

fn axis() -> Vec3 {
    Vec3([2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0])
}

fn turn(angle: f64) -> Tangent<3> {
    (axis() * angle).into()
}

#[test]
fn the_logarithm_is_right_up_to_pi() {
    for angle in [
        0.0,
        1e-300,
        1e-12,
        1e-8,
        0.1,
        0.28,
        0.29,
        1.0,
        2.0,
        3.0,
        PI - 1e-3,
        PI - 1e-8,
        PI - 1e-13,
    ] {
        let log = SO3::exp(&turn(angle)).log().unwrap();
        // The angle follows from the quaternion's two parts, each with a few roundings.
        assert_abs_diff_eq!(log, turn(angle), epsilon = 2e-15);
    }
    // Small logarithms keep their relative error too.
    let tiny = SO3::exp(&turn(1e-12)).log().unwrap();
    assert_abs_diff_eq!(tiny * 1e12, turn(1.0), epsilon = 4e-16);
}

#[test]
fn past_pi_the_logarithm_takes_the_short_way() {
    let log = SO3::exp(&turn(PI + 0.1)).log().unwrap();
    assert_abs_diff_eq!(log, turn(0.1 - PI), epsilon = 2e-15);
}

#[test]
fn at_pi_the_logarithm_says_that_it_has_two_values() {
    for axis in [
        axis(),
        Vec3([1.0, 0.0, 0.0]),
        Vec3([0.0, 1.0, 0.0]),
        Vec3([0.0, 0.0, -1.0]),
    ] {
        let half_turn = SO3::exp(&(axis * PI).into());
        let Err(NotUnique { representative }) = half_turn.log() else {
            panic!("a half turn about {axis:?} has two logarithms");
        };
        assert_abs_diff_eq!(SO3::exp(&representative), half_turn, epsilon = 1e-15);
        assert_abs_diff_eq!(representative.vec3().norm(), PI, epsilon = 1e-15);
        assert_eq!(half_turn.cayley_inverse(), Err(OutsideChart));
        assert_eq!(half_turn.retract_inverse::<Exp>(), Err(OutsideChart));
    }
}

#[test]
fn derivatives_exist_at_zero() {
    let mut xi = Tangent([Dual::constant(0.0); 3]);
    lie::seed(&mut xi, 0);
    for g in [SO3::exp(&xi), SO3::cayley(&xi)] {
        for d in 0..3 {
            let mut e = Vec3::zero();
            e[d] = 1.0;
            let derivative = Mat3(g.matrix().0.map(|row| row.map(|x| x.partial(d))));
            assert_eq!(derivative, e.hat());
            let log = g.log().unwrap();
            assert_eq!(log.0.map(|x| x.partial(d)), e.0);
        }
    }
}

#[test]
fn second_derivatives_of_exp_at_zero_are_those_of_the_series() {
    type Second = <Dual as Scalar>::Jet;
    let x = |i: usize| Second::variable(Dual::variable(0.0, i), i);
    let g = SO3::exp(&Tangent([x(0), x(1), x(2)]));
    for i in 0..3 {
        for j in 0..3 {
            let mut e = [Vec3::zero(); 2];
            (e[0][i], e[1][j]) = (1.0, 1.0);
            let [a, b] = e.map(Vec3::hat);
            let expected = (a * b + b * a) * 0.5;
            let got = Mat3(g.matrix().0.map(|row| row.map(|x| x.partial(i).partial(j))));
            assert_abs_diff_eq!(got, expected, epsilon = 1e-16);
        }
    }
}

#[test]
fn minus_identity_keeps_its_digits() {
    for angle in [1e-12, 1e-6, 1e-3, 0.5, 2.0, 3.0, PI] {
        let xi = turn(angle);
        let (a, w) = (angle.sin(), axis().hat());
        let exact = w * a + w * w * (2.0 * (angle / 2.0).sin().powi(2));
        let got = SO3::exp(&xi).minus_identity();
        let relative = (got - exact).frobenius() / exact.frobenius();
        // Nine entries, each with a few roundings of one half epsilon.
        assert!(relative < 1e-15, "{angle}: {relative:e}");
    }
}

/// Ten million products; every 32nd followed by one Newton step of the polar decomposition, as the integrators do.
#[test]
fn rotations_stay_orthogonal() {
    let step = SO3::cayley(&Tangent([1.1e-3, -2.3e-3, 3.7e-3]));
    let mut r = SO3::identity();
    for k in 1..=10_000_000_u32 {
        r = r.compose(&step);
        if k % 32 == 0 {
            r.normalize();
        }
    }
    assert!(
        r.orthogonality_error() < 1e-13,
        "{:e}",
        r.orthogonality_error()
    );
}

#[test]
fn a_matrix_that_does_not_rotate_is_refused() {
    let refused = |m: Mat3| SO3::from_matrix(m).unwrap_err();
    assert_eq!(refused(-Mat3::identity()).determinant, -1.0);
    assert_eq!(refused(Mat3::identity() * -1.5).determinant, -3.375);
    assert!(refused(Mat3::identity() * 1.01).defect > 1e-2);
    assert!(refused(Mat3([[f64::NAN; 3]; 3])).defect.is_nan());
    assert!(SO3::from_matrix(*SO3::exp(&turn(2.0)).matrix()).is_ok());
}

proptest! {
    #[test]
    fn quaternions_round_trip(q in proptest::array::uniform4(-1.0..1.0_f64)) {
        prop_assume!(q.iter().map(|x| x * x).sum::<f64>() > 1e-3);
        let r = SO3::from_quaternion(q);
        prop_assert!(r.orthogonality_error() < 4e-15);
        assert_abs_diff_eq!(SO3::from_quaternion(r.to_quaternion()), r, epsilon = 2e-15);
    }

    #[test]
    fn retractions_agree_to_second_order(a in -1e-2..1e-2_f64, b in -1e-2..1e-2_f64, c in -1e-2..1e-2_f64) {
        let xi = Tangent([a, b, c]);
        let (e, cay) = (SO3::retract::<Exp>(&xi), SO3::retract::<Cayley>(&xi));
        // exp - cay = xi^3 / 6 - xi^3 / 4 + ..., with |hat(xi)^3| <= |xi|^3 sqrt(2).
        let bound = xi.vec3().norm().powi(3) * (1.0 / 12.0) * 1.5 + 1e-15;
        prop_assert!((*e.matrix() - *cay.matrix()).frobenius() <= bound);
    }
}

/// Without the matrix, as with it; and as exact near the identity.
#[test]
fn a_displacement_is_the_rotation_less_the_identity() {
    let (x, a) = (
        Vec3([0.3, -1.0, 0.7]),
        Mat3([[2.0, 0.1, 0.2], [0.1, 1.0, 0.3], [0.2, 0.3, 0.5]]),
    );
    for angle in [0.0, 1e-9, 1e-4, 0.7, 1.9, 2.5, 3.0, PI] {
        let r = SO3::exp(&Tangent([2.0, -3.0, 6.0].map(|c| c / 7.0 * angle)));
        let (e, matrix) = (r.displacement(), r.minus_identity());
        let size = f64::EPSILON * angle;
        assert!((e.apply(x) - matrix * x).norm() <= 20.0 * size, "{angle}");
        // The skew part adds nothing but rounding.
        let trace = (r.symmetric_minus_identity() * a).trace();
        assert!(
            (e.trace_with(a) - trace).abs() <= 20.0 * size * angle.max(1e-3),
            "{angle}"
        );
    }
}
