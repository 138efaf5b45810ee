//! The best strokes of two swimmers beside the obvious ones, and what finding them costs.
//!
//! `cargo run --release -p lgvi-gait --example best_strokes` takes about a minute.

use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};

use articulated_fluid::Scene;
use gait::{
    Chain, Found, Fourier, Limits, Objective, Search, Stroke, Swimmer, Told, net_motion,
    net_with_gradient,
};
use lie::{LieGroup, SE3};
use sim::Method;

/// The search of a scene: by what, within which angle, with how many harmonics.
struct Task {
    file: &'static str,
    objective: Objective,
    angle: f64,
    order: usize,
}

const TASKS: [Task; 2] = [
    Task {
        file: "fish.toml",
        objective: Objective::AdvancePerLength,
        angle: 1.0,
        order: 2,
    },
    Task {
        file: "eel.toml",
        objective: Objective::AdvancePerWork,
        angle: 1.0,
        order: 2,
    },
];

const STARTS: u64 = 10;

fn main() -> Result<(), Box<dyn Error>> {
    for task in &TASKS {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/swim");
        let scene = Scene::load(&folder.join(task.file))?;
        println!(
            "{}: {}",
            task.file,
            scene.title.as_deref().unwrap_or_default()
        );
        costs(&scene)?;
        search(&scene, task)?;
    }
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

fn search(scene: &Scene, task: &Task) -> Result<(), Box<dyn Error>> {
    let limits = Limits {
        angle: task.angle,
        rate: f64::INFINITY,
    };
    let search = Search::new(scene, task.objective, limits)?;
    let own = search.own(task.order)?;
    let begin = Instant::now();
    let found = search.from_starts(&own, STARTS, &mut |_| (), &|| true)?;
    let spent = begin.elapsed();
    let own = search.value(&own)?;
    let values: Vec<String> = found.iter().map(told).collect();
    let best = Found::best(&found).map_or(f64::NAN, |best| best.value);
    let evaluations: usize = found.iter().flatten().map(|found| found.evaluations).sum();
    println!(
        "  best {} [{}]: {best:.6}, {:.2} times the scene's own {own:.6}",
        task.objective.name(),
        task.objective.unit(),
        best / own
    );
    println!(
        "  from {STARTS} starts in {spent:.1?}, {evaluations} evaluations: {}",
        values.join(", ")
    );
    Ok(())
}

fn told(found: &Option<Found>) -> String {
    match found {
        Some(found) => format!("{:.6}", found.value),
        None => "none".to_owned(),
    }
}
