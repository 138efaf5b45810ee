//! The best stroke, from many starts.

use core::f64::consts::PI;

use articulated_fluid::Scene;

use crate::chain::Chain;
use crate::clearance::Clearance;
use crate::error::GaitError;
use crate::objective::Objective;
use crate::stroke::{Fourier, Stroke};
use crate::swimmer::Swimmer;
use crate::tree::Moving;
use crate::walk::{Evaluated, Walk};

/// How far and how fast a joint may turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The largest angle of a hinge, or turn of a ball from rest, rad.
    pub angle: f64,
    /// The largest rate of a joint, rad/s: of a ball that of its rotation vector.
    pub rate: f64,
}

/// A search for the best stroke of a chain.
pub struct Search {
    chain: Chain,
    /// Where loads act, the net motion is that of its steady stroke.
    swimmer: Swimmer,
    clearance: Clearance,
    objective: Objective,
    limits: Limits,
}

/// A stroke that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The stroke.
    pub stroke: Fourier,
    /// What it has of the objective.
    pub value: f64,
    /// How many evaluations it took.
    pub evaluations: usize,
}

impl Found {
    /// The best of several, of which some were not found.
    pub fn best(found: &[Option<Self>]) -> Option<&Self> {
        let better = |a: &&Self, b: &&Self| a.value.total_cmp(&b.value);
        found.iter().flatten().max_by(better)
    }
}

impl Search {
    /// The search for a stroke of a scene, whose joints all move as told and whose bodies do not overlap.
    ///
    /// With drag or thrust it is for the best steady stroke, whose gradient is by first variations through the steps.
    ///
    /// # Errors
    /// [`GaitError`] as of [`Chain::new`] and [`Swimmer::new`]. [`GaitError::Limits`] of a limit that is not positive, or an angle above
    /// $\pi$. Without loads [`GaitError::Momentum`], and [`GaitError::Scallop`] of one coordinate.
    /// [`GaitError::Objective`] of the work where loads act, as they do work too.
    pub fn new(scene: &Scene, objective: Objective, limits: Limits) -> Result<Self, GaitError> {
        let Limits { angle, rate } = limits;
        if !(angle > 0.0 && angle <= PI && rate > 0.0) {
            return Err(GaitError::Limits { angle, rate });
        }
        let (chain, swimmer) = (Chain::new(scene)?, Swimmer::new(scene)?);
        match (swimmer.is_loaded(), objective) {
            (true, Objective::AdvancePerWork) => return Err(GaitError::Objective),
            (false, _) if swimmer.has_momentum() => return Err(GaitError::Momentum),
            (false, _) if chain.dim() < 2 => return Err(GaitError::Scallop),
            _ => (),
        }
        Ok(Self {
            clearance: Clearance::of(scene, chain.tree())?,
            chain,
            swimmer,
            objective,
            limits,
        })
    }

    /// What a stroke has of the objective; with loads the steady one.
    ///
    /// # Errors
    /// [`GaitError`]; [`GaitError::NotSteady`] where there is no steady stroke.
    pub fn value(&self, stroke: &Fourier) -> Result<f64, GaitError> {
        match self.swimmer.is_loaded() {
            false => self.objective.finely(&self.chain, stroke),
            true => Ok(self.evaluate(stroke)?.value),
        }
    }

    /// The chain.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// The scene's own stroke, by so many harmonics.
    ///
    /// # Errors
    /// [`GaitError::Order`] of too many, [`GaitError::Harmonics`] where they miss more than a thousandth of it.
    pub fn own(&self, order: usize) -> Result<Fourier, GaitError> {
        let own = Fourier::fit(self.swimmer.told(), order)?;
        match own.misses(self.swimmer.told()) {
            part if part > 1e-3 => Err(GaitError::Harmonics { order, part }),
            _ => Ok(own),
        }
    }

    /// When the scene's stroke begins, s.
    pub fn from(&self) -> f64 {
        self.swimmer.told().from()
    }

    /// The best strokes near the scene's own one and near random ones, `starts` in all; the same ones each time. `None` where no stroke
    /// within the limits was met.
    ///
    /// `see` is called after each start with the number of those done; `go_on` as in [`improve`](Self::improve).
    ///
    /// # Errors
    /// As [`improve`](Self::improve).
    pub fn from_starts(
        &self,
        own: &Fourier,
        starts: u64,
        see: &mut dyn FnMut(u64),
        go_on: &dyn Fn() -> bool,
    ) -> Result<Vec<Option<Found>>, GaitError> {
        let mut random = fastrand::Rng::with_seed(1);
        let mut found = Vec::new();
        for k in 0..starts {
            let start = match k {
                0 => own.clone(),
                _ => self.random(own, &mut random),
            };
            found.push(self.improve(&start, go_on)?);
            see(k + 1);
            if !go_on() {
                break;
            }
        }
        Ok(found)
    }

