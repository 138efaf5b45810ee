//! Where the bodies are and how they move: what viewers, tables and monitors read.

use lie::{LieGroup, Power, SO3, Scalar, Sym3, Vec3};
use smallvec::SmallVec;

use crate::error::ModelError;
use crate::joints::Any;
use crate::node::Node;
use crate::pose::Pose;
use crate::tree::{ArticulatedBody, Configuration, Momentum, Velocity};

/// Bodies whose quantities fit on the stack.
const FEW: usize = 8;

/// A quantity of each body.
pub(crate) type PerBody<T> = SmallVec<[T; FEW]>;

/// Where the bodies of a state are and how they move, in the order of the model.
#[derive(Clone, Debug, PartialEq)]
pub struct Kinematics {
    /// From body to reference frame.
    pub attitudes: Vec<SO3>,
    /// Angular velocities, rad/s, each in its body's frame.
    pub rates: Vec<Vec3>,
    /// Mass centres, m, reference frame.
    pub centres: Vec<Vec3>,
    /// The velocity of the first body's mass centre, m/s, reference frame.
    pub velocity: Vec3,
    /// The angular momentum about the base, kg m²/s, reference frame: the first body's mass centre, or its joint to the world.
    pub spin: Vec3,
    /// Where that is, m, reference frame.
    pub base: Vec3,
}

impl ArticulatedBody {
    /// Where the bodies are and how they move, at a time, a configuration and a velocity.
    ///
    /// # Errors
    /// As [`attitudes`](Self::attitudes).
    pub fn kinematics(
        &self,
        t: f64,
        g: &Configuration,
        xi: &Velocity,
    ) -> Result<Kinematics, ModelError> {
        let centres = self.centre_positions(t, g)?;
        let mut pose = Pose::default();
        let (r, pose) = self.pose(t, g, &mut pose);
        let (rates, velocities) = self.body_velocities((r, pose), xi);
        let (p, _) = self.body_momenta((r, pose), xi);
        let spins = r.iter().zip(&p).map(|(r, p)| r.rotate(*p));
        Ok(Kinematics {
            attitudes: r.to_vec(),
            rates: rates.to_vec(),
            centres,
            velocity: r[0].rotate(velocities[0]),
            spin: spins.fold(Vec3::zero(), |sum, spin| sum + spin),
            base: self.base_position(pose, g),
        })
    }

    /// The attitudes of all bodies at the time of a state, body to reference frame.
    ///
    /// # Errors
    /// [`ModelError::Shape`] where the state is not one of this model.
    pub fn attitudes(&self, t: f64, g: &Configuration) -> Result<Vec<SO3>, ModelError> {
        self.check(g)?;
        Ok(self.pose(t, g, &mut Pose::default()).0.to_vec())
    }

    /// Where the mass centres are, in the reference frame: $x$, then $x_p + R_p d_{pi} - R_i d_{ip}$, m.
    ///
    /// # Errors
    /// As [`attitudes`](Self::attitudes).
    pub fn centre_positions(&self, t: f64, g: &Configuration) -> Result<Vec<Vec3>, ModelError> {
        self.check(g)?;
        let mut pose = Pose::default();
        let (r, pose) = self.pose(t, g, &mut pose);
        let on = self.base_position(pose, g);
        let mut centres: Vec<Vec3> = Vec::with_capacity(r.len());
        for (i, node) in self.nodes.iter().enumerate() {
            let joint = match i {
                0 => on,
                _ => centres[node.parent] + r[node.parent].rotate(node.at_parent),
            };
            centres.push(joint - r[i].rotate(node.at_self));
        }
        Ok(centres)
    }

    /// Where the joints are, in the reference frame: $x_p + R_p d_{pi}$, m, in the order of the bodies that hang on them.
    ///
    /// # Errors
    /// As [`attitudes`](Self::attitudes).
    pub fn joint_positions(&self, t: f64, g: &Configuration) -> Result<Vec<Vec3>, ModelError> {
        let (centres, r) = (self.centre_positions(t, g)?, self.attitudes(t, g)?);
        let tails = self.nodes.iter().skip(1);
        let position = |node: &Node| centres[node.parent] + r[node.parent].rotate(node.at_parent);
        Ok(tails.map(position).collect())
    }

