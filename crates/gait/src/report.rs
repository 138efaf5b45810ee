//! What a stroke of a scene does.

use articulated_fluid::{Configuration, Scene};
use dvi::{Gauss, Integrator, State};
use lie::{LieGroup, SE3, Vec3};
use serde::Serialize;

use crate::chain::Chain;
use crate::effort::Effort;
use crate::error::GaitError;
use crate::net::net_motion;
use crate::screw::Screw;
use crate::steady::place;
use crate::stroke::Stroke;
use crate::swimmer::Swimmer;

/// A displacement below this part of the swimmer's length is rounding.
const NOWHERE: f64 = 1e-11;
/// The most strokes of a path.
const MOST_STROKES: u32 = 100_000;
/// The standard acceleration of gravity, m/s².
const GRAVITY: f64 = 9.80665;
/// How little the positive work may change with twice as many samples, relative.
const WORK: f64 = 1e-6;
const FIRST_SAMPLES: usize = 128;
const MOST_SAMPLES: usize = 4096;

/// Why a stroke moves as it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Swims {
    /// Without momentum: the shape alone leads, and every stroke leads as far.
    WithoutMomentum,
    /// With a momentum, which is kept: this is the first stroke, and the next one is another.
    WithMomentum,
    /// With loads or free joints: this is the steady stroke.
    Steadily,
}

/// A net motion as it is written.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct NetMotion {
    /// The turn about the axis, rad.
    pub turn_radians: f64,
    /// The axis, in the frame of the first body at the start of the stroke.
    pub axis: [f64; 3],
    /// The advance along the axis, m.
    pub advance_metres: f64,
    /// The displacement of the first body's mass centre, m, in its frame at the start of the stroke.
    pub displacement_metres: [f64; 3],
    /// The radius of the helix that repeated strokes lead along, m; 0 of a straight way.
    pub radius_metres: f64,
    /// The advance in a whole turn, m; none without a turn.
    pub pitch_metres: Option<f64>,
}

impl NetMotion {
    fn of(g: &SE3) -> Self {
        let screw = Screw::of(g);
        let pitch = screw.pitch();
        Self {
            turn_radians: screw.turn,
            axis: screw.axis.0,
            advance_metres: screw.advance,
            displacement_metres: g.translation.0,
            radius_metres: screw.radius,
            pitch_metres: pitch.is_finite().then_some(pitch),
        }
    }
}

/// What a stroke of a scene does.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Report {
    /// The period, s.
    pub period_seconds: f64,
    /// From when on the stroke repeats itself, s: the ramp's end.
    pub from_seconds: f64,
    /// Why it moves.
    pub swims: Swims,
    /// Its net motion.
    pub net: NetMotion,
    /// The part that the shape alone does, without momentum; none where joints are free.
    pub geometric: Option<NetMotion>,
    /// The rest: $h$ of $g_T = h\, g_{\text{geometric}}$.
    pub dynamic: Option<NetMotion>,
    /// The sum over the drives of $\int \max(0, \text{power})\,dt$, J.
    pub positive_work_joules: f64,
    /// At how many times the power was looked at; half as many change the work by less than a part in a million, unless they are 4096.
    pub samples: usize,
    /// $W_+ / (m g |d|)$ with the bodies' own mass and the displacement; none where a mass is not known, or the
    /// stroke leads nowhere.
    pub cost_of_transport: Option<f64>,
    /// The length of the stroke in the metric of the kinetic energy, m √kg; none where joints are free.
    pub length: Option<f64>,
    /// The multipliers of a steady stroke, real and imaginary parts, the largest first.
    pub multipliers: Vec<[f64; 2]>,
    /// Whether small disturbances of a steady stroke die out.
    pub stable: Option<bool>,
    /// Where the first body's mass centre is after each stroke, m, if it starts at the origin in the attitude of the reference frame.
    pub path_metres: Vec<[f64; 3]>,
}

impl Report {
    /// What a stroke of the scene does, and where `strokes` of them lead.
    ///
    /// # Errors
    /// [`GaitError`].
    pub fn of(scene: &Scene, strokes: u32) -> Result<Self, GaitError> {
        if strokes > MOST_STROKES {
            let most = MOST_STROKES;
            return Err(GaitError::Strokes { strokes, most });
        }
        let swimmer = Swimmer::new(scene)?;
        let chain = match Chain::new(scene) {
            Ok(chain) => Some(chain),
            Err(GaitError::Free { .. }) => None,
            Err(GaitError::Rigid) if swimmer.is_loaded() => None,
            Err(error) => return Err(error),
        };
        let told = swimmer.told();
        let geometric = chain
            .as_ref()
            .map(|chain| net_motion(chain, told))
            .transpose()?;
        let swims = match (&chain, swimmer.is_loaded(), swimmer.has_momentum()) {
            (Some(_), false, false) => Swims::WithoutMomentum,
            (Some(_), false, true) => Swims::WithMomentum,
            _ => Swims::Steadily,
        };
        let Motion {
            start,
            net,
            multipliers,
            stable,
            path,
        } = Motion::of(&swimmer, swims, (geometric, strokes))?;
        let (positive, samples) = converged(|samples| match (&start, &chain) {
            (None, Some(chain)) => Effort::Work.of(chain, told, samples),
            (Some(start), _) => positive_work(&swimmer, start, samples),
            // Where nothing is told, nothing drives.
            (None, None) => Ok(0.0),
        })?;
        let length = chain.as_ref();
        let length =
            length.map(|chain| converged(|samples| Effort::Length.of(chain, told, samples)));
        Ok(Self {
            period_seconds: told.period(),
            from_seconds: told.from(),
            swims,
            net: NetMotion::of(&net),
            geometric: geometric.as_ref().map(NetMotion::of),
            dynamic: geometric.map(|part| NetMotion::of(&net.compose(&part.inverse()))),
            positive_work_joules: positive,
            samples,
            cost_of_transport: cost(scene, positive, net.translation, swimmer.length()),
            length: length.transpose()?.map(|(length, _)| length),
            multipliers,
            stable,
            path_metres: path.iter().map(|g| g.translation.0).collect(),
        })
    }
}

