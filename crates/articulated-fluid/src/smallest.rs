//! The smallest model that describes a scene exactly, and the integrators that step it.

use dvi::{Integrator, State};
use lie::{R3, Vec3};

use crate::account::{Account, Found};
use crate::error::ModelError;
use crate::planar::{PlanarBody, PlanarConfiguration, Plane};
use crate::scene::{Scene, StartVelocity};
use crate::tree::{ArticulatedBody, Configuration};
use crate::views::{Comoving, Rerooted, Viewed};

/// An integrator chosen at run time.
type Boxed<G> = Box<dyn Integrator<Group = G> + Send>;

/// The smallest exact model of a scene, its start, the views that lead there, and the reasons for them.
#[derive(Clone, Debug)]
pub struct Smallest {
    /// The model in space: of the tree on its heaviest body, in a frame that moves with the mass centre where that is exact.
    pub model: ArticulatedBody,
    /// Where it starts, in its own coordinates.
    pub start: State<Configuration>,
    /// The plane that the motion stays in, if any.
    pub plane: Option<Plane>,
    /// What was left out, what was not, and why.
    pub account: Account,
    /// With the scene's own start, and the start that it is.
    root: Option<(Rerooted, [State<Configuration>; 2])>,
    /// With the start that has the drift.
    drift: Option<(Comoving, State<Configuration>)>,
}

impl Smallest {
    /// The integrator of the scene's own states that steps this model, by one for the model in space or for the one in the plane.
    ///
    /// Where the scene needs no view, it is the one for the model in space itself.
    ///
    /// ```
    /// use articulated_fluid::{Scene, scene};
    /// use dvi::{Gauss, Integrator};
    ///
    /// let scene = Scene::parse(scene::EXAMPLE, "example.toml")?;
    /// let mut integrator = scene.smallest()?.integrator(
    ///     |model| Box::new(Gauss::new::<4>(model)),
    ///     |model| Box::new(Gauss::new::<4>(model)),
    /// );
    /// integrator.step(&mut scene.initial_state()?, 0.05)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn integrator(
        &self,
        in_space: impl FnOnce(ArticulatedBody) -> Boxed<Configuration>,
        in_plane: impl FnOnce(PlanarBody) -> Boxed<PlanarConfiguration>,
    ) -> Boxed<Configuration> {
        let mut integrator: Boxed<Configuration> = match &self.plane {
            None => in_space(self.model.clone()),
            Some(plane) => Box::new(Viewed::new(plane.clone(), in_plane(plane.model()))),
        };
        if let Some((view, drifting)) = &self.drift {
            let viewed = Viewed::new(view.clone(), integrator);
            integrator = Box::new(viewed.starting(drifting, &self.start));
        }
        if let Some((view, [own, rooted])) = &self.root {
            let viewed = Viewed::new(view.clone(), integrator);
            integrator = Box::new(viewed.starting(own, rooted));
        }
        integrator
    }
}

impl Scene {
    /// The smallest model that describes this scene exactly.
    ///
    /// Each reduction restricts, eliminates or changes coordinates, and the motion is the same. Only what is exactly nothing is left
    /// out: a part that is merely small is not, and the account says how large it is.
    ///
    /// ```
    /// use articulated_fluid::Scene;
    ///
    /// let text = "
    ///     [fluid]
    ///     density = 0
    ///     [start]
    ///     velocity = [7600, 0, 0]
    ///     [[body]]
    ///     name = 'stone'
    ///     semi_axes = [3, 2, 1]
    ///     mass = 5
    ///     angular_velocity = [1, 2, 0]
    /// ";
    /// let smallest = Scene::parse(text, "stone.toml")?.smallest()?;
    /// assert_eq!(smallest.start.mu.1[0].0, [0.0; 3]);
    /// let taken: Vec<_> = smallest.account.taken().collect();
    /// assert_eq!(taken, ["translation", "joints", "weight", "drift"]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Scene::initial_state`].
    pub fn smallest(&self) -> Result<Smallest, ModelError> {
        let (mut model, own) = (self.model()?, self.initial_state()?);
        let mut start = own.clone();
        let root = Rerooted::new(&model);
        if let Some(view) = &root {
            model = view.model();
            start = self.start(&model, Some(view), self.velocity)?;
        }
        let rooted = start.clone();
        let drift = Comoving::new(&model).filter(|_| moves(&model, &start));
        if let Some(view) = &drift {
            // Of the velocities alone, so that the drift changes no digit of it.
            let still = match self.velocity {
                StartVelocity::NoMomentum => StartVelocity::NoMomentum,
                _ => StartVelocity::ZeroMomentum,
            };
            start = self.start(&model, root.as_ref(), still)?;
            start.g.1[0] = R3::identity();
            model = view.model();
        }
        let plane = Plane::find(&model, &start);
        let account = self.account(&Found {
            root: root.as_ref(),
            drifts: drift.is_some(),
            model: &model,
            plane: &plane,
        });
        Ok(Smallest {
            model,
            start,
            plane: plane.ok(),
            account,
            root: root.map(|view| (view, [own, rooted.clone()])),
            drift: drift.map(|view| (view, rooted)),
        })
    }
}

/// Whether the mass centre moves, or will.
fn moves(model: &ArticulatedBody, state: &State<Configuration>) -> bool {
    [state.mu.1[0].vec3(), model.net_weight()] != [Vec3::zero(); 2]
}
