//! What acts on bodies beside weight. Each load is a file, a variant of [`BodyLoad`], and its keys in [`KEYS`](crate::scene::KEYS).

mod drag;
mod thrust;

use lie::{Scalar, Vec3};

pub use drag::Drag;
pub use thrust::Thrust;

use crate::motion::Timed;
use crate::scene::entry::Table;
use crate::scene::error::SceneError;

/// The rate and the velocity of the mass centre of a body, both in its frame.
pub(crate) type Twist<S> = [Vec3<S>; 2];

/// A force at the mass centre of a body and a moment about it, both in its frame.
pub(crate) type Wrench<S> = [Vec3<S>; 2];

/// What acts on a body beside weight.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyLoad {
    /// Drag, linear and quadratic.
    Drag(Drag),
    /// Thrust, constant in the body's frame or as told.
    Thrust(Thrust),
}

/// What reads a load in a scene.
type Read = fn(&Table) -> Result<BodyLoad, SceneError>;

/// The names of the loads, which are their keys in a scene, in the order in which they act; and what reads them.
const ALL: &[(&str, Read)] = &[
    (Drag::NAME, |table| Drag::read(table).map(BodyLoad::Drag)),
    (Thrust::NAME, |table| {
        Thrust::read(table).map(BodyLoad::Thrust)
    }),
];

impl BodyLoad {
    /// The names of all kinds of loads.
    pub fn names() -> impl ExactSizeIterator<Item = &'static str> {
        ALL.iter().map(|(name, _)| *name)
    }

    /// Its name, as in `drag_work`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Drag(_) => Drag::NAME,
            Self::Thrust(_) => Thrust::NAME,
        }
    }

    /// Whether it does anything.
    pub fn acts(&self) -> bool {
        match self {
            Self::Drag(drag) => drag.acts(),
            Self::Thrust(_) => true,
        }
    }

    /// Where it acts, from the mass centre, m in the body's frame; none of one that acts at the mass centre.
    pub fn point_mut(&mut self) -> Option<&mut Vec3> {
        match self {
            Self::Drag(_) => None,
            Self::Thrust(thrust) => Some(&mut thrust.at),
        }
    }

    /// Whether its numbers make a load.
    pub(super) fn is_sound(&self) -> bool {
        match self {
            Self::Drag(drag) => drag.is_sound(),
            Self::Thrust(thrust) => thrust.at.is_finite(),
        }
    }

    /// The law that it is told by, if any.
    pub(super) fn law(&self) -> Option<&dyn Timed> {
        match self {
            Self::Drag(_) => None,
            Self::Thrust(thrust) => Some(&thrust.force),
        }
    }

    /// What it is told at the time `t`: the part of its wrench that depends on nothing else.
    #[inline(always)]
    pub(super) fn told<S: Scalar>(&self, t: S) -> Wrench<S> {
        match self {
            Self::Drag(_) => [Vec3::zero(); 2],
            Self::Thrust(thrust) => thrust.wrench(t),
        }
    }

    /// Its wrench, of what it is told and of the body's motion.
    #[inline(always)]
    pub(super) fn wrench<S: Scalar>(
        &self,
        told: Wrench<S>,
        twist: impl FnOnce() -> Twist<S>,
    ) -> Wrench<S> {
        match self {
            Self::Drag(drag) => drag.wrench(twist()),
            Self::Thrust(_) => told,
        }
    }

    /// The loads of the body in this table.
    pub(crate) fn read_all(body: &Table) -> Result<Vec<Self>, SceneError> {
        let given = ALL
            .iter()
            .filter_map(|(name, read)| Some((body.get(name)?, read)));
        given.map(|(value, read)| read(&value.table()?)).collect()
    }
}
