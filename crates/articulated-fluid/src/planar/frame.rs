//! Frames with the normal of a plane.

use lie::{LieGroup, Mat3, SO2, SO3, Vec3};

use super::vector::{Sym2, Vec2};

/// The coordinate axis, of either sign, that is nearest to `x`.
pub(super) fn nearest_axis(x: Vec3) -> Vec3 {
    let longest = (0..3).max_by(|a, b| x[*a].abs().total_cmp(&x[*b].abs()));
    let mut axis = Vec3::zero();
    let k = longest.unwrap_or(0);
    axis[k] = x[k].signum();
    axis
}

/// The largest component of `x` across a coordinate axis.
pub(super) fn off_axis(x: Vec3, axis: Vec3) -> f64 {
    let across = (0..3).filter(|k| axis[*k] == 0.0);
    across.map(|k| x[k].abs()).fold(0.0, f64::max)
}

/// A right-handed orthonormal frame whose third axis is the normal of a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) first: Vec3,
    pub(super) second: Vec3,
    pub(super) normal: Vec3,
}

impl Frame {
    /// The frame with this normal, a coordinate axis: of coordinate axes.
    pub(super) fn with_normal(normal: Vec3) -> Self {
        let first = match normal[0] == 0.0 {
            true => Vec3([1.0, 0.0, 0.0]),
            false => Vec3([0.0, 1.0, 0.0]),
        };
        Self {
            first,
            second: normal.cross(first),
            normal,
        }
    }

    /// The coordinates in the plane.
    pub(super) fn project(&self, x: Vec3) -> Vec2 {
        Vec2([self.first.dot(x), self.second.dot(x)])
    }

    pub(super) fn lift(&self, Vec2([x, y]): Vec2) -> Vec3 {
        self.first * x + self.second * y
    }

    /// The block of a symmetric matrix in the plane.
    pub(super) fn block(&self, a: Mat3) -> Sym2 {
        let (first, second) = (a * self.first, a * self.second);
        Sym2([
            self.first.dot(first),
            self.first.dot(second),
            self.second.dot(second),
        ])
    }

    /// The angle of $W^T R N$, with `self` as $W$, as a rotation; of a rotation that does not keep the plane, the nearest.
    pub(super) fn angle_of(&self, r: &SO3, body: &Self) -> SO2 {
        let (u, v) = (r.rotate(body.first), r.rotate(body.second));
        let cos = self.first.dot(u) + self.second.dot(v);
        let sin = self.second.dot(u) - self.first.dot(v);
        let length = cos.hypot(sin);
        if length == 0.0 {
            return SO2::identity();
        }
        SO2::from_cos_sin_unchecked(cos / length, sin / length)
    }

    /// $W \operatorname{rot}(\theta) N^T$ with `self` as $W$.
    pub(super) fn attitude(&self, r: &SO2, body: &Self) -> SO3 {
        let mut r = *r;
        r.normalize();
        let (along, across) = (
            self.lift(Vec2(r.rotate([1.0, 0.0]))),
            self.lift(Vec2(r.rotate([0.0, 1.0]))),
        );
        let columns = [
            (along, body.first),
            (across, body.second),
            (self.normal, body.normal),
        ];
        let outer = columns.map(|(to, from)| to.outer(from));
        SO3::from_matrix_unchecked(outer[0] + outer[1] + outer[2])
    }
}
