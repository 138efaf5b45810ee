//! The search for the plane of a motion: normals that it may have, and what violates them.

use dvi::{ContinuousSystem, State};
use lie::{LieGroup, Mat3, SO3, Vec3, VectorSpace};

use super::axes::{longest, normal_to, principal_axes, unit};
use super::plane::first_and_rest;
use super::{NotPlanar, NotPlanarCause};
use crate::elimination::{Momentum, Velocity, of};
use crate::model::Node;
use crate::springs::{Spring, Springs};
use crate::{ArticulatedBody, Configuration, Mass};

/// Violations up to this are those of rounding.
const ROUNDING: f64 = 1e-12;

/// What a rate that is all rounding may be relative to, as part of the rate that the momenta would give.
const ROUNDED_RATE: f64 = 1e-2;

/// A normal that was found.
pub(super) struct Found {
    pub(super) normal: Vec3,
    /// The size of the bodies, m.
    pub(super) length: f64,
}

/// How large a body is.
#[derive(Clone, Copy)]
struct Sizes {
    /// The radius of gyration, m.
    gyration: f64,
    /// The longest lever or that radius, m.
    extent: f64,
    /// The mass of the body and of those on it, relative to its own.
    carried: f64,
}

impl Sizes {
    /// The rate that belongs to the momentum $m v d$ of what the body carries, relative to $v$: $m d / m_i k_i^2$, 1/m.
    fn rate(&self) -> f64 {
        self.carried * (self.extent / self.gyration) / self.gyration
    }
}

/// How far a quantity is from what a plane asks of it, relative to the size of its kind.
#[derive(Clone, Copy)]
struct Violation {
    what: NotPlanarCause,
    body: usize,
    defect: f64,
}

/// Of the normals that suggest themselves, the one with the fewest violations, and of those with the smallest.
///
/// By the number first: a normal that distributes one violation over all quantities would hide its cause.
pub(super) fn normal<M: Mass>(
    model: &ArticulatedBody<M>,
    state: &State<Configuration>,
) -> Result<Found, NotPlanar> {
    let motion = Motion::new(model, state)?;
    let judged = motion
        .candidates()
        .into_iter()
        .map(|n| (n, motion.judge(n)));
    let better = |a: &(usize, Violation), b: &(usize, Violation)| {
        (a.0, a.1.defect).partial_cmp(&(b.0, b.1.defect))
    };
    let best = judged.reduce(|a, b| {
        let replaces = better(&b.1, &a.1).is_some_and(|order| order.is_lt());
        if replaces { b } else { a }
    });
    match best {
        Some((normal, (0, _))) => Ok(Found {
            normal,
            length: motion.length,
        }),
        Some((normal, (_, worst))) => Err(NotPlanar {
            defect: worst.defect,
            what: worst.what,
            body: worst.body,
            torque: motion.torque(normal),
            force: normal.dot(model.net_weight()).abs(),
            normal,
        }),
        None => Err(not_a_state()),
    }
}

fn not_a_state() -> NotPlanar {
    NotPlanar {
        defect: f64::INFINITY,
        what: NotPlanarCause::State,
        body: 0,
        torque: f64::NAN,
        force: f64::NAN,
        normal: Vec3::zero(),
    }
}

/// A model in motion.
struct Motion<'a, M> {
    model: &'a ArticulatedBody<M>,
    state: &'a State<Configuration>,
    xi: Velocity,
    tau: Momentum,
    sizes: Vec<Sizes>,
    /// The longest lever or radius of gyration, m.
    length: f64,
    /// The largest velocity, of the first body or of a joint or a part of a body about its mass centre, m/s.
    speed: f64,
    /// The largest angular rate, rad/s; not less than what rounding of the momenta makes of none.
    rate: f64,
}

impl<'a, M: Mass> Motion<'a, M> {
    fn new(
        model: &'a ArticulatedBody<M>,
        state: &'a State<Configuration>,
    ) -> Result<Self, NotPlanar> {
        let State { t, g, mu } = state;
        if [g.2.len(), mu.2.len()] != [model.nodes.len() - 1; 2] {
            return Err(not_a_state());
        }
        let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
        let mut workspace = ContinuousSystem::workspace::<f64>(model, g);
        model.velocity_and_force::<f64>(*t, g, mu, &mut workspace, &mut xi, &mut tau);
        let magnitude = xi.max_magnitude() + tau.max_magnitude() + mu.max_magnitude();
        if !(g.is_finite() && magnitude.is_finite()) {
            return Err(not_a_state());
        }
        let sizes = sizes(model);
        let extents = || sizes.iter().map(|size| size.extent);
        let length = extents().fold(0.0, f64::max);
        let rates = || first_and_rest(&xi.0, &xi.2).map(|omega| omega.vec3().norm());
        let speeds = rates().zip(extents()).map(|(rate, extent)| rate * extent);
        let speed = speeds.fold(xi.1.vec3().norm(), f64::max);
        let rounding = sizes.iter().map(|size| ROUNDED_RATE * speed * size.rate());
        let rate = rates().chain(rounding).fold(0.0, f64::max);
        Ok(Self {
            model,
            state,
            xi,
            tau,
            sizes,
            length,
            speed,
            rate,
        })
    }

