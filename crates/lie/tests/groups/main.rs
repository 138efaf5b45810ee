//! The groups of this crate and of a user's own: one program, for the laws are compiled once.

mod defaults;
mod lanes;
mod laws;
mod own_group;
mod plane;
mod rotations;
