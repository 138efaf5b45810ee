//! Gaits against published numbers, against the stepped motion, and against differences.

mod best;
mod gradients;
mod heights;
mod net;
mod refused;
mod rewritten;
mod steady;
mod swimmers;
