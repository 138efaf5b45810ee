//! Trees on hinges, welds and prescribed joints, free and held, against states found in other ways, and against the laws of such trees.

#[path = "../model/by_duals.rs"]
mod by_duals;
mod coupled;
mod keeps;
mod laws;
mod loads;
mod planar;
mod published;
mod stiff;
mod strokes;
mod trees;
mod vectors;
mod works;
mod wrong;
