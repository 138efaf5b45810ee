//! The bodies, their joints, and what is constant of them.

use lie::{Mat3, Power, R3, SO3, Vec3};

use crate::ModelError;

/// The paper's direct product $SO(3) \times \mathbb{R}^3 \times SO(3)^n$, $g = (R_0, x, R_1, \dots, R_n)$.
///
/// $R_i$ maps body $i$'s frame to the reference frame; $x$ is the mass centre of the head, in metres.
pub type Configuration<S = f64> = (SO3<S>, R3<S>, Power<SO3<S>>);

/// The total inertia of one body, the body's own plus the added one of the fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// $M_i$ in the body's frame, kg; anisotropic in a fluid.
    pub mass: Mat3,
    /// $J_i$ about the mass centre in the body's frame, kg m².
    pub inertia: Mat3,
}

/// A ball joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// Index of the body it is on.
    pub parent: usize,
    /// Index of the body that hangs on it.
    pub child: usize,
    /// $d_{0i}$: from the parent's mass centre, in the parent's frame, m.
    pub at_parent: Vec3,
    /// $d_{i0}$: from the child's mass centre, in the child's frame, m.
    pub at_child: Vec3,
}

/// Rigid bodies on ball joints in a perfect fluid: a head and its tails.
///
/// The model of T. Lee, M. Leok and N. H. McClamroch, *Dynamics of connected rigid bodies in a perfect fluid* (2009),
/// for any number of tails. Neutrally buoyant, so that no potential enters.
///
/// ```
/// use articulated_fluid::{ArticulatedBody, Body};
/// use lie::Mat3;
///
/// let body = Body { mass: Mat3::diagonal([1.0, 2.0, 2.0]), inertia: Mat3::diagonal([0.1, 0.2, 0.2]) };
/// let alone = ArticulatedBody::new(&[body], &[])?;
/// assert_eq!(alone.tails(), 0);
/// # Ok::<(), articulated_fluid::ModelError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ArticulatedBody {
    pub(crate) head: Head,
    pub(crate) tails: Vec<Tail>,
}

/// The head and what follows from its inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Head {
    /// $M_0$.
    pub(crate) m: Mat3,
    /// $J_0$.
    pub(crate) j: Mat3,
    /// $J_{d_0}$, (23).
    pub(crate) jd: Mat3,
}

/// A tail, its joint, and what follows from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tail {
    /// $M_i$.
    pub(crate) m: Mat3,
    /// $J_i$.
    pub(crate) j: Mat3,
    /// $d_{0i}$, in the head's frame.
    pub(crate) on_head: Vec3,
    /// $d_{i0}$, in the tail's frame.
    pub(crate) on_tail: Vec3,
    /// $J'_{d_i}$, (24).
    pub(crate) jd: Mat3,
    /// $J'^{-1}_i$ with $J'_i = J_i - \hat d_{i0} M_i \hat d_{i0}$, (24); constant in the tail's frame.
    pub(crate) j_inverse: Mat3,
    /// $M_i \hat d_{i0} J'^{-1}_i$: what the tail's own momentum adds to the force on its joint.
    pub(crate) recoil: Mat3,
    /// $M_i + M_i \hat d_{i0} J'^{-1}_i \hat d_{i0} M_i$: the mass that the joint feels.
    pub(crate) m_joint: Mat3,
}

