//! One group for all: any product of the groups that there are, sorted by kind.
//!
//! So an integrator is compiled once, whatever group a user's system lives on.

use lie::{LieGroup, Mat3, Power, Rn, SE2, SE3, SO2, SO3, Scalar, Vec3, VectorSpace};

/// Factors SO(2), SO(3), SE(2), SE(3), then coordinates of $\mathbb{R}^n$.
pub type Elements<S = f64> = (
    (Power<SO2<S>>, Power<SO3<S>>, Power<SE2<S>>, Power<SE3<S>>),
    Power<Rn<1, S>>,
);

/// How many there are of each kind, in that order.
pub type Counts = [usize; 5];

/// Numbers that a factor of each kind has.
const NUMBERS: Counts = [2, 9, 4, 12, 1];

pub fn counts(g: &Elements) -> Counts {
    let ((so2, so3, se2, se3), rn) = g;
    [so2.len(), so3.len(), se2.len(), se3.len(), rn.len()]
}

pub fn numbers_of(counts: Counts) -> usize {
    counts.iter().zip(NUMBERS).map(|(n, each)| n * each).sum()
}

pub fn identity([so2, so3, se2, se3, rn]: Counts) -> Elements {
    let rotations = (
        vec![SO2::identity(); so2].into_iter().collect(),
        vec![SO3::identity(); so3].into_iter().collect(),
        vec![SE2::identity(); se2].into_iter().collect(),
        vec![SE3::identity(); se3].into_iter().collect(),
    );
    (rotations, vec![Rn::identity(); rn].into_iter().collect())
}

/// Adds the numbers of an element, kind by kind: cosine and sine, or the matrix row by row, then the translation.
pub fn write<S: Scalar>(g: &Elements<S>, out: &mut Vec<S>) {
    let ((so2, so3, se2, se3), rn) = g;
    for turn in so2.iter() {
        out.extend([turn.cos(), turn.sin()]);
    }
    for turn in so3.iter() {
        out.extend(turn.matrix().0.as_flattened());
    }
    for place in se2.iter() {
        out.extend([place.rotation.cos(), place.rotation.sin()]);
        out.extend(place.translation);
    }
    for place in se3.iter() {
        out.extend(place.rotation.matrix().0.as_flattened());
        out.extend(place.translation.0);
    }
    for x in rn.iter() {
        out.push(x.0[0]);
    }
}

/// The element that has these numbers.
///
/// # Errors
/// Where there are too few, where one is not finite, or where a matrix is no rotation: a message.
pub fn read(counts: Counts, numbers: &[f64]) -> Result<Elements, String> {
    let expected = numbers_of(counts);
    if numbers.len() != expected {
        let found = numbers.len();
        return Err(format!(
            "the configuration has {found} numbers; expected {expected}"
        ));
    }
    if let Some(wrong) = numbers.iter().find(|x| !x.is_finite()) {
        return Err(format!(
            "the configuration has the number {wrong}; expected finite numbers"
        ));
    }
    let mut rest = numbers.iter().copied();
    let mut next = || rest.next().unwrap_or(f64::NAN);
    let [so2, so3, se2, se3, rn] = counts;
    let so2 = (0..so2)
        .map(|_| planar(&mut next))
        .collect::<Result<_, _>>()?;
    let so3 = (0..so3)
        .map(|_| spatial(&mut next))
        .collect::<Result<_, _>>()?;
    let se2 = (0..se2)
        .map(|_| Ok(SE2::new(planar(&mut next)?, [next(), next()])))
        .collect::<Result<_, String>>()?;
    let se3 = (0..se3)
        .map(|_| {
            Ok(SE3::new(
                spatial(&mut next)?,
                Vec3([next(), next(), next()]),
            ))
        })
        .collect::<Result<_, String>>()?;
    let rn = (0..rn).map(|_| Rn([next()])).collect();
    Ok(((so2, so3, se2, se3), rn))
}

/// Numbers that are off by this are taken for rounded.
const ROUNDED: f64 = 1e-8;

fn planar(next: &mut impl FnMut() -> f64) -> Result<SO2, String> {
    let [cos, sin] = [next(), next()];
    let off = (cos.hypot(sin) - 1.0).abs();
    match off <= ROUNDED {
        true => Ok(SO2::from_angle(sin.atan2(cos))),
        false => Err(format!(
            "a matrix is no rotation: its column has the length {}; expected [[cos a, -sin a], [sin a, cos a]]",
            cos.hypot(sin)
        )),
    }
}

fn spatial(next: &mut impl FnMut() -> f64) -> Result<SO3, String> {
    let mut matrix = Mat3::identity();
    matrix.0.as_flattened_mut().fill_with(next);
    SO3::from_matrix(matrix).map_err(|error| error.to_string())
}

/// The coordinates of a vector of the algebra or the dual.
pub fn coordinates<V: VectorSpace<Scalar = f64>>(x: &V) -> Vec<f64> {
    let mut out = vec![0.0; x.dim()];
    x.write(&mut out);
    out
}

/// The velocity that has these coordinates.
///
/// # Errors
/// Where there are too few or too many, or where one is not finite: a message.
pub fn velocity(
    g: &Elements,
    coordinates: &[f64],
) -> Result<<Elements as LieGroup>::Algebra, String> {
    let mut xi = g.zero_algebra();
    let (expected, found) = (xi.dim(), coordinates.len());
    if expected != found {
        return Err(format!(
            "the velocity has {found} coordinates; expected {expected}"
        ));
    }
    if let Some(wrong) = coordinates.iter().find(|x| !x.is_finite()) {
        return Err(format!(
            "the velocity has the number {wrong}; expected finite numbers"
        ));
    }
    xi.read(coordinates);
    Ok(xi)
}
