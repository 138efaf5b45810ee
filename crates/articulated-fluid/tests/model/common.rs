//! Random trees and states, dual numbers along curves, dense linear algebra and comparisons.

use core::ops::Range;

use articulated_fluid::{ArticulatedBody, Body, Configuration, Joint};
use dvi::{
    Context, ContinuousSystem, Derivatives, DiscreteLagrangian, Integrator, Lagrangian, State,
};
use lie::{
    AlgebraOver, DualOver, JET_DIRECTIONS, Jet, LieGroup, Mat3, Power, RealGroup, SO3, Scalar,
    Tangent, Vec3, VectorSpace,
};
use proptest::prelude::*;

/// Dual numbers, and dual numbers over them.
pub type J = <f64 as Scalar>::Jet;
pub type J2 = <J as Scalar>::Jet;
pub type Velocity<S = f64> = AlgebraOver<Configuration, S>;
pub type Momentum<S = f64> = DualOver<Configuration, S>;
pub type Matrix = Vec<Vec<f64>>;

/// A model with what it was made from, a state and a displacement.
#[derive(Clone, Debug)]
pub struct Sample {
    pub bodies: Vec<Body>,
    pub joints: Vec<Joint>,
    /// Gravity and the net mass of each body.
    pub weight: Option<(Vec3, Vec<f64>)>,
    /// Of each joint.
    pub stiffnesses: Vec<f64>,
    pub model: ArticulatedBody,
    pub g: Configuration,
    pub f: Configuration,
    pub xi: Velocity,
}

/// The model of these bodies, joints and weight.
pub fn build(
    bodies: &[Body],
    joints: &[Joint],
    weight: &Option<(Vec3, Vec<f64>)>,
) -> ArticulatedBody {
    let model = ArticulatedBody::new(bodies, joints).expect("a model");
    match weight {
        Some((gravity, masses)) => model.with_gravity(*gravity, masses).expect("a weight"),
        None => model,
    }
}

impl Sample {
    /// The same with other masses, weights or stiffnesses.
    pub fn rebuilt(mut self) -> Self {
        let model = build(&self.bodies, &self.joints, &self.weight);
        self.model = model.with_stiffness(&self.stiffnesses).expect("springs");
        self
    }

    /// The same without a fluid: each mass a number.
    pub fn dry(mut self) -> Self {
        for body in &mut self.bodies {
            body.mass = Mat3::diagonal([body.mass.trace() / 3.0; 3]);
        }
        self.rebuilt()
    }

    /// The momentum of the velocity.
    pub fn mu(&self) -> Momentum {
        let mu = self.model.legendre(0.0, &self.g, &self.xi);
        mu.expect("a velocity")
    }

    pub fn state(&self) -> State<Configuration> {
        let (g, mu) = (self.g.clone(), self.mu());
        State { t: 0.25, g, mu }
    }

    /// Gravity and net mass of each body; zero without a weight.
    pub fn weights(&self) -> (Vec3, Vec<f64>) {
        let none = || (Vec3::zero(), vec![0.0; self.bodies.len()]);
        self.weight.clone().unwrap_or_else(none)
    }

    /// The sum of the weights.
    pub fn force(&self) -> Vec3 {
        let (gravity, masses) = self.weights();
        gravity * masses.iter().sum::<f64>()
    }

    /// Whether nothing depends on where the whole is.
    pub fn floats(&self) -> bool {
        self.weights().1.iter().sum::<f64>() == 0.0
    }

    /// The centres from the first body on: $x_p + R_p d_{pi} - R_i d_{ip}$.
    pub fn centres<S: Scalar>(&self, (r, x, _): &Configuration<S>) -> Vec<Vec3<S>> {
        let mut centres = vec![x[0].vec3()];
        for joint in &self.joints {
            let on = r[joint.parent].rotate(joint.at_parent.lift());
            let back = r[joint.child].rotate(joint.at_child.lift());
            centres.push(centres[joint.parent] + on - back);
        }
        centres
    }

    /// $U = -\sum_i m_i \gamma \cdot x_i + \sum_i k_i (1 - \cos\theta_i)$.
    pub fn potential<S: Scalar>(&self, g: &Configuration<S>) -> S {
        let (gravity, masses) = self.weights();
        let weighed = masses.into_iter().zip(self.centres(g));
        let weight = weighed.fold(S::zero(), |sum, (m, x)| sum - (gravity * m).lift().dot(x));
        let elastic = self.joints.iter().zip(&self.stiffnesses);
        elastic.fold(weight, |sum, (joint, k)| {
            let turn = g.0[joint.parent].inverse().compose(&g.0[joint.child]);
            sum + (S::from_f64(3.0) - turn.matrix().trace()).times(0.5 * k)
        })
    }

