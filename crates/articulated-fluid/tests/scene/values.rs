//! Numbers, arrays and names that are none, and keys that are missing.

use crate::{assert_refused, refusal};

#[test]
fn wrong_numbers_of_elements_are_refused() {
    assert_refused(&[
        (
            "position = [1, 2, 3]",
            "position = [1, 2, 3, 4]",
            "f.toml:5:1: start.position: has 4 elements; \
             expected an array of 3 finite numbers, in m",
        ),
        (
            "semi_axes = [1, 2, 3]",
            "semi_axes = [1]",
            "f.toml:19:1: body.semi_axes: has 1 element; \
             expected an array of 3 finite numbers > 0, in m",
        ),
        (
            "attitude = [0, 1, 0, 0]",
            "attitude = [0, 1, 0]",
            "f.toml:11:1: body.attitude: has 3 elements; expected an array of 4 numbers \
             w, x, y, z: a quaternion of length 1 (to 1e-3), \
             a table { axis, angle } or \"aligned\"",
        ),
        (
            "total_mass = [1, 2, 3]",
            "total_mass = []",
            "f.toml:15:1: body.total_mass: has 0 elements; expected an array of 3 numbers > 0 \
             (diagonal) or of 3 rows of 3 numbers (symmetric to 1e-3 of the largest, positive definite), in kg",
        ),
        (
            "[0.5, 2, 0]",
            "[0.5, 2]",
            "f.toml:16:1: body.total_inertia: row 2 has 2 elements; expected an array of \
             3 numbers > 0 (diagonal) or of 3 rows of 3 numbers (symmetric to 1e-3 of the largest, positive definite), \
             in kg m^2",
        ),
        (
            "[0.5, 2, 0]",
            "2",
            "f.toml:16:1: body.total_inertia: mixes numbers and rows; expected an array of \
             3 numbers > 0 (diagonal) or of 3 rows of 3 numbers (symmetric to 1e-3 of the largest, positive definite), \
             in kg m^2",
        ),
    ]);
}

#[test]
fn what_is_not_finite_is_refused() {
    assert_refused(&[
        (
            "density = 1000",
            "density = nan",
            "f.toml:3:1: fluid.density: is NaN; expected a finite number >= 0, in kg/m^3",
        ),
        (
            "density = 1000",
            "density = inf",
            "f.toml:3:1: fluid.density: is inf; expected a finite number >= 0, in kg/m^3",
        ),
        (
            "density = 1000",
            "density = 1e999",
            "f.toml:3:1: fluid.density: floating-point number overflowed; \
             expected a finite number >= 0, in kg/m^3",
        ),
        (
            "position = [1, 2, 3]",
            "position = [1, nan, 3]",
            "f.toml:5:1: start.position: element 2 is NaN; \
             expected an array of 3 finite numbers, in m",
        ),
        (
            "velocity = [0.5, 0, -1]",
            "velocity = [0.5, 0, -inf]",
            "f.toml:6:1: start.velocity: element 3 is -inf; \
             expected an array of 3 finite numbers, in m/s, or \"zero-momentum\"",
        ),
        (
            "mass = 90",
            "mass = inf",
            "f.toml:10:1: body.mass: is inf; expected a finite number > 0, in kg",
        ),
        (
            "at_child = [2, 0, 0]",
            "at_child = [nan, 0, 0]",
            "f.toml:24:1: joint.at_child: element 1 is NaN; \
             expected an array of 3 finite numbers, in m",
        ),
        (
            "stiffness = 2.5",
            "stiffness = inf",
            "f.toml:30:1: joint.stiffness: is inf; expected a finite number >= 0, in N m",
        ),
        (
            "attitude = [0, 1, 0, 0]",
            "attitude = [0, nan, 0, 0]",
            "f.toml:11:1: body.attitude: element 2 is NaN; expected an array of 4 numbers \
             w, x, y, z: a quaternion of length 1 (to 1e-3), \
             a table { axis, angle } or \"aligned\"",
        ),
        (
            "total_mass = [1, 2, 3]",
            "total_mass = [1, 2, inf]",
            "f.toml:15:1: body.total_mass: element 3 is inf; expected an array of 3 numbers > 0 \
             (diagonal) or of 3 rows of 3 numbers (symmetric to 1e-3 of the largest, positive definite), in kg",
        ),
    ]);
}

