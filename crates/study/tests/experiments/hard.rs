//! The hard scenes: every method refuses with an error, or keeps momenta and orthogonality to rounding. In its own step attitudes and
//! energy are within the order's band; in longer ones each step is of the motion's root, and the energy is bounded up to a radian.

use std::path::{Path, PathBuf};

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::{State, StepError};
use lie::{SO3, VectorSpace};
use sim::method::Family;
use sim::{Method, Sample, Watch};
use study::baseline::{Tolerance, on_group};
use study::contender::{Contender, Problem};

/// A scene, and what each of [`METHODS`] makes of it: `G` must step, `-` may refuse.
struct Hard {
    name: &'static str,
    /// In which the fastest body turns by a radian or its velocity changes by itself, s.
    radian: f64,
    /// At the method's own step, at half a radian, and at 4 radians, which are more than pi.
    outcomes: [&'static str; 3],
}

/// How long a step is.
#[derive(Clone, Copy, PartialEq)]
enum Step {
    Own,
    Half,
    Long,
}

impl Step {
    const ALL: [Self; 3] = [Self::Own, Self::Half, Self::Long];

    /// Steps in the first window.
    fn count(self) -> u32 {
        if self == Self::Own { 10 } else { 4 }
    }

    /// In radians of the scene.
    fn theta(self, method: Method) -> f64 {
        match self {
            Self::Own => PAPER * method.default_step(),
            Self::Half => 0.5,
            Self::Long => 4.0,
        }
    }
}

const fn hard(name: &'static str, radian: f64, outcomes: [&'static str; 3]) -> Hard {
    Hard {
        name,
        radian,
        outcomes,
    }
}

/// The methods of each row.
const METHODS: [&str; 14] = [
    "lgvi",
    "lgvi-adjoint",
    "composition-2",
    "composition-4",
    "composition-6",
    "composition-8",
    "gauss-1",
    "gauss-2",
    "gauss-3",
    "gauss-4",
    "gauss-5",
    "gauss-6",
    "gauss-7",
    "gauss-8",
];

/// Whether a method must step, as a row has it; one that is in no row must take its own step, and may refuse longer ones.
fn must_step(method: Method, step: Step, row: &str) -> bool {
    let place = METHODS.iter().position(|name| *name == method.name());
    place.map_or(step == Step::Own, |place| &row[place..=place] == "G")
}

#[rustfmt::skip]
const TABLE: [Hard; 14] = [
    hard("needle",          0.2,   ["GGGGGGGGGGGGGG", "GGGGGG--------", "--------------"]),
    hard("disc",            0.4,   ["GGGGGGGGGGGGGG", "-------G----GG", "--------------"]),
    hard("light-tail",      0.033, ["GGGGGGGGGGGGGG", "GGGGGGGGGGGGGG", "--------------"]),
    hard("fast-spin",       0.0026,["GGGGGGGGGGGGGG", "GGGGGGGGGGGGGG", "--------------"]),
    hard("joint-at-centre", 0.2,   ["GGGGGGGGGGGGGG", "GGGGGGGGGGGGGG", "--------------"]),
    hard("folded-chain",    0.33,  ["GGGGGGGGGGGGGG", "---GGGGGGGGGGG", "--------------"]),
    hard("angle-pi",        0.3,   ["GGGGGGGGGGGGGG", "GGGGGGGGGGGGGG", "--------------"]),
    hard("at-rest",         1.0,   ["GGGGGGGGGGGGGG", "GGGGGGGGGGGGGG", "GGGGGGGGGGGGGG"]),
    hard("from-rest",       0.33,  ["GGGGGGGGGGGGGG", "-G-GGG--------", "--------------"]),
    hard("one-body",        0.33,  ["GGGGGGGGGGGGGG", "GGGGGGGGGGGGGG", "--------------"]),
    hard("fast-and-far",    0.005, ["GGGGGGGGGGGGGG", "GGGGGGGGGGGGGG", "------GGGGGGGG"]),
    hard("glide",           1.0,   ["GGGGGGGGGGGGGG", "--GGGGGGGGGGGG", "--------------"]),
    hard("rotors",          1.0,   ["GGGGGGGGGGGGGG", "GGGGGGGGGGGGGG", "--------------"]),
    hard("dense-fluid",     0.1,   ["GGGGGGGGGGGGGG", "---GGGGGGGGGGG", "--------------"]),
];

/// The fastest rate of the paper's scene, for which methods have their default steps, rad/s.
const PAPER: f64 = 0.728;
/// Of the reference; absolute for the momenta of the lightest body too.
const REFERENCE: Tolerance = Tolerance {
    relative: 1e-13,
    absolute: 1e-15,
};
/// The bands of errors in units of the order's power of the step in radians.
const BAND: f64 = 50.0;
/// Of a solved step, relative to the momentum: the default of the methods that solve a balance.
const RESIDUAL: f64 = 1e-13;
/// About a fixed axis the balance's other root is $\pi - 2 \theta$ from the motion's, rad: an error below this is of no other root, unless the
/// step is longer than a radian.
const OTHER_ROOT: f64 = 0.3;
/// Parts of a step over which its solution is followed from $h = 0$, and how far it may move from one to the next, rad.
const PARTS: u32 = 32;
const JUMP: f64 = 0.5;

