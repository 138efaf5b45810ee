//! A scene on its way, from frame to frame.

use articulated_fluid::{Account, ArticulatedBody, Configuration, Evaluation, Scene, Smallest};
use dvi::{State, StepError};
use lie::LieGroup;

use crate::choice::{Choice, Chosen, Stage};
use crate::clock::Clock;
use crate::dense::Dense;
use crate::drives::Drives;
use crate::error::SimError;
use crate::estimate::Estimator;
use crate::frame::{Frame, Sample};
use crate::method::{BoxedIntegrator, Method};
use crate::run::Run;
use crate::schedule::{Due, Schedule};
use crate::watch::Watch;

/// The most steps that [`Simulation::advance`] takes at once.
pub const CHUNK: u64 = 100;
/// Halvings of a default step in mid-run, at most.
const HALVINGS: u32 = 10;

/// How a scene is to be run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// What steps it.
    pub choice: Choice,
    /// The time to run to, s.
    pub until: f64,
    /// When there are frames.
    pub schedule: Schedule,
    /// Takes no reduction: all coordinates are unknowns and all terms are computed.
    pub full: bool,
    /// Lets two companions go along, in steps twice and four times as long: their differences estimate the error of the trajectory.
    /// They take three quarters as many steps again.
    pub estimate: bool,
}

impl Default for Plan {
    /// The default method for 100 s, with a frame every ten steps.
    fn default() -> Self {
        Self {
            choice: Choice::default(),
            until: 100.0,
            schedule: Schedule::Steps(10),
            full: false,
            estimate: false,
        }
    }
}

impl Plan {
    /// The method and the step that the choice comes to for a scene.
    ///
    /// ```
    /// use articulated_fluid::{Scene, scene};
    /// use sim::{Choice, Plan};
    ///
    /// let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
    /// let plan = Plan { choice: Choice::Accuracy(1e-6), until: 1.0, ..Plan::default() };
    /// let chosen = plan.resolve(&scene)?;
    /// let checked = chosen.checked.ok_or("an accuracy is checked")?;
    /// assert!(checked.estimate <= 1e-6);
    /// let integrator = chosen.integrator_of_smallest(&scene.smallest()?);
    /// assert_eq!(integrator.order(), chosen.method.order());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SimError`].
    pub fn resolve(&self, scene: &Scene) -> Result<Chosen, SimError> {
        let (model, smallest) = (scene.model()?, scene.smallest()?);
        self.on(scene, &model, &smallest).resolve(self.choice)
    }

    fn on<'a>(
        &self,
        scene: &'a Scene,
        model: &'a ArticulatedBody,
        smallest: &'a Smallest,
    ) -> Stage<'a> {
        Stage {
            scene,
            model,
            smallest,
            until: self.until,
            full: self.full,
        }
    }
}

/// Refuses a run that goes on beyond what its tables tell.
///
/// # Errors
/// [`SimError::Untold`].
pub fn check_told(model: &ArticulatedBody, until: f64) -> Result<(), SimError> {
    let [from, to] = model.told();
    match until > to || from > 0.0 {
        true => Err(SimError::Untold { from, to, until }),
        false => Ok(()),
    }
}

/// A run of a scene: an iterator over its frames, from t = 0 to the end.
///
/// It owns all that it needs and does nothing between two calls. To stop a run is to call no more: the
/// [state](Self::state) says where it is. Between two frames may lie many steps; [`advance`](Self::advance) returns after a
/// [few](CHUNK), so that a caller can show progress, or stop.
///
/// ```
/// use articulated_fluid::{Scene, scene};
/// use sim::{Choice, Plan, Schedule, Simulation};
///
/// let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
/// let plan = Plan { until: 10.0, schedule: Schedule::Steps(1000), ..Plan::default() };
/// let mut simulation = Simulation::new(&scene, &plan)?;
/// let mut is_stopped = false;
/// while !(simulation.is_done() || is_stopped) {
///     if let Some(frame) = simulation.advance()? {
///         println!("{} s: {} J", frame.t(), frame.sample.energy);
///     }
///     is_stopped = simulation.steps() >= 1250;
/// }
/// assert_eq!((simulation.steps(), simulation.state().t), (1300, 1.3));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct Simulation {
    pub(crate) title: Option<String>,
    pub(crate) account: Account,
    pub(crate) plan: Plan,
    pub(crate) chosen: Chosen,
    pub(crate) model: ArticulatedBody,
    pub(crate) run: Run<BoxedIntegrator<Configuration>>,
    pub(crate) watch: Watch,
    pub(crate) drives: Drives,
    /// The names of their joints.
    pub(crate) driven: Vec<String>,
    /// What watching needs to evaluate the model.
    watching: (Evaluation, <Configuration as LieGroup>::Algebra),
    pub(crate) estimator: Option<Estimator>,
    /// Where longer steps were not solved at first.
    pub(crate) shortened: Option<Shortened>,
    /// Frames given out.
    pub(crate) frames: u64,
    /// Whether frames inside a step are interpolated; the step that one lay in last.
    dense: (bool, Option<Dense>),
    /// The frame at t = 0, until it is given out.
    first: Option<Frame>,
    /// The number of the frame after those; none after the end, or a failure.
    next: Option<u64>,
}