#[test]
fn values_out_of_range_are_refused() {
    assert_refused(&[
        (
            "density = 1000",
            "density = -1",
            "f.toml:3:1: fluid.density: is -1.0; expected a finite number >= 0, in kg/m^3",
        ),
        (
            "mass = 90",
            "mass = 0",
            "f.toml:10:1: body.mass: is 0.0; expected a finite number > 0, in kg",
        ),
        (
            "stiffness = 2.5",
            "stiffness = -2.5",
            "f.toml:30:1: joint.stiffness: is -2.5; expected a finite number >= 0, in N m",
        ),
        (
            "semi_axes = [0.8, 0.15, 0.2]",
            "semi_axes = [0.8, -0.15, 0.2]",
            "f.toml:9:1: body.semi_axes: the semi-axis along y is -0.15; \
             expected a finite number > 0, in m",
        ),
        (
            "semi_axes = [1, 2, 3]",
            "semi_axes = [1e200, 2, 3]",
            "f.toml:19:1: body.semi_axes: the volume of semi-axes [1e200, 2.0, 3.0] is out of \
             range; expected lengths between about 1e-60 and 1e60, in m",
        ),
        (
            "density = 1000",
            "density = 1e308",
            "f.toml:19:1: body.semi_axes: the body's mass or inertia is out of range; \
             expected less extreme numbers",
        ),
        (
            "attitude = [0, 1, 0, 0]",
            "attitude = [0, 1.5, 0, 0]",
            "f.toml:11:1: body.attitude: has length 1.5; expected an array of 4 numbers \
             w, x, y, z: a quaternion of length 1 (to 1e-3), \
             a table { axis, angle } or \"aligned\"",
        ),
        (
            "total_mass = [1, 2, 3]",
            "total_mass = [1, -2, 3]",
            "f.toml:15:1: body.total_mass: element 2 is -2.0; expected an array of 3 numbers > 0 \
             (diagonal) or of 3 rows of 3 numbers (symmetric to 1e-3 of the largest, positive definite), in kg",
        ),
        (
            "[0.5, 2, 0]",
            "[0.6, 2, 0]",
            "f.toml:16:1: body.total_inertia: not symmetric: row 1 has 0.5 in column 2, row 2 has \
             0.6 in column 1; expected an array of 3 numbers > 0 (diagonal) or of 3 rows of \
             3 numbers (symmetric to 1e-3 of the largest, positive definite), in kg m^2",
        ),
        (
            "[0.5, 2, 0]",
            "[0.5, 0.125, 0]",
            "f.toml:16:1: body.total_inertia: not positive definite: pivot 2 is 0.0; expected \
             an array of 3 numbers > 0 (diagonal) or of 3 rows of 3 numbers (symmetric to 1e-3 of the largest, \
             positive definite), in kg m^2",
        ),
    ]);
}

#[test]
fn names_that_are_no_names_or_no_longer_free_are_refused() {
    assert_refused(&[
        (
            "name = \"tail-1\"",
            "name = \"\"",
            "f.toml:14:1: body.name: is \"\"; \
             expected a unique name of letters a-z A-Z, digits, - _ / and .",
        ),
        (
            "name = \"tail-1\"",
            "name = \"tail,1\\n\"",
            "f.toml:14:1: body.name: is \"tail,1\\n\"; \
             expected a unique name of letters a-z A-Z, digits, - _ / and .",
        ),
        (
            "name = \"tail-1\"",
            "name = \"head\"",
            "f.toml:14:1: body.name: \"head\" is the body in line 8; \
             expected a unique name of letters a-z A-Z, digits, - _ / and .",
        ),
    ]);
}

#[test]
fn missing_keys_are_reported_at_their_table() {
    assert_refused(&[
        (
            "density = 1000\n",
            "",
            "f.toml:2:1: fluid.density: missing; expected a finite number >= 0, in kg/m^3",
        ),
        (
            "[fluid]\ndensity = 1000\n",
            "",
            "f.toml:1:1: fluid: missing; expected one table [fluid]",
        ),
        (
            "name = \"tail-1\"\n",
            "",
            "f.toml:13:1: body.name: missing; \
             expected a unique name of letters a-z A-Z, digits, - _ / and .",
        ),
        (
            "total_mass = [1, 2, 3]\n",
            "",
            "f.toml:13:1: body.total_mass: missing; expected an array of 3 numbers > 0 \
             (diagonal) or of 3 rows of 3 numbers (symmetric to 1e-3 of the largest, positive definite), in kg",
        ),
        (
            "semi_axes = [1, 2, 3]\n",
            "",
            "f.toml:17:1: body: no inertia; expected either semi_axes, or mass and inertia, or \
             total_mass and total_inertia",
        ),
        (
            "density = 1000",
            "density = 0",
            "f.toml:17:1: body: no mass, and no neutral buoyancy at density 0; expected the key mass",
        ),
        (
            "parent = \"head\"\nchild = \"tail-1\"",
            "parent = \"head\"",
            "f.toml:25:1: joint.child: missing; expected the name of a body other than the first",
        ),
        (
            "at_parent = [1, 0, 0]\n",
            "",
            "f.toml:25:1: joint.at_parent: missing; expected an array of 3 finite numbers, in m",
        ),
    ]);
    let message = refusal("[fluid]\ndensity = 1\n").to_string();
    assert_eq!(
        message,
        "f.toml:1:1: body: missing; expected one table [[body]] for each body"
    );
}