    /// The largest $\lVert I - R_i^T R_i \rVert_F$ of the attitudes that are unknowns.
    pub fn orthogonality_error(&self, g: &Configuration) -> f64 {
        g.0.iter().map(SO3::orthogonality_error).fold(0.0, f64::max)
    }

    pub(crate) fn check(&self, g: &Configuration) -> Result<(), ModelError> {
        match self.has_shape_of(g) {
            true => Ok(()),
            false => Err(self.shape_error(g)),
        }
    }

    /// The error that a configuration or a momentum has another number of unknowns.
    pub(crate) fn shape_error<R, X, Q>(
        &self,
        (r, x, q): &(Power<R>, Power<X>, Power<Q>),
    ) -> ModelError {
        ModelError::Shape {
            expected: [
                self.joints.roots.len(),
                usize::from(self.is_free()),
                self.joints.hinges.len(),
            ],
            found: [r.len(), x.len(), q.len()],
        }
    }

    /// The position of the first body's mass centre, or of its joint where it is held, m.
    #[inline(always)]
    pub(crate) fn base_position<S: Scalar>(&self, pose: &Pose<S>, g: &Configuration<S>) -> Vec3<S> {
        match self.is_free() {
            true => g.1[0].vec3(),
            false => pose.place[0],
        }
    }

    /// The potential of all loads, J.
    pub(crate) fn potential<S: Scalar>(
        &self,
        (r, pose): (&[SO3<S>], &Pose<S>),
        g: &Configuration<S>,
    ) -> S {
        let x = self.base_position(pose, g);
        self.loads.potential(r, x) + self.loads.potential_of_hinges(&g.2)
    }

    /// The rates $\Omega_i$, (S1), and the velocities $V_i$ of the mass centres, (16), each in its body's frame:
    /// $V_i = C_i^T (V_p + \Omega_p \times d_{pi}) + d_{ip} \times \Omega_i$.
    pub(crate) fn body_velocities<S: Scalar>(
        &self,
        (r, pose): (&[SO3<S>], &Pose<S>),
        xi: &Velocity<S>,
    ) -> (PerBody<Vec3<S>>, PerBody<Vec3<S>>) {
        let bodies = self.nodes.len();
        let mut rates: PerBody<Vec3<S>> = SmallVec::with_capacity(bodies);
        let mut velocities: PerBody<Vec3<S>> = SmallVec::with_capacity(bodies);
        for (i, node) in self.nodes.iter().enumerate() {
            let rate = self.rate(i, xi, pose, || match i {
                0 => Vec3::zero(),
                _ => pose.c[i].inverse_rotate(rates[node.parent]),
            });
            let own = node.at_self.lift::<S>().cross(rate);
            let on = match i {
                0 if self.is_free() => xi.1[0].vec3(),
                0 => pose.place[1],
                _ => {
                    let swept = rates[node.parent].cross(node.at_parent.lift());
                    r[node.parent].rotate(velocities[node.parent] + swept)
                }
            };
            velocities.push(r[i].inverse_rotate(on) + own);
            rates.push(rate);
        }
        (rates, velocities)
    }

    /// The momenta of a velocity of the right shape, (10) with the rows of (4), and by (S4) those of what the joints leave free.
    pub(crate) fn momenta(&self, t: f64, g: &Configuration, xi: &Velocity) -> Momentum {
        let mut pose = Pose::default();
        let (r, pose) = self.pose(t, g, &mut pose);
        let bodies = self.body_momenta((r, pose), xi);
        self.gather_momenta(pose, bodies)
    }

    /// Linear momentum, and the angular one about the first body's mass centre or its joint to the world, at the time 0.
    pub(crate) fn total_momentum(&self, g: &Configuration, xi: &Velocity) -> [Vec3; 2] {
        let mut pose = Pose::default();
        let (r, pose) = self.pose(0.0, g, &mut pose);
        let (p, linear) = self.body_momenta((r, pose), xi);
        let spins = r.iter().zip(&p).map(|(r, p)| r.rotate(*p));
        [linear, spins.fold(Vec3::zero(), |sum, spin| sum + spin)]
    }

