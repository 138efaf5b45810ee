//! The picture: each system's motion beside the exact one, and its energy error over time.

use std::f64::consts::PI;

use dvi::{Integrator, Lagrangian, State};
use figure::{Colour, Figure, Line, Panel, Scale, Style};
use lie::{RealGroup, SE3, SO3, Vec3};
use study::baseline::{Tolerance, on_group};
use study::problems::{Problem, ProblemError};
use study::survey::{LongRun, SurveyError, systems};

use super::{DRAWN, rows};

/// Names, colours and styles of the [`DRAWN`] methods; the second is dashed, since it may lie on the first.
const LOOKS: [(&str, Colour, Style); 3] = [
    ("left rule, order 1", Colour::Orange, Style::Solid),
    ("midpoint, order 2", Colour::Blue, Style::Dashed),
    ("Gauss, order 8", Colour::BluishGreen, Style::Solid),
];
/// Of the exact motion, which is drawn last.
const EXACT: (&str, Colour, Style) = ("exact, marked at equal times", Colour::Black, Style::Solid);
/// States of the exact motion in one drawing, of which [`MARK`] in every [`SPACE`] make a mark.
const SAMPLES: u32 = 1200;
const SPACE: usize = 12;
const MARK: usize = 5;

/// All panels, from the long runs of the systems.
pub fn figure(runs: &[Vec<LongRun>]) -> Result<Figure, SurveyError> {
    let motions = [free_body()?, top()?, pendulum()?, flutter()?];
    let energies = [
        "energy error: left and midpoint rule are one method",
        "energy error",
        "energy error",
        "energy error: left and midpoint rule are one method",
    ];
    let mut panels = Vec::new();
    for ((motion, title), runs) in motions.into_iter().zip(energies).zip(runs) {
        panels.extend([motion, energy(title, runs)]);
    }
    for (panel, letter) in panels.iter_mut().zip('a'..) {
        panel.title = format!("({letter}) {}", panel.title);
    }
    Ok(Figure {
        title: "Four systems: motion at coarse steps, and energy over a thousand periods".into(),
        columns: 2,
        panels,
        ..Figure::default()
    })
}

fn line((label, colour, style): (&str, Colour, Style), points: Curve) -> Line {
    Line {
        label: label.into(),
        colour,
        style,
        points,
        marker: None,
    }
}

/// Points in the units of the axes.
type Curve = Vec<(f64, f64)>;

/// A motion in a plane of two of its quantities.
struct Drawing<'a, G: RealGroup> {
    title: &'a str,
    labels: [&'a str; 2],
    /// The curves of a trajectory.
    curves: &'a dyn Fn(&[State<G>]) -> Vec<Curve>,
    /// Times of the problem, and steps in each.
    times: f64,
    steps: u32,
}

impl<G: RealGroup> Drawing<'_, G> {
    /// The panel: the [`DRAWN`] methods, and the exact motion.
    fn panel<L, X>(&self, problem: &Problem<L, X>) -> Result<Panel, SurveyError>
    where
        L: Lagrangian<Group = G> + Clone + 'static,
    {
        let mut lines = Vec::new();
        for (place, look) in DRAWN.into_iter().zip(LOOKS) {
            let mut integrator = (rows::<L>()[place].make)(problem.lagrangian.clone());
            let h = problem.time / f64::from(self.steps);
            let mut states = vec![problem.start.clone()];
            while let Some(last) = states.last().filter(|s| s.t < self.times * problem.time) {
                let mut next = last.clone();
                integrator.step(&mut next, h)?;
                states.push(next);
            }
            lines.extend((self.curves)(&states).into_iter().map(|c| line(look, c)));
        }
        let states = exact(problem, self.times * problem.time)?;
        for curve in (self.curves)(&states) {
            let marks = curve
                .chunks(SPACE)
                .map(|chunk| &chunk[..MARK.min(chunk.len())]);
            lines.extend(marks.map(|mark| line(EXACT, mark.to_vec())));
        }
        let [x, y] = self.labels;
        Ok(Panel {
            title: self.title.into(),
            x_label: x.into(),
            y_label: y.into(),
            y_scale: Scale::Linear,
            lines,
            ..Panel::default()
        })
    }
}

