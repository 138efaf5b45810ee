//! Loads put on a tree.

use lie::Vec3;

use super::forces::LoadedJoint;
use super::gravity::Weight;
use super::hinge_spring::{HingeSpring, HingeSprings};
use super::joint_load::JointLoad;
use super::on_bodies::BodyLoad;
use super::spring::{Spring, Springs};
use crate::error::ModelError;
use crate::joints::Role;
use crate::tree::{ArticulatedBody, Identity};

impl ArticulatedBody {
    /// The same bodies under gravity. On each acts its net mass, kg, times `gravity`, m/s² in the reference frame, at its mass centre.
    /// The net mass is that of the body less that of the displaced fluid.
    ///
    /// # Errors
    /// [`ModelError::NetMasses`] where there is not one net mass for each body; [`ModelError::NotFinite`] where the forces are not.
    pub fn with_gravity(mut self, gravity: Vec3, net_masses: &[f64]) -> Result<Self, ModelError> {
        let (expected, found) = (self.nodes.len(), net_masses.len());
        if expected != found {
            return Err(ModelError::NetMasses { expected, found });
        }
        let weight = Weight::new(gravity, net_masses, &self.nodes);
        if !weight.is_finite() {
            return Err(ModelError::NotFinite { quantity: "weight" });
        }
        self.loads.weight = Some(weight);
        Ok(self)
    }

    /// The same with buoyancy anywhere in the bodies: for each the displaced mass times the point of its buoyancy from the mass centre, kg m in
    /// its frame. It adds to [`with_gravity`](Self::with_gravity), and is nothing without.
    ///
    /// # Errors
    /// [`ModelError::NetMasses`] where there is not one for each body; [`ModelError::NotFinite`] where one is not.
    pub fn with_buoyancy(mut self, moments: &[Vec3]) -> Result<Self, ModelError> {
        let (expected, found) = (self.nodes.len(), moments.len());
        if expected != found {
            return Err(ModelError::NetMasses { expected, found });
        }
        let weight = self.loads.weight.take();
        self.loads.weight = weight.map(|weight| weight.with_buoyancy(moments));
        match self.loads.weight.as_ref().is_none_or(Weight::is_finite) {
            true => Ok(self),
            false => Err(ModelError::NotFinite {
                quantity: "buoyancy",
            }),
        }
    }

    /// Gravity, m/s² in the reference frame, where it acts on a net mass.
    pub fn gravity(&self) -> Option<Vec3> {
        self.loads.weight.as_ref().map(Weight::gravity)
    }

    /// The total weight less the buoyancy, N in the reference frame: the rate of the linear momentum. Zero without gravity.
    pub fn net_weight(&self) -> Vec3 {
        self.loads
            .weight
            .as_ref()
            .map_or(Vec3::zero(), Weight::force)
    }