/// How a stroke moves.
struct Motion {
    /// Where it is stepped from; none where the shape alone tells all.
    start: Option<State<Configuration>>,
    net: SE3,
    multipliers: Vec<[f64; 2]>,
    stable: Option<bool>,
    /// Where the first body is after each stroke.
    path: Vec<SE3>,
}

impl Motion {
    fn of(
        swimmer: &Swimmer,
        swims: Swims,
        (geometric, strokes): (Option<SE3>, u32),
    ) -> Result<Self, GaitError> {
        let repeating = |net: SE3| {
            let mut path = vec![SE3::identity()];
            for n in 0..strokes as usize {
                path.push(path[n].compose(&net));
            }
            path
        };
        let mut found = Self {
            start: None,
            net: geometric.unwrap_or_default(),
            multipliers: Vec::new(),
            stable: None,
            path: Vec::new(),
        };
        match swims {
            Swims::WithoutMomentum => found.path = repeating(found.net),
            Swims::Steadily => {
                let (steady, _) = swimmer.steady()?;
                found.path = repeating(steady.net);
                found.stable = (!steady.multipliers.is_empty()).then(|| steady.is_stable());
                (found.net, found.multipliers) = (steady.net, steady.multipliers);
                found.start = Some(steady.state);
            }
            Swims::WithMomentum => {
                let start = swimmer.start()?;
                found.path = several(swimmer, &start, strokes.max(1))?;
                found.net = found.path[1];
                found.path.truncate(strokes as usize + 1);
                found.start = Some(start);
            }
        }
        Ok(found)
    }
}

/// The positive work of the drives in a period, which each step counts by its sum.
fn positive_work(
    swimmer: &Swimmer,
    start: &State<Configuration>,
    steps: usize,
) -> Result<f64, GaitError> {
    let model = swimmer.model();
    let (mut state, mut work) = (start.clone(), Default::default());
    let mut gauss = Gauss::new::<2>(swimmer.system());
    let (mut drives, mut positive) = (model.drives(), 0.0);
    let h = swimmer.told().period() / steps as f64;
    let from = state.t;
    for k in 0..steps {
        state.t = from + k as f64 * h;
        let before: Vec<f64> = drives.iter().map(|drive| drive.work).collect();
        let see = &mut |path: dvi::Path<_>| model.add_drives(path, &mut work, &mut drives);
        gauss
            .step_along(&mut state, h, see)
            .map_err(GaitError::Step)?;
        let gains = drives.iter().zip(before);
        let gains = gains.map(|(drive, before)| drive.work - before);
        positive += gains.filter(|gain| *gain > 0.0).sum::<f64>();
    }
    Ok(positive)
}

/// Where each of several strokes with a momentum leads from the start.
fn several(
    swimmer: &Swimmer,
    start: &State<Configuration>,
    strokes: u32,
) -> Result<Vec<SE3>, GaitError> {
    const STEPS: u32 = 60;
    let mut state = start.clone();
    let first = place(&state).inverse();
    let mut path = vec![SE3::identity()];
    for _ in 0..strokes {
        swimmer.advance(&mut state, swimmer.told().period(), STEPS)?;
        path.push(first.compose(&place(&state)));
    }
    Ok(path)
}

/// A figure by so many samples that half as many change it by less than a part in a million.
fn converged(of: impl Fn(usize) -> Result<f64, GaitError>) -> Result<(f64, usize), GaitError> {
    let (mut samples, mut found) = (FIRST_SAMPLES, of(FIRST_SAMPLES)?);
    if !found.is_finite() {
        let quantity = "work";
        return Err(GaitError::NotFinite { quantity });
    }
    while samples < MOST_SAMPLES {
        samples *= 2;
        let finer = of(samples)?;
        let change = (finer - found).abs();
        found = finer;
        if change <= WORK * found.abs() {
            break;
        }
    }
    Ok((found, samples))
}

/// $W_+ / (m g |d|)$.
fn cost(scene: &Scene, positive: f64, displacement: Vec3, length: f64) -> Option<f64> {
    let masses: Option<Vec<f64>> = scene.bodies.iter().map(|body| body.mass()).collect();
    let mass: f64 = masses?.iter().sum();
    let far = displacement.norm();
    (far > NOWHERE * length).then(|| positive / (mass * GRAVITY * far))
}
