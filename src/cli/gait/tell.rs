//! What a stroke does, as text.

use gait::{NetMotion, Report, Swims};
use sim::number::{decimal, rounded};

use super::super::print;
use super::digits;

fn vector(x: [f64; 3]) -> String {
    let [x, y, z] = x.map(|x| decimal(rounded(if x.abs() < 1e-12 { 0.0 } else { x }, 6)));
    format!("({x}, {y}, {z})")
}

fn screw(net: &NetMotion) -> String {
    let (turn, advance) = (digits(net.turn_radians), digits(net.advance_metres));
    match net.pitch_metres {
        None => format!("{advance} m along {}, without a turn", vector(net.axis)),
        Some(_) => format!(
            "{turn} rad about {}, {advance} m along it",
            vector(net.axis)
        ),
    }
}

/// A line for each quantity, aligned.
pub(super) fn text(report: &Report) -> String {
    let swims = match report.swims {
        Swims::WithoutMomentum => "without momentum: the shape alone leads, at any speed",
        Swims::WithMomentum => {
            "with a momentum, which is kept: the first stroke, and each is another"
        }
        Swims::Steadily => "with loads or free joints: the steady stroke",
    };
    let mut rows: Vec<[String; 2]> = Vec::new();
    let mut row = |name: &str, value: String| rows.push([name.to_owned(), value]);
    let (period, from) = (digits(report.period_seconds), digits(report.from_seconds));
    row("stroke", format!("{period} s, repeats from {from} s on"));
    row("swims", swims.to_owned());
    row("net motion", screw(&report.net));
    row(
        "displacement",
        format!("{} m", vector(report.net.displacement_metres)),
    );
    if let Some(pitch) = report.net.pitch_metres {
        let radius = digits(report.net.radius_metres);
        row(
            "helix",
            format!("radius {radius} m, pitch {} m", digits(pitch)),
        );
    }
    if let (Some(geometric), Some(dynamic)) = (&report.geometric, &report.dynamic)
        && report.swims != Swims::WithoutMomentum
    {
        row("geometric part", screw(geometric));
        row("dynamic part", screw(dynamic));
    }
    let work = digits(report.positive_work_joules);
    row(
        "positive work",
        format!("{work} J, by the power at {} times", report.samples),
    );
    let cost = report.cost_of_transport.map_or_else(
        || "not known: the stroke leads nowhere, or a body has no mass of its own".to_owned(),
        digits,
    );
    row("cost of transport", cost);
    if let Some(length) = report.length {
        row("length", format!("{} m kg^1/2", digits(length)));
    }
    if let Some(stable) = report.stable {
        let [re, im] = report.multipliers[0];
        let word = if stable { "shrinks" } else { "grows" };
        let size = digits(re.hypot(im));
        row(
            "stability",
            format!("a disturbance {word} to {size} of itself in a stroke at most"),
        );
    }
    if let Some(last) = report.path_metres.last() {
        let strokes = report.path_metres.len() - 1;
        row(
            &format!("after {strokes} strokes"),
            format!("{} m", vector(*last)),
        );
    }
    print::columns(&rows)
}
