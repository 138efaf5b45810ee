//! The search for the plane of a motion: the coordinate planes, and what violates them.

use dvi::{Context, ContinuousSystem, State};
use lie::{LieGroup, Mat3, SO3, Vec3, VectorSpace};

use super::error::{NotPlanar, NotPlanarCause};
use super::frame::{nearest_axis, off_axis};
use crate::loads::{Spring, Springs, Weight};
use crate::node::Node;
use crate::tree::{ArticulatedBody, Configuration, Momentum, Velocity};

/// How large a body is.
#[derive(Clone, Copy)]
struct Sizes {
    /// The radius of gyration, m.
    gyration: f64,
    /// The longest lever or that radius, m.
    extent: f64,
}

/// How far a quantity is from what a plane asks of it, relative to the size of its kind.
#[derive(Clone, Copy)]
struct Violation {
    what: NotPlanarCause,
    body: usize,
    defect: f64,
}

/// Of the coordinate axes, the one with the fewest violations, and of those with the smallest.
///
/// By the number first: a normal that distributes one violation over all quantities would hide its cause.
pub(super) fn normal(
    model: &ArticulatedBody,
    state: &State<Configuration>,
) -> Result<Vec3, NotPlanar> {
    if !model.has_views() {
        return Err(NotPlanar {
            what: NotPlanarCause::Joint,
            ..not_a_state()
        });
    }
    let motion = Motion::new(model, state)?;
    let [x, y, z] = Mat3::identity().0.map(Vec3);
    let judged = [z, y, x].into_iter().map(|n| (n, motion.judge(n)));
    let better = |a: &(usize, Violation), b: &(usize, Violation)| {
        (a.0, a.1.defect).partial_cmp(&(b.0, b.1.defect))
    };
    let best = judged.reduce(|a, b| {
        let replaces = better(&b.1, &a.1).is_some_and(|order| order.is_lt());
        if replaces { b } else { a }
    });
    match best {
        Some((normal, (0, _))) => Ok(normal),
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
struct Motion<'a> {
    model: &'a ArticulatedBody,
    state: &'a State<Configuration>,
    xi: Velocity,
    tau: Momentum,
    sizes: Vec<Sizes>,
    /// The largest velocity, of the first body or of a joint or a part of a body about its mass centre, m/s.
    speed: f64,
    /// The largest angular rate, rad/s.
    rate: f64,
}

impl<'a> Motion<'a> {
    fn new(model: &'a ArticulatedBody, state: &'a State<Configuration>) -> Result<Self, NotPlanar> {
        let State { t, g, mu } = state;
        if !(model.has_shape_of(g) && model.has_shape_of(mu)) {
            return Err(not_a_state());
        }
        let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
        let (at, mut work) = (Context::new(*t, &[]), Default::default());
        model.velocity_and_force::<f64>(at, g, mu, &mut work, &mut xi, &mut tau);
        let magnitude = xi.max_magnitude() + tau.max_magnitude() + mu.max_magnitude();
        if !(g.is_finite() && magnitude.is_finite()) {
            return Err(not_a_state());
        }
        let sizes = sizes(model);
        let extents = || sizes.iter().map(|size| size.extent);
        let rates = || xi.0.iter().map(|omega| omega.vec3().norm());
        let speeds = rates().zip(extents()).map(|(rate, extent)| rate * extent);
        let speed = speeds.fold(xi.1[0].vec3().norm(), f64::max);
        let rate = rates().fold(0.0, f64::max);
        Ok(Self {
            model,
            state,
            xi,
            tau,
            sizes,
            speed,
            rate,
        })
    }

    fn attitude(&self, i: usize) -> &SO3 {
        &self.state.g.0[i]
    }

    fn rate(&self, i: usize) -> Vec3 {
        self.xi.0[i].vec3()
    }

    /// The size of body `i` with a joint at `x`, m.
    fn reach(&self, i: usize, x: Vec3) -> f64 {
        x.norm().max(self.sizes[i].gyration)
    }

    fn springs(&self) -> impl Iterator<Item = &Spring> {
        self.model.loads.springs.iter().flat_map(Springs::iter)
    }

    /// How many quantities violate the plane with this normal, and the worst of all.
    fn judge(&self, n: Vec3) -> (usize, Violation) {
        let none = Violation {
            what: NotPlanarCause::State,
            body: 0,
            defect: 0.0,
        };
        self.violations(n).fold((0, none), |(count, worst), one| {
            let violated = usize::from(one.defect != 0.0);
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
            defect: ratio(n.dot(self.xi.1[0].vec3()), self.speed),
        };
        let weight = Violation {
            what: NotPlanarCause::GravityOffPlane,
            body: 0,
            defect: self.gravity_off_plane(n),
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
        let (axis, on) = (self.axis(i, n), self.axis(node.parent, n));
        let coupling = |a: Mat3| ratio(off_axis(a * axis, axis), a.frobenius());
        let spin = off_axis(self.rate(i), axis);
        let violation = |what, body, defect| Violation { what, body, defect };
        use NotPlanarCause::*;
        let joint = |body, axis: Vec3, x: Vec3| {
            let defect = ratio(axis.dot(x), self.reach(body, x));
            violation(JointOffPlane, body, defect)
        };
        [
            violation(AttitudeOffPlane, i, self.attitude_off_plane(i, n)),
            violation(MassCoupling, i, coupling(self.model.masses[i])),
            violation(InertiaCoupling, i, coupling(node.j)),
            joint(i, axis, node.at_self),
            joint(node.parent, on, node.at_parent),
            violation(SpinOffPlane, i, ratio(spin, self.rate)),
        ]
        .into_iter()
    }

    /// The coordinate axis of body `i` that is nearest to the normal.
    fn axis(&self, i: usize, n: Vec3) -> Vec3 {
        nearest_axis(self.attitude(i).inverse_rotate(n))
    }

    /// How far that axis is from the normal, and the normal from it.
    fn attitude_off_plane(&self, i: usize, n: Vec3) -> f64 {
        let (r, axis) = (self.attitude(i), self.axis(i, n));
        off_axis(r.inverse_rotate(n), axis).max(off_axis(r.rotate(axis), n))
    }

    /// The part of gravity along the normal, where it acts.
    fn gravity_off_plane(&self, n: Vec3) -> f64 {
        let acts = |weight: &&Weight| !weight.is_balanced();
        let gravity = self
            .model
            .loads
            .weight
            .as_ref()
            .filter(acts)
            .map(Weight::gravity);
        gravity.map_or(0.0, |gravity| ratio(n.dot(gravity), gravity.norm()))
    }

    /// How far apart the normals in the frames of both bodies are, which the joint aligns at rest.
    fn spring_off_plane(&self, spring: &Spring, n: Vec3) -> f64 {
        let parent = spring.parent.unwrap_or(spring.child);
        (self.axis(spring.child, n) - self.axis(parent, n)).norm()
    }

    /// The largest part of a $\dot p_i$ perpendicular to the normal, N m.
    fn torque(&self, n: Vec3) -> f64 {
        let transport = Configuration::coadjoint_bracket(&self.xi, &self.state.mu);
        let rates = transport.0.iter().zip(self.tau.0.iter()).enumerate();
        let off = rates.map(|(i, (transport, tau))| {
            let normal = self.attitude(i).inverse_rotate(n);
            (transport.vec3() + tau.vec3()).cross(normal).norm()
        });
        off.fold(0.0, f64::max)
    }
}

/// How large each body is.
fn sizes(model: &ArticulatedBody) -> Vec<Sizes> {
    let bodies = model.nodes.iter().zip(&model.masses);
    let size = |(node, mass): (&Node, &Mat3)| {
        let gyration = (node.j.trace() / mass.trace()).sqrt();
        let extent = gyration;
        Sizes { gyration, extent }
    };
    let mut sizes: Vec<Sizes> = bodies.map(size).collect();
    for (i, node) in model.nodes.iter().enumerate().skip(1) {
        for (body, x) in [(node.parent, node.at_parent), (i, node.at_self)] {
            sizes[body].extent = sizes[body].extent.max(x.norm());
        }
    }
    sizes
}

/// The size of a part relative to a whole: zero of nothing alone.
fn ratio(part: f64, whole: f64) -> f64 {
    if part == 0.0 {
        return 0.0;
    }
    (part.abs() / whole).max(f64::MIN_POSITIVE)
}
