//! The model in space and in the plane, against its formulas and on the scenes of the collection: one program, for what they
//! share is compiled once.

mod acceleration_form;
mod by_duals;
mod common;
mod conserved;
mod continuous_model;
mod discrete_derivatives;
mod flat_trees;
mod forced;
mod lanes;
mod model_errors;
mod on_se3;
mod paper_formulas;
mod planar;
mod planar_plane;
mod scenes_files;
mod springs;
mod tree;
mod views;
mod views_of_scenes;
