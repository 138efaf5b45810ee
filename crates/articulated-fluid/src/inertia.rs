//! The inertia (4) solved from the leaves to the first body, in time and memory proportional to the bodies.
//!
//! [`formulas`](crate::formulas) derives it; the [kinds of joints](crate::joints) eliminate what is theirs.

use core::ops::Add;

use lie::{Cotangent, Ldl3, SO3, Scalar, Sym3, Vec3};

use crate::error::ModelError;
use crate::joints::{Damped, HingeFactors, Kinds, Link};
use crate::loads::on_bodies::Twist;
use crate::pose::{Drive, Pose};
use crate::tree::{ArticulatedBody, Configuration, Identity, Momentum, Velocity};

/// The inertia at a configuration, factorised, with the storage for solves.
#[derive(Clone, Debug)]
pub(crate) struct Elimination<S = f64> {
    /// What the links were made for.
    tree: Option<Identity>,
    links: Vec<Link<S>>,
    hinges: Vec<HingeFactors<S>>,
    /// $M_0^\ast$ of a free base.
    base: Ldl3<S>,
    /// $h d$ of each joint; empty without dampers.
    resistances: Vec<S>,
}

impl<S: Scalar> Default for Elimination<S> {
    fn default() -> Self {
        Self {
            tree: None,
            links: Vec::new(),
            hinges: Vec::new(),
            base: Ldl3::identity(),
            resistances: Vec::new(),
        }
    }
}

impl Elimination {
    /// Whether the matrix is positive definite, once it is factorised.
    fn is_definite(&self, tree: &ArticulatedBody) -> bool {
        let bodies = tree.nodes.iter().zip(&self.links);
        let mut balls = bodies.filter(|(node, _)| node.role.is_root());
        let base = !tree.is_free() || self.base.is_positive();
        base && balls.all(|(_, link)| link.ldl.is_positive())
            && self.hinges.iter().all(HingeFactors::is_positive)
    }
}

impl ArticulatedBody {
    /// The rate at which dampers and servos brake the fastest motion, 1/s: the largest $\lambda$ of $D \xi = \lambda \mathbb I(g)\, \xi$.
    ///
    /// A step of $-h$ has a pole at $h \lambda = 1$, (S23).
    ///
    /// # Errors
    /// [`ModelError::Shape`] where the configuration is not one of this model.
    pub fn braking_rate(&self, t: f64, g: &Configuration) -> Result<f64, ModelError> {
        self.check(g)?;
        let joints = &self.loads.forces.joints;
        if joints.iter().all(|joint| joint.load.resistance() == 0.0) {
            return Ok(0.0);
        }
        let (mut work, mut pose) = (Elimination::default(), Pose::default());
        let (r, pose) = self.pose(t, g, &mut pose);
        let mut is_beyond = |h: f64| {
            work.resist(self, -h);
            work.factorise::<Damped>(self, r, &pose.c);
            !work.is_definite(self)
        };
        let mut doublings = (-60..60).map(|k| f64::from(k).exp2());
        let Some(mut far) = doublings.find(|h| is_beyond(*h)) else {
            return Ok(0.0);
        };
        let mut near = 0.5 * far;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (near + far);
            match is_beyond(middle) {
                true => far = middle,
                false => near = middle,
            }
        }
        Ok(1.0 / far)
    }
}

impl<S: Scalar> Elimination<S> {
    /// Puts the dampers of a step of `h` into the matrix, (S23), which is factorised after this.
    pub(crate) fn resist(&mut self, tree: &ArticulatedBody, h: S) {
        self.resistances.clear();
        let joints = tree.loads.forces.joints.iter();
        for joint in joints.filter(|joint| joint.load.resistance() != 0.0) {
            self.resistances.resize(tree.nodes.len(), S::zero());
            self.resistances[joint.child] = h.times(joint.load.resistance());
        }
    }
}

/// Halvings that find a pole to six digits.
const BISECTIONS: u32 = 20;

