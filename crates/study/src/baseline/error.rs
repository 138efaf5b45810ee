//! Why an integration was refused or gave up.

/// Failure of [`integrate`](super::integrate).
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BaselineError {
    /// A tolerance is out of range.
    #[error(
        "tolerances out of range (relative {relative:e}, absolute {absolute:e}): give a relative one in [2.3e-15, 1) and an absolute one that is positive and finite"
    )]
    Tolerance {
        /// The relative tolerance given.
        relative: f64,
        /// The absolute tolerance given.
        absolute: f64,
    },
    /// The end time is not positive and finite.
    #[error("the end time {until} is not positive and finite: give the duration of the run")]
    Until {
        /// The end time given.
        until: f64,
    },
    /// The sampling interval is not positive and finite.
    #[error(
        "the sampling interval {every} is not positive and finite: give the time between samples"
    )]
    Every {
        /// The sampling interval given.
        every: f64,
    },
    /// The state has no component.
    #[error("the initial state is empty: give at least one component")]
    EmptyState,
    /// The start is no configuration of the model.
    #[error("the start does not fit the model: give a configuration of its size")]
    Misfit,
    /// A component of the initial state is not finite.
    #[error("component {index} of the initial state is {value}: give finite numbers")]
    InitialState {
        /// Position of the component.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// The samples would not fit into memory.
    #[error("{samples:e} samples are more than the {limit} that are kept: sample less often")]
    TooManySamples {
        /// Samples asked for.
        samples: f64,
        /// Samples possible for a state of this size.
        limit: usize,
    },
    /// The right-hand side is not finite, however short the step.
    #[error(
        "the right-hand side is not finite at t = {t}: check its formula there, or end the run earlier"
    )]
    NonFiniteRhs {
        /// Time of the call.
        t: f64,
    },
    /// The solution overflowed.
    #[error(
        "the state is not finite at t = {t}: the solution grows without bound, end the run earlier"
    )]
    NonFiniteState {
        /// End of the step that overflowed.
        t: f64,
    },
    /// No step is short enough for the tolerance.
    #[error(
        "no step is short enough at t = {t}: the solution may have a singularity there, or the tolerance is too tight, loosen it"
    )]
    StepUnderflow {
        /// Time reached.
        t: f64,
    },
    /// The budget of steps is spent.
    #[error(
        "{steps} steps have only reached t = {t}: the problem may be stiff, loosen the tolerance or shorten the run"
    )]
    TooManySteps {
        /// Time reached.
        t: f64,
        /// Steps tried.
        steps: usize,
    },
}
