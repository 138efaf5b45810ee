//! What a body is to its parent once all that hangs on it is eliminated, and what a joint leaves free.
//!
//! A body whose children are eliminated has the momenta
//! $F_i = A u - K \Omega_i + \varphi$ and $r_i = H \Omega_i - K^T u$ with the velocity $u$ of its joint. What the joint leaves free
//! is solved for, and the force on it is $F_i = M^\ast u + f^\ast$: its parent takes over the mass and the force.
//! A joint that leaves less than a rotation free hands up $A, K, H$ and the moment with it.
//!
//! Each kind of joint is a file: how it eliminates the mass and the force, how the velocity goes on outwards, and what it makes of a moment.

mod ball;
mod given;
mod hinge;
mod kind;
mod link;

pub use hinge::Hinge;
pub(crate) use hinge::HingeFactors;
pub use kind::JointKind;
pub(crate) use kind::Role;
pub(crate) use link::Link;
