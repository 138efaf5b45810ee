//! What a robot's scene says, against the URDF by hand.

mod fluid;
mod names;
mod refused;
mod robot;
mod trees;
