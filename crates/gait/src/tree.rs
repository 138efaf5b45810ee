//! A tree of bodies whose joints move as told, by its shape: the formulas over any scalar.

use core::ops::Range;

use articulated_fluid::ArticulatedBody;
use lie::{Cotangent, LieGroup, Mat3, SO3, Scalar, Tangent, Vec3};

use crate::error::GaitError;
use crate::joint::{Steered, Turning};
use crate::rigid::Rigid;

/// A free tree of bodies by its shape.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    links: Vec<Link>,
    joints: Vec<Moving>,
}

/// A joint that moves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Moving {
    /// Its name in the scene.
    pub name: String,
    /// Its coordinates in the shape: the angle of a hinge, the rotation vector of a ball.
    pub coordinates: Range<usize>,
}

/// A body, and the joint that it hangs on.
#[derive(Clone, Debug)]
struct Link {
    parent: usize,
    at_parent: Vec3,
    at_self: Vec3,
    mass: Mat3,
    coupling: Mat3,
    inertia: Mat3,
    joint: Steered,
}

/// A tree in a shape.
pub(crate) struct Posed<S> {
    /// The connection's columns $A_j$.
    pub(crate) connection: Vec<Tangent<6, S>>,
    /// $M_{qq} - M_{qg} \mathbb{I}^{-1} M_{gq}$, row by row.
    pub(crate) metric: Vec<S>,
}

impl<S: Scalar> Posed<S> {
    /// $\xi = -A \dot q$: the velocity of the first body in its frame, at zero momentum.
    pub(crate) fn velocity(&self, rates: &[S]) -> Tangent<6, S> {
        let columns = self.connection.iter().zip(rates);
        columns.fold(Tangent::zero(), |sum, (a, rate)| sum - *a * *rate)
    }

    /// $G \dot q$.
    pub(crate) fn momenta(&self, rates: &[S]) -> Vec<S> {
        let row = |j: usize| {
            let row = self.metric[rates.len() * j..].iter().zip(rates);
            row.fold(S::zero(), |sum, (entry, rate)| sum + *entry * *rate)
        };
        (0..rates.len()).map(row).collect()
    }

    /// $\dot q^T G \dot q$: twice the kinetic energy at zero momentum, J.
    pub(crate) fn twice_energy(&self, rates: &[S]) -> S {
        let each = self.momenta(rates).into_iter().zip(rates);
        each.fold(S::zero(), |sum, (momentum, rate)| sum + momentum * *rate)
    }
}

/// Where the bodies are, in the frame of the first.
struct Placed<S> {
    attitudes: Vec<SO3<S>>,
    centres: Vec<Vec3<S>>,
    /// Of all that hangs on each body, itself included.
    composites: Vec<Rigid<S>>,
    /// Of each coordinate: how fast what hangs on it moves, at a rate of 1.
    twists: Vec<(usize, Tangent<6, S>)>,
}

impl Tree {
    /// The tree of a model, whose joints are called so by their bodies.
    pub(crate) fn new(
        model: &ArticulatedBody,
        name: &dyn Fn(usize) -> String,
    ) -> Result<Self, GaitError> {
        let (mut links, mut joints): (Vec<Link>, Vec<Moving>) = (Vec::new(), Vec::new());
        for (i, body) in model.bodies().enumerate() {
            links.push(Link {
                parent: 0,
                at_parent: Vec3::zero(),
                at_self: Vec3::zero(),
                mass: body.mass,
                coupling: body.coupling,
                inertia: body.inertia,
                joint: Steered {
                    rest: SO3::identity(),
                    turning: Turning::Fixed,
                },
            });
            let Some(on) = i.checked_sub(1).and_then(|i| model.joints().nth(i)) else {
                continue;
            };
            let first = joints.last().map_or(0, |last| last.coordinates.end);
            let joint =
                Steered::of(&on.kind, first).ok_or_else(|| GaitError::Free { joint: name(i) })?;
            if joint.dim() > 0 {
                joints.push(Moving {
                    name: name(i),
                    coordinates: first..first + joint.dim(),
                });
            }
            let link = &mut links[i];
            (link.parent, link.at_parent, link.at_self) = (on.parent, on.at_parent, on.at_child);
            link.joint = joint;
        }
        match joints.is_empty() {
            true => Err(GaitError::Rigid),
            false => Ok(Self { links, joints }),
        }
    }

