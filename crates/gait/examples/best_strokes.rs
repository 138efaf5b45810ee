//! The best strokes of two swimmers beside sinusoids, and what finding them costs.
//!
//! `cargo run --release -p lgvi-gait --example best_strokes` draws `out/strokes.png`, and writes `out/fish-best.toml` and
//! `out/eel-best.toml`.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use articulated_fluid::Scene;
use figure::{Colour, Figure, Line, Panel, Style};
use gait::{
    Chain, Effort, Found, Fourier, Limits, Objective, Search, Stroke, Swimmer, Told, net_motion,
    net_with_gradient, with_stroke,
};
use lie::{LieGroup, SE3};
use sim::Method;

/// The search of a scene: by what, over which effort, within which angle, with how many harmonics.
struct Task {
    name: &'static str,
    objective: Objective,
    effort: Effort,
    label: &'static str,
    angle: f64,
    order: usize,
}

const TASKS: [Task; 2] = [
    Task {
        name: "fish",
        objective: Objective::AdvancePerLength,
        effort: Effort::Length,
        label: "length of the path of shapes [m kg^1/2]",
        angle: 1.0,
        order: 2,
    },
    Task {
        name: "eel",
        objective: Objective::AdvancePerWork,
        effort: Effort::Work,
        label: "positive work [J]",
        angle: 1.0,
        order: 2,
    },
];

const STARTS: u64 = 10;
/// Strokes in a row that are drawn, of those that cost most.
const DRAWN: f64 = 10.0;

fn main() -> Result<(), Box<dyn Error>> {
    let mut panels = Vec::new();
    for task in &TASKS {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/swim");
        let file = folder.join(format!("{}.toml", task.name));
        let (scene, text) = (Scene::load(&file)?, fs::read_to_string(&file)?);
        println!(
            "{}: {}",
            task.name,
            scene.title.as_deref().unwrap_or_default()
        );
        costs(&scene)?;
        let (search, [own, sine, best]) = search(&scene, task)?;
        panels.extend([
            shapes(task, search.chain(), [&own, &best]),
            ways(task, search.chain(), [&own, &sine, &best])?,
        ]);
        fs::create_dir_all("out")?;
        let best = with_stroke(&text, search.chain(), &best, search.from())?;
        fs::write(format!("out/{}-best.toml", task.name), best)?;
    }
    let figure = Figure {
        title: "The best strokes beside sinusoids".into(),
        columns: 2,
        panels,
        ..Figure::default()
    };
    fs::write("out/strokes.png", figure.render()?.png)?;
    Ok(())
}

/// The best of several times.
fn time(mut work: impl FnMut() -> Result<(), Box<dyn Error>>) -> Result<Duration, Box<dyn Error>> {
    let mut best = Duration::MAX;
    for _ in 0..20 {
        let begin = Instant::now();
        work()?;
        best = best.min(begin.elapsed());
    }
    Ok(best)
}

/// A gradient beside the stepping of a stroke.
fn costs(scene: &Scene) -> Result<(), Box<dyn Error>> {
    const STEPS: u32 = 20;
    let begin = Instant::now();
    let chain = Chain::new(scene)?;
    println!("  recorded in {:.1?}", begin.elapsed());
    let swimmer = Swimmer::new(scene)?;
    let told = Told::new(swimmer.model())?;
    let known = net_motion(&chain, &told)?;
    let (start, h) = (swimmer.start()?, told.period() / f64::from(STEPS));
    let method: Method = "gauss-4".parse()?;
    let mut gauss = method.integrator_of_smallest(&scene.smallest()?);
    let mut end = SE3::identity();
    let stepping = time(|| {
        let mut state = start.clone();
        let first = SE3::new(state.g.0[0], state.g.1[0].vec3());
        for _ in 0..STEPS {
            gauss.step(&mut state, h)?;
        }
        end = first
            .inverse()
            .compose(&SE3::new(state.g.0[0], state.g.1[0].vec3()));
        Ok(())
    })?;
    let off = (known.translation - end.translation).norm();
    println!("  stepping a stroke by {STEPS} steps of gauss-4: {stepping:.1?}, {off:.1e} m off");
    for order in [1, 2, 4, 8] {
        let stroke = Fourier::fit(&told, order)?;
        let mut net = SE3::identity();
        let spent = time(|| {
            net = net_with_gradient(&chain, &stroke, 32)?.0;
            Ok(())
        })?;
        let off = (known.translation - net.translation).norm();
        let ratio = spent.as_secs_f64() / stepping.as_secs_f64();
        println!(
            "  net motion and its gradient in {} coefficients: {spent:.1?}, {ratio:.2} strokes, {off:.1e} m off",
            stroke.coefficients().len()
        );
    }
    Ok(())
}

