//! The bodies' motion by an adaptive method.

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{State, System};
use lie::lanes::{self, Job};
use lie::{Batch, LieGroup, VectorSpace};

use super::stages::RightHandSide;
use super::{BaselineError, Pair, Tolerance, Trajectory, Work, raw};

/// The motion of a model by an embedded pair on the entries of the rotation matrices, which nothing keeps orthogonal.
///
/// The right-hand side is inlined for the fastest instructions of this processor, as the variational methods' is, so that the two
/// are compared fairly.
///
/// ```
/// use articulated_fluid::Scene;
/// use study::baseline::{Motion, Pair, Tolerance};
///
/// let scene = Scene::parse(include_str!("../../../../scenes/fish-chain.toml"), "fish-chain.toml")?;
/// let (model, start) = (scene.model()?, scene.initial_state()?);
/// let mut motion = Motion::new(&Pair::DP853, &model, &start, 1.0, Tolerance::uniform(1e-10))?;
/// assert_eq!(motion.at(1.0)?.t, 1.0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct Motion {
    trajectory: Box<dyn Solution + Send>,
    state: State<Configuration>,
}

impl Motion {
    /// The motion from `start` to the time `until`, s.
    ///
    /// # Errors
    /// [`BaselineError`] for a tolerance, an end or a start out of range.
    pub fn new(
        pair: &'static Pair,
        model: &ArticulatedBody,
        start: &State<Configuration>,
        until: f64,
        tolerance: Tolerance,
    ) -> Result<Self, BaselineError> {
        if !(model.fits(&start.g) && start.mu.same_shape(&start.g.zero_dual())) {
            return Err(BaselineError::Misfit);
        }
        let trajectory = lanes::run_single(Begin {
            pair,
            model,
            start,
            until,
            tolerance,
        })?;
        let state = start.clone();
        Ok(Self { trajectory, state })
    }

    /// The state at a time, s, that is not before the start of the last step taken, nor after the end.
    ///
    /// # Errors
    /// [`BaselineError`].
    pub fn at(&mut self, t: f64) -> Result<&State<Configuration>, BaselineError> {
        let y = self.trajectory.at(t)?;
        raw::read(y, &mut self.state.g, &mut self.state.mu);
        self.state.t = t;
        Ok(&self.state)
    }

    /// The cost so far.
    pub fn work(&self) -> Work {
        self.trajectory.work()
    }
}

/// A trajectory by any instructions.
trait Solution {
    fn at(&mut self, t: f64) -> Result<&[f64], BaselineError>;
    fn work(&self) -> Work;
}

impl<F: RightHandSide, S: Batch<Item = f64>> Solution for Trajectory<F, S> {
    fn at(&mut self, t: f64) -> Result<&[f64], BaselineError> {
        self.at(t)
    }

    fn work(&self) -> Work {
        self.work()
    }
}

struct Begin<'a> {
    pair: &'static Pair,
    model: &'a ArticulatedBody,
    start: &'a State<Configuration>,
    until: f64,
    tolerance: Tolerance,
}

impl Job for Begin<'_> {
    type Output = Result<Box<dyn Solution + Send>, BaselineError>;

    fn run<S: Batch<Item = f64>>(self) -> Self::Output {
        let mut rates = raw::Rates::<S>::new(self.model, &self.start.g);
        let rhs = move |t: f64, y: &[f64], dy: &mut [f64]| rates.evaluate(t, y, dy);
        let start = (self.start.t, &raw::pack(self.start)[..]);
        let trajectory =
            Trajectory::<_, S>::new(self.pair, rhs, start, self.until, self.tolerance)?;
        Ok(Box::new(trajectory))
    }
}