fn directory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/hard")
}

fn load(name: &str) -> Problem {
    let scene = Scene::load(&directory().join(format!("{name}.toml"))).unwrap();
    let (model, start) = (scene.model().unwrap(), scene.initial_state().unwrap());
    Problem {
        model,
        start,
        until: 1.0,
    }
}

fn reference(problem: &Problem, from: &State<Configuration>, until: f64) -> State<Configuration> {
    on_group::integrate(&problem.model, from, until, REFERENCE).unwrap()
}

/// The largest angle between bodies of two states, rad.
fn apart(a: &State<Configuration>, b: &State<Configuration>) -> f64 {
    let angle = |a: &SO3, b: &SO3| {
        let sine = (*a.matrix() - *b.matrix()).frobenius() / 8.0_f64.sqrt();
        2.0 * sine.clamp(0.0, 1.0).asin()
    };
    let angles = a.g.0.iter().zip(b.g.0.iter()).map(|(a, b)| angle(a, b));
    angles.fold(0.0, f64::max)
}

/// What rounding is measured by: kg m/s and kg m²/s that cancel in the sums.
struct Scales {
    linear: f64,
    angular: f64,
}

impl Scales {
    fn new(model: &ArticulatedBody, state: &State<Configuration>, sample: &Sample) -> Self {
        let masses = model.bodies().map(|body| body.mass.frobenius());
        let linear = (2.0 * sample.kinetic * masses.sum::<f64>()).sqrt();
        let far = sample.linear.norm() * state.g.1[0].vec3().norm();
        let angular = state.mu.max_magnitude().max(sample.angular.norm()) + far;
        Self { linear, angular }
    }

    fn widen(&mut self, other: &Self) {
        self.linear = self.linear.max(other.linear);
        self.angular = self.angular.max(other.angular);
    }
}

/// How a run in the first window went.
struct Outcome {
    refused: Option<StepError>,
    /// What is outside its band.
    wrong: Vec<String>,
}

fn run(problem: &Problem, method: Method, radian: f64, step: Step) -> Outcome {
    let (theta, steps) = (step.theta(method), step.count());
    let h = theta * radian;
    let Problem { model, start, .. } = problem;
    let mut integrator = Contender::Structure(method).integrator(problem).unwrap();
    let mut state = start.clone();
    let first = Sample::take(model, start).unwrap();
    let (mut watch, mut scales) = (Watch::new(model, first), Scales::new(model, start, &first));
    let (mut wrong, mut refused, mut exact) = (Vec::new(), None, start.clone());
    let later = reference(problem, start, problem.until);
    let mut kinetic = first
        .kinetic
        .max(Sample::take(model, &later).unwrap().kinetic);
    let at_rest = kinetic == 0.0;
    for k in 0..steps {
        let before = state.clone();
        if let Err(error) = integrator.step(&mut state, h) {
            // Printed, numbers are exact.
            if format!("{before:?}") != format!("{state:?}") {
                wrong.push("a refused step has changed the state".to_owned());
            }
            refused = Some(error);
            break;
        }
        let Some(sample) = Sample::take(model, &state) else {
            wrong.push("not a number".to_owned());
            break;
        };
        watch.add(&sample);
        scales.widen(&Scales::new(model, &state, &sample));
        // Over the window at the method's own step; beyond, each step by itself.
        exact = reference(
            problem,
            if step == Step::Own { &exact } else { &before },
            state.t,
        );
        kinetic = kinetic.max(Sample::take(model, &exact).unwrap().kinetic);
        let error = apart(&exact, &state);
        if at_rest || step == Step::Own {
            let order = match at_rest {
                true => 0.0,
                false => BAND * theta.powi(method.order() as i32) * theta * f64::from(k + 1),
            };
            let allowed = order + unsolved(problem, method, h) + 1e-11;
            if error.is_nan() || error > allowed {
                wrong.push(format!(
                    "step {k}: attitude {error:.1e}, allowed {allowed:.1e}"
                ));
            }
        } else if (error.is_nan() || error > OTHER_ROOT || theta > 1.0)
            && !is_continued(problem, method, (&before, &state), h)
        {
            wrong.push(format!("step {k}: attitude {error:.1e}, of another root"));
        }
    }
    // Of a step longer than a radian the order says nothing, but a body at rest has no energy.
    let order = (BAND * theta.powi(method.order() as i32)).min(0.9);
    let energy = match theta > 1.0 && !at_rest {
        true => f64::INFINITY,
        false => (order + 1e-11) * kinetic,
    };
    wrong.extend(outside(method, steps, (&watch, &scales, energy)));
    Outcome { refused, wrong }
}

