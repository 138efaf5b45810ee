//! What drives do: torque and work of joints and places that move as told, and of loads, (S16)–(S17).

use dvi::{Context, ContinuousSystem, Path, State};
use lie::{LieGroup, Vec3};

use crate::lagrangian::Evaluation;
use crate::loads::Scenery;
use crate::loads::on_bodies::{BodyLoad, Twist, Wrench};
use crate::tree::{ArticulatedBody, Configuration};

/// What does work that is no gradient's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveKind {
    /// What moves the joint of a body, or its place, as told; or the torque, the damper and the servo in it.
    Joint {
        /// The body that hangs on it.
        body: usize,
    },
    /// The loads of this [name](crate::BodyLoad::name) on all bodies that have one.
    Loads(&'static str),
}

/// What the drive of a joint, or of the place of the first one, or a load, has done along a motion.
///
/// A drive turns a body at the rate $a$ against its parent, about its joint, with the torque $\lambda$. Its work is
/// $\int \lambda \cdot a\,dt$, and in the reference frame $\lambda = \dot N - T$. $N$ is the angular momentum about the joint of all that
/// moves with the body. $T$ is the torque on that without a drive. A place moves the linear momentum likewise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// What it is.
    pub kind: DriveKind,
    /// $\int \lambda \cdot a\,dt$, with that of a place, J.
    pub work: f64,
    /// $\int \lambda\,dt$, N m s in the reference frame: over a time, it is the mean torque on the body; zero of loads on bodies.
    pub impulse: Vec3,
}

/// What a drive moves the tree by, at a time, in the reference frame.
#[derive(Clone, Copy)]
struct Port {
    /// $a$, or the velocity of a place.
    rate: Vec3,
    /// $N$, or the linear momentum.
    momentum: Vec3,
    /// $T$, or the force on the whole.
    load: Vec3,
}

impl Port {
    fn unused() -> Self {
        let [rate, momentum, load] = [Vec3::zero(); 3];
        Self {
            rate,
            momentum,
            load,
        }
    }

    /// Of forces on bodies, which are known by their power alone.
    fn on_bodies(
        wrenches: impl Iterator<Item = (usize, Wrench<f64>)>,
        twist: impl Fn(usize) -> Twist<f64>,
    ) -> Self {
        let power = wrenches.map(|(i, [force, moment])| {
            let [omega, v] = twist(i);
            force.dot(v) + moment.dot(omega)
        });
        let power: f64 = power.sum();
        Self {
            rate: Vec3([power, 0.0, 0.0]),
            momentum: Vec3::zero(),
            load: Vec3([-1.0, 0.0, 0.0]),
        }
    }
}

/// By a turn, and by a place.
type Ports = [Port; 2];

impl ArticulatedBody {
    /// The drives, which have done nothing: of all joints that move as told or have a load, in the order of the bodies.
    /// Then come the loads on bodies, name by name.
    pub fn drives(&self) -> Vec<Drive> {
        let forces = &self.loads.forces;
        let driven = |body: &usize| {
            forces.in_joint(*body).is_some()
                || self.is_turned(*body)
                || *body == 0 && self.is_carried()
        };
        let bodies = (0..self.nodes.len()).filter(driven);
        let joints = bodies.map(|body| DriveKind::Joint { body });
        let has = |name: &&str| forces.bodies.iter().any(|(_, load)| load.name() == *name);
        let loads = BodyLoad::names().filter(has).map(DriveKind::Loads);
        let idle = |kind| Drive {
            kind,
            work: 0.0,
            impulse: Vec3::zero(),
        };
        joints.chain(loads).map(idle).collect()
    }

    /// Adds what the [drives](Self::drives) do along a path of this tree's states.
    ///
    /// The momenta are those of the polynomial through the states, so that the account is of the order of the path's method.
    pub fn add_drives(&self, path: Path<Configuration>, work: &mut Evaluation, to: &mut [Drive]) {
        let states = path.states().iter();
        let ports: Vec<Vec<Ports>> = states.map(|state| self.ports(state, to, work)).collect();
        let last = ports.len() - 1;
        for (k, drive) in to.iter_mut().enumerate() {
            let work = |way: usize| {
                let at = |i: usize| &ports[i][k][way];
                let gained = path.line_integral(|i, j| at(i).rate.dot(at(j).momentum));
                gained - path.integral(|i| at(i).rate.dot(at(i).load))
            };
            drive.work += work(0) + work(1);
            if !matches!(drive.kind, DriveKind::Joint { .. }) {
                continue;
            }
            let at = |i: usize| &ports[i][k][0];
            let load = |d: usize| path.integral(|i| at(i).load.0[d]);
            drive.impulse += at(last).momentum - at(0).momentum - Vec3([0, 1, 2].map(load));
        }
    }

    fn ports(
        &self,
        State { t, g, mu }: &State<Configuration>,
        drives: &[Drive],
        work: &mut Evaluation,
    ) -> Vec<Ports> {
        let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
        self.velocity_and_force(Context::new(*t, &[]), g, mu, work, &mut xi, &mut tau);
        let Evaluation {
            pose,
            torques,
            elimination,
            on_whole,
            ..
        } = work;
        let (on_whole, elimination) = (*on_whole, &*elimination);
        let (r, pose) = self.pose(*t, g, pose);
        let (momenta, linear) = self.body_momenta((r, pose), &xi);
        let momenta = self.outer_momenta(pose, momenta);
        let at = Scenery { t: *t, g, r };
        let twist = |i: usize| elimination.twist(i);
        let forces = &self.loads.forces;
        let port = |drive: &Drive| match drive.kind {
            DriveKind::Loads(name) => {
                let wrenches = forces.on_bodies(name, *t, twist);
                [Port::on_bodies(wrenches, twist), Port::unused()]
            }
            DriveKind::Joint { body: i } => {
                let turn = match (self.is_turned(i), forces.in_joint(i)) {
                    (true, _) => Port {
                        rate: r[i].rotate(pose.rates[i]),
                        momentum: r[i].rotate(momenta[i]),
                        load: r[i].rotate(torques[i].vec3()),
                    },
                    (false, Some(joint)) => {
                        let load = joint.act(at, &joint.told(*t), twist);
                        Port {
                            rate: r[i].rotate(load.rate),
                            momentum: Vec3::zero(),
                            load: -r[i].rotate(load.torque),
                        }
                    }
                    (false, None) => Port::unused(),
                };
                let place = match i == 0 && self.is_carried() {
                    false => Port::unused(),
                    true => Port {
                        rate: pose.place[1],
                        momentum: linear,
                        load: on_whole,
                    },
                };
                [turn, place]
            }
        };
        drives.iter().map(port).collect()
    }
}
