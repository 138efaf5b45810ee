//! The points as a CSV table.

use core::fmt::Write;

use super::{Curve, Measured, Point};
use crate::contender::Control;

const HEADER: &str = "method,order,control,value,steps,seconds,runs,evaluations,iterations,attitude_error,position_error,\
energy_error,energy_slope,linear_momentum_deviation,angular_momentum_deviation,orthogonality_error,failure\n";

/// A line for each point, the failed ones with their cause; SI units, energies relative.
pub fn csv(curves: &[Curve], until: f64) -> String {
    let mut text = HEADER.to_owned();
    for curve in curves {
        let name = curve.contender.name();
        let order = curve.contender.order();
        let control = match curve.contender.control() {
            Control::Step => "step",
            Control::Tolerance => "tolerance",
            Control::Accuracy => "accuracy",
        };
        for Point { setting, outcome } in &curve.points {
            let value = setting.value(until);
            let rest = match outcome {
                Ok(measured) => numbers(measured),
                Err(failure) => format!("{}{}", ",".repeat(12), quoted(&failure.to_string())),
            };
            // A string takes what is written to it.
            let _ = writeln!(text, "{name},{order},{control},{value:e},{rest}");
        }
    }
    text
}

fn numbers(Measured { cost, runs, errors }: &Measured) -> String {
    format!(
        "{},{:e},{runs},{},{},{:e},{:e},{},{},{:e},{:e},{:e},",
        cost.steps,
        cost.time.as_secs_f64(),
        cost.evaluations,
        cost.iterations,
        errors.attitude,
        errors.position,
        optional(errors.energy),
        optional(errors.energy_slope),
        errors.linear_momentum,
        errors.angular_momentum,
        errors.orthogonality,
    )
}

/// A number, or nothing.
pub(crate) fn optional(x: Option<f64>) -> String {
    x.map_or_else(String::new, |x| format!("{x:e}"))
}

/// A text that may have commas.
pub(crate) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}