impl Simulation {
    /// The run of a scene at t = 0; an accuracy takes a rehearsal of the whole run first; see [`Choice::Accuracy`].
    ///
    /// # Errors
    /// [`SimError`].
    pub fn new(scene: &Scene, plan: &Plan) -> Result<Self, SimError> {
        let (model, smallest) = (scene.model()?, scene.smallest()?);
        check_told(&model, plan.until)?;
        let stage = plan.on(scene, &model, &smallest);
        let start = scene.initial_state()?;
        let first = Frame::new(&model, start.clone());
        let first = first.map_err(|error| SimError::unmeasured(0.0, error))?;
        let chosen = stage.resolve(plan.choice)?;
        let clock = Clock::new(plan.until, chosen.step)?;
        plan.schedule.check(&clock)?;
        let estimator = plan.estimate.then(|| {
            let span = (clock.until(), clock.steps(), chosen.method.order());
            Estimator::new(|| stage.integrator(&chosen), &start, span)
        });
        let run = Run::new(stage.integrator(&chosen), start, clock);
        Ok(Self {
            title: scene.title.clone(),
            account: smallest.account,
            plan: *plan,
            chosen,
            watch: Watch::new(&model, first.sample),
            watching: (Evaluation::default(), first.velocity.clone()),
            drives: Drives::new(&model),
            driven: scene.driven_joints().map(str::to_owned).collect(),
            estimator,
            shortened: None,
            frames: 0,
            dense: (false, None),
            model,
            run,
            first: Some(first),
            next: Some(1),
        })
    }

    /// The same run, with frames inside a step of Gauss collocation interpolated between its stages, which costs next to nothing.
    ///
    /// With $S$ stages such frames have an error of $O(h^{S+1})$ in the step $h$, where the run has $O(h^{2S})$. Other methods have no such
    /// stages, and what drives do is summed along steps: then frames are exact as without this.
    #[must_use]
    pub fn interpolated(mut self) -> Self {
        let interpolates = self.chosen.method.stages().is_some() && self.drives.are_none();
        self.dense = (interpolates, None);
        self
    }

    /// The method: what was chosen, or what was found for an accuracy.
    pub fn method(&self) -> Method {
        self.chosen.method
    }

    /// The times of the steps.
    pub fn clock(&self) -> &Clock {
        self.run.clock()
    }

    /// The number of steps taken.
    pub fn steps(&self) -> u64 {
        self.run.cost().steps
    }

    /// The state at the end of the last step.
    pub fn state(&self) -> &State<Configuration> {
        self.run.state()
    }

    /// The model of the whole scene, which the frames are measured with, whatever is stepped.
    pub fn model(&self) -> &ArticulatedBody {
        &self.model
    }

    /// Whether no frame is left: all are given out, or one failed.
    pub fn is_done(&self) -> bool {
        self.first.is_none() && self.next.is_none()
    }

    /// Goes on to the next frame, or a [few](CHUNK) steps towards it; `None` where it is not there yet, or none is left.
    ///
    /// # Errors
    /// [`SimError::Step`] and [`SimError::NotFinite`]: then the run is done, and stays at the end of its last step.
    pub fn advance(&mut self) -> Result<Option<Frame>, SimError> {
        if let Some(first) = self.first.take() {
            self.frames += 1;
            return Ok(Some(first));
        }
        let Some(number) = self.next.take() else {
            return Ok(None);
        };
        let due = self.plan.schedule.due(self.clock(), number);
        let frame = self.towards(&due)?;
        self.next = match &frame {
            None => Some(number),
            Some(_) => (due.steps < self.clock().steps()).then_some(number + 1),
        };
        Ok(frame)
    }