    /// The same bodies on elastic joints, at rest where the frames of body and parent are aligned. The potential of a joint is
    /// $k (1 - \cos\theta)$ with the angle $\theta$ between these and the stiffness $k \ge 0$, N m. Zero is a free joint.
    ///
    /// Of a hinge it is $\frac12 k (q - q_0)^2$ of its angle, $k$ in N m/rad. The stiffnesses are in the order of [`joints`](Self::joints),
    /// before them that of the joint to the world, if there is one.
    ///
    /// # Errors
    /// [`ModelError::Stiffnesses`] where there is not one for each joint; [`ModelError::Stiffness`] where one is negative or not finite;
    /// [`ModelError::Spring`] where a joint leaves nothing free.
    ///
    /// ```
    /// use articulated_fluid::{ArticulatedBody, Body, Joint, JointKind};
    /// use dvi::State;
    /// use lie::{LieGroup, Mat3, SO3, Tangent, Vec3};
    ///
    /// let body = Body::new(Mat3::diagonal([1.0, 2.0, 2.0]), Mat3::diagonal([0.1, 0.2, 0.2]));
    /// let (at_parent, at_child) = (Vec3([0.6, 0.0, 0.0]), Vec3([-0.6, 0.0, 0.0]));
    /// let pair = ArticulatedBody::new(&[body; 2], &[Joint::new([0, 1], [at_parent, at_child], JointKind::Ball)])?;
    /// let elastic = pair.with_stiffness(&[5.0])?;
    /// let mut g = elastic.aligned();
    /// g.0[1] = SO3::exp(&Tangent([0.0, 0.0, 0.3]));
    /// let mu = g.zero_dual();
    /// let energy = elastic.conserved(&State { t: 0.0, g, mu })?.energy;
    /// assert!((energy - 5.0 * (1.0 - 0.3_f64.cos())).abs() < 1e-15);
    /// # Ok::<(), articulated_fluid::ModelError>(())
    /// ```
    pub fn with_stiffness(mut self, stiffnesses: &[f64]) -> Result<Self, ModelError> {
        let first = usize::from(self.is_free());
        let (expected, found) = (self.nodes.len() - first, stiffnesses.len());
        if expected != found {
            return Err(ModelError::Stiffnesses { expected, found });
        }
        let (mut of_balls, mut of_hinges) = (vec![], vec![]);
        for (child, stiffness) in (first..).zip(stiffnesses.iter().copied()) {
            if !(stiffness.is_finite() && stiffness >= 0.0) {
                let body = child;
                return Err(ModelError::Stiffness { body, stiffness });
            }
            if stiffness == 0.0 {
                continue;
            }
            match self.nodes[child].role {
                Role::Ball(_) => of_balls.push(Spring {
                    parent: (child > 0).then(|| self.nodes[child].parent),
                    child,
                    stiffness,
                }),
                Role::Hinge(hinge) => of_hinges.push(HingeSpring {
                    hinge,
                    stiffness,
                    rest: self.joints.hinges[hinge].rest_angle,
                }),
                _ => return Err(ModelError::Spring { body: child }),
            }
        }
        self.loads.springs = Springs::new(of_balls);
        self.loads.hinge_springs = HingeSprings::new(of_hinges);
        Ok(self)
    }

    /// The same bodies with these loads in their joints, in the order of [`with_stiffness`](Self::with_stiffness).
    ///
    /// # Errors
    /// [`ModelError::Stiffnesses`] where there is not one for each joint; [`ModelError::Load`] where a load does not suit its joint.
    /// Then the joint leaves nothing free or is of another kind, or a number is negative or not finite.
    pub fn with_joint_loads(mut self, loads: &[JointLoad]) -> Result<Self, ModelError> {
        let first = usize::from(self.is_free());
        let (expected, found) = (self.nodes.len() - first, loads.len());
        if expected != found {
            return Err(ModelError::Stiffnesses { expected, found });
        }
        let acting = (first..).zip(loads).filter(|(_, load)| load.acts());
        let joints = acting.map(|(child, load)| {
            let hinge = match self.nodes[child].role {
                Role::Ball(_) => None,
                Role::Hinge(k) => Some((k, self.joints.hinges[k].axis)),
                _ => return Err(ModelError::Load { body: child }),
            };
            let load = load.clone();
            match load.suits(hinge.is_some()) {
                true => Ok(LoadedJoint {
                    parent: (child > 0).then(|| self.nodes[child].parent),
                    child,
                    hinge,
                    load,
                }),
                false => Err(ModelError::Load { body: child }),
            }
        });
        self.loads.forces.joints = joints.collect::<Result<_, _>>()?;
        // Storage of the tree before has not read these.
        self.identity = Identity::new();
        Ok(self)
    }

    /// The same bodies with these loads on some of them.
    ///
    /// # Errors
    /// [`ModelError::Load`] where there is no such body, or a number is negative or not finite.
    pub fn with_loads_on_bodies(mut self, loads: &[(usize, BodyLoad)]) -> Result<Self, ModelError> {
        for (body, load) in loads {
            if *body >= self.nodes.len() || !load.is_sound() {
                return Err(ModelError::Load { body: *body });
            }
        }
        let of = |name: &'static str| {
            let acting = loads.iter().filter(|(_, load)| load.acts());
            acting.filter(move |(_, load)| load.name() == name)
        };
        self.loads.forces.bodies = BodyLoad::names().flat_map(of).cloned().collect();
        // Storage of the tree before has not read these.
        self.identity = Identity::new();
        Ok(self)
    }
}