    /// $\sum_i x_i \times m_i \gamma$: the moment of the weights about the origin.
    pub fn moment(&self) -> Vec3 {
        let (gravity, masses) = self.weights();
        let weighed = masses.into_iter().zip(self.centres(&self.g));
        weighed.fold(Vec3::zero(), |sum, (m, x)| sum + x.cross(gravity * m))
    }

    /// The velocity of each centre in the reference frame as a linear map of $\xi$, by its 3 rows:
    /// $\dot x_i = \dot x_p - R_p \hat d_{pi} \Omega_p + R_i \hat d_{ip} \Omega_i$.
    pub fn jacobians(&self) -> Vec<Matrix> {
        let (r, x) = (&self.g.0, translation(self.bodies.len()));
        let mut first = vec![vec![0.0; self.xi.dim()]; 3];
        (0..3).for_each(|k| first[k][x.start + k] = 1.0);
        let mut jacobians = vec![first];
        for joint in &self.joints {
            let mut rows = jacobians[joint.parent].clone();
            let on_parent = -(*r[joint.parent].matrix() * joint.at_parent.hat());
            let on_child = *r[joint.child].matrix() * joint.at_child.hat();
            for (body, block) in [(joint.parent, on_parent), (joint.child, on_child)] {
                for (k, row) in rows.iter_mut().enumerate() {
                    let row = &mut row[rates(body)];
                    (0..3).for_each(|j| row[j] += block[(k, j)]);
                }
            }
            jacobians.push(rows);
        }
        jacobians
    }

    /// The velocities of the centres in the reference frame.
    pub fn centre_velocities(&self) -> Vec<Vec3> {
        let xi = self.xi.coordinates();
        let velocity = |j: Matrix| product(&j, &xi).try_into().map(Vec3).expect("three rows");
        self.jacobians().into_iter().map(velocity).collect()
    }

    /// The inertia of any tree, $\sum_i V_i^T R_i M_i R_i^T V_i$ with the linear maps $V_i$, and each $J_i$ on the diagonal.
    pub fn inertia(&self) -> Matrix {
        let mut out = vec![vec![0.0; self.xi.dim()]; self.xi.dim()];
        let moving = self
            .bodies
            .iter()
            .zip(self.jacobians())
            .zip(self.g.0.iter());
        for (i, ((body, v), r)) in moving.enumerate() {
            let m = r.matrix().conjugate(body.mass);
            for (row, entries) in out.iter_mut().enumerate() {
                let momentum = [0, 1, 2].map(|k| (0..3).map(|l| v[l][row] * m[(l, k)]).sum());
                let momentum: [f64; 3] = momentum;
                for (column, entry) in entries.iter_mut().enumerate() {
                    *entry += (0..3).map(|k| momentum[k] * v[k][column]).sum::<f64>();
                }
            }
            let own = rates(i);
            for (k, row) in own.clone().enumerate() {
                (0..3).for_each(|l| out[row][own.start + l] += body.inertia[(k, l)]);
            }
        }
        out
    }
}

/// The coordinates of body `i`'s rotation.
pub fn rates(i: usize) -> Range<usize> {
    3 * i..3 * i + 3
}

/// The coordinates of the first body's translation: they come after all rotations.
pub fn translation(bodies: usize) -> Range<usize> {
    rates(bodies)
}

/// The element of a translation, or its velocity or momentum.
pub fn alone<X>(x: impl Into<X>) -> Power<X> {
    Power::new(vec![x.into()])
}

/// No hinges.
pub fn none<X>() -> Power<X> {
    Power::new(vec![])
}

/// The attitudes' matrices and the position.
pub fn entries((r, x, _): &Configuration) -> Vec<f64> {
    let attitudes = r.iter().flat_map(|r| r.matrix().0.concat());
    attitudes.chain(x[0].0).collect()
}

pub fn vector(size: f64) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-size..size).prop_map(Vec3)
}

/// $A A^T + 0.2$: symmetric, positive definite and full.
pub fn spd() -> impl Strategy<Value = Mat3> {
    prop::array::uniform3(prop::array::uniform3(-1.0..1.0))
        .prop_map(|a| Mat3(a).conjugate(Mat3::identity()) + Mat3::diagonal([0.2; 3]))
}

