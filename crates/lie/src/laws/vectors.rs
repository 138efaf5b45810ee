//! The laws of a vector space: its methods against `get` and `set`.

use super::checker::{Report, coordinates as coordinates_of, tolerance};
use super::linear::{filled, generic, zero};
use super::verdict::Outcome;
use crate::{Scalar, VectorSpace};

/// Checks the methods, starting from vectors filled with other numbers than they must leave.
pub(super) fn check<V: VectorSpace>(c: &mut Report, shape: &V) -> Outcome {
    coordinates(c, shape)?;
    slices(c, &generic(shape, 1.5))?;
    combinations(c, &generic(shape, 1.5), &generic(shape, -0.75))?;
    magnitudes(c, &generic(shape, 1.5))
}

fn coordinates<V: VectorSpace>(c: &mut Report, shape: &V) -> Outcome {
    for i in 0..shape.dim() {
        let (mut x, value) = (generic(shape, 1.5), V::Scalar::from_f64(9.0));
        let mut expected = coordinates_of(&x);
        x.set(i, value);
        expected[i] = value;
        same(
            c,
            "set x_i, and x_i alone",
            (&coordinates_of(&x), &expected),
        )?;
    }
    Ok(())
}

fn slices<V: VectorSpace>(c: &mut Report, x: &V) -> Outcome {
    let expected = coordinates_of(x);
    let garbage = V::Scalar::from_f64(9.0);

    // One number more than needed, which must stay.
    let mut written = vec![garbage; x.dim() + 1];
    x.write(&mut written);
    let (front, rest) = written.split_at(x.dim());
    same(c, "write(x)_i = x_i", (front, &expected))?;
    same(c, "write(x) leaves what is past x", (rest, &[garbage]))?;

    let mut copy = filled(x, &|_| garbage);
    copy.read(&[&expected[..], &[garbage]].concat());
    vectors(c, "read(write(x)) = x", (&copy, x))?;
    same(c, "coordinates(x)_i = x_i", (&x.coordinates(), &expected))
}

fn combinations<V: VectorSpace>(c: &mut Report, x: &V, y: &V) -> Outcome {
    let (a, garbage) = (V::Scalar::from_f64(0.5), V::Scalar::from_f64(9.0));
    let expected = filled(x, &|i| x.get(i) + a * y.get(i));

    let mut added = x.clone();
    added.add_scaled(a, y);
    vectors(c, "add_scaled: x + a y", (&added, &expected))?;
    let mut set = filled(x, &|_| garbage);
    set.set_sum(x, a, y);
    vectors(c, "set_sum = x + a y", (&set, &expected))?;

    let mut copied = filled(x, &|_| garbage);
    copied.copy_from(x);
    vectors(c, "copy_from: x", (&copied, x))?;
    let mut scaled = x.clone();
    scaled.scale(a);
    vectors(c, "scale: a x", (&scaled, &filled(x, &|i| a * x.get(i))))?;

    let mut none = x.clone();
    none.set_zero();
    vectors(c, "set_zero = 0", (&none, &zero(x)))?;
    vectors(c, "zero_like = 0", (&x.zero_like(), &zero(x)))
}

fn magnitudes<V: VectorSpace>(c: &mut Report, x: &V) -> Outcome {
    let coordinates = || (0..x.dim()).map(|i| x.get(i).magnitude());
    let squares: f64 = coordinates().map(|a| a * a).sum();
    let largest = coordinates().fold(0.0, f64::max);
    let case = || format!("x = {x:?}");
    let tolerance = tolerance::<V::Scalar>(1.0 + squares);
    let sides = (&[x.norm_squared()][..], &[squares][..]);
    c.numbers("|x|^2 = sum of x_i^2", &case, sides, tolerance)?;
    let sides = (&[x.max_magnitude()][..], &[largest][..]);
    c.numbers("max_magnitude = max |x_i|", &case, sides, tolerance)
}

fn vectors<V: VectorSpace>(c: &mut Report, formula: &'static str, sides: (&V, &V)) -> Outcome {
    c.vectors(formula, &|| format!("{:?}", sides.1), sides, 1.0)
}

fn same<S: Scalar>(c: &mut Report, formula: &'static str, sides: (&[S], &[S])) -> Outcome {
    let case = || format!("{:?}", sides.1);
    c.numbers(formula, &case, sides, tolerance::<S>(1.0))
}
