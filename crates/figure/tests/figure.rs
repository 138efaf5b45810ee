//! Figures on disk: complete, small, readable, and refused with a reason.

use std::fs;
use std::path::{Path, PathBuf};

use figure::{Colour, Figure, FigureError, Kind, Line, Mosaic, Panel, Saved, Scale, Style, Tiles};

/// A folder of its own, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("study-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a temporary folder");
        Self(path)
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).expect("the folder").flatten();
        let mut names: Vec<_> = entries
            .map(|e| e.file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn line(label: &str, style: Style, points: Vec<(f64, f64)>) -> Line {
    let colour = match style {
        Style::Solid => Colour::Vermillion,
        _ => Colour::Blue,
    };
    Line {
        label: label.into(),
        colour,
        style,
        points,
        marker: None,
    }
}

fn panel(title: &str, y_scale: Scale, lines: Vec<Line>) -> Panel {
    Panel {
        title: title.into(),
        x_label: "t [s]".into(),
        y_label: "y [m]".into(),
        y_scale,
        lines,
        ..Panel::default()
    }
}

fn figure(columns: usize, panels: Vec<Panel>) -> Figure {
    Figure {
        title: "A title".into(),
        columns,
        panels,
        ..Figure::default()
    }
}

fn noise(k: u32, seed: f64) -> f64 {
    let x = (f64::from(k) * 12.9898 + seed).sin() * 43758.5453;
    x - x.floor()
}

fn series(seed: f64) -> Vec<(f64, f64)> {
    (0..100_000)
        .map(|k| (f64::from(k) * 1e-3, noise(k, seed)))
        .collect()
}

fn smooth(phase: f64) -> Vec<(f64, f64)> {
    (0..100_000)
        .map(|k| f64::from(k) * 1e-3)
        .map(|t| (t, (0.3 * t + phase).sin()))
        .collect()
}

fn saved(figure: &Figure, folder: &Folder) -> Saved {
    figure.save(&folder.0.join("chart")).expect("a figure")
}

fn png_size(path: &Path) -> (u32, u32) {
    let bytes = fs::read(path).expect("the bitmap");
    let decoder = png::Decoder::new(bytes.as_slice());
    let mut reader = decoder.read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size()];
    let info = reader.next_frame(&mut pixels).expect("whole");
    assert!(pixels.iter().any(|p| *p != 255), "something is drawn");
    (info.width, info.height)
}

#[test]
fn eight_panels_of_noise_stay_small() {
    let folder = Folder::new("noise");
    let panels = (0..8).map(|k| {
        let seeds = (0..3).map(f64::from);
        let ours = seeds
            .clone()
            .map(|s| line("LGVI", Style::Solid, series(s + f64::from(k))));
        let theirs = seeds.map(|s| line("RK 4(5)", Style::Dashed, smooth(s)));
        panel(
            &format!("({k})"),
            if k % 2 == 0 {
                Scale::Linear
            } else {
                Scale::Log
            },
            ours.chain(theirs).collect(),
        )
    });
    let saved = saved(&figure(2, panels.collect()), &folder);
    let svg = fs::read_to_string(&saved.svg).unwrap();
    assert!(svg.len() < 1_000_000, "{} bytes", svg.len());
    let (width, height) = png_size(&saved.png);
    assert_eq!(width, 1600);
    assert!((1400..1700).contains(&height));
    assert!(svg.starts_with(&format!("<svg width=\"{width}\" height=\"{height}\"")));
    assert_eq!(folder.names(), ["chart.png", "chart.svg"]);
}

#[test]
fn one_legend_names_every_kind_of_line_once() {
    let folder = Folder::new("legend");
    let lines = || {
        vec![
            line("one", Style::Solid, vec![(0.0, 0.0), (1.0, 1.0)]),
            line("one", Style::Solid, vec![(0.0, 1.0), (1.0, 0.0)]),
            line("two & <three>", Style::Dotted, vec![(0.0, 0.5), (1.0, 0.5)]),
            line("", Style::Dashed, vec![(0.0, 0.2), (1.0, 0.5)]),
        ]
    };
    let panels = ["p", "q", "r"].map(|t| panel(t, Scale::Linear, lines()));
    let saved = saved(&figure(3, panels.to_vec()), &folder);
    let svg = fs::read_to_string(saved.svg).unwrap();
    assert_eq!(svg.matches(">\none\n<").count(), 1);
    assert_eq!(svg.matches(">\ntwo &amp; &lt;three&gt;\n<").count(), 1);
    assert!(svg.contains("sans-serif"));
}