/// States of the exact motion, by the independent reference, which serves all problems.
fn exact<L, X>(problem: &Problem<L, X>, until: f64) -> Result<Vec<State<L::Group>>, SurveyError>
where
    L: Lagrangian + Clone,
{
    let times: Vec<f64> = (0..=SAMPLES)
        .map(|k| until * f64::from(k) / f64::from(SAMPLES))
        .collect();
    let system = problem.lagrangian.clone().hamiltonian();
    let states = on_group::sample(&system, &problem.start, &times, Tolerance::uniform(1e-10));
    Ok(states.map_err(ProblemError::from)?)
}

fn free_body() -> Result<Panel, SurveyError> {
    let curve = |states: &[State<SO3>]| {
        let component = |i: usize| states.iter().map(|s| (s.t, s.mu[i])).collect();
        vec![component(0), component(1), component(2)]
    };
    let drawing = Drawing {
        title: "free rigid body: its momentum in its own frame",
        labels: ["t [s]", "kg m²/s"],
        curves: &curve,
        times: 2.0,
        steps: 40,
    };
    drawing.panel(&systems::free_rigid_body()?)
}

/// Azimuth, counted on past whole turns, and height, m, of a point on the sphere.
fn unrolled(points: impl Iterator<Item = Vec3>) -> Curve {
    let mut azimuth: Option<f64> = None;
    let place = |p: Vec3| {
        let angle = p[1].atan2(p[0]);
        let last = azimuth.unwrap_or(angle);
        let turns = ((last - angle) / (2.0 * PI)).round();
        azimuth = Some(angle + 2.0 * PI * turns);
        (angle + 2.0 * PI * turns, p[2])
    };
    points.map(place).collect()
}

fn top() -> Result<Panel, SurveyError> {
    let axis = |s: &State<SO3>| s.g.rotate(Vec3([0.0, 0.0, 1.0]));
    let drawing = Drawing {
        title: "Lagrange's top: the tip of its axis",
        labels: ["azimuth [rad]", "height [m]"],
        curves: &|states: &[State<SO3>]| vec![unrolled(states.iter().map(axis))],
        times: 6.0,
        steps: 40,
    };
    drawing.panel(&systems::heavy_top()?)
}

fn pendulum() -> Result<Panel, SurveyError> {
    let centre = |s: &State<SO3>| s.g.rotate(Vec3([0.0, 0.0, -0.5]));
    let drawing = Drawing {
        title: "pendulum in space: its mass centre",
        labels: ["azimuth [rad]", "height [m]"],
        curves: &|states: &[State<SO3>]| vec![unrolled(states.iter().map(centre))],
        times: 4.0,
        steps: 60,
    };
    drawing.panel(&systems::pendulum()?)
}

fn flutter() -> Result<Panel, SurveyError> {
    let problem = systems::flutter()?;
    let impulse = problem.start.g.rotation.rotate(impulse(&problem.start));
    let along = impulse * (1.0 / impulse.norm());
    let across = Vec3([0.0, 0.0, 1.0]).cross(along);
    let path = |states: &[State<SE3>]| {
        let points = states.iter().map(|s| s.g.translation);
        vec![points.map(|p| (p.dot(along), p.dot(across))).collect()]
    };
    let drawing = Drawing {
        title: "ellipsoid in a perfect fluid: its path",
        labels: ["along the impulse [m]", "across [m]"],
        curves: &path,
        times: 6.0,
        steps: 24,
    };
    drawing.panel(&problem)
}

fn impulse(state: &State<SE3>) -> Vec3 {
    Vec3([state.mu[3], state.mu[4], state.mu[5]])
}

/// Windows in which the largest error is shown.
const WINDOWS: usize = 160;

fn energy(title: &str, runs: &[LongRun]) -> Panel {
    let lines = runs.iter().zip(LOOKS).map(|(run, look)| {
        let window = run.energy.len().div_ceil(WINDOWS).max(1);
        let largest = run.energy.chunks(window).map(|chunk| {
            let error = chunk.iter().fold(0.0, |m: f64, (_, e)| m.max(e.abs()));
            (chunk[chunk.len() / 2].0, error)
        });
        line(look, largest.collect())
    });
    Panel {
        title: title.into(),
        x_label: "t [s]".into(),
        y_label: "|ΔE / E|".into(),
        y_scale: Scale::Log,
        lines: lines.collect(),
        ..Panel::default()
    }
}