pub fn body() -> impl Strategy<Value = Body> {
    (spd(), spd()).prop_map(|(mass, inertia)| Body::new(mass, inertia))
}

/// Any rotation.
pub fn attitude() -> impl Strategy<Value = SO3> {
    let length = |q: &[f64; 4]| q.iter().map(|x| x * x).sum::<f64>().sqrt();
    prop::array::uniform4(-1.0..1.0)
        .prop_filter("a direction", move |q| length(q) > 0.1)
        .prop_map(SO3::from_quaternion)
}

/// How a tree branches.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// Each body is on any before it.
    Any,
    Chain,
    Star,
    /// A chain of the even bodies, an odd one on each.
    Comb,
}

impl Shape {
    /// The bodies that may carry body `i`.
    pub fn parents(self, i: usize) -> Range<usize> {
        match self {
            Self::Any => 0..i,
            Self::Chain => i - 1..i,
            Self::Star => 0..1,
            Self::Comb => i + i % 2 - 2..i + i % 2 - 1,
        }
    }
}

/// No weight; any; and one that the whole does not feel. The net masses' sums have no rounding.
fn weight(bodies: usize) -> impl Strategy<Value = Option<(Vec3, Vec<f64>)>> {
    let masses = prop::collection::vec((-64..64_i32).prop_map(|m| f64::from(m) / 64.0), bodies);
    (0..3_u8, vector(2.0), masses).prop_map(|(kind, gravity, mut masses)| {
        if kind == 1 {
            masses[0] -= masses.iter().sum::<f64>();
        }
        (kind > 0).then_some((gravity, masses))
    })
}

/// Free joints, and elastic ones among them.
pub fn stiffnesses(joints: usize) -> impl Strategy<Value = Vec<f64>> {
    let some = prop::collection::vec(prop_oneof![Just(0.0), 0.1..3.0], joints);
    prop_oneof![Just(vec![0.0; joints]), some]
}

/// A tree of `others` bodies beside the first. Attitudes anywhere, the displacement up to `size` in angle and length.
pub fn sample_of(shape: Shape, others: usize, size: f64) -> impl Strategy<Value = Sample> {
    let parents: Vec<_> = (1..=others).map(|i| shape.parents(i)).collect();
    let points = prop::collection::vec((vector(1.5), vector(1.5)), others);
    let displacement = move || vector(size / 3_f64.sqrt());
    let turns = prop::collection::vec(displacement().prop_map(|w| SO3::exp(&w.into())), others + 1);
    (
        prop::collection::vec(body(), others + 1),
        (parents, points, weight(others + 1), stiffnesses(others)),
        (vector(5.0), prop::collection::vec(attitude(), others + 1)),
        (displacement(), turns),
        (vector(1.0), prop::collection::vec(vector(1.0), others + 1)),
    )
        .prop_map(
            |(bodies, (parents, points, weight, stiffnesses), (x, r), (dx, f), (v, omega))| {
                let joint = |(i, (parent, (at_parent, at_child)))| Joint {
                    parent,
                    child: i + 1,
                    at_parent,
                    at_child,
                    kind: Default::default(),
                };
                let joints: Vec<_> = parents
                    .into_iter()
                    .zip(points)
                    .enumerate()
                    .map(joint)
                    .collect();
                let pose = |x: Vec3, r: Vec<SO3>| (Power::new(r), alone(x), none());
                Sample {
                    model: build(&bodies, &joints, &weight),
                    bodies,
                    joints,
                    weight,
                    stiffnesses,
                    g: pose(x, r),
                    f: pose(dx, f),
                    xi: (
                        omega.into_iter().map(Tangent::from).collect(),
                        alone(v),
                        Power::new(vec![]),
                    ),
                }
                .rebuilt()
            },
        )
}