/// Masses and momenta, from the leaves to the first body.
impl<S: Scalar> Elimination<S> {
    /// $h d$ of the joint of body `i`.
    #[inline(always)]
    fn resistance<K: Kinds>(&self, i: usize) -> Option<S> {
        match K::ARE_DAMPED {
            true => self.resistances.get(i).copied(),
            false => None,
        }
    }

    /// Makes a link for each body.
    #[inline(always)]
    fn prepare(&mut self, tree: &ArticulatedBody) {
        if !self.tree.is_some_and(|made| made.is(tree.identity)) {
            self.make_links(tree);
        }
    }

    #[cold]
    fn make_links(&mut self, tree: &ArticulatedBody) {
        let bodies = tree.nodes.iter().zip(&tree.masses);
        self.links = bodies.map(|(node, mass)| Link::alone(node, mass)).collect();
        self.hinges = vec![HingeFactors::at_rest(); tree.joints.hinges.len()];
        self.tree = Some(tree.identity);
    }

    /// Eliminates the bodies from the leaves on. Those without children on balls stay as they were made.
    #[inline(always)]
    pub(crate) fn factorise<K: Kinds>(
        &mut self,
        tree: &ArticulatedBody,
        r: &[SO3<S>],
        c: &[SO3<S>],
    ) {
        self.prepare(tree);
        for i in (1..tree.nodes.len()).rev() {
            self.factorise_link::<K>(tree, i, (r, c));
        }
        self.factorise_base::<K>(tree);
    }

    #[inline(always)]
    fn factorise_link<K: Kinds>(
        &mut self,
        tree: &ArticulatedBody,
        i: usize,
        (r, c): (&[SO3<S>], &[SO3<S>]),
    ) {
        let node = &tree.nodes[i];
        if node.is_last_sibling {
            self.links[node.parent].reset(&tree.nodes[node.parent], &tree.masses[node.parent]);
        }
        let resistance = self.resistance::<K>(i);
        tree.eliminate_mass::<K, S>(i, resistance, &mut self.links[i], &mut self.hinges);
        let (parent, link) = self.joint(i, node.parent);
        if tree.role::<K>(i).is_root() {
            link.c = r[node.parent].matrix().transpose() * *r[i].matrix();
            match resistance {
                None => parent.carry_mass(link, node.lever.lift()),
                Some(by) => parent.carry_inertia(&link.resisted(by), node.lever.lift()),
            }
        } else {
            link.c = *c[i].matrix();
            parent.carry_inertia(link, node.lever.lift());
        }
    }

    #[inline(always)]
    fn factorise_base<K: Kinds>(&mut self, tree: &ArticulatedBody) {
        let resistance = self.resistance::<K>(0);
        tree.eliminate_mass::<K, S>(0, resistance, &mut self.links[0], &mut self.hinges);
        if tree.floats::<K>() {
            self.base = self.links[0].mass.ldl();
        }
    }

    /// Eliminates the momenta from the leaves on, and finds the first body's velocity.
    #[inline(always)]
    pub(crate) fn begin<K: Kinds>(
        &mut self,
        tree: &ArticulatedBody,
        r0: &SO3<S>,
        drive: Drive<S>,
        mu: &Momentum<S>,
    ) {
        self.read_momenta::<K>(tree, mu);
        for i in (1..tree.nodes.len()).rev() {
            self.eliminate_momentum::<K>(tree, i, drive, mu);
        }
        self.begin_base::<K>(tree, r0, drive, mu);
    }

    #[inline(always)]
    fn read_momenta<K: Kinds>(&mut self, tree: &ArticulatedBody, mu: &Momentum<S>) {
        for (i, link) in self.links.iter_mut().enumerate() {
            link.force = Vec3::zero();
            link.w = tree.own_momentum::<K, S>(i, mu);
        }
    }

    #[inline(always)]
    fn eliminate_momentum<K: Kinds>(
        &mut self,
        tree: &ArticulatedBody,
        i: usize,
        drive: Drive<S>,
        mu: &Momentum<S>,
    ) {
        let node = &tree.nodes[i];
        tree.eliminate_force::<K, S>(i, (drive, mu), &mut self.links[i], &mut self.hinges);
        let resistance = self.resistance::<K>(i);
        let (parent, link) = self.joint(i, node.parent);
        match tree.role::<K>(i).is_root() {
            true => parent.carry_force(link, node.lever.lift()),
            false => return parent.carry_wrench(link, node.lever.lift()),
        }
        if let Some(by) = resistance {
            parent.w += link.c * (link.w * by);
        }
    }

