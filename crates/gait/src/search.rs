//! The best stroke: by sequential quadratic programming (SLSQP), from many starts.
//!
//! The gradients are exact and the limits many: a stroke is held within them at several times. D. Kraft's method takes both. It needs
//! some tens of evaluations, where methods without gradients need thousands.

use core::cell::RefCell;

use articulated_fluid::Scene;
use slsqp::{Func, StopTols};

use crate::chain::Chain;
use crate::clearance::Clearance;
use crate::error::GaitError;
use crate::objective::Objective;
use crate::stroke::{Fourier, Stroke, Told};
use crate::swimmer::Swimmer;
use crate::tree::Moving;

/// A limit may be exceeded by so much of it.
const SLACK: f64 = 1e-6;
/// Evaluations from one start, at most.
const MOST: usize = 500;

/// How far and how fast a joint may turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The largest angle of a hinge, or turn of a ball from rest, rad.
    pub angle: f64,
    /// The largest rate of the coordinates of a joint together, rad/s.
    pub rate: f64,
}

/// A search for the best stroke of a chain.
pub struct Search {
    chain: Chain,
    /// Where loads act: then the net motion is that of the steady stroke.
    loaded: Option<Swimmer>,
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

/// An evaluation, with all that hangs on it.
#[derive(Clone)]
struct Evaluated {
    at: Vec<f64>,
    value: f64,
    gradient: Vec<f64>,
    /// Each at most 0.
    limits: Vec<(f64, Vec<f64>)>,
}

impl Search {
    /// The search for a stroke of a scene, whose joints all move as told and whose bodies do not overlap.
    ///
    /// With drag, thrust or weight it is for the best steady stroke, whose gradient is by first variations through the steps.
    ///
    /// # Errors
    /// [`GaitError`] as of [`Chain::new`] and [`Swimmer::new`]; [`GaitError::Limits`] where a limit is not positive;
    /// [`GaitError::Objective`] of the work where loads act, as they do work too.
    pub fn new(scene: &Scene, objective: Objective, limits: Limits) -> Result<Self, GaitError> {
        if !(limits.angle > 0.0 && limits.rate > 0.0 && limits.angle.is_finite()) {
            return Err(GaitError::Limits {
                angle: limits.angle,
                rate: limits.rate,
            });
        }
        let chain = Chain::new(scene)?;
        let loaded = Some(Swimmer::new(scene)?).filter(Swimmer::is_loaded);
        if loaded.is_some() && objective == Objective::AdvancePerWork {
            return Err(GaitError::Objective);
        }
        Ok(Self {
            clearance: Clearance::of(scene, chain.tree())?,
            chain,
            loaded,
            objective,
            limits,
        })
    }