impl ArticulatedBody {
    /// The model of these bodies, the first one the head, with one joint from the head to each other.
    ///
    /// # Errors
    /// [`ModelError`] where a matrix is not symmetric and positive definite, or the joints do not make a star.
    pub fn new(bodies: &[Body], joints: &[Joint]) -> Result<Self, ModelError> {
        let (head, tails) = bodies.split_first().ok_or(ModelError::NoBody)?;
        for (index, body) in bodies.iter().enumerate() {
            let refuse = |matrix| ModelError::NotPositiveDefinite {
                body: index,
                matrix,
            };
            positive_definite(&body.mass)
                .then_some(())
                .ok_or_else(|| refuse("mass"))?;
            positive_definite(&body.inertia)
                .then_some(())
                .ok_or_else(|| refuse("inertia"))?;
        }
        for (index, joint) in joints.iter().enumerate() {
            let Joint { parent, child, .. } = *joint;
            let points = [joint.at_parent, joint.at_child];
            let finite = points.iter().flat_map(|p| p.0).all(f64::is_finite);
            if parent != 0 || child == 0 || child > tails.len() || !finite {
                return Err(ModelError::Joint {
                    joint: index,
                    parent,
                    child,
                    last: tails.len(),
                });
            }
        }
        let tail = |(i, body): (usize, &Body)| {
            let mut leading = joints.iter().filter(|joint| joint.child == i + 1);
            match (leading.next(), leading.count()) {
                (Some(joint), 0) => {
                    let tail = Tail::new(body, joint);
                    tail.is_finite()
                        .then_some(tail)
                        .ok_or(ModelError::OutOfRange { body: i + 1 })
                }
                (first, more) => {
                    let count = usize::from(first.is_some()) + more;
                    Err(ModelError::Joints { body: i + 1, count })
                }
            }
        };
        let tails = tails
            .iter()
            .enumerate()
            .map(tail)
            .collect::<Result<_, _>>()?;
        Ok(Self {
            head: Head::new(head),
            tails,
        })
    }

    /// The number of tails $n$.
    pub fn tails(&self) -> usize {
        self.tails.len()
    }

    /// The total inertia of body `i`, the head being 0; `None` past the last.
    pub fn body(&self, i: usize) -> Option<Body> {
        if i == 0 {
            return Some(Body {
                mass: self.head.m,
                inertia: self.head.j,
            });
        }
        let tail = self.tails.get(i - 1)?;
        Some(Body {
            mass: tail.m,
            inertia: tail.j,
        })
    }

    /// The joints, in the order of the tails.
    pub fn joints(&self) -> impl Iterator<Item = Joint> + '_ {
        self.tails.iter().enumerate().map(|(i, tail)| Joint {
            parent: 0,
            child: i + 1,
            at_parent: tail.on_head,
            at_child: tail.on_tail,
        })
    }

    /// The aligned configuration: all attitudes the identity, the head at the origin.
    pub fn aligned(&self) -> Configuration {
        let tails = Power::new(vec![SO3::identity(); self.tails.len()]);
        (SO3::identity(), R3::identity(), tails)
    }
}

impl Head {
    fn new(body: &Body) -> Self {
        Self {
            m: body.mass,
            j: body.inertia,
            jd: nonstandard(body.inertia),
        }
    }
}

impl Tail {
    fn new(body: &Body, joint: &Joint) -> Self {
        let (m, d) = (body.mass, joint.at_child.hat());
        let j_prime = body.inertia - d * m * d;
        let j_inverse = j_prime.inverse();
        let recoil = m * d * j_inverse;
        Self {
            m,
            j: body.inertia,
            on_head: joint.at_parent,
            on_tail: joint.at_child,
            jd: nonstandard(j_prime),
            j_inverse,
            recoil,
            m_joint: m + recoil * d * m,
        }
    }

    fn is_finite(&self) -> bool {
        let derived = [self.jd, self.j_inverse, self.recoil, self.m_joint];
        derived.iter().all(|a| a.frobenius().is_finite())
    }
}

/// $J_d = \frac12 \mathrm{tr}[J] I - J$, (23); indefinite where added inertia breaks the triangle inequality.
fn nonstandard(j: Mat3) -> Mat3 {
    Mat3::diagonal([0.5 * j.trace(); 3]) - j
}

/// By the leading minors of a matrix that is symmetric to rounding, brought to trace one against underflow.
fn positive_definite(a: &Mat3) -> bool {
    if a.trace() <= 0.0 {
        return false;
    }
    let a = *a * (1.0 / a.trace());
    let symmetric = a.skew_vee().norm() <= 1e-12 * a.frobenius();
    let minor = a[(0, 0)] * a[(1, 1)] - a[(0, 1)] * a[(1, 0)];
    let positive = a[(0, 0)] > 0.0 && minor > 0.0 && a.determinant() > 0.0;
    symmetric && positive && a.frobenius().is_finite()
}
