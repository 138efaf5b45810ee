//! Eight panels of made-up data, drawn into the temporary folder (or to the
//! stem given as argument).

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use figure::{Colour, Figure, Line, Panel, Scale, Style};

type Curve = fn(f64) -> f64;

fn line(method: &str, curve: Curve) -> Line {
    let (colour, style) = match method {
        "LGVI" => (Colour::Vermillion, Style::Solid),
        _ => (Colour::Blue, Style::Dashed),
    };
    let times = (0..=20_000).map(|k| f64::from(k) * 1e-3);
    Line {
        label: method.into(),
        colour,
        style,
        points: times.map(|t| (t, curve(t))).collect(),
        marker: None,
    }
}

fn panel(title: &str, y_label: &str, scale: Scale, ours: &[Curve], theirs: &[Curve]) -> Panel {
    let ours = ours.iter().map(|c| line("LGVI", *c));
    let theirs = theirs.iter().map(|c| line("RK 4(5)", *c));
    Panel {
        title: title.into(),
        x_label: "t [s]".into(),
        y_label: y_label.into(),
        y_scale: scale,
        lines: ours.chain(theirs).collect(),
        ..Panel::default()
    }
}

fn noise(t: f64) -> f64 {
    (t * 1e5).sin() * (t * 317.0).cos()
}

fn panels() -> Vec<Panel> {
    use Scale::{Linear, Log};
    let spin: [Curve; 3] = [
        |t| t.sin(),
        |t| (1.3 * t).cos() * 0.5,
        |t| 0.2 * (2.1 * t).sin() - 0.6,
    ];
    let drifted: [Curve; 3] = [
        |t| (1.01 * t).sin(),
        |t| (1.32 * t).cos() * 0.5,
        |t| 0.2 * (2.13 * t).sin() - 0.6,
    ];
    vec![
        panel(
            "(a) angular velocity Ω₀",
            "Ω₀ [rad/s]",
            Linear,
            &spin,
            &drifted,
        ),
        panel(
            "(b) position x",
            "x [m]",
            Linear,
            &[|t| 0.3 * t],
            &[|t| 0.29 * t + 0.01 * t.sin()],
        ),
        panel(
            "(c) total energy",
            "E [J]",
            Linear,
            &[|t| 5.2 + 1e-4 * (9.0 * t).sin()],
            &[|t| 5.2 - 4e-4 * t],
        ),
        panel(
            "(d) energy error",
            "|ΔE| [J]",
            Log,
            &[|t| 1e-7 * (9.0 * t).sin().abs()],
            &[|t| 2e-6 * t],
        ),
        panel(
            "(e) linear momentum error",
            "‖Δp‖ [kg·m/s]",
            Linear,
            &[|t| 3e-14 * noise(t)],
            &[|t| 4e-13 * t * 0.1],
        ),
        panel(
            "(f) angular momentum error",
            "‖Δπ‖ [kg·m²/s]",
            Log,
            &[|t| 1e-15 * (1.0 + noise(t)) * t.sqrt()],
            &[|t| 1e-6 * t * t],
        ),
        panel(
            "(g) orthogonality error of the attitude",
            "‖I − RᵀR‖",
            Log,
            &[|t| 2e-16 * (1.0 + (40.0 * t).floor() % 5.0)],
            &[|t| 1e-8 * t],
        ),
        panel(
            "(h) kinetic energies",
            "T [J]",
            Linear,
            &[|t| 120.0 + 80.0 * t.cos()],
            &[|t| 120.0 + 81.0 * t.cos() * (-0.01 * t).exp()],
        ),
    ]
}

fn main() -> Result<(), Box<dyn Error>> {
    let stem = std::env::args_os()
        .nth(1)
        .map_or_else(|| std::env::temp_dir().join("chart-grid"), PathBuf::from);
    let figure = Figure {
        title: "A chain of three bodies in a perfect fluid".into(),
        columns: 2,
        panels: panels(),
        ..Figure::default()
    };
    let drawn = figure.render()?;
    fs::write(stem.with_extension("svg"), drawn.svg)?;
    fs::write(stem.with_extension("png"), drawn.png)?;
    println!("drawn to {}, as .svg and .png", stem.display());
    Ok(())
}