    /// The chain.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// The scene's own stroke, as far as so many harmonics tell it.
    ///
    /// # Errors
    /// [`GaitError::NotPeriodic`], [`GaitError::Still`].
    pub fn own(&self, scene: &Scene, order: usize) -> Result<Fourier, GaitError> {
        let model = scene.model().map_err(GaitError::Model)?;
        Fourier::fit(&Told::new(&model)?, order)
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
    /// `None` where no stroke within the limits was met.
    ///
    /// # Errors
    /// [`GaitError::Shape`] of a start of another number of coordinates.
    pub fn improve(
        &self,
        start: &Fourier,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Option<Found>, GaitError> {
        let first = self.evaluate(start)?;
        let last: RefCell<Option<Evaluated>> = RefCell::new(None);
        let best: RefCell<Option<Found>> = RefCell::new(None);
        let count = RefCell::new(0);
        let scale = 1.0 / first.value.abs().max(f64::MIN_POSITIVE);
        let evaluated = |x: &[f64]| -> Evaluated {
            if let Some(known) = last.borrow().as_ref().filter(|known| known.at == x) {
                return known.clone();
            }
            if !go_on()
                && let Some(known) = last.borrow().as_ref()
            {
                // Nothing changes any more, which ends the search.
                let mut known = known.clone();
                known.gradient.fill(0.0);
                return known;
            }
            *count.borrow_mut() += 1;
            let Ok(found) = self.evaluate(&start.with(x)) else {
                // Its shape is the start's, which could be evaluated.
                return first.clone();
            };
            let allowed = found.limits.iter().all(|(value, _)| *value <= SLACK);
            let before = best
                .borrow()
                .as_ref()
                .map_or(f64::NEG_INFINITY, |best| best.value);
            if allowed && found.value > before {
                *best.borrow_mut() = Some(Found {
                    stroke: start.with(x),
                    value: found.value,
                    evaluations: 0,
                });
            }
            *last.borrow_mut() = Some(found.clone());
            found
        };
        let objective = |x: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
            let found = evaluated(x);
            if let Some(gradient) = gradient {
                let slopes = gradient.iter_mut().zip(&found.gradient);
                slopes.for_each(|(to, slope)| *to = -scale * slope);
            }
            -scale * found.value
        };
        let limit = |k: usize| {
            let evaluated = &evaluated;
            move |x: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
                let found = evaluated(x);
                let (value, slopes) = &found.limits[k];
                if let Some(gradient) = gradient {
                    gradient.copy_from_slice(slopes);
                }
                *value
            }
        };
        let limits: Vec<_> = (0..first.limits.len()).map(limit).collect();
        let limits: Vec<&dyn Func<()>> =
            limits.iter().map(|limit| limit as &dyn Func<()>).collect();
        let bounds = vec![(-self.limits.angle, self.limits.angle); start.coefficients().len()];
        let stop = StopTols {
            ftol_rel: 1e-10,
            ..StopTols::default()
        };
        // Whether it ended well or gave up: the best that was met counts.
        let _ = slsqp::minimize(
            objective,
            start.coefficients(),
            &bounds,
            &limits,
            (),
            MOST,
            Some(stop),
        );
        let evaluations = *count.borrow();
        let best = best.into_inner();
        Ok(best.map(|found| Found {
            evaluations,
            ..found
        }))
    }

    fn evaluate(&self, stroke: &Fourier) -> Result<Evaluated, GaitError> {
        let (value, gradient) = match &self.loaded {
            None => self.objective.with_gradient(&self.chain, stroke)?,
            Some(swimmer) => match swimmer.steady_by(stroke) {
                Ok(motion) => self.objective.of_motion(&self.chain, stroke, motion)?,
                // There is none so far away: the search has to come back.
                Err(GaitError::Step(_) | GaitError::NotSteady { .. }) => {
                    (0.0, vec![0.0; stroke.coefficients().len()])
                }
                Err(error) => return Err(error),
            },
        };
        Ok(Evaluated {
            at: stroke.coefficients().to_vec(),
            value,
            gradient,
            limits: self.limits_of(stroke)?,
        })
    }

    /// How far a stroke exceeds each limit, relative to it, at several times of the period; with the gradients.
    fn limits_of(&self, stroke: &Fourier) -> Result<Vec<(f64, Vec<f64>)>, GaitError> {
        let times = 8 * (stroke.order() + 1);
        let mut limits =
            Vec::with_capacity(times * (2 * self.chain.joints().len() + self.clearance.len()));
        for i in 0..times {
            let t = stroke.period() * i as f64 / times as f64;
            let [q, rates] = [0, 1].map(|k| stroke.derivative(t, k));
            let bases = [0, 1].map(|k| stroke.basis(t, k));
            for joint in self.chain.joints() {
                limits.push(within(joint, &q, self.limits.angle, &bases[0]));
                if self.limits.rate.is_finite() {
                    limits.push(within(joint, &rates, self.limits.rate, &bases[1]));
                }
            }
            for (value, slopes) in self.clearance.overlaps(&q)? {
                let each = slopes
                    .iter()
                    .flat_map(|slope| bases[0].iter().map(move |phi| slope * phi));
                limits.push((value, each.collect()));
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
