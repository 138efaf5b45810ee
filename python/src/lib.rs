//! The native half of the Python package `lgvi`; its other half, `package/lgvi`, has the names, the help and the checks of types.

mod attend;
mod ensemble;
mod errors;
mod gait;
mod replace;
mod run;
mod scene;
mod system;

/// What `lgvi` is made of; use `lgvi` itself.
#[pyo3::pymodule]
mod _lgvi {
    #[pymodule_export]
    use crate::ensemble::ensemble;
    #[pymodule_export]
    use crate::gait::{best_gait, gait_report, height_maps, objectives};
    #[pymodule_export]
    use crate::run::methods;
    #[pymodule_export]
    use crate::scene::NativeScene;
    #[pymodule_export]
    use crate::system::{Comparison, NativeFormula, NativeRecording, NativeSystem, Tracer, exp};
}
