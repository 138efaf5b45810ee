//! The forms of a body, and what gravity needs of them.

use articulated_fluid::ellipsoid::Ellipsoid;

use crate::{GOOD, assert_refused, diagonal, parse};

#[test]
fn the_totals_of_an_ellipsoid_are_its_own_and_the_added_inertia() {
    let scene = parse(GOOD);
    for (index, mass) in [(0, Some(90.0)), (2, None)] {
        let body = &scene.bodies[index];
        let shape = Ellipsoid::new(body.semi_axes().expect("semi-axes")).expect("an ellipsoid");
        let mass = mass.unwrap_or(shape.neutral_mass(1000.0));
        let (dry, added) = (shape.dry_inertia(mass), shape.added_inertia(1000.0));
        let masses = shape.added_mass(1000.0).map(|added| mass + added);
        assert_eq!(diagonal(body.total_mass), masses);
        assert_eq!(
            diagonal(body.total_inertia),
            [0, 1, 2].map(|i| dry[i] + added[i])
        );
    }
}

#[test]
fn mixed_and_incomplete_forms_are_refused() {
    assert_refused(&[
        (
            "mass = 90",
            "total_inertia = [1, 1, 1]",
            "f.toml:10:1: body.total_inertia: given together with semi_axes; expected either \
             semi_axes, or mass and inertia, or total_mass and total_inertia",
        ),
        (
            "mass = 90",
            "mass = 90\nvolume = 1",
            "f.toml:11:1: body.volume: given together with semi_axes; expected either \
             semi_axes, or mass and inertia, or total_mass and total_inertia",
        ),
        (
            "total_mass = [1, 2, 3]",
            "mass = 3",
            "f.toml:15:1: body.mass: given together with total_inertia; expected either \
             semi_axes, or mass and inertia, or total_mass and total_inertia",
        ),
        (
            "total_mass = [1, 2, 3]",
            "total_mass = [1, 2, 3]\nadded_mass = [1, 2, 3]",
            "f.toml:16:1: body.added_mass: given together with total_mass; expected either \
             semi_axes, or mass and inertia, or total_mass and total_inertia",
        ),
        (
            "semi_axes = [0.8, 0.15, 0.2]\n",
            "",
            "f.toml:9:1: body.mass: a mass alone; expected semi_axes or inertia as well",
        ),
        (
            "semi_axes = [1, 2, 3]",
            "inertia = [1, 1, 1]",
            "f.toml:17:1: body.mass: missing; expected a finite number > 0, in kg",
        ),
    ]);
}

/// A scene of one body that is given by its `keys`.
fn one(gravity: &str, density: f64, keys: &str) -> String {
    format!("gravity = {gravity}\nfluid.density = {density}\n[[body]]\nname = 'hull'\n{keys}")
}

#[test]
fn an_explicit_body_is_the_sum_of_its_own_and_the_added_inertia() {
    let scene = parse(&one(
        "[0, 0, -9.8]",
        1000.0,
        "mass = 3\ninertia = [[2, 0.5, 0], [0.5, 2, 0], [0, 0, 1.5]]\n\
         added_mass = [[1, 1, 0], [1, 1, 0], [0, 0, 0]]\nadded_inertia = [0, 0, 4]\nvolume = 0.002",
    ));
    assert_eq!(scene.gravity, [0.0, 0.0, -9.8]);
    let body = &scene.bodies[0];
    assert_eq!(
        body.total_mass,
        [[4.0, 1.0, 0.0], [1.0, 4.0, 0.0], [0.0, 0.0, 3.0]]
    );
    assert_eq!(
        body.total_inertia,
        [[2.0, 0.5, 0.0], [0.5, 2.0, 0.0], [0.0, 0.0, 5.5]]
    );
    assert_eq!(body.semi_axes(), None);
    assert_eq!(body.net_mass, 1.0);
}

#[test]
fn the_net_mass_is_less_the_displaced_one() {
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    for (density, keys, expected) in [
        (1.0, "semi_axes = [1, 1, 1]", 0.0),
        (1.0, "semi_axes = [1, 1, 1]\nmass = 4.18879020478639", 0.0),
        (1.0, "semi_axes = [1, 1, 1]\nmass = 6", 6.0 - ball),
        (
            1.0,
            "shape = [1, 1, 1]\nmass = 6\ninertia = [1, 1, 1]",
            6.0 - ball,
        ),
        (
            1.0,
            "shape = [1, 1, 1]\nvolume = 2\nmass = 6\ninertia = [1, 1, 1]",
            4.0,
        ),
        (1.0, "volume = 8\nmass = 6\ninertia = [1, 1, 1]", -2.0),
        (0.0, "mass = 6\ninertia = [1, 1, 1]", 6.0),
    ] {
        let scene = parse(&one("[0, 0, -9.8]", density, keys));
        assert_eq!(scene.bodies[0].net_mass, expected, "{keys}");
    }
}

