//! Principal axes of a symmetric matrix.

use lie::{Mat3, SO3};

/// Sweeps of Jacobi's rotations: they converge quadratically.
const SWEEPS: usize = 12;

/// The axes $R$ and the moments $\lambda$ with $A = R\, \mathrm{diag}(\lambda)\, R^T$, by Jacobi's rotations.
///
/// Of a diagonal matrix the axes are the frame's own.
pub(crate) fn principal(matrix: Mat3) -> (SO3, [f64; 3]) {
    let (mut a, mut axes) = (matrix, Mat3::identity());
    for (p, q) in [(0, 1), (0, 2), (1, 2)].repeat(SWEEPS) {
        if a[(p, q)] == 0.0 {
            continue;
        }
        let cot = (a[(q, q)] - a[(p, p)]) / (2.0 * a[(p, q)]);
        let tan = 1.0_f64.copysign(cot) / (cot.abs() + cot.hypot(1.0));
        let cos = 1.0 / tan.hypot(1.0);
        let mut turn = Mat3::identity();
        (turn[(p, p)], turn[(q, q)]) = (cos, cos);
        (turn[(p, q)], turn[(q, p)]) = (cos * tan, -cos * tan);
        a = turn.transpose().conjugate(a);
        // Rounding would leave rests that are turned again and again.
        (a[(p, q)], a[(q, p)]) = (0.0, 0.0);
        axes = axes * turn;
    }
    let moments = [a[(0, 0)], a[(1, 1)], a[(2, 2)]];
    (SO3::from_matrix_unchecked(axes), moments)
}

#[cfg(test)]
mod tests {
    use lie::Vec3;
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn the_axes_and_moments_give_the_matrix_again(
            diagonal in [-1.0..1.0, -1.0..1.0, -1.0..1.0],
            off in [-1.0..1.0, -1.0..1.0, -1.0..1.0],
            small in 1e-12..1.0,
        ) {
            let [x, y, z] = off.map(|x| x * small);
            let [a, b, c] = diagonal;
            let matrix = Mat3([[a, x, y], [x, b, z], [y, z, c]]);
            let (axes, moments) = principal(matrix);
            let again = axes.matrix().conjugate(Mat3::diagonal(moments));
            prop_assert!((again - matrix).frobenius() < 1e-14);
            prop_assert!(axes.orthogonality_error() < 1e-14);
            let [u, v, w] = [0, 1, 2].map(|i| axes.matrix().row(i));
            prop_assert!((u.cross(v) - w).norm() < 1e-14);
        }
    }

    #[test]
    fn a_diagonal_matrix_has_the_axes_of_the_frame() {
        let (axes, moments) = principal(Mat3::diagonal([3.0, 1.0, 2.0]));
        assert_eq!((axes, moments), (SO3::identity(), [3.0, 1.0, 2.0]));
        assert_eq!(axes.rotate(Vec3([1.0, 2.0, 3.0])), Vec3([1.0, 2.0, 3.0]));
    }
}