#[test]
fn values_that_cannot_be_placed_are_left_out() {
    let folder = Folder::new("holes");
    let bad = vec![
        (0.0, 0.0),
        (f64::NAN, 1.0),
        (1.0, f64::NAN),
        (2.0, f64::INFINITY),
        (f64::NEG_INFINITY, 1.0),
        (1e308, 1.0),
        (3.0, -1e308),
        (4.0, -2.0),
    ];
    let good = vec![(0.0, 1e-16), (1.0, 0.0), (2.0, 1e-12)];
    let panels = vec![
        panel(
            "only bad",
            Scale::Log,
            vec![line("a", Style::Solid, bad.clone())],
        ),
        panel(
            "some good",
            Scale::Log,
            vec![line("b", Style::Dashed, good)],
        ),
        panel("linear", Scale::Linear, vec![line("c", Style::Dotted, bad)]),
        panel("none", Scale::Linear, vec![]),
        panel(
            "one point",
            Scale::Linear,
            vec![line("d", Style::Solid, vec![(1.0, 1.0)])],
        ),
    ];
    let saved = saved(&figure(2, panels), &folder);
    let svg = fs::read_to_string(&saved.svg).unwrap();
    assert_eq!(svg.matches("no data").count(), 2);
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    assert!(svg.contains("10⁻¹⁶") && svg.contains("10⁻¹²"));
    png_size(&saved.png);
}

#[test]
fn long_texts_do_not_leave_the_figure() {
    let folder = Folder::new("long");
    let long = "words and more words ".repeat(40);
    let mut panel = panel(
        &long,
        Scale::Linear,
        vec![line(&long, Style::Solid, vec![(0.0, -1e-13), (1e7, 2e-13)])],
    );
    panel.x_label.clone_from(&long);
    panel.y_label.clone_from(&long);
    let mut figure = figure(1, vec![panel]);
    figure.title.clone_from(&long);
    let svg = fs::read_to_string(saved(&figure, &folder).svg).unwrap();
    assert!(!svg.contains(&long));
    assert!(svg.matches('…').count() >= 5);
    assert!(svg.contains("×10⁻¹³") && svg.contains("×10⁷"));
}

#[test]
fn a_dot_in_the_name_is_kept_and_files_are_replaced() {
    let folder = Folder::new("names");
    let one = figure(1, vec![panel("p", Scale::Linear, vec![])]);
    let stem = folder.0.join("fig2.v1");
    fs::write(folder.0.join("fig2.v1.svg"), "old").unwrap();
    let saved = one.save(&stem).unwrap();
    assert_eq!(folder.names(), ["fig2.v1.png", "fig2.v1.svg"]);
    assert!(fs::read_to_string(saved.svg).unwrap().ends_with("</svg>\n"));
}

#[test]
fn what_cannot_be_drawn_or_written_is_named() {
    let folder = Folder::new("errors");
    let one = || vec![panel("p", Scale::Linear, vec![])];
    let stem = folder.0.join("chart");
    let save = |f: Figure, stem: &Path| f.save(stem).expect_err("a refusal");

    assert!(matches!(
        save(figure(1, vec![]), &stem),
        FigureError::NoPanel
    ));
    assert!(matches!(
        save(figure(0, one()), &stem),
        FigureError::NoColumn
    ));
    assert!(matches!(
        save(
            figure(99, vec![panel("p", Scale::Linear, vec![]); 20]),
            &stem
        ),
        FigureError::TooLarge { columns: 20, .. }
    ));
    for nameless in ["/", "..", "folder/"] {
        let error = save(figure(1, one()), Path::new(nameless));
        assert!(
            matches!(error, FigureError::NoFileName { .. }),
            "{nameless}"
        );
    }
    let error = save(figure(1, one()), &folder.0.join("absent/chart"));
    assert!(matches!(error, FigureError::Write { .. }), "{error}");

    // A folder in the way of one file: nothing half-done stays behind.
    fs::create_dir(folder.0.join("chart.svg")).unwrap();
    let error = save(figure(1, one()), &stem);
    assert!(matches!(error, FigureError::Write { .. }), "{error}");
    assert_eq!(folder.names(), ["chart.svg"]);
}

fn mosaic(maps: usize) -> Mosaic {
    let kind = |label: &str, colour, sign: &str| Kind {
        label: label.into(),
        colour,
        sign: sign.into(),
    };
    let tiles = |k: usize| Tiles {
        title: format!("map {k}"),
        kinds: vec![0, 1, 1, 0, 1, 0, 7, 0],
    };
    Mosaic {
        title: "maps".into(),
        columns: 2,
        x_label: "h [s]".into(),
        y_label: "k".into(),
        x: ["0.1", "0.2", "0.4"].map(String::from).into(),
        y: ["1", "2"].map(String::from).into(),
        kinds: vec![
            kind("good", Some(Colour::Blue), "g"),
            kind("none", None, "–"),
        ],
        maps: (0..maps).map(tiles).collect(),
        notes: vec!["a note".into()],
    }
}

#[test]
fn a_mosaic_has_every_map_and_refuses_none() {
    let drawn = mosaic(3).render().unwrap();
    for text in ["maps", "map 2", "good", "0.4", "h [s]", "a note"] {
        assert!(drawn.svg.contains(text), "{text}");
    }
    assert!(drawn.png.len() > 1000);
    assert!(matches!(mosaic(0).render(), Err(FigureError::NoPanel)));
    let none = Mosaic {
        columns: 0,
        ..mosaic(1)
    };
    assert!(matches!(none.render(), Err(FigureError::NoColumn)));
    let tall = mosaic(1000).render();
    assert!(matches!(tall, Err(FigureError::TooLarge { .. })));
}
