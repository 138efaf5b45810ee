//! The plane of a motion: states in space to states in the plane, and back.

use dvi::State;
use lie::{Cotangent, LieGroup, Power, Rn, SO2, SO3, Vec3, VectorSpace};

use super::error::NotPlanar;
use super::find;
use super::frame::{Frame, nearest_axis, off_axis};
use super::loads::{Loads, Spring, Springs, Weight};
use super::tree::{Node, PlanarBody, PlanarConfiguration};
use super::vector::Vec2;
use crate::loads;
use crate::tree::{ArticulatedBody, Configuration};
use crate::views::View;

/// The mirror plane of a model and its motion, with the model in it.
///
/// $W = [e_1\ e_2\ n]$ is the frame of the plane in space, $N_i = [u_i\ v_i\ n_i]$ in that of body $i$: the attitude in space is
/// $R_i = W \operatorname{rot}(\theta_i) N_i^T$, with $\operatorname{rot}(\theta)$ about the third axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    model: PlanarBody,
    /// $W$.
    world: Frame,
    /// $N_i$.
    bodies: Vec<Frame>,
    /// $n \cdot x$, m.
    offset: f64,
}

impl Plane {
    /// The plane that is a mirror of the model and of the motion from this state, exactly.
    ///
    /// The normal is a coordinate axis in the reference frame and in that of each body, and a principal direction of each mass and
    /// inertia. The joints, the velocity and the gravity lie in the plane, and the bodies spin about the normal. That has one direction
    /// in the frames of both bodies of an elastic joint. Every number that would lead out of the plane is zero: a plane in a tilted
    /// frame, of which rounding leaves some, is not found.
    ///
    /// # Errors
    /// [`NotPlanar`], with what violates the best plane, and by how much.
    pub fn find(model: &ArticulatedBody, state: &State<Configuration>) -> Result<Self, NotPlanar> {
        let world = Frame::with_normal(find::normal(model, state)?);
        let body =
            |i: usize| Frame::with_normal(nearest_axis(state.g.0[i].inverse_rotate(world.normal)));
        let bodies: Vec<Frame> = (0..model.nodes.len()).map(body).collect();
        let mut plane = Self {
            model: PlanarBody {
                nodes: nodes(model, &bodies),
                loads: Loads::default(),
            },
            world,
            bodies,
            offset: world.normal.dot(state.g.1[0].vec3()),
        };
        plane.model.loads.weight = plane.weight(model);
        plane.model.loads.springs = plane.springs(model);
        Ok(plane)
    }

    /// The model in the plane.
    pub fn model(&self) -> PlanarBody {
        self.model.clone()
    }

    /// The plane's normal, in the reference frame.
    pub fn normal(&self) -> Vec3 {
        self.world.normal
    }

    /// The state in the plane; of a state that is [not of the plane](Self::contains), the nearest.
    pub fn project(&self, state: &State<Configuration>) -> State<PlanarConfiguration> {
        let (mut planar, State { t, g, mu }) = (self.origin(), state);
        planar.t = *t;
        planar.g.1[0].0 = self.world.project(g.1[0].vec3()).0;
        planar.mu.1[0].0 = self.world.project(mu.1[0].vec3()).0;
        for (i, body) in self.bodies.iter().enumerate() {
            planar.g.0[i] = self.world.angle_of(&g.0[i], body);
            planar.mu.0[i][0] = body.normal.dot(mu.0[i].vec3());
        }
        planar
    }

    /// The state in space.
    pub fn lift(&self, planar: &State<PlanarConfiguration>) -> State<Configuration> {
        let n = self.bodies.len();
        let g: Configuration = (
            Power::new(vec![SO3::identity(); n]),
            Power::new(vec![Rn::identity()]),
            Power::new(vec![]),
        );
        let mu = g.zero_dual();
        let mut state = State { t: planar.t, g, mu };
        self.lift_into(planar, &mut state);
        state
    }

    /// [`lift`](Self::lift) into a state of the same number of bodies.
    pub fn lift_into(&self, planar: &State<PlanarConfiguration>, state: &mut State<Configuration>) {
        let State { t, g, mu } = planar;
        state.t = *t;
        let x = self.world.lift(Vec2(g.1[0].0)) + self.world.normal * self.offset;
        state.g.1[0] = x.into();
        state.mu.1[0] = self.world.lift(Vec2(mu.1[0].0)).into();
        for (i, body) in self.bodies.iter().enumerate() {
            state.g.0[i] = self.world.attitude(&g.0[i], body);
            state.mu.0[i] = (body.normal * mu.0[i][0]).into();
        }
    }