#[test]
fn totals_may_break_the_triangle_inequality_and_a_body_may_not() {
    let flat = "mass = 1\ninertia = [[2, 1, 0], [1, 2, 0], [0, 0, 4]]";
    assert_eq!(parse(&one("[0, 0, 0]", 1.0, flat)).bodies[0].net_mass, 0.0);
    parse(&one(
        "[0, 0, 0]",
        1.0,
        "total_mass = [1, 1, 1]\ntotal_inertia = [1, 1, 3]",
    ));
}

#[test]
fn bodies_that_cannot_be_are_refused() {
    let refused = |gravity: &str, keys: &str, expected: &str| {
        let message = crate::refusal(&one(gravity, 1.0, keys)).to_string();
        assert_eq!(message, format!("f.toml:{expected}"));
    };
    let (none, down) = ("[0, 0, 0]", "[0, 0, -9.8]");
    let triangle = "body.inertia: a principal moment exceeds the sum of the two others; expected \
                    the inertia of the body alone, and what the fluid adds as added_inertia; an \
                    inertia with the added one in it is total_inertia, with total_mass";
    for inertia in ["[1, 1, 2.1]", "[[2, 1, 0], [1, 2, 0], [0, 0, 4.001]]"] {
        let keys = format!("mass = 1\ninertia = {inertia}");
        refused(none, &keys, &format!("6:1: {triangle}"));
    }
    let semidefinite = "an array of 3 numbers >= 0 (diagonal) or of 3 rows of 3 numbers, or of 6 \
                        rows of 6 (symmetric to 1e-3 of the largest, positive semidefinite), in \
                        kg, kg m and kg m^2";
    for (added, what) in [
        ("[1, -1, 0]", "element 2 is -1.0"),
        (
            "[[1, 2, 0], [2, 1, 0], [0, 0, 1]]",
            "not positive semidefinite",
        ),
        (
            "[[0, 0, 0], [0, 0, 1], [0, 1, 1]]",
            "not positive semidefinite",
        ),
    ] {
        let keys = format!("mass = 1\ninertia = [1, 1, 1]\nadded_mass = {added}");
        let message = format!("7:1: body.added_mass: {what}; expected {semidefinite}");
        refused(none, &keys, &message);
    }
    refused(
        down,
        "mass = 1\ninertia = [1, 1, 1]",
        "3:1: body: no volume, on which buoyancy depends; expected the key volume or shape in a \
         scene with gravity",
    );
    refused(
        down,
        "total_mass = [1, 1, 1]\ntotal_inertia = [1, 1, 1]",
        "5:1: body.total_mass: the body's own mass is not known, so its weight is not; expected \
         semi_axes, or mass and inertia, in a scene with gravity",
    );
    refused(
        none,
        "mass = 1\ninertia = [1, 1, 1]\nvolume = -1",
        "7:1: body.volume: is -1.0; expected a finite number >= 0, in m^3",
    );
    refused(
        none,
        "mass = 1e308\ninertia = [1, 1, 1]\nadded_mass = [1e308, 0, 0]",
        "5:1: body.mass: the body's mass or inertia is out of range; expected less extreme numbers",
    );
    refused(
        "[0, 1]",
        "semi_axes = [1, 1, 1]",
        "1:1: gravity: has 2 elements; expected an array of 3 finite numbers, in m/s^2",
    );
}

#[test]
fn without_a_fluid_nothing_is_added() {
    let keys = "mass = 1\ninertia = [1, 1, 1]\n";
    for (added, key) in [
        ("added_mass = [5, 5, 9]", "added_mass"),
        ("added_inertia = [0, 0, 1e-9]", "added_inertia"),
    ] {
        let text = one("[0, 0, 0]", 0.0, &format!("{keys}{added}"));
        assert_eq!(
            crate::refusal(&text).to_string(),
            format!(
                "f.toml:7:1: body.{key}: not zero, but without a fluid (fluid.density = 0) nothing \
                 is added; expected zero or no such key, or a density > 0"
            )
        );
    }
    let zero = "added_mass = [0, 0, 0]\nadded_inertia = [0, 0, 0]";
    parse(&one("[0, 0, 0]", 0.0, &format!("{keys}{zero}")));
}

#[test]
fn a_volume_of_zero_contradicts_a_shape() {
    let keys = "mass = 1\ninertia = [1, 1, 1]\nvolume = 0";
    for density in [0.0, 1.0] {
        let text = one("[0, 0, 0]", density, &format!("{keys}\nshape = [1, 1, 1]"));
        assert_eq!(
            crate::refusal(&text).to_string(),
            "f.toml:7:1: body.volume: volume is 0, but the key shape gives the body an extent; \
             expected a volume > 0 or no such key, or no shape"
        );
    }
    let scene = parse(&one("[0, 0, -9.8]", 1.0, keys));
    assert_eq!(scene.bodies[0].net_mass, 1.0);
}