/// Equal bodies on each other, bent and turning gently.
pub fn gentle(shape: Shape, bodies: usize) -> (ArticulatedBody, State<Configuration>) {
    let mass = Mat3::diagonal([1.0, 2.0, 2.0]);
    let inertia = Mat3::diagonal([0.1, 0.2, 0.2]);
    let joint = |child: usize| Joint {
        parent: shape.parents(child).start,
        child,
        at_parent: Vec3([0.6, 0.0, 0.0]),
        at_child: Vec3([-0.6, 0.0, 0.0]),
        kind: Default::default(),
    };
    let joints: Vec<_> = (1..bodies).map(joint).collect();
    let model = build(&vec![Body::new(mass, inertia); bodies], &joints, &None);
    let wave = |i: usize| {
        let phase = 0.7 * i as f64;
        Tangent([
            0.1 * phase.cos(),
            0.2 * phase.sin(),
            0.3 * (1.3 * phase).sin(),
        ])
    };
    let turns = (0..bodies).map(|i| SO3::exp(&wave(i))).collect();
    let rates = (0..bodies).map(|i| wave(i + 5)).collect();
    let (x, v) = (alone(Vec3::zero()), alone(Vec3([0.2, -0.1, 0.1])));
    let start = model.state(0.0, (turns, x, none()), &(rates, v, none()));
    (model, start.expect("a state"))
}

/// 1 to 5 bodies, displacements tiny and large.
pub fn any_sample() -> impl Strategy<Value = Sample> {
    (0..=4_usize, sizes()).prop_flat_map(|(others, size)| sample_of(Shape::Any, others, size))
}

/// The paper's three bodies: a star without a weight, on free joints.
pub fn three_bodies() -> impl Strategy<Value = Sample> {
    sizes().prop_flat_map(|size| {
        sample_of(Shape::Star, 2, size).prop_map(|sample| {
            Sample {
                weight: None,
                stiffnesses: vec![0.0; 2],
                ..sample
            }
            .rebuilt()
        })
    })
}

fn sizes() -> impl Strategy<Value = f64> {
    prop::sample::select(vec![1e-6, 1e-3, 0.1, 3.0])
}

/// The paper's notation for three bodies: $M_i$, $J_i$, $d_{0i}$ and $d_{i0}$ by the index $i$.
pub struct Paper {
    pub m: [Mat3; 3],
    pub j: [Mat3; 3],
    pub d_0: [Vec3; 3],
    pub d: [Vec3; 3],
}

impl Paper {
    pub fn new(sample: &Sample) -> Self {
        let [one, two] = [&sample.joints[0], &sample.joints[1]];
        Self {
            m: [0, 1, 2].map(|i| sample.bodies[i].mass),
            j: [0, 1, 2].map(|i| sample.bodies[i].inertia),
            d_0: [Vec3::zero(), one.at_parent, two.at_parent],
            d: [Vec3::zero(), one.at_child, two.at_child],
        }
    }

    /// The matrix (4), block by block, in the order of the model's coordinates.
    pub fn inertia(&self, r: [Mat3; 3]) -> Matrix {
        let Self { m, j, d_0, d } = self;
        let (r0, t) = (r[0], r.map(Mat3::transpose));
        let (hat_0, hat) = (d_0.map(Vec3::hat), d.map(Vec3::hat));
        let top = |i: usize| hat_0[i] * t[0] * r[i] * m[i] * t[i] * r0 * hat_0[i];
        let right = |i: usize| hat_0[i] * t[0] * r[i] * m[i] * t[i];
        let left = |i: usize| r[i] * m[i] * t[i] * r0 * hat_0[i];
        let mass = |i: usize| r[i] * m[i] * t[i];
        let zero = Mat3::zero();
        let blocks = [
            [
                j[0] - top(1) - top(2),
                right(1) + right(2),
                hat_0[1] * t[0] * r[1] * m[1] * hat[1],
                hat_0[2] * t[0] * r[2] * m[2] * hat[2],
            ],
            [
                -left(1) - left(2),
                mass(0) + mass(1) + mass(2),
                r[1] * m[1] * hat[1],
                r[2] * m[2] * hat[2],
            ],
            [
                hat[1] * m[1] * t[1] * r0 * hat_0[1],
                -(hat[1] * m[1] * t[1]),
                j[1] - hat[1] * m[1] * hat[1],
                zero,
            ],
            [
                hat[2] * m[2] * t[2] * r0 * hat_0[2],
                -(hat[2] * m[2] * t[2]),
                zero,
                j[2] - hat[2] * m[2] * hat[2],
            ],
        ];
        let entry = |row: usize, column: usize| {
            let block = blocks[PRINTED[row / 3]][PRINTED[column / 3]];
            block[(row % 3, column % 3)]
        };
        (0..12)
            .map(|row| (0..12).map(|column| entry(row, column)).collect())
            .collect()
    }
}

