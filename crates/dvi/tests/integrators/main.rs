//! The integrators and their laws on small systems: one program, for what they share is compiled once.

mod adapters;
mod allocation;
mod common;
mod composition;
mod domains;
mod forces;
mod gauss;
mod hamiltonian;
mod lanes;
mod laws;
mod naive;
mod parameters;
mod pilot;
mod shapes;
mod traced;
mod variational;
mod variations;
