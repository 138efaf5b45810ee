//! The attitudes of all bodies, from those that the configuration has: $R_i = R_p C_i$ outwards, (S1)–(S2).

use lie::{SO3, Scalar, Vec3};

use crate::motion::{self, Motion, Timed};
use crate::tree::{ArticulatedBody, Base, Configuration, Identity};

/// Where the bodies are at a time, and what moves as told.
#[derive(Clone, Debug)]
pub(crate) struct Pose<S> {
    /// The tree and the time that the motions were read of at last.
    read: Option<(Identity, S)>,
    /// $R_i$; empty where the configuration has them all.
    pub(crate) r: Vec<SO3<S>>,
    /// $C_i = R_p^T R_i$ of hinges and motions.
    pub(crate) c: Vec<SO3<S>>,
    /// $a_i$ of motions, zero of the others.
    pub(crate) rates: Vec<Vec3<S>>,
    /// $x_J$ and $\dot x_J$ of a held base.
    pub(crate) place: [Vec3<S>; 2],
}

impl<S: Scalar> Default for Pose<S> {
    fn default() -> Self {
        Self {
            read: None,
            r: Vec::new(),
            c: Vec::new(),
            rates: Vec::new(),
            place: [Vec3::zero(); 2],
        }
    }
}

impl<S: Scalar> Pose<S> {
    /// The rates of what moves as told.
    #[inline(always)]
    pub(crate) fn drive(&self) -> Drive<'_, S> {
        Drive {
            rates: &self.rates,
            place: self.place[1],
        }
    }
}

/// What moves as told; at rest in the matrix of a step.
#[derive(Clone, Copy)]
pub(crate) struct Drive<'a, S> {
    rates: &'a [Vec3<S>],
    /// $\dot x_J$.
    pub(crate) place: Vec3<S>,
}

impl<S: Scalar> Drive<'_, S> {
    pub(crate) fn at_rest() -> Self {
        Self {
            rates: &[],
            place: Vec3::zero(),
        }
    }

    /// $a_i$.
    #[inline(always)]
    pub(crate) fn rate(&self, i: usize) -> Vec3<S> {
        self.rates.get(i).copied().unwrap_or(Vec3::zero())
    }
}

impl ArticulatedBody {
    /// The attitudes of all bodies at the time `t`.
    #[inline(always)]
    pub(crate) fn pose<'a, S: Scalar>(
        &self,
        t: S,
        g: &'a Configuration<S>,
        pose: &'a mut Pose<S>,
    ) -> (&'a [SO3<S>], &'a Pose<S>) {
        if self.is_simple() {
            return (&g.0, pose);
        }
        self.read_motions_at(t, pose);
        if !self.has_inner() {
            return (&g.0, pose);
        }
        for (i, node) in self.nodes.iter().enumerate() {
            pose.r[i] = match self.own_attitude(i, g, pose) {
                Some(r) => r,
                None if i == 0 => pose.c[0],
                None => {
                    let turned = *pose.r[node.parent].matrix() * *pose.c[i].matrix();
                    SO3::from_matrix_unchecked(turned)
                }
            };
        }
        (&pose.r, pose)
    }

    /// $C_i$ and $a_i$ of all motions, and where the base is held, unless they were read for this time and tree.
    #[inline(always)]
    pub(crate) fn read_motions_at<S: Scalar>(&self, t: S, pose: &mut Pose<S>) {
        let known = |(tree, at): (Identity, S)| tree.is(self.identity) && at == t;
        if !pose.read.is_some_and(known) {
            self.read_motions(t, pose);
        }
    }

    /// Reads the motions, but lets the joints of some bodies do others: each the attitude on the parent, and its rate in the body's frame.
    pub(crate) fn steer_motions<S: Scalar>(
        &self,
        t: S,
        others: impl Iterator<Item = (usize, (SO3<S>, Vec3<S>))>,
        pose: &mut Pose<S>,
    ) {
        self.read_motions_at(t, pose);
        for (body, (attitude, rate)) in others {
            (pose.c[body], pose.rates[body]) = (attitude, rate);
        }
    }

    /// From when to when all that moves as told is told, s: tables are not for ever.
    pub fn told(&self) -> [f64; 2] {
        let place = match &self.base {
            Base::Free => None,
            Base::Held { place, .. } => Some(place.told()),
        };
        let motions = self.joints.motions.iter().map(Motion::told);
        let all = motions.chain(place).chain(self.loads.forces.told());
        all.fold([f64::NEG_INFINITY, f64::INFINITY], |[a, b], [from, to]| {
            [a.max(from), b.min(to)]
        })
    }

    /// From when on all that moves as told repeats itself, and after how long, s: nothing told repeats after 0 s; `None` where it never does.
    pub fn repeats(&self) -> Option<[f64; 2]> {
        let place = match &self.base {
            Base::Free => None,
            Base::Held { place, .. } => Some(place.repeats()),
        };
        let motions = self.joints.motions.iter().map(Motion::repeats);
        motion::common(motions.chain(place).chain(self.loads.forces.repeats()))
    }

    /// How fast what is told changes in the first seconds, rad/s; zero where nothing is told.
    pub fn told_rate(&self, until: f64) -> f64 {
        let place = match &self.base {
            Base::Free => 0.0,
            Base::Held { place, .. } => place.rate(until),
        };
        let motions = self.joints.motions.iter().map(|motion| motion.rate(until));
        let all = motions.chain(self.loads.forces.told_rates(until));
        all.fold(place, f64::max)
    }

    /// Whether all motions are numbers at the time `t`.
    pub(crate) fn knows(&self, t: f64) -> bool {
        let known = self
            .joints
            .motions
            .iter()
            .all(|motion| motion.at(t).1.is_finite());
        let placed = match &self.base {
            Base::Free => true,
            Base::Held { place, .. } => place.derivative(t, 0).iter().all(|x| x.is_finite()),
        };
        let told = self.loads.forces.are_known(t);
        known && placed && told
    }

    fn read_motions<S: Scalar>(&self, t: S, pose: &mut Pose<S>) {
        let bodies = self.nodes.len();
        pose.r.resize(bodies, SO3::identity());
        pose.c.resize(bodies, SO3::identity());
        pose.rates.resize(bodies, Vec3::zero());
        for i in 0..bodies {
            self.read_motion(t, i, pose);
        }
        if let Base::Held { place, .. } = &self.base {
            pose.place = motion::at(place.as_ref(), t).map(Vec3);
        }
        pose.read = Some((self.identity, t));
    }
}
