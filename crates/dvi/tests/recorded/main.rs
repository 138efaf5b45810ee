//! Systems by their value alone run on what was recorded of it, and say so.

mod beam;
mod by_jets;
mod ensemble;
mod forces;
mod means;
mod parts;
mod steps;