    /// The velocity with that of a rigid whole added, which turns at `w` about the first body's mass centre, in the reference frame.
    pub(crate) fn carried(&self, g: &Configuration, xi: &Velocity, [v, w]: [Vec3; 2]) -> Velocity {
        let mut moved = xi.clone();
        for (omega, r) in moved.0.iter_mut().zip(g.0.iter()) {
            *omega = (omega.vec3() + r.inverse_rotate(w)).into();
        }
        for x in moved.1.iter_mut() {
            *x = (x.vec3() + v).into();
        }
        moved
    }

    /// Twice the kinetic energy of these rates and velocities, (6), and that of coupled inertia, (S26).
    #[inline(always)]
    pub(crate) fn twice_kinetic<S: Scalar>(&self, rates: &[Vec3<S>], velocities: &[Vec3<S>]) -> S {
        let mut twice = S::zero();
        for (i, node) in self.nodes.iter().enumerate() {
            let (omega, v) = (rates[i], velocities[i]);
            twice += v.dot(self.masses[i].apply(v)) + omega.dot(node.j.apply(omega));
            if self.is_coupled {
                twice += v.dot(node.coupling.apply(omega)).times(2.0);
            }
        }
        twice
    }

    /// $\sum_i R_i M_i R_i^T$ at the time 0.
    pub(crate) fn total_mass_of(&self, g: &Configuration) -> Sym3 {
        self.total_mass(self.pose(0.0, g, &mut Pose::default()).0)
    }

    /// With $F_i = M_i V_i + \sum_k C_k F_k$: the total $p_x = R_0 F_0$ and
    /// $p_i = J_i \Omega_i - d_{ip} \times F_i + \sum_k d_{ik} \times C_k F_k$; coupled inertia adds to both, (S26).
    pub(crate) fn body_momenta(
        &self,
        (r, pose): (&[SO3], &Pose<f64>),
        xi: &Velocity,
    ) -> (PerBody<Vec3>, Vec3) {
        let (rates, mut momenta) = self.body_velocities((r, pose), xi);
        let mut p: PerBody<Vec3> = SmallVec::with_capacity(rates.len());
        for (i, (omega, v)) in rates.iter().zip(&mut momenta).enumerate() {
            let node = &self.nodes[i];
            p.push(node.j * *omega + node.coupling.transpose_mul(*v));
            *v = self.momentum::<Any, f64>(i, *omega, *v);
        }
        for (i, node) in self.nodes.iter().enumerate().skip(1).rev() {
            let force = r[i].rotate(momenta[i]);
            let on_parent = r[node.parent].inverse_rotate(force);
            p[i] -= node.at_self.cross(momenta[i]);
            p[node.parent] += node.at_parent.cross(on_parent);
            momenta[node.parent] += on_parent;
        }
        p[0] -= self.nodes[0].at_self.cross(momenta[0]);
        (p, r[0].rotate(momenta[0]))
    }

    /// $n_i = p_i + \sum_k C_k n_k$ over what hangs on $i$ by no ball, (S4).
    pub(crate) fn outer_momenta(
        &self,
        pose: &Pose<f64>,
        mut momenta: PerBody<Vec3>,
    ) -> PerBody<Vec3> {
        for (i, node) in self.nodes.iter().enumerate().skip(1).rev() {
            if !node.role.is_root() {
                let on_parent = pose.c[i].rotate(momenta[i]);
                momenta[node.parent] += on_parent;
            }
        }
        momenta
    }

    /// Of a root $n$, of a hinge $s \cdot n$, (S4).
    fn gather_momenta(&self, pose: &Pose<f64>, (p, linear): (PerBody<Vec3>, Vec3)) -> Momentum {
        let mut momenta = self.aligned().zero_dual();
        for (i, n) in self.outer_momenta(pose, p).iter().enumerate() {
            self.project::<Any, f64>(i, *n, &mut momenta);
        }
        if self.is_free() {
            momenta.1[0] = linear.into();
        }
        momenta
    }
}
