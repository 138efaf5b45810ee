//! Attitudes, rates and the velocity at the start.

use articulated_fluid::scene::StartVelocity;

use crate::{GOOD, assert_refused, parse};

#[test]
fn a_quaternion_is_normalised() {
    let text = GOOD.replace("[0, 1, 0, 0]", "[0.6, 0, 0, 0.8000005]");
    let attitude = parse(&text).bodies[0].attitude;
    let length = attitude.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!((length - 1.0).abs() < 4.0 * f64::EPSILON);
    assert!((attitude[0] - 0.6).abs() < 1e-6);
}

#[test]
fn an_attitude_has_three_forms() {
    let (sin, cos) = 0.25_f64.sin_cos();
    for (written, expected) in [
        ("\"aligned\"", [1.0, 0.0, 0.0, 0.0]),
        ("{ axis = [0, 0, 2], angle = 0.5 }", [cos, 0.0, 0.0, sin]),
        (
            "{ axis = [0, -1e300, 0], angle = 0.5 }",
            [cos, 0.0, -sin, 0.0],
        ),
        (
            "{ axis = [1e-300, 0, 0], angle = -0.5 }",
            [cos, -sin, 0.0, 0.0],
        ),
        ("{ axis = [3, 0, 4], angle = 0 }", [1.0, 0.0, 0.0, 0.0]),
    ] {
        let scene = parse(&GOOD.replace("[0, 1, 0, 0]", written));
        for (found, expected) in scene.bodies[0].attitude.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15, "{written}");
        }
    }
}

#[test]
fn attitudes_that_are_none_are_refused() {
    let expected = "an array of 4 numbers w, x, y, z: a quaternion of length 1 (to 1e-3), \
                    a table { axis, angle } or \"aligned\"";
    for (written, at, message) in [
        (
            "\"straight\"",
            "1: body.attitude",
            format!("is \"straight\"; expected {expected}"),
        ),
        (
            "3",
            "1: body.attitude",
            format!("wrong type: integer `3`; expected {expected}"),
        ),
        (
            "1979-05-27",
            "1: body.attitude",
            format!("wrong type: date or time; expected {expected}"),
        ),
        (
            "{ axis = [0, 0, 0], angle = 1 }",
            "14: body.attitude.axis",
            "has length 0; expected an array of 3 finite numbers, not all 0".to_owned(),
        ),
        (
            "{ axis = [0, 0, 1], angle = inf }",
            "32: body.attitude.angle",
            "is inf; expected a finite number, in rad".to_owned(),
        ),
        (
            "{ axis = [0, 0, 1] }",
            "1: body.attitude.angle",
            "missing; expected a finite number, in rad".to_owned(),
        ),
        (
            "{ axis = [0, 0, 1], degrees = 90 }",
            "32: body.attitude.degrees",
            "unknown key; expected `axis` or `angle`".to_owned(),
        ),
        (
            "{ axis = 'z', angle = 90 }",
            "14: body.attitude.axis",
            "wrong type: string \"z\"; expected an array of 3 finite numbers, not all 0".to_owned(),
        ),
    ] {
        let expected = format!("f.toml:11:{at}: {message}");
        assert_refused(&[("[0, 1, 0, 0]", written, &expected)]);
    }
}

/// The head turns by a half about x; the tail by a quarter about z.
const TURNED: &str = "
fluid.density = 1
start.velocity = 'zero-momentum'
[[body]]
name = 'head'
semi_axes = [1, 1, 1]
attitude = { axis = [1, 0, 0], angle = 3.141592653589793 }
angular_velocity = [1, 2, 3]
[[body]]
name = 'tail'
semi_axes = [1, 1, 1]
attitude = { axis = [0, 0, 1], angle = 1.5707963267948966 }
joint_rate = [10, 20, 30]
[[joint]]
parent = 'head'
child = 'tail'
at_parent = [1, 0, 0]
at_child = [-1, 0, 0]
";

#[test]
fn a_joint_rate_is_relative_to_the_parent() {
    let scene = parse(TURNED);
    // In the reference frame the head turns at (1, -2, -3), in the tail's that is (-2, -1, -3).
    let rate = scene.bodies[1].angular_velocity;
    for (found, expected) in rate.iter().zip([8.0, 19.0, 27.0]) {
        assert!((found - expected).abs() < 1e-14, "{rate:?}");
    }
}

#[test]
fn rates_that_do_not_fit_are_refused() {
    assert_refused(&[
        (
            "angular_velocity = [1, 2, 3]",
            "joint_rate = [1, 2, 3]",
            "f.toml:12:1: body.joint_rate: the first body hangs on no joint; \
             expected the key angular_velocity",
        ),
        (
            "angular_velocity = [1, 2, 3]",
            "angular_velocity = [1, 2, 3]\njoint_rate = [1, 2, 3]",
            "f.toml:13:1: body.joint_rate: given together with angular_velocity; \
             expected one of them",
        ),
        (
            "semi_axes = [1, 2, 3]",
            "semi_axes = [1, 2, 3]\njoint_rate = [1, 2]",
            "f.toml:20:1: body.joint_rate: has 2 elements; \
             expected an array of 3 finite numbers, in rad/s",
        ),
    ]);
    let text = TURNED
        .replace("[1, 2, 3]", "[0, 0, -1e308]")
        .replace("30]", "1.7e308]");
    assert_eq!(
        crate::refusal(&text).to_string(),
        "f.toml:13:1: body.joint_rate: with the parent's, the rate overflows; \
         expected less extreme numbers"
    );
}

#[test]
fn the_velocity_may_be_that_of_no_momentum() {
    let scene = parse(TURNED);
    assert_eq!(scene.velocity, StartVelocity::ZeroMomentum);
    let (_, momentum, _) = scene.initial_state().expect("a state").mu;
    assert!(momentum[0].vec3().norm() < 1e-13, "{momentum:?}");
    assert_refused(&[(
        "velocity = [0.5, 0, -1]",
        "velocity = 'rest'",
        "f.toml:6:1: start.velocity: is \"rest\"; \
         expected an array of 3 finite numbers, in m/s, or \"zero-momentum\"",
    )]);
}
