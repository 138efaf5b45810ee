//! The map as a picture.

use sim::number::{decimal, three_digits};

use super::outcome::{ENERGY_BAND, ENERGY_DRIFT, GROUP, MOMENTUM, WRONG};
use super::{Class, Map};
use figure::{Colour, Kind, Mosaic, Tiles};

const COLUMNS: usize = 5;

impl Class {
    /// Its colour, none for the paper's, and its sign.
    fn look(self) -> (Option<Colour>, &'static str) {
        match self {
            Self::Good => (Some(Colour::BluishGreen), "·"),
            Self::EnergyBand => (Some(Colour::Orange), "E"),
            Self::EnergyDrift => (Some(Colour::Yellow), "D"),
            Self::MomentumLost => (Some(Colour::SkyBlue), "M"),
            Self::GroupLeft => (Some(Colour::Blue), "G"),
            Self::Refused => (Some(Colour::ReddishPurple), "R"),
            Self::NonFinite => (Some(Colour::Black), "N"),
            Self::SilentlyWrong => (Some(Colour::Vermillion), "W"),
            Self::NotRun => (None, "–"),
        }
    }
}

/// A map of each method: the step to the right, the parameter upwards.
pub fn picture(map: &Map, title: &str) -> Mosaic {
    let grid = &map.grid;
    let name = |number: &f64| three_digits(*number);
    Mosaic {
        title: title.to_owned(),
        columns: COLUMNS,
        x_label: "step h [s]".to_owned(),
        y_label: grid.parameter.label().to_owned(),
        x: grid.steps.iter().map(name).collect(),
        y: grid.values.iter().map(name).collect(),
        kinds: kinds(map),
        maps: (0..grid.methods.len())
            .map(|method| tiles(map, method))
            .collect(),
        notes: vec![thresholds(grid.until)],
    }
}

/// The classes; that some were not run is told only where it is so.
fn kinds(map: &Map) -> Vec<Kind> {
    let shown = Class::ALL
        .into_iter()
        .filter(|class| *class != Class::NotRun || map.count(*class) > 0);
    let kind = |class: Class| {
        let (colour, sign) = class.look();
        Kind {
            label: class.description().to_owned(),
            colour,
            sign: sign.to_owned(),
        }
    };
    shown.map(kind).collect()
}

fn tiles(map: &Map, method: usize) -> Tiles {
    let (values, steps) = (map.grid.values.len(), map.grid.steps.len());
    let index = |class: Class| Class::ALL.iter().position(|other| *other == class);
    let contender = map.grid.methods[method];
    Tiles {
        title: format!("{contender}, order {}", contender.order()),
        kinds: (0..values * steps)
            .map(|k| map.cell(method, k / steps, k % steps).class)
            .filter_map(index)
            .collect(),
    }
}

fn thresholds(until: f64) -> String {
    format!(
        "Each tile is a run of {} s. Energy: off by {:.0} % of the largest kinetic energy, or on a line that moves by {:.0} % of it and \
         explains more than half of the variance. Momentum: off by {MOMENTUM:e} of that of the largest kinetic energy. Group: an orthogonality \
         error of {GROUP:e}. Refused: a typed error. Silently wrong: none of this, and an attitude \
         is off by {WRONG} rad after a step, or as many as turn a body by half a radian, from a state of the \
         run.",
        decimal(until),
        100.0 * ENERGY_BAND,
        100.0 * ENERGY_DRIFT,
    )
}