    /// A random stroke within the limits of the angles, in most of its length.
    fn random(&self, like: &Fourier, random: &mut fastrand::Rng) -> Fourier {
        let mut coefficients = Vec::new();
        for _ in 0..self.chain.dim() {
            let mut part = |of: f64| of * self.limits.angle * (2.0 * random.f64() - 1.0);
            coefficients.push(part(0.1));
            for k in 1..=like.order() {
                coefficients.extend([part(0.5), part(0.5)].map(|x| x / (k * k) as f64));
            }
        }
        like.with(&coefficients)
    }

    /// The best stroke near another one. `go_on` is asked before each evaluation; once it says no, the best until then is given.
    ///
    /// `None` where no stroke within the limits was met, or none that is steady. Angles and rates are within their limits at all times, to 1e-6
    /// of them. Bodies do not overlap at `16 (K + 1)` times of the stroke.
    ///
    /// # Errors
    /// [`GaitError::Shape`] of a start of another number of coordinates; [`GaitError::TooLarge`] of too many limits.
    pub fn improve(
        &self,
        start: &Fourier,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Option<Found>, GaitError> {
        let first = match self.evaluate(start) {
            Err(GaitError::Step(_) | GaitError::NotSteady { .. } | GaitError::Still) => {
                return Ok(None);
            }
            first => first?,
        };
        // A wave within ±a may have harmonics of 4 a / π.
        let bound = 4.0 / PI * self.limits.angle;
        let evaluate = |x: &[f64]| self.evaluate(&start.with(x));
        let ended = Walk::new(first, &evaluate, go_on).climb((bound, self.least()))?;
        let Some(best) = ended.best else {
            return Ok(None);
        };
        let stroke = start.with(&best);
        Ok(Some(Found {
            value: self.value(&stroke)?,
            evaluations: ended.evaluations,
            stroke,
        }))
    }

    /// What counts as nothing of the objective.
    fn least(&self) -> f64 {
        1e-9 * self.chain.gyration()
    }

    fn evaluate(&self, stroke: &Fourier) -> Result<Evaluated, GaitError> {
        let (value, gradient) = match self.swimmer.is_loaded() {
            false => self.objective.with_gradient(&self.chain, stroke)?,
            true => {
                let motion = self.swimmer.steady_by(stroke)?;
                self.objective.of_motion(&self.chain, stroke, motion)?
            }
        };
        if !(value.is_finite() && gradient.iter().all(|slope| slope.is_finite())) {
            let quantity = "objective";
            return Err(GaitError::NotFinite { quantity });
        }
        Ok(Evaluated {
            x: stroke.coefficients().to_vec(),
            value,
            gradient,
            limits: self.limits_of(stroke)?,
        })
    }

    /// How far a stroke exceeds each limit, relative to it, at several times of the period; with the gradients.
    ///
    /// A trigonometric polynomial of degree $K$ is at most $1 / \cos(\pi K / N)$ times as large as at $N > 2 K$ equal times (M. Riesz, 1914).
    /// A limit that is nearer by that at these times holds at all times.
    fn limits_of(&self, stroke: &Fourier) -> Result<Vec<(f64, Vec<f64>)>, GaitError> {
        let times = 16 * (stroke.order() + 1);
        let nearer = (PI * stroke.order() as f64 / times as f64).cos();
        let Limits { angle, rate } = self.limits;
        let times = (0..times).map(|i| stroke.period() * i as f64 / times as f64);
        let shapes: Vec<Vec<f64>> = times.clone().map(|t| stroke.derivative(t, 0)).collect();
        let overlaps = self.clearance.overlaps(&shapes)?;
        let mut limits = Vec::new();
        for (i, (t, q)) in times.zip(&shapes).enumerate() {
            let rates = stroke.derivative(t, 1);
            let bases = [0, 1].map(|k| stroke.basis(t, k));
            for joint in self.chain.joints() {
                limits.push(within(joint, q, nearer * angle, &bases[0]));
                if rate.is_finite() {
                    limits.push(within(joint, &rates, nearer * rate, &bases[1]));
                }
            }
            for (value, slopes) in overlaps.iter().map(|of_pair| &of_pair[i]) {
                let each = slopes
                    .iter()
                    .flat_map(|slope| bases[0].iter().map(move |phi| slope * phi));
                limits.push((*value, each.collect()));
            }
        }
        Ok(limits)
    }
}

/// $|q|^2 / a^2 - 1$ of the coordinates of a joint, and its gradient in the coefficients.
fn within(joint: &Moving, q: &[f64], most: f64, basis: &[f64]) -> (f64, Vec<f64>) {
    let own = &q[joint.coordinates.clone()];
    let squared: f64 = own.iter().map(|x| (x / most).powi(2)).sum();
    let mut gradient = vec![0.0; q.len() * basis.len()];
    for j in joint.coordinates.clone() {
        for (c, phi) in basis.iter().enumerate() {
            gradient[j * basis.len() + c] = 2.0 * q[j] / (most * most) * phi;
        }
    }
    (squared - 1.0, gradient)
}
