//! A scene whose joints do a stroke, with all that acts on it.

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::{Gauss, Integrator, State};
use lie::{SE3, Tangent};

use crate::error::GaitError;
use crate::net::distance;
use crate::steady::{Period, Steady, steady};
use crate::steered::SteeredTree;
use crate::stroke::{Fourier, Stroke, Told};

/// Steps of a period at first, and at most.
const STEPS: u32 = 24;
const MOST_STEPS: u32 = 384;
/// Periods that are stepped before Newton's method tries again.
const SETTLING: u32 = 8;
/// How little the net motion may change with twice as many steps, rad and m.
const CONVERGED: f64 = 1e-10;

/// A scene that swims: what its joints are told, and all that acts on it.
///
/// With drag or free joints a stroke has no net motion of its own: that depends on the motion before. What it leads to is the
/// [steady](Self::steady) stroke.
pub struct Swimmer {
    model: ArticulatedBody,
    start: State<Configuration>,
    told: Told,
    is_loaded: bool,
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
        let model = scene.model().map_err(GaitError::Model)?;
        Ok(Self {
            start: scene.initial_state().map_err(GaitError::Model)?,
            told: Told::new(&model)?,
            is_loaded: !(model.keeps_momentum() && floats(scene)),
            model,
        })
    }

    /// Whether something acts that changes the momentum: drag, thrust, a weight.
    pub fn is_loaded(&self) -> bool {
        self.is_loaded
    }

    /// The model.
    pub fn model(&self) -> &ArticulatedBody {
        &self.model
    }

    /// The scene's state at the time that the stroke repeats from.
    pub fn start(&self) -> State<Configuration> {
        let mut start = self.start.clone();
        start.t = self.told.from();
        start
    }

    /// What the joints are told.
    pub fn told(&self) -> &Told {
        &self.told
    }

    /// The steady stroke that the scene's own leads to, and how many steps of Gauss's method of four stages its period took:
    /// twice as many change it by less than 1e-10.
    ///
    /// # Errors
    /// [`GaitError::Step`], [`GaitError::NotSteady`].
    pub fn steady(&self) -> Result<(Steady, u32), GaitError> {
        let mut start = self.start();
        let mut steps = STEPS;
        let mut found = match steady(self.system(), &start, self.period(steps)) {
            Err(GaitError::NotSteady { .. }) => {
                self.settle(&mut start)?;
                steady(self.system(), &start, self.period(steps))?
            }
            found => found?,
        };
        while steps < MOST_STEPS {
            let finer = steady(self.system(), &found.state, self.period(2 * steps))?;
            let change = distance(&found.net, &finer.net);
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
    /// As [`steady`](Self::steady).
    pub fn steady_by(&self, stroke: &Fourier) -> Result<(SE3, Vec<Tangent<6>>), GaitError> {
        let steered = SteeredTree::new(self.model.clone(), stroke, self.told.from());
        let found = steady(steered, &self.start(), self.period(2 * STEPS))?;
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

    fn settle(&self, state: &mut State<Configuration>) -> Result<(), GaitError> {
        let mut gauss = Gauss::new::<4>(self.system());
        let h = self.told.period() / f64::from(STEPS);
        for _ in 0..SETTLING * STEPS {
            gauss.step(state, h).map_err(GaitError::Step)?;
        }
        Ok(())
    }
}

/// Whether no weight is left that would give the whole a momentum.
fn floats(scene: &Scene) -> bool {
    let mut bodies = scene.bodies.iter();
    let afloat = bodies.all(|body| body.net_mass == 0.0 && body.buoyancy_at == [0.0; 3]);
    afloat || scene.gravity == [0.0; 3]
}
