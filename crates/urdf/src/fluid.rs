//! What the fluid adds to a body of several ellipsoids.

use lie::{Mat3, Vec3};

use crate::shape::Solid;

/// A place this close to the mass centre, relative to the ellipsoid's length, is there but for rounding.
const ROUNDING: f64 = 1e-14;

/// What the fluid does to a body, about its mass centre and in its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Share {
    /// Added mass $M$, kg.
    pub mass: Mat3,
    /// How it couples velocity and turning, $C$ of $V \cdot C \Omega$, kg m.
    pub coupling: Mat3,
    /// Added inertia $J$, kg m².
    pub inertia: Mat3,
    /// Of what is displaced, m³.
    pub volume: f64,
    /// Where the buoyancy acts, from the mass centre, m.
    pub centre: Vec3,
}

/// The ellipsoids together, as if each were alone in the fluid.
///
/// An ellipsoid has the added mass $A$ and the added inertia $B$, and $r$ leads from the mass centre to it. The sums are $M = \sum A$,
/// $C = -\sum A \hat r$ and $J = \sum B - \hat r A \hat r$.
pub(crate) fn share(solids: &[Solid], mass_centre: Vec3, density: f64) -> Share {
    let mut share = Share {
        mass: Mat3::zero(),
        coupling: Mat3::zero(),
        inertia: Mat3::zero(),
        volume: 0.0,
        centre: Vec3::zero(),
    };
    let mut moment = Vec3::zero();
    for solid in solids {
        let ellipsoid = &solid.ellipsoid;
        let turned = |diagonal| {
            solid
                .frame
                .turn
                .matrix()
                .conjugate(Mat3::diagonal(diagonal))
        };
        let mass = turned(ellipsoid.added_mass(density));
        let longest = ellipsoid.semi_axes().into_iter().fold(0.0, f64::max);
        let r = match solid.frame.at - mass_centre {
            r if r.norm() < ROUNDING * longest => Vec3::zero(),
            r => r,
        };
        let by_place = r.hat().transpose() * mass * r.hat();
        share.mass += mass;
        share.coupling -= mass * r.hat();
        share.inertia += turned(ellipsoid.added_inertia(density)) + by_place;
        share.volume += ellipsoid.volume();
        moment += r * ellipsoid.volume();
    }
    if share.volume > 0.0 {
        share.centre = moment * (1.0 / share.volume);
    }
    share
}

impl Share {
    /// The added mass of 6 rows, translation first.
    pub fn rows(&self) -> [[f64; 6]; 6] {
        let (m, c, j) = (self.mass.0, self.coupling.0, self.inertia.0);
        let ct = self.coupling.transpose().0;
        let beside = |a: [f64; 3], b: [f64; 3]| {
            core::array::from_fn(|k| if k < 3 { a[k] } else { b[k - 3] })
        };
        core::array::from_fn(|i| match i {
            0..3 => beside(m[i], c[i]),
            _ => beside(ct[i - 3], j[i - 3]),
        })
    }
}
