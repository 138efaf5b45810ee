//! The laws, and whether a scene obeys them.

use articulated_fluid::Scene;
use lie::{LieGroup, SO3, Tangent, Vec3};
use sim::Method;

use super::change::{self, Units};

/// Steps of a run: short, since rounding grows with a chaotic motion.
pub const STEPS: usize = 10;
/// The fastest rate of the paper's scene, for which methods have their default steps, rad/s.
const PAPER: f64 = 0.728;
/// What rounding may make of attitudes in a run, rad: inputs and sums are rounded otherwise, and light bodies on long levers amplify it.
const ROUNDING: f64 = 1e-9;
/// How many times the method's own error another root may make.
const OWN_ERRORS: f64 = 10.0;
/// How far apart the longest steps of two roots may be.
const REFUSAL: f64 = 1.5;
/// The grid on which the longest step is looked for.
const GROWTH: f64 = 1.1;

/// What is changed of a scene.
#[derive(Clone, Copy, PartialEq)]
pub enum Law {
    PowersOfTwo,
    OtherUnits,
    Siblings,
    Place,
    Drift,
    Turn,
    FirstBody,
    LongestStep,
}

impl Law {
    /// Each with its name.
    pub const ALL: [(Self, &'static str); 8] = [
        (Self::PowersOfTwo, "units, powers of two"),
        (Self::OtherUnits, "other units"),
        (Self::Siblings, "order of siblings"),
        (Self::Place, "place"),
        (Self::Drift, "drift, dry"),
        (Self::Turn, "turn"),
        (Self::FirstBody, "first body"),
        (Self::LongestStep, "longest step, first body"),
    ];

    /// The scene described otherwise, and the factor of time; none where the law says nothing of it.
    fn apply(self, scene: &Scene, case: u64) -> Option<(Scene, f64)> {
        let spread = |k: u64| ((case * 37 + k * 11) % 23) as f64 / 11.5 - 1.0;
        let vector = |size: f64| Vec3([1, 2, 3].map(|k| size * spread(k)));
        let bodies = scene.bodies.len();
        let dry = scene.density == 0.0;
        match self {
            Self::PowersOfTwo => {
                let two = |k: u64| 2.0_f64.powi((20.0 * spread(k)) as i32);
                let units = Units {
                    length: two(1),
                    mass: two(2),
                    time: two(3),
                };
                Some((units.of(scene), units.time))
            }
            Self::OtherUnits => {
                let other = |k: u64| 10.0_f64.powf(3.0 * spread(k));
                let units = Units {
                    length: other(4),
                    mass: other(5),
                    time: other(6),
                };
                Some((units.of(scene), units.time))
            }
            Self::Siblings => {
                (bodies > 2).then(|| (change::reordered(scene, &change::order_from(scene, 0)), 1.0))
            }
            Self::Place => Some((change::moved(scene, vector(100.0)), 1.0)),
            Self::Drift => dry.then(|| (change::drifting(scene, vector(1000.0)), 1.0)),
            Self::Turn => Some((
                change::turned(scene, &SO3::exp(&Tangent(vector(2.0).0))),
                1.0,
            )),
            Self::FirstBody | Self::LongestStep => (bodies > 1).then(|| {
                let first = 1 + case as usize % (bodies - 1);
                (
                    change::reordered(scene, &change::order_from(scene, first)),
                    1.0,
                )
            }),
        }
    }
}

/// The attitudes after every step, as far as it got, in the order of the bodies' names.
pub fn run(scene: &Scene, method: Method, h: f64, steps: usize) -> Vec<Vec<SO3>> {
    let smallest = scene.smallest().expect("a random scene is a model");
    let mut integrator = method.integrator_of_smallest(&smallest);
    let mut state = scene.initial_state().expect("a random scene has a start");
    let mut names: Vec<_> = scene
        .bodies
        .iter()
        .map(|body| &body.name)
        .enumerate()
        .collect();
    names.sort_by_key(|(_, name)| *name);
    let mut step = || {
        integrator.step(&mut state, h).ok()?;
        let all: Vec<SO3> = state.g.0.to_vec();
        Some(names.iter().map(|(i, _)| all[*i]).collect())
    };
    (0..steps).map_while(|_| step()).collect()
}

/// The largest angle between bodies, rad; of runs that end at different steps, infinite.
pub fn apart(a: &[Vec<SO3>], b: &[Vec<SO3>]) -> f64 {
    if a.len() != b.len() {
        return f64::INFINITY;
    }
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    let angle = |(a, b): (&SO3, &SO3)| (*a.matrix() - *b.matrix()).frobenius() / 2.0_f64.sqrt();
    pairs.map(angle).fold(0.0, f64::max)
}

/// The method's step in radians of the scene's fastest body.
fn step(scene: &Scene, method: Method) -> f64 {
    let rates = scene
        .bodies
        .iter()
        .map(|body| Vec3(body.angular_velocity).norm());
    PAPER * method.default_step() / rates.fold(0.0, f64::max)
}

/// The longest first step that is solved, on a grid from the method's own.
fn longest(scene: &Scene, method: Method) -> f64 {
    let mut h = step(scene, method);
    let solves = |h: f64| !run(scene, method, h, 1).is_empty();
    while solves(h * GROWTH) && h < 1e3 {
        h *= GROWTH;
    }
    h
}

/// Whether the law holds, and how far the attitudes are apart; none where it says nothing.
pub fn holds(law: Law, method: Method, (scene, case): (&Scene, u64)) -> Option<(bool, f64)> {
    let (other, time) = law.apply(scene, case)?;
    if law == Law::LongestStep {
        let (a, b) = (longest(scene, method), longest(&other, method));
        return Some((a.max(b) <= REFUSAL * GROWTH * a.min(b), 0.0));
    }
    let h = step(scene, method);
    let (here, there) = (
        run(scene, method, h, STEPS),
        run(&other, method, h * time, STEPS),
    );
    let difference = match law {
        Law::Turn => turned_back(&here, &there),
        _ => apart(&here, &there),
    };
    let allowed = match law {
        Law::PowersOfTwo => 0.0,
        Law::FirstBody => {
            let fine = run(scene, method, 0.5 * h, 2 * STEPS);
            let fine: Vec<_> = fine.into_iter().skip(1).step_by(2).collect();
            // Where shorter steps are refused and longer ones not, there is no error to compare with.
            (fine.len() == here.len()).then_some(())?;
            OWN_ERRORS * apart(&here, &fine) + ROUNDING
        }
        _ => ROUNDING,
    };
    Some((difference <= allowed, difference))
}

/// The differences that a turn of the whole leaves: each step is compared by the turns of all bodies relative to the first step's.
fn turned_back(here: &[Vec<SO3>], there: &[Vec<SO3>]) -> f64 {
    let relative = |run: &[Vec<SO3>]| -> Vec<Vec<SO3>> {
        let Some(first) = run
            .first()
            .and_then(|first| first.first())
            .map(SO3::inverse)
        else {
            return vec![];
        };
        let turn = |r: &SO3| first.compose(r);
        run.iter()
            .map(|step| step.iter().map(turn).collect())
            .collect()
    };
    if here.len() != there.len() {
        return f64::INFINITY;
    }
    apart(&relative(here), &relative(there))
}