    #[inline(always)]
    fn begin_base<K: Kinds>(
        &mut self,
        tree: &ArticulatedBody,
        r0: &SO3<S>,
        drive: Drive<S>,
        mu: &Momentum<S>,
    ) {
        tree.eliminate_force::<K, S>(0, (drive, mu), &mut self.links[0], &mut self.hinges);
        let u = match tree.floats::<K>() {
            true => {
                let rest = r0.inverse_rotate(mu.1[0].vec3()) - self.links[0].force;
                self.base.solve(rest)
            }
            false => r0.inverse_rotate(drive.place),
        };
        let handed = (Vec3::zero(), u);
        tree.advance::<K, S>(0, handed, drive, &mut self.links[0], &mut self.hinges);
    }

    /// [`factorise`](Self::factorise) and [`begin`](Self::begin) in one pass, the momenta of a body while its factors are at hand.
    #[inline(always)]
    pub(crate) fn factorise_and_begin<K: Kinds>(
        &mut self,
        tree: &ArticulatedBody,
        (r, c): (&[SO3<S>], &[SO3<S>]),
        drive: Drive<S>,
        mu: &Momentum<S>,
    ) {
        self.prepare(tree);
        self.read_momenta::<K>(tree, mu);
        for i in (1..tree.nodes.len()).rev() {
            self.factorise_link::<K>(tree, i, (r, c));
            self.eliminate_momentum::<K>(tree, i, drive, mu);
        }
        self.factorise_base::<K>(tree);
        self.begin_base::<K>(tree, &r[0], drive, mu);
    }

    /// The links of body `i` and of its `parent`.
    #[inline(always)]
    fn joint(&mut self, i: usize, parent: usize) -> (&mut Link<S>, &mut Link<S>) {
        let (before, after) = self.links.split_at_mut(i);
        (&mut before[parent], &mut after[0])
    }
}

/// Velocities, from the first body to the leaves.
impl<S: Scalar> Elimination<S> {
    /// The velocity of body `i`'s joint, from its parent's velocity; then its own. What the parent hands on is returned.
    #[inline(always)]
    fn advance<K: Kinds>(
        &mut self,
        tree: &ArticulatedBody,
        i: usize,
        drive: Drive<S>,
    ) -> (Vec3<S>, Vec3<S>) {
        let node = &tree.nodes[i];
        let resistance = self.resistance::<K>(i);
        let (parent, link) = self.joint(i, node.parent);
        let u = parent.joint_velocity(link, node.at_parent.lift());
        let turning = match tree.role::<K>(i).is_root() && resistance.is_none() {
            true => Vec3::zero(),
            false => link.c.transpose_mul(parent.omega),
        };
        if let Some(by) = resistance.filter(|_| tree.role::<K>(i).is_root()) {
            link.w += link.ldl.solve(turning * by);
        }
        let handed = (turning, u);
        tree.advance::<K, S>(i, handed, drive, &mut self.links[i], &mut self.hinges);
        handed
    }

    /// $\Omega_i$ and $V_i$, once they are found.
    #[inline(always)]
    pub(crate) fn twist(&self, i: usize) -> Twist<S> {
        [self.links[i].omega, self.links[i].v]
    }

    #[inline(always)]
    fn write<K: Kinds>(&self, tree: &ArticulatedBody, i: usize, xi: &mut Velocity<S>) {
        tree.write_velocity::<K, S>(i, &self.links[i], &self.hinges, xi);
    }

    #[inline(always)]
    fn write_base<K: Kinds>(&self, tree: &ArticulatedBody, r0: &SO3<S>, xi: &mut Velocity<S>) {
        self.write::<K>(tree, 0, xi);
        if tree.floats::<K>() {
            xi.1[0] = r0.rotate(self.links[0].v).into();
        }
    }

