//! What a step says of itself: solved where it is, and why not where it is not.

mod degenerate;
mod domain;
mod reset;
mod rounding;
mod units;
