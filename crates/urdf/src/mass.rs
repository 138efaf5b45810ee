//! Masses of links, and of links that are fixed to each other.

use lie::{Mat3, Vec3};

use crate::error::UrdfError;
use crate::pose::Pose;
use crate::principal::principal;

/// How far a principal moment may exceed the sum of the two others, relative: rounding.
const ROUNDING: f64 = 1e-13;

/// Mass, mass centre and inertia about it, in some frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mass {
    /// kg.
    pub mass: f64,
    /// m.
    pub centre: Vec3,
    /// kg m².
    pub inertia: Mat3,
}

impl Mass {
    /// That of a link, in its frame.
    pub fn of(link: &urdf_rs::Link) -> Result<Self, UrdfError> {
        let inertial = &link.inertial;
        let mass = inertial.mass.value;
        if !(mass == 0.0 || mass.is_normal() && mass > 0.0) {
            let link = link.name.clone();
            return Err(UrdfError::Mass { link, mass });
        }
        let i = &inertial.inertia;
        let about = [
            [i.ixx, i.ixy, i.ixz],
            [i.ixy, i.iyy, i.iyz],
            [i.ixz, i.iyz, i.izz],
        ];
        let origin = &inertial.origin;
        let values = [
            &about[0][..],
            &about[1],
            &about[2],
            &origin.xyz.0,
            &origin.rpy.0,
        ]
        .concat();
        if !values.iter().all(|x| x.is_finite()) {
            return Err(UrdfError::Number {
                element: "link",
                name: link.name.clone(),
                what: "the inertia and its origin",
                value: values,
                expected: "finite numbers, in kg m^2, m and rad",
            });
        }
        let aligned = Self {
            mass,
            centre: Vec3::zero(),
            inertia: Mat3(about),
        };
        Ok(aligned.seen_from(&Pose::of(origin)))
    }

    /// 1 kg, for what is held: it plays no part there.
    pub fn of_one() -> Self {
        Self {
            mass: 1.0,
            centre: Vec3::zero(),
            inertia: Mat3::identity(),
        }
    }

    /// The same in the frame in which its own is `pose`.
    pub fn seen_from(&self, pose: &Pose) -> Self {
        Self {
            mass: self.mass,
            centre: pose.place(self.centre),
            inertia: pose.turn.matrix().conjugate(self.inertia),
        }
    }

    /// All together: $J = \sum J_i + m_i (|r_i|^2 - r_i r_i^T)$, $r_i$ from the mass centre.
    pub fn sum(masses: &[Self]) -> Self {
        let mass: f64 = masses.iter().map(|one| one.mass).sum();
        let weighted = |sum: Vec3, one: &Self| sum + one.centre * one.mass;
        let centre = match mass {
            0.0 => Vec3::zero(),
            mass => masses.iter().fold(Vec3::zero(), weighted) * (1.0 / mass),
        };
        let inertia = |sum: Mat3, one: &Self| {
            let r = one.centre - centre;
            let moved = Mat3::diagonal([r.norm_squared(); 3]) - r.outer(r);
            sum + one.inertia + moved * one.mass
        };
        Self {
            mass,
            centre,
            inertia: masses.iter().fold(Mat3::zero(), inertia),
        }
    }

    /// Refuses what no rigid body has; `link` is the one to name.
    pub fn check(&self, link: &str) -> Result<(), UrdfError> {
        if self.mass == 0.0 {
            let link = link.to_owned();
            return Err(UrdfError::NoMass { link });
        }
        let (_, mut moments) = principal(self.inertia);
        moments.sort_by(f64::total_cmp);
        let [a, b, c] = moments;
        match a > ROUNDING * c && c <= (a + b) * (1.0 + ROUNDING) {
            true => Ok(()),
            false => Err(UrdfError::Inertia {
                link: link.to_owned(),
                moments,
            }),
        }
    }
}