    /// The velocities from the first body on, into `xi`: $\mathbb I(g) \xi = \mu$ is solved.
    #[inline(always)]
    pub(crate) fn finish<K: Kinds>(
        &mut self,
        tree: &ArticulatedBody,
        r0: &SO3<S>,
        drive: Drive<S>,
        xi: &mut Velocity<S>,
    ) {
        self.write_base::<K>(tree, r0, xi);
        for i in 1..self.links.len() {
            self.advance::<K>(tree, i, drive);
            self.write::<K>(tree, i, xi);
        }
    }

    /// The velocities likewise, and the forces (11)–(13) on each body about its joint:
    /// $\tau_i = M_i V_i \times u_i + \sum_{k \text{ on } i} (\Omega_i \times l_k) \times C_k F_k$.
    #[inline(always)]
    pub(crate) fn finish_with_forces<K: Kinds>(
        &mut self,
        tree: &ArticulatedBody,
        r0: &SO3<S>,
        drive: Drive<S>,
        xi: &mut Velocity<S>,
        tau: &mut [Cotangent<3, S>],
    ) {
        self.write_base::<K>(tree, r0, xi);
        let u = match tree.floats::<K>() {
            true => self.links[0].v,
            false => r0.inverse_rotate(drive.place),
        };
        let base = &self.links[0];
        tau[0] = tree.momentum::<K, S>(0, base.omega, base.v).cross(u).into();
        tree.force_on_joint::<K, S>(0, (Vec3::zero(), u), base, &mut self.hinges);
        for i in 1..self.links.len() {
            let (turning, u) = self.advance::<K>(tree, i, drive);
            self.write::<K>(tree, i, xi);
            let (node, link) = (&tree.nodes[i], &self.links[i]);
            let momentum = tree.momentum::<K, S>(i, link.omega, link.v);
            tau[i] = momentum.cross(u).into();
            let force = tree.force_on_joint::<K, S>(i, (turning, u), link, &mut self.hinges);
            let on_parent = link.c * force;
            let turned = self.links[node.parent].omega.cross(node.lever.lift());
            let tau = &mut tau[node.parent];
            *tau = (tau.vec3() + turned.cross(on_parent)).into();
        }
    }

    /// What the joints make of these moments on the bodies, $T_i = \tau_i + \sum_k C_k T_k$ over those that hang on $i$ by no ball:
    /// that of a root, and of a hinge $s \cdot (T_j + n_j \times \Omega_j)$, (S14).
    #[inline(always)]
    pub(crate) fn gather<K: Kinds>(
        &self,
        tree: &ArticulatedBody,
        tau: &mut [Cotangent<3, S>],
        out: &mut Momentum<S>,
    ) {
        for (i, node) in tree.nodes.iter().enumerate().rev() {
            let (own, link) = (tau[i].vec3(), &self.links[i]);
            let transport = tree.transport::<K, S>(i, link, &self.hinges);
            if tree.project::<K, S>(i, own + transport, out) {
                let on_parent = tau[node.parent].vec3() + self.links[i].c * own;
                tau[node.parent] = on_parent.into();
            }
        }
    }
}

impl ArticulatedBody {
    /// $M_i V_i + C_i \Omega_i$.
    #[inline(always)]
    pub(crate) fn momentum<K: Kinds, S: Scalar>(
        &self,
        i: usize,
        omega: Vec3<S>,
        v: Vec3<S>,
    ) -> Vec3<S> {
        let momentum = self.masses[i].apply(v);
        match self.couples::<K>() {
            true => momentum + self.nodes[i].coupling.apply(omega),
            false => momentum,
        }
    }

    /// $\sum_i R_i M_i R_i^T$: the slope of the linear momentum in $\dot x$, and that of (31) in $\Delta x / h$.
    #[inline(always)]
    pub(crate) fn total_mass(&self, r: &[SO3]) -> Sym3 {
        let masses = self.masses.iter().zip(r);
        let turned = masses.map(|(mass, r)| Sym3::upper(mass).turned(r.matrix()));
        turned.fold(Sym3::zero(), Sym3::add)
    }
}
