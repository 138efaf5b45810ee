//! What steps a scene: a method, or what a pilot run finds for an accuracy.

use articulated_fluid::{Configuration, Smallest};
use dvi::{Pilot, PilotError};

use crate::method::{BoxedIntegrator, Method, Model};

/// What is to step a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choice {
    /// A method.
    Method {
        /// Which.
        method: Method,
        /// The longest step to take, s; unless given, the method's [default](Method::default_step).
        step: Option<f64>,
    },
    /// Gauss collocation with the stages and the step that a [pilot run](Pilot) finds for this error by the end, rad and m.
    Accuracy(f64),
}

impl Default for Choice {
    fn default() -> Self {
        Method::default().into()
    }
}

impl From<Method> for Choice {
    fn from(method: Method) -> Self {
        Self::Method { method, step: None }
    }
}

impl Choice {
    /// What it comes to for the first `duration` seconds of a scene.
    ///
    /// # Errors
    /// [`PilotError`] of an accuracy.
    ///
    /// ```
    /// use articulated_fluid::{Scene, scene};
    /// use sim::Choice;
    ///
    /// let smallest = Scene::parse(scene::EXAMPLE, "example.toml")?.smallest()?;
    /// let chosen = Choice::Accuracy(1e-6).resolve(&smallest, 1.0)?;
    /// let pilot = chosen.pilot.expect("an accuracy takes a pilot run");
    /// assert!(pilot.estimate <= 1e-6 && pilot.horizon == 1.0);
    /// let integrator = chosen.integrator_of_smallest(&smallest);
    /// assert_eq!(integrator.order(), chosen.method.order());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn resolve(self, smallest: &Smallest, duration: f64) -> Result<Chosen, PilotError> {
        match self {
            Self::Method { method, step } => Ok(Chosen {
                method,
                step: step.unwrap_or_else(|| method.default_step()),
                pilot: None,
            }),
            Self::Accuracy(accuracy) => pilot(smallest, duration, accuracy).map(Chosen::from),
        }
    }
}

fn pilot(smallest: &Smallest, duration: f64, accuracy: f64) -> Result<Pilot, PilotError> {
    let start = &smallest.start;
    match &smallest.plane {
        None => Pilot::run(&smallest.model, start, duration, accuracy),
        Some(plane) => Pilot::run(&plane.model(), &plane.project(start), duration, accuracy),
    }
}

/// What a [`Choice`] has come to for a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chosen {
    /// The method.
    pub method: Method,
    /// The longest step to take, s.
    pub step: f64,
    /// What a pilot run has found, where one was made.
    pub pilot: Option<Pilot>,
}

impl From<Pilot> for Chosen {
    fn from(pilot: Pilot) -> Self {
        // A pilot tries no other numbers of stages than there are methods of.
        let method = u32::try_from(pilot.stages).ok().and_then(Method::gauss);
        Self {
            method: method.unwrap_or_default(),
            step: pilot.h,
            pilot: Some(pilot),
        }
    }
}

impl Chosen {
    /// The integrator of a model.
    pub fn integrator<M: Model>(&self, model: M) -> BoxedIntegrator<M::Group> {
        match &self.pilot {
            Some(pilot) => pilot.integrator(model),
            None => self.method.integrator(model),
        }
    }

    /// The same with all coordinates among the unknowns of a step.
    pub fn integrator_in_full<M: Model>(&self, model: M) -> BoxedIntegrator<M::Group> {
        match &self.pilot {
            Some(pilot) => pilot.integrator(model),
            None => self.method.integrator_in_full(model),
        }
    }

    /// The integrator of a scene's smallest exact model: it steps that, and gives the scene's own states.
    pub fn integrator_of_smallest(&self, smallest: &Smallest) -> BoxedIntegrator<Configuration> {
        smallest.integrator(
            |model| self.integrator(model),
            |model| self.integrator(model),
        )
    }
}