/// Where the print has the blocks of the model's coordinates: there the translation stands after the first rotation.
const PRINTED: [usize; 4] = [0, 2, 3, 1];

/// The matrices $R_0, R_1, R_2$ of a configuration or displacement of three bodies.
pub fn matrices(g: &Configuration) -> [Mat3; 3] {
    [0, 1, 2].map(|i| *g.0[i].matrix())
}

/// The model's coordinates of $(p_0, p_x, p_1, p_2)$.
pub fn stacked(blocks: [Vec3; 4]) -> Vec<f64> {
    PRINTED.iter().flat_map(|i| blocks[*i].0).collect()
}

/// $g \exp(\eta)$ to first order, with the dual directions from `first` on.
pub fn moved(g: &Configuration, first: usize) -> Configuration<J> {
    let g = g.lift::<J>();
    let mut eta = g.zero_algebra();
    lie::seed(&mut eta, first);
    g.compose(&LieGroup::cayley(&eta))
}

/// $x + \epsilon\,\dot x$, $\epsilon$ being the first dual direction.
pub fn along<V, W>(zero: &W, x: &V, dot: &V) -> W
where
    V: VectorSpace<Scalar = f64>,
    W: VectorSpace<Scalar = J>,
{
    let mut curve = zero.clone();
    for i in 0..x.dim() {
        let slope = J::constant(dot.get(i));
        curve.set(i, J::constant(x.get(i)) + J::variable(0.0, 0) * slope);
    }
    curve
}

/// The continuous flow through a state to first order: $\dot g = g\,\xi$, $\dot\mu = \mathrm{ad}^*_\xi \mu + \tau$.
pub fn flow(sample: &Sample) -> (Configuration<J>, Momentum<J>) {
    let (g, mu) = (&sample.g, sample.mu());
    let (xi, tau) = velocity_and_force::<f64>(&sample.model, g, &mu);
    let mut mu_dot = Configuration::coadjoint_bracket(&xi, &mu);
    mu_dot.add_scaled(1.0, &tau);
    let lifted = g.lift::<J>();
    let step: Velocity<J> = along(&lifted.zero_algebra(), &xi.zero_like(), &xi);
    let g = lifted.compose(&LieGroup::cayley(&step));
    (g, along(&lifted.zero_dual(), &mu, &mu_dot))
}

/// At the time zero, without parameters.
pub fn at_zero<S: Scalar>() -> Context<'static, S> {
    Context::new(S::zero(), &[])
}

/// $L$.
pub fn lagrangian<S: Scalar>(model: &ArticulatedBody, g: &Configuration<S>, xi: &Velocity<S>) -> S {
    Lagrangian::value(model, at_zero(), g, xi)
}

/// $L_d$.
pub fn action<S: Scalar>(
    model: &ArticulatedBody,
    g: &Configuration<S>,
    f: &Configuration<S>,
    h: S,
) -> S {
    DiscreteLagrangian::value(model, at_zero(), g, f, h)
}

/// Into storage filled with what must not survive.
pub fn velocity_and_force<S: Scalar>(
    model: &ArticulatedBody,
    g: &Configuration<S>,
    mu: &Momentum<S>,
) -> (Velocity<S>, Momentum<S>) {
    let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
    spoil(&mut xi);
    spoil(&mut tau);
    let mut work = Default::default();
    model.velocity_and_force::<S>(at_zero(), g, mu, &mut work, &mut xi, &mut tau);
    (xi, tau)
}

/// The closed derivatives, into storage filled with what must not survive.
pub fn closed<S: Scalar>(
    model: &ArticulatedBody,
    g: &Configuration<S>,
    f: &Configuration<S>,
    h: S,
) -> Derivatives<Configuration, S> {
    let mut out = Derivatives::new(g);
    spoil(&mut out.d_f);
    spoil(&mut out.d_g);
    model.derivatives(at_zero(), g, f, h, &mut Default::default(), &mut out);
    out
}

/// The derivatives by dual numbers.
pub fn by_jets<S: Scalar>(
    model: &ArticulatedBody,
    g: &Configuration<S>,
    f: &Configuration<S>,
    h: S,
) -> Derivatives<Configuration, S> {
    let mut out = Derivatives::new(g);
    out.by_jets(model, at_zero(), g, f, h);
    out
}

