//! Why an integration was refused or gave up.

/// Why there is no state at a time.
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
    /// The end time is not finite, or not after the start.
    #[error("the end time {until:?} is not finite, or not after the start: give a later one")]
    Until {
        /// The end time given.
        until: f64,
    },
    /// The sampling interval is not positive and finite.
    #[error(
        "the sampling interval {every:?} is not positive and finite: give the time between samples"
    )]
    Every {
        /// The sampling interval given.
        every: f64,
    },
    /// The time asked for lies before the last step or after the end.
    #[error(
        "there is no state at t = {t:?}: ask for times that grow, here from {from:?} to {until:?}"
    )]
    Time {
        /// The time asked for.
        t: f64,
        /// The start of the last step.
        from: f64,
        /// The end of the run.
        until: f64,
    },
    /// The state has no component.
    #[error("the initial state is empty: give at least one component")]
    EmptyState,
    /// The start is no configuration of the model.
    #[error("the start does not fit the model: give a configuration of its size")]
    Misfit,
    /// A component of the initial state is not finite.
    #[error("component {index} of the initial state is {value:?}: give finite numbers")]
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
        "the right-hand side is not finite at t = {t:?}: check its formula there, or end the run earlier"
    )]
    NonFiniteRhs {
        /// Time of the stage.
        t: f64,
    },
    /// The solution overflowed.
    #[error(
        "the state is not finite at t = {t:?}: the solution grows without bound, end the run earlier"
    )]
    NonFiniteState {
        /// Time of the stage that overflowed.
        t: f64,
    },
    /// No step is short enough for the tolerance.
    #[error(
        "no step is short enough at t = {t:?}: the solution may have a singularity there, or the tolerance is too tight, loosen it"
    )]
    StepUnderflow {
        /// Time reached.
        t: f64,
    },
    /// The budget of steps is spent.
    #[error(
        "{steps} steps have only reached t = {t:?}: the problem may be stiff, loosen the tolerance or shorten the run"
    )]
    TooManySteps {
        /// Time reached.
        t: f64,
        /// Steps tried.
        steps: usize,
    },
}
