//! Numbers, small matrices and dual copies: what the integrators compute with.

pub(crate) mod degenerate;
pub(crate) mod duals;
pub(crate) mod elements;
pub(crate) mod large;
pub(crate) mod numbers;
pub(crate) mod sizes;
pub(crate) mod sparse;
