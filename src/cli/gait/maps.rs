//! Pictures of height functions.

use std::path::Path;

use articulated_fluid::Scene;
use figure::{Colour, Figure, Heat, Labels, Line, Panel, Style};
use gait::{Chain, HeightMaps, Told};
use lie::VectorSpace;

use super::super::error::CliError;
use super::super::files::Files;
use super::{Args, digits, failed};

/// What the six heights are.
const NAMES: [(&str, &str); 6] = [
    ("turn about x", "1/rad"),
    ("turn about y", "1/rad"),
    ("turn about z", "1/rad"),
    ("advance along x", "m/rad^2"),
    ("advance along y", "m/rad^2"),
    ("advance along z", "m/rad^2"),
];

/// A map whose values are below this part of the largest of its kind is one of rounding.
const NOTHING: f64 = 1e-9;

/// Of a map, in pixels: three in a row are about as wide.
const HEIGHT: f64 = 560.0;

/// Draws the maps around the scene's stroke.
pub(super) fn draw(args: &Args, scene: &Scene, stem: &Path) -> Result<(), CliError> {
    let fail = |source| failed(args, source);
    let chain = Chain::new(scene).map_err(fail)?;
    let model = scene.model().map_err(|source| fail(source.into()))?;
    let told = Told::new(&model).map_err(fail)?;
    let files = Files::begin(stem, Some(&args.scene))?;
    let maps = HeightMaps::of(&chain, &told).map_err(fail)?;
    let drawn = picture(scene, &chain, &maps).render()?;
    files.complete(&drawn, &table(&maps))?.place()
}

fn picture(scene: &Scene, chain: &Chain, maps: &HeightMaps) -> Figure {
    let largest = |k: usize| maps.heights[k].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let of_kind = |k: usize| (k / 3 * 3..k / 3 * 3 + 3).map(largest).fold(0.0, f64::max);
    let shown = (0..6).filter(|k| largest(*k) > NOTHING * of_kind(*k));
    let names: Vec<&str> = chain.joints().iter().map(|joint| &joint.name[..]).collect();
    let label = |k: usize| format!("{} [rad]", names.get(k).copied().unwrap_or_default());
    let panel = |k: usize| Panel {
        title: format!(
            "{} [{}], up to {}",
            NAMES[k].0,
            NAMES[k].1,
            digits(largest(k))
        ),
        x_label: label(0),
        y_label: label(names.len().saturating_sub(1)),
        heat: Some(Heat {
            x: ends(&maps.first),
            y: ends(&maps.second),
            columns: maps.first.len(),
            values: maps.heights[k].clone(),
        }),
        lines: vec![Line {
            label: String::new(),
            colour: Colour::Black,
            style: Style::Solid,
            marker: None,
            points: maps
                .stroke
                .iter()
                .chain(maps.stroke.first())
                .map(|[x, y]| (*x, *y))
                .collect(),
        }],
        ..Panel::default()
    };
    let panels: Vec<Panel> = shown.map(panel).collect();
    let title = scene.title.as_deref().unwrap_or("height functions");
    let exact = maps.exact.coordinates();
    let by_area = maps.by_area.coordinates();
    let told = |x: &[f64]| {
        x.iter()
            .map(|x| digits(if x.abs() < 1e-12 { 0.0 } else { *x }))
            .collect::<Vec<_>>()
            .join(", ")
    };
    Figure {
        title: title.to_owned(),
        columns: panels.len().clamp(1, 3),
        labels: Labels::Ends,
        plot_height: HEIGHT,
        notes: vec![
            "Height functions in the body coordinates whose connection is least over the map. Orange is positive, of a loop from the first coordinate to the second.".to_owned(),
            format!("Net motion without momentum and loads, by the areas (turn, rad; advance, m): {}. Exactly: {}.", told(&by_area), told(&exact)),
        ],
        panels,
    }
}

fn ends(all: &[f64]) -> [f64; 2] {
    [all[0], all[all.len() - 1]]
}

fn table(maps: &HeightMaps) -> String {
    let mut text = "first,second,turn_x,turn_y,turn_z,advance_x,advance_y,advance_z\n".to_owned();
    for (row, second) in maps.second.iter().enumerate() {
        for (column, first) in maps.first.iter().enumerate() {
            let at = row * maps.first.len() + column;
            let heights = maps.heights.iter().map(|all| all[at].to_string());
            let heights: Vec<String> = heights.collect();
            text += &format!("{first},{second},{}\n", heights.join(","));
        }
    }
    text
}
