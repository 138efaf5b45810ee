//! A scene whose joints do a stroke, with all that acts on it.

use core::f64::consts::TAU;

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::{Gauss, Integrator, State};
use lie::{SE3, Tangent, VectorSpace};

use crate::error::GaitError;
use crate::net::distance;
use crate::steady::{Period, Scales, Steady, steady};
use crate::steered::SteeredTree;
use crate::stroke::{Fourier, Stroke, Told};

/// Steps of a period at first, and at most.
const STEPS: u32 = 24;
const MOST_STEPS: u32 = 384;
/// Periods that are stepped before Newton's method tries again.
const SETTLING: u32 = 8;
/// How little the net motion may change with twice as many steps, rad and body lengths.
const CONVERGED: f64 = 1e-10;

/// A scene that swims: what its joints are told, and all that acts on it.
///
/// With drag or free joints a stroke has no net motion of its own: that depends on the motion before. What it leads to is the
/// [steady](Self::steady) stroke.
pub struct Swimmer {
    model: ArticulatedBody,
    start: State<Configuration>,
    told: Told,
    scales: Scales,
}

impl Swimmer {
    /// The swimmer of a scene.
    ///
    /// # Errors
    /// [`GaitError::Held`], [`GaitError::NotPeriodic`], [`GaitError::Still`], [`GaitError::Model`].
    pub fn new(scene: &Scene) -> Result<Self, GaitError> {
        if scene.mount.is_some() {
            return Err(GaitError::Held);
        }
        let model = scene.model()?;
        if !floats(scene) {
            return Err(GaitError::Weight);
        }
        let told = Told::new(&model)?;
        Ok(Self {
            start: scene.initial_state()?,
            scales: scales(&model, told.period()),
            told,
            model,
        })
    }

    /// Whether something acts that changes the momentum: drag or thrust.
    pub fn is_loaded(&self) -> bool {
        !self.scales.is_kept
    }

    /// Whether the whole has a momentum at the start: more than 1e-12 of what the bodies have, or have in a motion of a length in a period.
    pub fn has_momentum(&self) -> bool {
        const NOTHING: f64 = 1e-12;
        let start = &self.start;
        let Ok(kept) = self.model.conserved(start) else {
            return true;
        };
        let spin = kept.angular - start.g.1[0].vec3().cross(kept.linear);
        let speed = self
            .model
            .velocity(start)
            .map_or(0.0, |xi| xi.max_magnitude());
        let Scales {
            linear,
            angular,
            length,
            ..
        } = self.scales;
        let faster = 1.0 + speed * self.told.period() * (1.0 + 1.0 / length);
        kept.linear.norm() > NOTHING * linear * faster || spin.norm() > NOTHING * angular * faster
    }

    /// The radius of gyration of its bodies, m.
    pub fn length(&self) -> f64 {
        self.scales.length
    }

    /// The model.
    pub fn model(&self) -> &ArticulatedBody {
        &self.model
    }

    /// The scene's state at the time that the stroke repeats from, to which it is stepped.
    ///
    /// # Errors
    /// [`GaitError::Step`].
    pub fn start(&self) -> Result<State<Configuration>, GaitError> {
        let mut state = self.start.clone();
        let from = self.told.from();
        let steps = (from / self.told.period() * f64::from(2 * STEPS)).ceil();
        self.advance(&mut state, from, steps as u32)?;
        Ok(state)
    }

    /// Steps a state by so many equal steps, s, of Gauss's method of eight stages.
    pub(crate) fn advance(
        &self,
        state: &mut State<Configuration>,
        span: f64,
        steps: u32,
    ) -> Result<(), GaitError> {
        let (from, h) = (state.t, span / f64::from(steps.max(1)));
        let mut gauss = Gauss::new::<8>(self.system());
        for k in 0..steps {
            state.t = from + f64::from(k) * h;
            gauss.step(state, h).map_err(GaitError::Step)?;
        }
        state.t = from + span;
        Ok(())
    }

    /// What the joints are told.
    pub fn told(&self) -> &Told {
        &self.told
    }

    /// The steady stroke that the scene's own leads to, and how many steps of Gauss's method of four stages its period took.
    ///
    /// Half as many steps change it by less than 1e-10, in rad and body lengths, unless they are 384.
    ///
    /// # Errors
    /// [`GaitError::Step`], [`GaitError::NotSteady`], and [`GaitError::Momentum`] where a momentum is kept.
    pub fn steady(&self) -> Result<(Steady, u32), GaitError> {
        if self.scales.is_kept && self.has_momentum() {
            return Err(GaitError::Momentum);
        }
        let mut start = self.start()?;
        let mut steps = STEPS;
        let mut found = match steady(self.system(), &start, (self.period(steps), self.scales)) {
            Err(GaitError::NotSteady { .. }) => {
                let span = f64::from(SETTLING) * self.told.period();
                self.advance(&mut start, span, SETTLING * STEPS)?;
                steady(self.system(), &start, (self.period(steps), self.scales))?
            }
            found => found?,
        };
        while steps < MOST_STEPS {
            let finer = steady(
                self.system(),
                &found.state,
                (self.period(2 * steps), self.scales),
            )?;
            let change = distance(&found.net, &finer.net, self.scales.length);
            found = finer;
            steps *= 2;
            if change < CONVERGED {
                break;
            }
        }
        Ok((found, steps))
    }

    /// The steady stroke where the joints do another stroke of the same period, and $h^{-1} \partial h$ of its net motion by each coefficient:
    /// exactly that of these steps, by first variations.
    ///
    /// # Errors
    /// As [`steady`](Self::steady); [`GaitError::Shape`] and [`GaitError::Period`] of a stroke of other coordinates or another period.
    pub fn steady_by(&self, stroke: &Fourier) -> Result<(SE3, Vec<Tangent<6>>), GaitError> {
        let (expected, found) = (
            self.told.derivative(0.0, 0).len(),
            stroke.coordinates().len(),
        );
        if expected != found {
            return Err(GaitError::Shape { expected, found });
        }
        let period = stroke.period();
        if (period - self.told.period()).abs() > 1e-12 * period {
            return Err(GaitError::Period { period });
        }
        let steered = SteeredTree::new(self.model.clone(), stroke, self.told.from());
        let steps = (STEPS * stroke.order() as u32).max(2 * STEPS);
        let found = steady(steered, &self.start, (self.period(steps), self.scales))?;
        Ok((found.net, found.slopes))
    }

    /// What is stepped where the joints do as they are told.
    pub(crate) fn system(&self) -> SteeredTree {
        SteeredTree::as_told(self.model.clone())
    }

    fn period(&self, steps: u32) -> Period {
        Period {
            from: self.told.from(),
            length: self.told.period(),
            steps,
        }
    }
}

/// Whether no weight is left that would move or turn the whole.
fn floats(scene: &Scene) -> bool {
    let mut bodies = scene.bodies.iter();
    let afloat = bodies.all(|body| body.net_mass == 0.0 && body.buoyancy_at == [0.0; 3]);
    afloat || scene.gravity == [0.0; 3]
}

/// What its motions are compared with.
fn scales(model: &ArticulatedBody, period: f64) -> Scales {
    let bodies = model.bodies();
    let [mass, inertia] = bodies.fold([0.0; 2], |[m, j], body| {
        [m + body.mass.trace() / 3.0, j + body.inertia.trace() / 3.0]
    });
    let (length, omega) = ((inertia / mass).sqrt(), TAU / period);
    Scales {
        length,
        linear: mass * length * omega,
        angular: inertia * omega,
        is_kept: model.keeps_momentum(),
    }
}
