//! Directions in space: units, normals and principal axes.

use lie::{Mat3, Vec3};

/// Sweeps of Jacobi's rotations: they converge quadratically.
const SWEEPS: usize = 8;

/// $x / |x|$.
pub(super) fn unit(x: Vec3) -> Vec3 {
    x * (1.0 / x.norm())
}

/// The longest of the vectors; zero of none.
pub(super) fn longest(vectors: &[Vec3]) -> Vec3 {
    let longer = |a: &&Vec3, b: &&Vec3| a.norm().total_cmp(&b.norm());
    vectors
        .iter()
        .max_by(longer)
        .copied()
        .unwrap_or(Vec3::zero())
}

/// The cross product of two vectors, the longest and the one farthest from its line; zero where all are on one.
pub(super) fn normal_to(vectors: &[Vec3]) -> Vec3 {
    let first = longest(vectors);
    let across: Vec<Vec3> = vectors.iter().map(|x| first.cross(*x)).collect();
    longest(&across)
}

/// The eigenvectors of a symmetric matrix, by Jacobi's rotations.
pub(super) fn principal_axes(mut a: Mat3) -> [Vec3; 3] {
    let mut axes = Mat3::identity();
    for (p, q) in [(0, 1), (0, 2), (1, 2)].repeat(SWEEPS) {
        if a[(p, q)] == 0.0 {
            continue;
        }
        let angle = 0.5 * (2.0 * a[(p, q)] / (a[(q, q)] - a[(p, p)])).atan();
        let (sin, cos) = angle.sin_cos();
        let mut turn = Mat3::identity();
        (turn[(p, p)], turn[(p, q)]) = (cos, -sin);
        (turn[(q, p)], turn[(q, q)]) = (sin, cos);
        (a, axes) = (turn.conjugate(a), turn * axes);
    }
    axes.0.map(Vec3)
}
