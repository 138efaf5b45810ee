//! The same tree, hung on its heaviest body.
//!
//! The momentum $p_0$ of the first body has the lever momenta of all that hangs on it. Where that is far heavier, they cancel in
//! its angular velocity, and digits are lost. So the tree is hung on the body $r$ of the largest mass, by the trace of $M_r$. With
//! the lever $l_i$ of each body $i$ on the path from the first one, from where the path enters it to where it leaves it,
//! $$ x_r = x_0 + \sum_i R_i l_i, \qquad p_x' = p_x, \qquad p_i' = p_i - l_i \times R_i^T p_x . $$
//! The first and the last body are entered and left at their mass centres. Attitudes are the same, and so is the Lagrangian. The
//! discrete Lagrangian (22) is another one: it depends on the root by its own error.

use dvi::{State, System};
use lie::Vec3;

use super::view::View;
use crate::node::{Body, Joint};
use crate::tree::{ArticulatedBody, Configuration, Velocity};

/// The [`View`] that hangs a tree on its heaviest body.
#[derive(Clone, Debug, PartialEq)]
pub struct Rerooted {
    model: ArticulatedBody,
    /// The body of the scene that each body is: those of the path from the heaviest to the first, then the others.
    order: Vec<usize>,
    /// $l_i$ of the bodies of the path, m, each in its frame.
    levers: Vec<Vec3>,
}

impl Rerooted {
    /// The view of a free tree on ball joints whose first body is not the heaviest; of several that are, the first is taken.
    ///
    /// ```
    /// use articulated_fluid::{ArticulatedBody, Body, Joint, JointKind, Rerooted};
    /// use lie::{Mat3, Vec3};
    ///
    /// let body = |m: f64| Body::new(Mat3::diagonal([m; 3]), Mat3::diagonal([0.1; 3]));
    /// let (at_parent, at_child) = (Vec3([0.5, 0.0, 0.0]), Vec3([-2.0, 0.0, 0.0]));
    /// let joints = [Joint::new([0, 1], [at_parent, at_child], JointKind::Ball)];
    /// let view = Rerooted::new(&ArticulatedBody::new(&[body(1.0), body(9.0)], &joints)?).expect("a heavier one");
    /// assert_eq!(view.model().bodies().next(), Some(body(9.0)));
    /// # Ok::<(), articulated_fluid::ModelError>(())
    /// ```
    pub fn new(model: &ArticulatedBody) -> Option<Self> {
        let mass = |i: &usize| model.masses[*i].trace();
        let bodies = 1..model.nodes.len();
        let heaviest = bodies.fold(0, |best, i| if mass(&i) > mass(&best) { i } else { best });
        (heaviest != 0 && model.has_views())
            .then(|| Self::on(model, heaviest))
            .flatten()
    }

    /// The view that hangs the tree on the body `root`; `None` where the numbers overflow there.
    fn on(model: &ArticulatedBody, root: usize) -> Option<Self> {
        let above = |i: &usize| (*i > 0).then(|| model.nodes[*i].parent);
        let path: Vec<usize> = core::iter::successors(Some(root), above).collect();
        let mut on_path = vec![false; model.nodes.len()];
        path.iter().for_each(|i| on_path[*i] = true);
        let others = (0..model.nodes.len()).filter(|i| !on_path[*i]);
        let order: Vec<usize> = path.iter().copied().chain(others).collect();
        Some(Self {
            model: reordered(model, &order, path.len())?,
            levers: levers(model, &path),
            order,
        })
    }

    /// The model of the tree on its heaviest body.
    pub fn model(&self) -> ArticulatedBody {
        self.model.clone()
    }

    /// The body of the scene on which the tree hangs.
    pub fn root(&self) -> usize {
        self.listed(0)
    }

    /// The body of the scene that body `k` of the model is.
    pub(crate) fn listed(&self, k: usize) -> usize {
        self.order[k]
    }