/// $\mathsf T_e^* \mathsf L_g \cdot \mathbf D_g L$ by dual numbers.
pub fn force_by_jets(sample: &Sample) -> Vec<f64> {
    let Sample { model, g, xi, .. } = sample;
    let still = along(&g.lift::<J>().zero_algebra(), xi, &xi.zero_like());
    let mut force = vec![];
    for first in (0..xi.dim()).step_by(JET_DIRECTIONS) {
        let value = lagrangian(model, &moved(g, first), &still);
        force.extend((0..JET_DIRECTIONS).map(|d| value.partial(d)));
    }
    force.truncate(xi.dim());
    force
}

/// Fills with NaN, so that a coordinate that is not written shows.
pub fn spoil<V: VectorSpace>(x: &mut V) {
    (0..x.dim()).for_each(|i| x.set(i, V::Scalar::from_f64(f64::NAN)));
}

/// The Hessian $\mathbf D^2_\xi L$ by dual numbers over dual numbers.
pub fn hessian(model: &ArticulatedBody, g: &Configuration, xi: &Velocity) -> Matrix {
    let (dim, lifted) = (xi.dim(), g.lift::<J2>());
    let mut out = vec![vec![f64::NAN; dim]; dim];
    for row in (0..dim).step_by(JET_DIRECTIONS) {
        for column in (0..dim).step_by(JET_DIRECTIONS) {
            let (mut inner, mut moved) = (g.lift::<J>().zero_algebra(), lifted.zero_algebra());
            lie::seed(&mut inner, column);
            lie::seed(&mut moved, row);
            for i in 0..dim {
                let x = inner.get(i) + J::constant(xi.get(i));
                moved.set(i, moved.get(i) + J2::constant(x));
            }
            let value = lagrangian(model, &lifted, &moved);
            for (d, entries) in out[row..].iter_mut().take(JET_DIRECTIONS).enumerate() {
                let entries = entries[column..].iter_mut().take(JET_DIRECTIONS);
                let slope = value.partial(d);
                entries.enumerate().for_each(|(e, x)| *x = slope.partial(e));
            }
        }
    }
    out
}

/// Solves $A x = b$ by Gauss's elimination with row pivoting.
pub fn solve(a: &Matrix, b: &[f64]) -> Vec<f64> {
    let (n, mut rows) = (b.len(), a.clone());
    rows.iter_mut().zip(b).for_each(|(row, b)| row.push(*b));
    for k in 0..n {
        let largest = (k..n).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs()));
        rows.swap(k, largest.expect("a row"));
        let (above, below) = rows.split_at_mut(k + 1);
        for row in below {
            let factor = row[k] / above[k][k];
            (k..=n).for_each(|j| row[j] -= factor * above[k][j]);
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| rows[k][j] * x[j]).sum();
        x[k] = (rows[k][n] - known) / rows[k][k];
    }
    x
}

/// $A x$.
pub fn product(a: &Matrix, x: &[f64]) -> Vec<f64> {
    let row = |row: &Vec<f64>| row.iter().zip(x).map(|(a, x)| a * x).sum();
    a.iter().map(row).collect()
}

/// The largest magnitude; NaN counts as infinite.
pub fn largest(x: &[f64]) -> f64 {
    let size = |x: &f64| if x.is_nan() { f64::INFINITY } else { x.abs() };
    x.iter().map(size).fold(0.0, f64::max)
}

pub fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Asserts that positions, attitudes and momenta differ by no more than `tolerance`, momenta relative to their norm.
#[track_caller]
pub fn assert_same(a: &State<Configuration>, b: &State<Configuration>, tolerance: f64) {
    assert_close(&entries(&a.g), &entries(&b.g), tolerance);
    let momenta = b.mu.coordinates();
    assert_close(&a.mu.coordinates(), &momenta, tolerance * norm(&momenta));
    assert!((a.t - b.t).abs() <= tolerance);
}

/// Asserts that no entry of `a` and `b` differs by more than `tolerance`.
#[track_caller]
pub fn assert_close(a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    let difference: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    let worst = largest(&difference);
    assert!(worst <= tolerance, "{worst:e} > {tolerance:e}: {a:?} {b:?}");
}

/// The state after so many steps of `h` seconds.
pub fn run(
    mut integrator: impl Integrator<Group = Configuration>,
    start: &State<Configuration>,
    (h, steps): (f64, u32),
) -> State<Configuration> {
    let mut state = start.clone();
    for _ in 0..steps {
        integrator.step(&mut state, h).expect("a step");
    }
    state
}
