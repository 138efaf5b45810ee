//! SO(2) and SE(2) where they are easily wrong: at zero, at a quarter turn, at pi, after many products.

use core::f64::consts::{FRAC_PI_2, PI};

use approx::assert_abs_diff_eq;
use lie::{Exp, Jet, LieGroup, NotUnique, OutsideChart, SE2, SO2, Scalar, Tangent};
use proptest::prelude::*;

type Dual = <f64 as Scalar>::Jet;

const ANGLES: [f64; 11] = [
    0.0,
    1e-300,
    1e-12,
    1e-8,
    0.3,
    FRAC_PI_2,
    2.0,
    3.0,
    PI - 1e-6,
    PI - 1e-12,
    PI,
];

/// `x` is `expected` to `roundings` halves of an epsilon, relative to it.
fn assert_close(x: f64, expected: f64, roundings: f64, what: &str) {
    let error = (x - expected).abs();
    let allowed = 0.5 * roundings * f64::EPSILON * expected.abs();
    assert!(error <= allowed, "{what}: {x:e} in place of {expected:e}");
}

#[test]
fn maps_keep_their_digits_at_every_angle() {
    for angle in ANGLES.into_iter().flat_map(|a| [a, -a]) {
        let r = SO2::from_angle(angle);
        assert_close(r.angle(), angle, 2.0, "angle");
        assert_close(r.sqrt().angle(), 0.5 * angle, 4.0, "angle of the root");
        let expected = -2.0 * (0.5 * angle).sin().powi(2);
        assert_close(r.cos_minus_one(), expected, 8.0, "cos - 1");
    }
}

/// The chart's coordinate is $2 \tan\frac\theta2$, as far as the sine of an angle close to $\pi$ is known.
#[test]
fn the_cayley_chart_keeps_its_digits_up_to_pi() {
    for xi in [1e-300, 1e-8, 0.5, 2.0, 7.0, 1e4, 1e8, 1e12] {
        for xi in [xi, -xi] {
            let back = SO2::cayley(&Tangent([xi])).cayley_inverse().unwrap();
            assert_close(back[0], xi, 8.0, "chart");
        }
    }
}

#[test]
fn at_pi_the_inverses_say_that_they_have_no_single_value() {
    for angle in [PI, -PI, PI - 1e-16] {
        let g = SE2::exp(&Tangent([angle, 1.0, -2.0]));
        let Err(NotUnique { representative }) = g.log() else {
            panic!("a half turn has two logarithms");
        };
        let again = SE2::exp(&representative);
        assert_abs_diff_eq!(again, g, epsilon = 1e-15);
        assert_eq!(g.cayley_inverse(), Err(OutsideChart));
        assert_eq!(g.retract_inverse::<Exp>(), Err(OutsideChart));
    }
}

#[test]
fn past_pi_the_logarithm_takes_the_short_way() {
    let log = SO2::from_angle(PI + 0.1).log().unwrap();
    assert_abs_diff_eq!(log[0], 0.1 - PI, epsilon = 1e-15);
}

#[test]
fn derivatives_exist_at_zero() {
    let mut xi = Tangent([Dual::constant(0.0); 3]);
    lie::seed(&mut xi, 0);
    for g in [SE2::exp(&xi), SE2::cayley(&xi)] {
        for (map, factor) in [(g.log().unwrap(), 1.0), (g.sqrt().log().unwrap(), 0.5)] {
            for d in 0..3 {
                let expected = [0, 1, 2].map(|i| if i == d { factor } else { 0.0 });
                assert_eq!(map.0.map(|x| x.partial(d)), expected);
            }
        }
        assert_eq!(g.rotation.cos_minus_one().partial(0), 0.0);
    }
}

/// The cosine there is zero, and must not be divided by.
#[test]
fn the_angle_has_a_derivative_at_a_quarter_turn() {
    for sin in [1.0, -1.0] {
        let quarter = SO2::from_cos_sin_unchecked(0.0, sin);
        let lifted = <SO2 as LieGroup>::convert::<f64, Dual>(&quarter, Dual::constant);
        let turned = lifted.compose(&SO2::from_angle(Dual::variable(0.0, 0)));
        assert_eq!(turned.angle().value(), sin * FRAC_PI_2);
        assert_eq!(turned.angle().partial(0), 1.0);
    }
}

#[test]
fn rotations_stay_of_unit_length() {
    let step = SO2::<f64>::cayley(&Tangent([3.7e-3]));
    let mut r = SO2::identity();
    for k in 1..=1_000_000_u32 {
        r = r.compose(&step);
        if k % 32 == 0 {
            r.normalize();
        }
    }
    let defect = r.cos() * r.cos() + r.sin() * r.sin() - 1.0;
    assert!(defect.abs() < 1e-14, "{defect:e}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// As far as a half turn, which the examples of the other groups' directions do not reach in the plane.
    #[test]
    fn se2_anywhere(
        angles in proptest::array::uniform3(-PI..PI),
        v in proptest::array::uniform3(proptest::array::uniform2(-2.0..2.0_f64)),
    ) {
        let xi = [0, 1, 2].map(|i| Tangent([angles[i], v[i][0], v[i][1]]));
        lie::laws::check(&[SE2::exp(&xi[0]), SE2::exp(&xi[1])], &xi)?;
        let turns = xi.map(|xi| Tangent([xi[0]]));
        lie::laws::check(&[SO2::exp(&turns[0]), SO2::exp(&turns[1])], &turns)?;
    }
}

#[test]
fn the_laws_hold_close_to_a_half_turn() {
    let velocities = [PI - 1e-6, 1e-6 - PI, PI - 1e-3, 1e-8, 3.0]
        .map(|angle| Tangent([angle, 1.2, -0.4 * angle]));
    let elements = velocities.map(|xi| SE2::exp(&xi));
    let report = lie::laws::check(&elements, &velocities).unwrap();
    assert!(report.worst < 0.5, "{report:?}");
    let turns = velocities.map(|xi| Tangent([xi[0]]));
    let report = lie::laws::check(&turns.map(|xi| SO2::exp(&xi)), &turns).unwrap();
    assert!(report.worst < 0.5, "{report:?}");
}
