//! The group of unit quaternions, and a heavy top on it, by the public interface of `lgvi` alone.

mod quaternion;
mod top;

pub use quaternion::UnitQuaternion;
pub use top::{MatrixTop, QuaternionTop};