    /// Goes on to the frame at the time `t`, whatever the schedule, or a [few](CHUNK) steps towards it; `None` where it is not there yet.
    ///
    /// Inside a step the frame is one by a shorter step of the method. Times must increase from frame to frame.
    ///
    /// ```
    /// use articulated_fluid::{Scene, scene};
    /// use sim::{Plan, Simulation};
    ///
    /// let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
    /// let mut simulation = Simulation::new(&scene, &Plan { until: 1.0, ..Plan::default() })?;
    /// for t in [0.0, 0.3333, 1.0] {
    ///     let frame = loop {
    ///         if let Some(frame) = simulation.advance_to(t)? {
    ///             break frame;
    ///         }
    ///     };
    ///     assert_eq!(frame.t(), t);
    /// }
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`advance`](Self::advance); [`SimError::Outside`] of a time before the last step, or after the end.
    pub fn advance_to(&mut self, t: f64) -> Result<Option<Frame>, SimError> {
        let (from, to) = (self.state().t, self.clock().until());
        let due = Due::at(self.clock(), t);
        let inside = |dense: &Dense| dense.is_after(due.steps);
        let is_ahead = due.steps >= self.steps() || self.dense.1.as_ref().is_some_and(inside);
        if !(t >= 0.0 && t <= to && is_ahead) {
            return Err(SimError::Outside { t, from, to });
        }
        match self.first.take() {
            Some(first) if t == 0.0 => {
                self.frames += 1;
                Ok(Some(first))
            }
            _ => self.towards(&due),
        }
    }

    /// A frame, or a few steps towards it: by shorter ones where a default step is refused.
    fn towards(&mut self, due: &Due) -> Result<Option<Frame>, SimError> {
        match self.go_to(due) {
            Ok(frame) => {
                self.frames += u64::from(frame.is_some());
                Ok(frame)
            }
            Err(SimError::Step { .. }) if self.may_shorten() => {
                self.shorten();
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// A few steps towards a frame.
    fn go_to(&mut self, due: &Due) -> Result<Option<Frame>, SimError> {
        let stop = due.steps.min(self.steps() + CHUNK);
        while self.steps() < stop {
            self.step()?;
        }
        match stop < due.steps {
            true => Ok(None),
            false => self.frame(due).map(Some),
        }
    }

    /// A step that nobody asked for is not a reason to stop.
    fn may_shorten(&self) -> bool {
        let is_default = matches!(self.plan.choice, Choice::Method { step: None, .. });
        let halvings = self.shortened.map_or(0, |shortened| shortened.halvings);
        is_default && halvings < HALVINGS
    }

    fn shorten(&mut self) {
        let (at, from) = (self.state().t, self.clock().step());
        let first = Shortened {
            at,
            from,
            halvings: 0,
        };
        self.shortened.get_or_insert(first).halvings += 1;
        self.run.halve();
        // Its companions are in step with the run no longer.
        self.estimator = self.estimator.take().map(Estimator::lost);
    }

    /// Takes a step, and watches what it keeps.
    fn step(&mut self) -> Result<(), SimError> {
        let solved = self.drives.step(&self.model, &mut self.run);
        solved.map_err(|error| self.refused(error))?;
        self.watch()
    }

    /// Takes into account what the step has kept.
    fn watch(&mut self) -> Result<(), SimError> {
        let state = self.run.state();
        let (work, xi) = &mut self.watching;
        let kept = Sample::of(&self.model, state, (work, xi));
        let mut sample = kept.map_err(|error| SimError::unmeasured(state.t, error))?;
        sample.work = self.drives.work();
        self.watch.add(&sample);
        if let Some(estimator) = &mut self.estimator {
            estimator.look(self.run.cost().steps, state);
        }
        Ok(())
    }

    fn frame(&mut self, due: &Due) -> Result<Frame, SimError> {
        if self.dense.0 && due.ahead != 0.0 {
            let state = self.inside(due)?;
            return Frame::new(&self.model, state)
                .map_err(|error| SimError::unmeasured(due.t, error));
        }
        let seen = self.drives.look(&self.model, &mut self.run, due);
        let (state, drives) = seen.map_err(|error| self.refused(error))?;
        let frame = Frame::new(&self.model, state);
        let mut frame = frame.map_err(|error| SimError::unmeasured(due.t, error))?;
        frame.sample.work = drives.iter().map(|drive| drive.work).sum();
        frame.drives = drives;
        Ok(frame)
    }

    /// The state inside a step, which is taken before.
    fn inside(&mut self, due: &Due) -> Result<State<Configuration>, SimError> {
        let dense = match self
            .dense
            .1
            .take()
            .filter(|dense| dense.is_after(due.steps))
        {
            Some(dense) => dense,
            None => {
                let mut seen = None;
                let see =
                    &mut |path: dvi::Path<Configuration>| seen = Some(Dense::new(due.steps, path));
                let solved = self.run.advance_along(see);
                solved.map_err(|error| self.refused(error))?;
                self.watch()?;
                // Collocation shows each step once.
                seen.ok_or(SimError::Outside {
                    t: due.t,
                    from: self.state().t,
                    to: self.clock().until(),
                })?
            }
        };
        Ok(self.dense.1.insert(dense).at(due.t))
    }

    fn refused(&self, source: StepError) -> SimError {
        SimError::Step {
            step: self.steps(),
            t: self.state().t,
            source,
        }
    }
}

/// Where a default step turned out to be too long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shortened {
    /// s.
    pub(crate) at: f64,
    /// The step until then, s.
    pub(crate) from: f64,
    /// Since then.
    pub(crate) halvings: u32,
}

impl Iterator for Simulation {
    type Item = Result<Frame, SimError>;

    /// The next frame, however many steps away.
    fn next(&mut self) -> Option<Self::Item> {
        while !self.is_done() {
            if let Some(frame) = self.advance().transpose() {
                return Some(frame);
            }
        }
        None
    }
}

impl core::iter::FusedIterator for Simulation {}
