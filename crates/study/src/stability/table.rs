//! The map as a CSV table.

use core::fmt::Write;

use sim::number::decimal;

use super::{Limit, Map, Outcome, Wall};
use crate::work_precision::{optional, quoted};

const HEADER: &str = "method,order,parameter,value,step,class,time,energy_error,energy_drift,energy_trend,momentum_error,\
orthogonality_error,attitude_error,wall,failure\n";

/// A line for each cell; times in s, angles in rad, the rest relative. The wall stands where a method's good steps end.
pub fn csv(map: &Map) -> String {
    let mut text = HEADER.to_owned();
    let grid = &map.grid;
    for (m, method) in grid.methods.iter().enumerate() {
        for (v, value) in grid.values.iter().enumerate() {
            let Limit { wall, next, .. } = *map.limit(m, v);
            for (s, step) in grid.steps.iter().enumerate() {
                let (order, parameter) = (method.order(), grid.parameter);
                let [value, step] = [*value, *step].map(decimal);
                let wall = if next == Some(s) { wall } else { Wall::None };
                let rest = cell(map.cell(m, v, s), wall);
                // A string takes what is written to it.
                let _ = writeln!(text, "{method},{order},{parameter},{value},{step},{rest}");
            }
        }
    }
    text
}

fn cell(outcome: &Outcome, wall: Wall) -> String {
    let failure = outcome.failure.as_ref();
    format!(
        "{},{},{},{},{:e},{},{:e},{},{},{}",
        outcome.class,
        decimal(outcome.t),
        optional(outcome.energy),
        optional(outcome.drift),
        outcome.trend,
        optional(outcome.momentum),
        outcome.orthogonality,
        optional(outcome.attitude),
        if wall == Wall::None { "" } else { wall.name() },
        failure.map_or_else(String::new, |failure| quoted(&failure.to_string())),
    )
}
