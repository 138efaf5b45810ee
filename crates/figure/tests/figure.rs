//! What is drawn: complete, small, readable, the same twice, and refused with a reason.

use figure::{
    Colour, Figure, FigureError, Kind, Labels, Level, Line, Marker, Mosaic, Panel, Rendered, Scale,
    Style, Tiles,
};
use resvg::tiny_skia::Pixmap;
use resvg::usvg::{Options, Tree};

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

/// The SVG of a picture that obeys the laws of all: the bitmap is the SVG's, and something is drawn on it.
fn lawful(drawn: Rendered) -> (String, (u32, u32)) {
    let Rendered { svg, png } = drawn;
    let mut options = Options::default();
    let font = include_bytes!("../assets/DejaVuSans-subset.ttf");
    options.fontdb_mut().load_font_data(font.to_vec());
    let tree = Tree::from_str(&svg, &options).expect("an SVG document");
    let bitmap = Pixmap::decode_png(&png).expect("a PNG");
    let size = (bitmap.width(), bitmap.height());
    let exact = tree.size().to_int_size();
    assert_eq!(size, (exact.width(), exact.height()));
    let (width, height) = size;
    assert!(svg.starts_with(&format!("<svg width=\"{width}\" height=\"{height}\"")));
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    let mut again = Pixmap::new(width, height).expect("a bitmap");
    resvg::render(&tree, Default::default(), &mut again.as_mut());
    assert!(again == bitmap, "the bitmap is the SVG's");
    let white = |pixel: &u8| *pixel == 255;
    assert!(!bitmap.data().iter().all(white), "something is drawn");
    let opaque = bitmap.pixels().iter().all(|pixel| pixel.alpha() == 255);
    assert!(opaque, "on paper");
    (svg, size)
}

fn svg(figure: &Figure) -> String {
    lawful(figure.render().expect("a figure")).0
}

#[test]
fn eight_panels_of_noise_stay_small() {
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
    let figure = figure(2, panels.collect());
    let (svg, (width, height)) = lawful(figure.render().unwrap());
    assert!(svg.len() < 1_000_000, "{} bytes", svg.len());
    assert_eq!(width, 1600);
    assert!((1400..1700).contains(&height));
    assert_eq!(svg.matches("stroke-dasharray=\"9 5.5\"").count(), 8 * 3 + 1);
}

#[test]
fn one_legend_names_every_kind_of_line_once() {
    let lines = || {
        vec![
            line("one", Style::Solid, vec![(0.0, 0.0), (1.0, 1.0)]),
            line("one", Style::Solid, vec![(0.0, 1.0), (1.0, 0.0)]),
            line("two & <three>", Style::Dotted, vec![(0.0, 0.5), (1.0, 0.5)]),
            line("", Style::Dashed, vec![(0.0, 0.2), (1.0, 0.5)]),
        ]
    };
    let panels = ["p", "q", "r"].map(|t| panel(t, Scale::Linear, lines()));
    let svg = svg(&figure(3, panels.to_vec()));
    assert_eq!(svg.matches(">one<").count(), 1);
    assert_eq!(svg.matches(">two &amp; &lt;three&gt;<").count(), 1);
    assert!(svg.contains("sans-serif"));
}

#[test]
fn values_that_cannot_be_placed_are_left_out() {
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
    let svg = svg(&figure(2, panels));
    assert_eq!(svg.matches("no data").count(), 2);
    assert!(svg.contains("10⁻¹⁶") && svg.contains("10⁻¹²"));
}

#[test]
fn long_texts_do_not_leave_the_figure() {
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
    let svg = svg(&figure);
    assert!(!svg.contains(&long));
    assert!(svg.matches('…').count() >= 5);
    assert!(svg.contains("×10⁻¹³") && svg.contains("×10⁷"));
}

#[test]
fn what_cannot_be_drawn_is_named() {
    let one = || vec![panel("p", Scale::Linear, vec![])];
    let refusal = |figure: Figure| figure.render().expect_err("a refusal");
    assert!(matches!(refusal(figure(1, vec![])), FigureError::NoPanel));
    assert!(matches!(refusal(figure(0, one())), FigureError::NoColumn));
    let wide = figure(99, vec![panel("p", Scale::Linear, vec![]); 20]);
    assert!(matches!(
        refusal(wide),
        FigureError::TooLarge { columns: 20, .. }
    ));
    for plot_height in [0.0, -1.0, 2001.0, f64::NAN] {
        let figure = Figure {
            plot_height,
            ..figure(1, one())
        };
        let error = refusal(figure);
        assert!(matches!(error, FigureError::PlotHeight { .. }), "{error}");
    }
}

#[test]
fn marked_lines_are_named_at_their_ends() {
    let marked = |label: &str, marker, y| Line {
        marker: Some(marker),
        ..line(label, Style::Dashed, vec![(1.0, 1.0), (2.0, y)])
    };
    let panel = Panel {
        levels: vec![Level {
            label: "limit".into(),
            y: 3.0,
        }],
        lines: vec![
            marked("one", Marker::Circle, 2.0),
            marked("two", Marker::Cross, 2.0),
        ],
        ..panel("p", Scale::Log, vec![])
    };
    let figure = Figure {
        labels: Labels::Ends,
        notes: vec!["a note ".repeat(50)],
        ..figure(1, vec![panel])
    };
    let svg = svg(&figure);
    for name in ["one", "two", "limit"] {
        assert_eq!(svg.matches(&format!(">{name}<")).count(), 1, "{name}");
    }
    // The names, and lines of the note.
    assert!(svg.matches("text-anchor=\"start\"").count() >= 3 + 3);
    assert_eq!(figure.render().unwrap(), figure.render().unwrap());
}

#[test]
fn any_text_is_drawn() {
    let text = "a\0b\u{1}c\td\u{ffff}\u{7f}\"&amp;<!--]]>汉🐟\u{202e}";
    let mut panel = panel(text, Scale::Linear, vec![line(text, Style::Solid, vec![])]);
    panel.y_label = text.into();
    svg(&figure(1, vec![panel]));
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
    let (svg, _) = lawful(mosaic(3).render().unwrap());
    for text in ["maps", "map 2", "good", "0.4", "h [s]", "a note"] {
        assert!(svg.contains(text), "{text}");
    }
    // The paper, the legend, and of each map six tiles fit.
    assert_eq!(svg.matches("<rect").count(), 1 + 2 + 3 * 6);
    assert!(matches!(mosaic(0).render(), Err(FigureError::NoPanel)));
    let none = Mosaic {
        columns: 0,
        ..mosaic(1)
    };
    assert!(matches!(none.render(), Err(FigureError::NoColumn)));
    let tall = mosaic(1000).render();
    assert!(matches!(tall, Err(FigureError::TooLarge { .. })));
}