    /// The configuration and the velocity in the view's coordinates: $\dot x_r = \dot x_0 + \sum_i R_i (\Omega_i \times l_i)$.
    pub(crate) fn motion(&self, g: &Configuration, xi: &Velocity) -> (Configuration, Velocity) {
        let (mut inner, mut rates) = (g.clone(), xi.clone());
        let (mut x, mut v) = (g.1[0].vec3(), xi.1[0].vec3());
        for (&i, &lever) in self.order.iter().zip(&self.levers) {
            x += g.0[i].rotate(lever);
            v += g.0[i].rotate(xi.0[i].vec3().cross(lever));
        }
        for (k, &i) in self.order.iter().enumerate() {
            (inner.0[k], rates.0[k]) = (g.0[i], xi.0[i]);
        }
        (inner.1[0], rates.1[0]) = (x.into(), v.into());
        (inner, rates)
    }
}

impl View for Rerooted {
    type Inner = Configuration;
    type Frame = ();

    fn enter(&self, outer: &State<Configuration>) -> Option<((), State<Configuration>)> {
        let (g, mu) = (&outer.g, &outer.mu);
        if !(self.model.fits(g) && self.model.has_shape_of(mu)) {
            return None;
        }
        let (mut inner, linear) = (outer.clone(), mu.1[0].vec3());
        let mut x = g.1[0].vec3();
        for (k, &i) in self.order.iter().enumerate() {
            let r = g.0[i];
            let lever = self.levers.get(k).copied().unwrap_or(Vec3::zero());
            x += r.rotate(lever);
            let p = mu.0[i].vec3() - lever.cross(r.inverse_rotate(linear));
            (inner.g.0[k], inner.mu.0[k]) = (r, p.into());
        }
        inner.g.1[0] = x.into();
        Some(((), inner))
    }

    fn leave(&self, (): &(), inner: &State<Configuration>, outer: &mut State<Configuration>) {
        let (g, mu) = (&inner.g, &inner.mu);
        let (mut x, linear) = (g.1[0].vec3(), mu.1[0].vec3());
        for (k, &i) in self.order.iter().enumerate() {
            let r = g.0[k];
            let lever = self.levers.get(k).copied().unwrap_or(Vec3::zero());
            x -= r.rotate(lever);
            let p = mu.0[k].vec3() + lever.cross(r.inverse_rotate(linear));
            (outer.g.0[i], outer.mu.0[i]) = (r, p.into());
        }
        (outer.t, outer.g.1[0], outer.mu.1[0]) = (inner.t, x.into(), mu.1[0]);
    }
}

/// $l_i$ along the path from the root of the view up to the first body: from the joint to the parent to the one that the path came by.
fn levers(model: &ArticulatedBody, path: &[usize]) -> Vec<Vec3> {
    let entry = |k: usize| match k {
        0 => Vec3::zero(),
        k => model.nodes[path[k - 1]].at_parent,
    };
    // The first body has no joint to a parent: zero.
    let lever = |(k, i): (usize, &usize)| entry(k) - model.nodes[*i].at_self;
    path.iter().enumerate().map(lever).collect()
}

/// The model with its bodies in this order, the first ones a path whose joints are reversed.
fn reordered(model: &ArticulatedBody, order: &[usize], path: usize) -> Option<ArticulatedBody> {
    let mut places = vec![0; order.len()];
    order.iter().enumerate().for_each(|(k, &i)| places[i] = k);
    let bodies: Vec<Body> = model.bodies().collect();
    let bodies: Vec<Body> = order.iter().map(|&i| bodies[i]).collect();
    let joint = |joint: Joint| {
        let (parent, child) = (places[joint.parent], places[joint.child]);
        match child < path {
            false => Joint {
                parent,
                child,
                ..joint
            },
            true => Joint {
                parent: child,
                child: parent,
                at_parent: joint.at_child,
                at_child: joint.at_parent,
                kind: joint.kind,
            },
        }
    };
    let joints: Vec<Joint> = model.joints().map(joint).collect();
    let mut stiffnesses = vec![0.0; joints.len()];
    let springs = model
        .loads
        .springs
        .iter()
        .flat_map(|springs| springs.iter());
    for spring in springs {
        stiffnesses[joints[spring.child - 1].child - 1] = spring.stiffness;
    }
    let mut made = ArticulatedBody::new(&bodies, &joints).ok()?;
    made = made.with_stiffness(&stiffnesses).ok()?;
    match &model.loads.weight {
        None => Some(made),
        Some(weight) => {
            let net: Vec<f64> = order.iter().map(|&i| weight.net_masses()[i]).collect();
            made.with_gravity(weight.gravity(), &net).ok()
        }
    }
}