    /// Whether a state is one of this plane, exactly: of as many bodies, and with no part out of the plane.
    pub fn contains(&self, state: &State<Configuration>) -> bool {
        let ((r, x, q), (p, px, _)) = (&state.g, &state.mu);
        let normal = self.world.normal;
        let n = self.bodies.len();
        if [r.len(), x.len(), p.len(), px.len(), q.len()] != [n, 1, n, 1, 0] {
            return false;
        }
        let keeps = |(body, r): (&Frame, &SO3)| {
            let (there, back) = (r.rotate(body.normal), r.inverse_rotate(normal));
            let off = off_axis(there, normal).max(off_axis(back, body.normal));
            off == 0.0 && there.dot(normal) > 0.0
        };
        let spins = |(body, p): (&Frame, &Cotangent<3>)| off_axis(p.vec3(), body.normal) == 0.0;
        let finite = state.g.is_finite() && state.mu.max_magnitude().is_finite();
        let mut bodies = self.bodies.iter().zip(r.iter());
        let mut momenta = self.bodies.iter().zip(p.iter());
        finite
            && normal.dot(x[0].vec3()) == self.offset
            && normal.dot(px[0].vec3()) == 0.0
            && bodies.all(keeps)
            && momenta.all(spins)
    }

    /// All angles zero, at rest at the origin.
    fn origin(&self) -> State<PlanarConfiguration> {
        let g: PlanarConfiguration = (
            Power::new(vec![SO2::identity(); self.bodies.len()]),
            Power::new(vec![Rn::identity()]),
        );
        let mu = g.zero_dual();
        State { t: 0.0, g, mu }
    }

    /// $a_i$ and $b_i$ from the torques at the angles $\pi/2$ and 0.
    fn weight(&self, model: &ArticulatedBody) -> Option<Weight> {
        let weight = model.loads.weight.as_ref()?;
        let torque = |i: usize, angle: SO2| {
            let (body, n) = (&self.bodies[i], self.bodies[i].normal);
            n.dot(weight.torque(i, &self.world.attitude(&angle, body)))
        };
        let (across, along) = (SO2::from_cos_sin_unchecked(0.0, 1.0), SO2::identity());
        let lever = |i: usize| Vec2([-torque(i, across), torque(i, along)]);
        Some(Weight {
            total: self.world.project(weight.force()),
            levers: (0..self.bodies.len()).map(lever).collect(),
        })
    }

    /// $\alpha_i$ is the angle of $N_p^T N_i$.
    fn springs(&self, model: &ArticulatedBody) -> Option<Springs> {
        let elastic = model.loads.springs.as_ref()?.iter();
        let spring = |spring: &loads::Spring| {
            let (parent, child) = (spring.parent?, spring.child);
            Some(Spring {
                parent,
                child,
                stiffness: spring.stiffness,
                rest: self.bodies[parent].angle_of(&SO3::identity(), &self.bodies[child]),
            })
        };
        Some(Springs(elastic.filter_map(spring).collect()))
    }
}

impl View for Plane {
    type Inner = PlanarConfiguration;
    type Frame = ();

    fn enter(&self, outer: &State<Configuration>) -> Option<((), State<PlanarConfiguration>)> {
        self.contains(outer).then(|| ((), self.project(outer)))
    }

    fn leave(&self, (): &(), inner: &State<PlanarConfiguration>, outer: &mut State<Configuration>) {
        self.lift_into(inner, outer);
    }
}

/// The bodies in their frames' planes.
fn nodes(model: &ArticulatedBody, frames: &[Frame]) -> Vec<Node> {
    let bodies = model.nodes.iter().zip(&model.masses).zip(frames);
    let planar = bodies.map(|((node, mass), frame)| {
        let on = &frames[node.parent];
        let j = frame.normal.dot(node.j * frame.normal);
        let points = [
            on.project(node.at_parent),
            frame.project(node.at_self),
            on.project(node.lever),
        ];
        Node::new(node.parent, frame.block(*mass), j, points)
    });
    planar.collect()
}