    /// How many coordinates a shape has.
    pub(crate) fn dim(&self) -> usize {
        self.joints.last().map_or(0, |last| last.coordinates.end)
    }

    /// The joints that move, in the order of the bodies.
    pub(crate) fn joints(&self) -> &[Moving] {
        &self.joints
    }

    /// Connection and metric at a shape of [`dim`](Self::dim) numbers.
    pub(crate) fn at<S: Scalar>(&self, q: &[S]) -> Posed<S> {
        let placed = self.place(q);
        let momenta: Vec<Cotangent<6, S>> = placed
            .twists
            .iter()
            .map(|(i, twist)| placed.composites[*i].momentum(twist))
            .collect();
        let velocity = placed.composites[0].velocity();
        let connection: Vec<Tangent<6, S>> = momenta.iter().map(&velocity).collect();
        let m = q.len();
        let mut metric = vec![S::zero(); m * m];
        for l in 0..m {
            for j in 0..=l {
                let own = match self.carries(placed.twists[j].0, placed.twists[l].0) {
                    true => momenta[l].pair(&placed.twists[j].1),
                    false => S::zero(),
                };
                let entry = own - momenta[l].pair(&connection[j]);
                (metric[m * j + l], metric[m * l + j]) = (entry, entry);
            }
        }
        Posed { connection, metric }
    }

    /// The radius of gyration of the whole, with what the fluid adds, m.
    pub(crate) fn gyration(&self, q: &[f64]) -> f64 {
        self.place(q).composites[0].gyration()
    }

    /// Where the bodies are in the frame of the first: attitudes and mass centres, m.
    pub(crate) fn bodies<S: Scalar>(&self, q: &[S]) -> Vec<(SO3<S>, Vec3<S>)> {
        let placed = self.place(q);
        placed.attitudes.into_iter().zip(placed.centres).collect()
    }

    /// The first of the bodies that are welded to a body.
    pub(crate) fn cluster(&self, mut body: usize) -> usize {
        while body > 0 && self.links[body].joint.dim() == 0 {
            body = self.links[body].parent;
        }
        body
    }

    /// Whether body `i` is body `k`, or one that `k` hangs on.
    fn carries(&self, i: usize, mut k: usize) -> bool {
        while k > i {
            k = self.links[k].parent;
        }
        k == i
    }

    fn place<S: Scalar>(&self, q: &[S]) -> Placed<S> {
        let count = self.links.len();
        let mut placed = Placed {
            attitudes: Vec::with_capacity(count),
            centres: Vec::with_capacity(count),
            composites: Vec::with_capacity(count),
            twists: Vec::with_capacity(q.len()),
        };
        for (i, link) in self.links.iter().enumerate() {
            let (turn, rates) = link.joint.turn(q);
            let (on, joint) = match i {
                0 => (SO3::identity(), Vec3::zero()),
                _ => {
                    let on = placed.attitudes[link.parent];
                    let lever = on.rotate(link.at_parent.lift());
                    (on, placed.centres[link.parent] + lever)
                }
            };
            let attitude = on.compose(&turn);
            let centre = joint - attitude.rotate(link.at_self.lift());
            for rate in rates {
                let w = attitude.rotate(rate);
                placed.twists.push((i, (w, joint.cross(w)).into()));
            }
            let inertia = [&link.mass, &link.coupling, &link.inertia];
            placed
                .composites
                .push(Rigid::of(inertia, attitude.matrix(), centre));
            placed.attitudes.push(attitude);
            placed.centres.push(centre);
        }
        for i in (1..count).rev() {
            let own = placed.composites[i];
            placed.composites[self.links[i].parent].add(&own);
        }
        placed
    }
}
