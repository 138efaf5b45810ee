//! What is shown of a run.

use sim::Report;
use sim::number::{scientific, three_digits};

use crate::recording::Recording;

/// A motion on a page.
#[derive(Clone, Copy, Debug)]
pub struct Motion<'a> {
    /// The method's name.
    pub name: &'a str,
    /// What is told of it, in a line.
    pub facts: &'a str,
    /// What was seen of it.
    pub recording: &'a Recording,
}

/// What is told of a run beside its method's name: order, step, and how far its energy is from what the motion keeps.
pub fn facts(report: &Report) -> String {
    let what = match report.energy_is_kept {
        true => "energy",
        false => "energy less work",
    };
    format!(
        "order {}, steps of {} s, {what} within {} J",
        report.method_order,
        three_digits(report.step_seconds),
        scientific(report.energy_error_max_joules)
    )
}