/// What the tolerance of the whole residual leaves open of the turn of the body with the smallest inertia, rad.
fn unsolved(problem: &Problem, method: Method, h: f64) -> f64 {
    if matches!(method.family(), Family::Gauss { .. }) {
        return 0.0;
    }
    let moments = problem
        .model
        .bodies()
        .flat_map(|body| [0, 1, 2].map(|i| body.inertia[(i, i)]));
    let smallest = moments.fold(f64::INFINITY, f64::min);
    RESIDUAL * problem.start.mu.max_magnitude() * h / smallest
}

/// Whether the step is what shorter and shorter steps from the same state lead back to nothing without a jump.
fn is_continued(
    problem: &Problem,
    method: Method,
    (before, after): (&State<Configuration>, &State<Configuration>),
    h: f64,
) -> bool {
    let step = |part: u32| {
        let mut integrator = Contender::Structure(method).integrator(problem).unwrap();
        let mut state = before.clone();
        let length = h * f64::from(part) / f64::from(PARTS);
        integrator.step(&mut state, length).ok().map(|_| state)
    };
    let mut last = before.clone();
    for part in 1..=PARTS {
        match step(part) {
            Some(next) if apart(&last, &next) < JUMP => last = next,
            Some(_) => return false,
            // A part that is refused is a gap, and what lies beyond it has to be as near.
            None => {}
        }
    }
    apart(&last, after) < 1e-6
}

/// The conserved quantities outside their bands; the energy's is given.
fn outside(
    method: Method,
    steps: u32,
    (watch, scales, energy): (&Watch, &Scales, f64),
) -> Vec<String> {
    let substeps = match method.family() {
        Family::Composition { substeps } => substeps,
        _ => 1,
    };
    // A random walk of roundings.
    let rounding = 10.0 * f64::EPSILON * f64::from(steps * substeps).sqrt();
    // 32 products lie between two normalisations, each good to a few roundings.
    let orthogonality = 200.0 * f64::EPSILON;
    let quantities = [
        ("energy", watch.energy(), energy),
        ("linear momentum", watch.linear(), rounding * scales.linear),
        (
            "angular momentum",
            watch.angular(),
            rounding * scales.angular,
        ),
        ("orthogonality", watch.orthogonality(), orthogonality),
    ];
    let out = |(_, is, may): &(&str, f64, f64)| is.is_nan() || is > may;
    let tell = |(name, is, may)| format!("{name} {is:.1e}, allowed {may:.1e}");
    quantities.into_iter().filter(out).map(tell).collect()
}

#[test]
fn every_hard_scene_has_a_row() {
    let mut files: Vec<_> = std::fs::read_dir(directory())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    let mut rows: Vec<_> = TABLE
        .iter()
        .map(|row| format!("{}.toml", row.name))
        .collect();
    files.sort();
    rows.sort();
    assert_eq!(files, rows);
}

#[test]
fn every_method_is_good_or_refuses() {
    assert!(METHODS.iter().all(|name| name.parse::<Method>().is_ok()));
    let (mut cells, mut refusals, mut faults) = (0, 0, Vec::new());
    for Hard {
        name,
        radian,
        outcomes,
    } in &TABLE
    {
        let mut problem = load(name);
        problem.until = *radian;
        for (step, expected) in Step::ALL.into_iter().zip(outcomes) {
            let mut found = String::new();
            assert_eq!(METHODS.len(), expected.len(), "{name}");
            for method in Method::all() {
                let theta = step.theta(method);
                let outcome = run(&problem, method, *radian, step);
                cells += 1;
                refusals += u32::from(outcome.refused.is_some());
                found.push(if outcome.refused.is_some() { '-' } else { 'G' });
                let broken = outcome
                    .refused
                    .filter(|_| must_step(method, step, expected));
                let broken = broken.map(|error| error.to_string());
                let wrong = outcome.wrong.into_iter().chain(broken);
                faults
                    .extend(wrong.map(|what| format!("{name}, {method}, {theta:.1e} rad: {what}")));
            }
            println!("{name:16} {found}");
        }
    }
    println!("{cells} cells, {refusals} refused");
    assert!(
        faults.is_empty(),
        "{} of {cells}:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

/// Just before the fold, in a frame at rest and in one that moves; with any root that is near its guess, a step turns by 2 rad.
#[test]
fn two_rotors_past_their_fold_are_seen() {
    let problem = load("rotors");
    for (method, velocity) in [("lgvi", 0.0), ("lgvi-adjoint", 0.0), ("lgvi-adjoint", 1e3)] {
        let method: Method = method.parse().unwrap();
        for h in [0.9460645233317553, 0.9601826969832394, 0.9668478186190652] {
            let mut integrator = Contender::Structure(method).integrator(&problem).unwrap();
            let mut state = problem.start.clone();
            // Of 3 kg.
            state.mu.1[0][0] += 3.0 * velocity;
            let mut steps = 0;
            for _ in 0..60 {
                let before = state.clone();
                if integrator.step(&mut state, h).is_err() {
                    break;
                }
                steps += 1;
                let turn = apart(&before, &state);
                assert!(
                    turn < core::f64::consts::FRAC_PI_2,
                    "{method}, h = {h}: {turn}"
                );
            }
            assert!(steps > 10, "{method}, h = {h}: only {steps} steps");
        }
    }
}
