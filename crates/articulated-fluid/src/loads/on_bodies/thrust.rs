//! Thrust: a force at a point of a body, which goes with it, (S28).

use std::sync::Arc;

use lie::{Scalar, Vec3};

use super::Wrench;
use crate::motion::{self, Law, Sinusoid};
use crate::scene::entry::{Table, Value};
use crate::scene::error::SceneError;
use crate::scene::laws;

/// A force at a point of a body.
#[derive(Clone, Debug)]
pub struct Thrust {
    /// N, in the body's frame.
    pub force: Arc<dyn Law<3>>,
    /// From the mass centre, m in the body's frame.
    pub at: Vec3,
}

impl PartialEq for Thrust {
    /// Laws are the same where they are one and the same.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.force, &other.force) && self.at == other.at
    }
}

impl Thrust {
    pub(super) const NAME: &str = "thrust";

    /// By its keys in a scene.
    pub(super) fn read(table: &Table) -> Result<Self, SceneError> {
        let force = table.require("force")?;
        let force = match force.is_table() {
            true => laws::law::<3>(&force.table()?)?,
            false => Arc::new(Sinusoid::constant(force.array()?)),
        };
        let at = Vec3(table.read("at", [0.0; 3], Value::array)?);
        Ok(Self { force, at })
    }

    /// The force and the moment about the mass centre.
    #[inline(always)]
    pub(super) fn wrench<S: Scalar>(&self, t: S) -> Wrench<S> {
        let force = Vec3(motion::value(self.force.as_ref(), t));
        [force, self.at.lift::<S>().cross(force)]
    }
}