    fn attitude(&self, i: usize) -> &SO3 {
        of((&self.state.g.0, &self.state.g.2), i)
    }

    fn rate(&self, i: usize) -> Vec3 {
        of((&self.xi.0, &self.xi.2), i).vec3()
    }

    /// Unit vectors that may be the normal, in the reference frame: the coordinate axes, the angular velocity of the fastest
    /// body, what is normal to what lies in the plane, the axis of the largest twist, and the principal axes of the first body and
    /// of the whole.
    fn candidates(&self) -> Vec<Vec3> {
        let bodies = 0..self.model.nodes.len();
        let faster = |a: &usize, b: &usize| self.rate(*a).norm().total_cmp(&self.rate(*b).norm());
        let fastest = bodies.max_by(faster).unwrap_or(0);
        let spin = self.attitude(fastest).rotate(self.rate(fastest));
        let first = self.attitude(0).matrix().conjugate(self.model.nodes[0].j);
        let (levers, velocity, gravity) = (self.levers(), self.velocity(), self.gravity());
        let longest = longest(&levers);
        let in_plane = [levers, vec![velocity, gravity]].concat();
        let [x, y, z] = Mat3::identity().0.map(Vec3);
        let mut candidates = vec![z, y, x, spin, normal_to(&in_plane)];
        // These whatever their lengths: a velocity is short next to a fast spin.
        candidates.extend([gravity.cross(velocity), velocity.cross(longest)]);
        candidates.push(longest.cross(gravity));
        candidates.push(self.twist());
        candidates.extend(principal_axes(first));
        candidates.extend(principal_axes(self.shape(&in_plane)));
        candidates.retain(|n| n.is_finite() && n.norm() > 0.0);
        candidates.into_iter().map(unit).collect()
    }

    /// The joints from the mass centres, relative to the size of the body, in the reference frame.
    fn levers(&self) -> Vec<Vec3> {
        let points = self.model.nodes.iter().enumerate().flat_map(|(i, node)| {
            let points = [(node.parent, node.at_parent), (i, node.at_self)];
            points.map(|(body, x)| {
                let lever = self.attitude(body).rotate(x);
                lever * (1.0 / self.reach(body, x))
            })
        });
        points.collect()
    }

    /// The size of body `i` with a joint at `x`, m.
    fn reach(&self, i: usize, x: Vec3) -> f64 {
        x.norm().max(self.sizes[i].gyration)
    }

    /// The first body's, relative to the speed.
    fn velocity(&self) -> Vec3 {
        self.xi.1.vec3() * (1.0 / self.speed.max(f64::MIN_POSITIVE))
    }

    /// Of length 1; zero where it does nothing.
    fn gravity(&self) -> Vec3 {
        let weight = self.model.weight.as_ref();
        let acts = weight.filter(|weight| !weight.is_balanced());
        let gravity = acts.map_or(Vec3::zero(), |weight| weight.gravity());
        gravity * (1.0 / gravity.norm().max(f64::MIN_POSITIVE))
    }

    fn springs(&self) -> impl Iterator<Item = &Spring> {
        self.model.springs.iter().flat_map(Springs::iter)
    }

    /// The largest torque of an elastic joint, in the reference frame.
    fn twist(&self) -> Vec3 {
        let r = (&self.state.g.0, &self.state.g.2[..]);
        let torque = |spring: &Spring| of(r, spring.child).rotate(spring.torque(r));
        longest(&self.springs().map(torque).collect::<Vec<_>>())
    }

    /// A symmetric matrix with the normal as a principal axis, as it is one of each term: masses, inertias, $x x^T$ in the plane.
    fn shape(&self, in_plane: &[Vec3]) -> Mat3 {
        let bodies = self.model.masses.iter().zip(&self.model.nodes).enumerate();
        let bodies = bodies.map(|(i, (mass, node))| {
            let (mass, inertia) = (mass.matrix(), node.j);
            let sum = mass * (1.0 / mass.trace()) + inertia * (1.0 / inertia.trace());
            self.attitude(i).matrix().conjugate(sum)
        });
        let in_plane = in_plane.iter().map(|x| x.outer(*x));
        bodies.chain(in_plane).fold(Mat3::zero(), |sum, a| sum + a)
    }

    /// How many quantities violate the plane with this normal, and the worst of all.
    fn judge(&self, n: Vec3) -> (usize, Violation) {
        let none = Violation {
            what: NotPlanarCause::State,
            body: 0,
            defect: 0.0,
        };
        self.violations(n).fold((0, none), |(count, worst), one| {
            let violated = usize::from(!one.defect.le(&ROUNDING));
            let worst = if one.defect > worst.defect {
                one
            } else {
                worst
            };
            (count + violated, worst)
        })
    }