/// The scene's own stroke, the best one of its form, and the best of all.
fn search(scene: &Scene, task: &Task) -> Result<(Search, [Fourier; 3]), Box<dyn Error>> {
    let limits = Limits {
        angle: task.angle,
        rate: f64::INFINITY,
    };
    let search = Search::new(scene, task.objective, limits)?;
    let own = search.own(task.order)?;
    let begin = Instant::now();
    let found = search.from_starts(&own, STARTS, &mut |_| (), &|| true)?;
    let spent = begin.elapsed();
    let best = Found::best(&found).ok_or("no stroke was found")?;
    let sine = best_amplitude(&search, &own, task.angle)?;
    let evaluations: usize = found.iter().flatten().map(|found| found.evaluations).sum();
    let values: Vec<String> = found.iter().map(told).collect();
    println!("  {} [{}]", task.objective.name(), task.objective.unit());
    println!("  the scene's own: {:.6}", search.value(&own)?);
    println!(
        "  its form at its best amplitude: {:.6}",
        search.value(&sine)?
    );
    println!("  the best: {:.6}", best.value);
    println!(
        "  from {STARTS} starts in {spent:.1?}, {evaluations} evaluations: {}",
        values.join(", ")
    );
    let best = best.stroke.clone();
    Ok((search, [own, sine, best]))
}

fn told(found: &Option<Found>) -> String {
    match found {
        Some(found) => format!("{:.6}", found.value),
        None => "none".to_owned(),
    }
}

/// The largest angle of a joint in a stroke, rad.
fn largest_angle(chain: &Chain, stroke: &Fourier) -> f64 {
    let times = (0..512).map(|i| stroke.period() * f64::from(i) / 512.0);
    let angles = times.flat_map(|t| {
        let q = stroke.derivative(t, 0);
        let angle = move |own: &[f64]| own.iter().map(|x| x * x).sum::<f64>().sqrt();
        let joints = chain.joints().iter();
        joints.map(move |joint| angle(&q[joint.coordinates.clone()]))
    });
    angles.fold(0.0, f64::max)
}

/// The same stroke, larger or smaller by what makes it best within the angle.
fn best_amplitude(search: &Search, own: &Fourier, angle: f64) -> Result<Fourier, Box<dyn Error>> {
    const TRIED: u32 = 200;
    let most = angle / largest_angle(search.chain(), own);
    let mut best = (f64::NEG_INFINITY, own.clone());
    for k in 1..=TRIED {
        let scale = most * f64::from(k) / f64::from(TRIED);
        let coefficients = own.coefficients().iter().map(|x| scale * x).collect();
        let stroke = Fourier::new(own.period(), own.order(), coefficients)?;
        let value = search.value(&stroke)?;
        if value > best.0 {
            best = (value, stroke);
        }
    }
    Ok(best.1)
}

const COLOURS: [Colour; 6] = [
    Colour::Blue,
    Colour::Vermillion,
    Colour::BluishGreen,
    Colour::ReddishPurple,
    Colour::SkyBlue,
    Colour::Orange,
];

/// The shape over a stroke: the scene's own dashed, the best one solid.
fn shapes(task: &Task, chain: &Chain, strokes: [&Fourier; 2]) -> Panel {
    let mut lines = Vec::new();
    for (stroke, style) in strokes.into_iter().zip([Style::Dashed, Style::Solid]) {
        let shapes: Vec<(f64, Vec<f64>)> = (0..=200)
            .map(|i| f64::from(i) / 200.0)
            .map(|part| (part, stroke.derivative(part * stroke.period(), 0)))
            .collect();
        for j in 0..chain.dim() {
            lines.push(Line {
                label: String::new(),
                colour: COLOURS[j % COLOURS.len()],
                style,
                marker: None,
                points: shapes.iter().map(|(t, q)| (*t, q[j])).collect(),
            });
        }
    }
    Panel {
        title: format!("{}: own dashed, best solid", task.name),
        x_label: "part of the period".into(),
        y_label: "joint coordinates [rad]".into(),
        lines,
        ..Panel::default()
    }
}

/// How far strokes in a row lead, over what they cost.
fn ways(task: &Task, chain: &Chain, strokes: [&Fourier; 3]) -> Result<Panel, Box<dyn Error>> {
    let labels = [
        ("the scene's own", Colour::Black, Style::Dashed),
        ("at its best amplitude", Colour::Blue, Style::Dashed),
        ("best", Colour::Vermillion, Style::Solid),
    ];
    let efforts = strokes.map(|stroke| task.effort.of(chain, stroke, 4096));
    let efforts = efforts.into_iter().collect::<Result<Vec<_>, _>>()?;
    let all = DRAWN
        * efforts
            .iter()
            .fold(0.0, |most: f64, effort| most.max(*effort));
    let mut lines = Vec::new();
    let each = strokes.into_iter().zip(efforts);
    for ((stroke, effort), (label, colour, style)) in each.zip(labels) {
        let net = net_motion(chain, stroke)?;
        let mut g = SE3::identity();
        let mut points = vec![(0.0, 0.0)];
        while let Some((spent, _)) = points.last()
            && spent + effort <= all * 1.001
        {
            g = g.compose(&net);
            points.push((spent + effort, g.translation.norm()));
        }
        lines.push(Line {
            label: label.into(),
            colour,
            style,
            marker: None,
            points,
        });
    }
    Ok(Panel {
        title: format!("{}: strokes in a row", task.name),
        x_label: task.label.into(),
        y_label: "distance [m]".into(),
        lines,
        ..Panel::default()
    })
}
