//! The curves under the picture.

use serde::Serialize;

use crate::motion::Motion;
use crate::pack::{Pack, range};
use crate::recording::Still;

/// Steps of a curve from its lowest to its highest point.
const LEVELS: u32 = 65_535;
/// Drives that have a line of their own, at most.
const MOST_DRIVES: usize = 4;
/// What is smaller is drawn as this, so that an error of zero has a logarithm.
const LEAST: f64 = 1e-18;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Chart {
    title: &'static str,
    unit: &'static str,
    /// Whether the curves are decimal logarithms.
    log: bool,
    lines: Vec<Line>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Line {
    name: String,
    /// The motion's number.
    motion: usize,
    /// The group of its pack.
    curve: String,
}

/// A chart in the making, over the motions and their packs.
struct Drawing<'a> {
    chart: Chart,
    motions: &'a [Motion<'a>],
}

impl<'a> Drawing<'a> {
    fn new(title: &'static str, unit: &'static str, log: bool, motions: &'a [Motion<'a>]) -> Self {
        let lines = vec![];
        Self {
            chart: Chart {
                title,
                unit,
                log,
                lines,
            },
            motions,
        }
    }

    /// A line of each motion; those after the first have the method in their names.
    fn line(&mut self, packs: &mut [Pack], name: &str, value: impl Fn(&Still) -> f64) {
        for (motion, pack) in packs.iter_mut().enumerate() {
            let of = &self.motions[motion];
            let scaled = |still: &Still| match self.chart.log {
                true => value(still).abs().max(LEAST).log10(),
                false => value(still),
            };
            let numbers = of.recording.stills().map(scaled);
            let curve = format!("{}: {name}", self.chart.title);
            pack.add(&curve, (range(numbers.clone()), LEVELS), [numbers]);
            let name = match self.motions.len() {
                1 => name.to_owned(),
                _ => format!("{} {name}", of.name).trim_end().to_owned(),
            };
            self.chart.lines.push(Line {
                name,
                motion,
                curve,
            });
        }
    }
}

/// The charts of one motion or more of a scene, with their curves in the packs.
pub(crate) fn charts(
    motions: &[Motion],
    packs: &mut [Pack],
    drives: &[(String, usize)],
) -> Vec<Chart> {
    let Some(first) = motions.first() else {
        return vec![];
    };
    let model = first.recording.model();
    let mut charts = vec![];
    if model.keeps_energy() || motions.len() == 1 {
        let title = match model.keeps_energy() {
            true => "energy error",
            false => "energy less work, error",
        };
        let mut energy = Drawing::new(title, "J", true, motions);
        let name = if motions.len() == 1 { "energy" } else { "" };
        energy.line(packs, name, |still| still.departures[0]);
        charts.push(energy.chart);
    }
    let unit = "kg m/s and kg m²/s";
    let mut momenta = match model.keeps_momentum() {
        true => Drawing::new("momentum error", unit, true, motions),
        false => Drawing::new("momentum", unit, false, motions),
    };
    match model.keeps_momentum() {
        true => {
            momenta.line(packs, "linear", |still| still.departures[1]);
            momenta.line(packs, "angular", |still| still.departures[2]);
        }
        false => {
            momenta.line(packs, "linear", |still| still.sample.linear.norm());
            momenta.line(packs, "angular", |still| still.sample.angular.norm());
        }
    }
    charts.push(momenta.chart);
    if !drives.is_empty() {
        charts.push(work(&motions[..1], &mut packs[..1], drives));
    }
    charts
}

/// Of the first motion: of others it is not known.
fn work(motions: &[Motion], packs: &mut [Pack], drives: &[(String, usize)]) -> Chart {
    let mut work = Drawing::new("work", "J", false, motions);
    match drives.len() <= MOST_DRIVES {
        true => {
            for (name, k) in drives {
                work.line(packs, name, |still| {
                    still.work.get(*k).copied().unwrap_or(0.0)
                });
            }
        }
        false => work.line(packs, "all drives", |still| still.work.iter().sum()),
    }
    let start = motions[0].recording.stills().next();
    let start = start.map_or(0.0, |still| still.sample.energy);
    work.line(packs, "energy gained", |still| still.sample.energy - start);
    work.chart
}