    fn violations(&self, n: Vec3) -> impl Iterator<Item = Violation> {
        let bodies = 0..self.model.nodes.len();
        let of_bodies = bodies.flat_map(move |i| self.violations_of(i, n));
        let velocity = Violation {
            what: NotPlanarCause::VelocityOffPlane,
            body: 0,
            defect: ratio(n.dot(self.xi.1.vec3()), self.speed),
        };
        let force = self
            .model
            .weight
            .as_ref()
            .map_or(Vec3::zero(), |w| w.force());
        let weight = Violation {
            what: NotPlanarCause::GravityOffPlane,
            body: 0,
            defect: ratio(n.dot(force), force.norm()),
        };
        let springs = self.springs().map(move |spring| Violation {
            what: NotPlanarCause::SpringOffPlane,
            body: spring.child,
            defect: self.spring_off_plane(spring, n),
        });
        of_bodies.chain([velocity, weight]).chain(springs)
    }

    fn violations_of(&self, i: usize, n: Vec3) -> impl Iterator<Item = Violation> {
        let node = &self.model.nodes[i];
        let (normal, on) = (
            self.attitude(i).inverse_rotate(n),
            self.attitude(node.parent).inverse_rotate(n),
        );
        let coupling = |a: Mat3| ratio(normal.cross(a * normal).norm(), a.frobenius());
        let spin = self.rate(i).cross(normal).norm();
        let violation = |what, body, defect| Violation { what, body, defect };
        use NotPlanarCause::*;
        let joint = |body, normal: Vec3, x: Vec3| {
            let defect = ratio(normal.dot(x), self.reach(body, x));
            violation(JointOffPlane, body, defect)
        };
        [
            violation(MassCoupling, i, coupling(self.model.masses[i].matrix())),
            violation(InertiaCoupling, i, coupling(node.j)),
            joint(i, normal, node.at_self),
            joint(node.parent, on, node.at_parent),
            violation(SpinOffPlane, i, ratio(spin, self.rate)),
            violation(GravityOffPlane, 0, self.gravity_off_plane(i, n)),
        ]
        .into_iter()
    }

    /// What gravity along the normal adds to the torque on body `i`, relative to the torque's size at any angle.
    ///
    /// Half a turn about the normal reverses the torque but for that.
    fn gravity_off_plane(&self, i: usize, n: Vec3) -> f64 {
        let Some(weight) = &self.model.weight else {
            return 0.0;
        };
        let r = self.attitude(i);
        let normal = r.inverse_rotate(n);
        let turned = |angle: f64| SO3::exp(&(n * angle).into()).compose(r);
        let [start, quarter, half] =
            [0.0, 0.5, 1.0].map(|turns| weight.torque(i, &turned(turns * core::f64::consts::PI)));
        let off = 0.5 * (start + half).norm();
        let in_plane = normal.dot(start).hypot(normal.dot(quarter));
        ratio(off, in_plane.hypot(off))
    }

    /// How far apart the normals in the frames of both bodies are, which the joint aligns at rest.
    fn spring_off_plane(&self, spring: &Spring, n: Vec3) -> f64 {
        let [on, normal] =
            [spring.parent, spring.child].map(|body| self.attitude(body).inverse_rotate(n));
        (normal - on).norm()
    }

    /// The largest part of a $\dot p_i$ perpendicular to the normal, N m.
    fn torque(&self, n: Vec3) -> f64 {
        let transport = Configuration::coadjoint_bracket(&self.xi, &self.state.mu);
        let rates = first_and_rest(&transport.0, &transport.2)
            .zip(first_and_rest(&self.tau.0, &self.tau.2))
            .enumerate();
        let off = rates.map(|(i, (transport, tau))| {
            let normal = self.attitude(i).inverse_rotate(n);
            (transport.vec3() + tau.vec3()).cross(normal).norm()
        });
        off.fold(0.0, f64::max)
    }
}

/// How large each body is.
fn sizes<M: Mass>(model: &ArticulatedBody<M>) -> Vec<Sizes> {
    let masses: Vec<f64> = model.masses.iter().map(|m| m.matrix().trace()).collect();
    let bodies = model.nodes.iter().zip(&masses);
    let size = |(node, mass): (&Node, &f64)| {
        let gyration = (node.j.trace() / mass).sqrt();
        Sizes {
            gyration,
            extent: gyration,
            carried: 1.0,
        }
    };
    let mut sizes: Vec<Sizes> = bodies.map(size).collect();
    for (i, node) in model.nodes.iter().enumerate().skip(1).rev() {
        sizes[node.parent].carried += sizes[i].carried * (masses[i] / masses[node.parent]);
        for (body, x) in [(node.parent, node.at_parent), (i, node.at_self)] {
            sizes[body].extent = sizes[body].extent.max(x.norm());
        }
    }
    sizes
}

/// The size of a part relative to a whole; none of nothing.
fn ratio(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part.abs() / whole }
}
