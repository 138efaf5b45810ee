//! What the fluid adds to a body of several ellipsoids.

use lie::{Mat3, Vec3};

use crate::shape::Solid;

/// What the fluid does to a body, about its mass centre and in its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Share {
    /// The added mass of 6 rows, translation first, kg, kg m and kg m².
    pub added: [[f64; 6]; 6],
    /// Of what is displaced, m³.
    pub volume: f64,
    /// Where the buoyancy acts, from the mass centre, m.
    pub centre: Vec3,
}

/// The ellipsoids together, as if each were alone in the fluid: with $r$ from the mass centre to one that has the added mass $A$
/// and the added inertia $B$, $M = \sum A$, $C = -\sum A \hat r$ and $J = \sum B - \hat r A \hat r$.
pub(crate) fn share(solids: &[Solid], mass_centre: Vec3, density: f64) -> Share {
    let (mut m, mut c, mut j) = (Mat3::zero(), Mat3::zero(), Mat3::zero());
    let (mut volume, mut moment) = (0.0, Vec3::zero());
    for solid in solids {
        let ellipsoid = &solid.ellipsoid;
        let turned = |diagonal| {
            solid
                .frame
                .turn
                .matrix()
                .conjugate(Mat3::diagonal(diagonal))
        };
        let (mass, inertia) = (
            turned(ellipsoid.added_mass(density)),
            turned(ellipsoid.added_inertia(density)),
        );
        let r = solid.centre() - mass_centre;
        m = m + mass;
        c = c - mass * r.hat();
        j = j + inertia + r.hat().transpose() * mass * r.hat();
        volume += ellipsoid.volume();
        moment = moment + r * ellipsoid.volume();
    }
    let ct = c.transpose();
    let row = |i: usize| match i {
        0..3 => [m.0[i], c.0[i]].concat(),
        _ => [ct.0[i - 3], j.0[i - 3]].concat(),
    };
    let centre = match volume {
        0.0 => Vec3::zero(),
        volume => moment * (1.0 / volume),
    };
    Share {
        added: core::array::from_fn(|i| core::array::from_fn(|k| row(i)[k])),
        volume,
        centre,
    }
}
