//! What wraps a discrete Lagrangian hands its inertia on: the same steps, and none over dual numbers.

use std::cell::Cell;
use std::ops::Range;

use dvi::{
    Adjoint, Composition, Context, Derivatives, DiscreteLagrangian, Discretised, Force, Forced,
    Integrator, Quadrature, State, System, Variational, laws,
};
use lie::{AlgebraOver, Cotangent, DualOver, LieGroup, Mat3, Over, R3, SO3, Scalar, Tangent, Vec3};

use crate::common::{INERTIA, distance};

type Group = (SO3, R3);

/// Added masses along the body's axes, kg: the block of the cyclic coordinates turns with the body.
const MASS: [f64; 3] = [1.0, 3.0, 2.0];
/// The point whose velocity they belong to, from the body's origin in its own frame, m: position and attitude are coupled.
const OFFSET: Vec3 = Vec3([0.5, -0.3, 0.2]);

/// A free body in a fluid, $L_d = \frac{1}{2h} |R^T \Delta x + (F - I) o|^2_M + \frac1h \mathrm{tr}[(I - F) J_d]$, whose position is
/// cyclic: derivatives and inertia by hand. It counts what is asked of it.
#[derive(Default)]
struct Body {
    factorised: Cell<u32>,
    solved: Cell<u32>,
    over_duals: Cell<u32>,
}

fn count(counter: &Cell<u32>) {
    counter.set(counter.get() + 1);
}

fn jd() -> Mat3 {
    let trace: f64 = INERTIA.iter().sum();
    Mat3::diagonal(INERTIA.map(|j| 0.5 * trace - j))
}

impl Body {
    fn look<S: Scalar>(&self) {
        if S::DUAL_LEVELS > 0 {
            count(&self.over_duals);
        }
    }
}

/// How far the point with the mass has moved, in the body's frame.
fn moved<S: Scalar>(g: &Over<Group, S>, f: &Over<Group, S>) -> Vec3<S> {
    g.0.inverse_rotate(f.1.vec3()) + f.0.minus_identity() * OFFSET.lift()
}

impl System for Body {
    type Group = Group;

    fn cyclic(&self) -> Range<usize> {
        3..6
    }
}

impl DiscreteLagrangian for Body {
    /// The attitude of which the inertia is factorised.
    type Workspace<S: Scalar> = Option<SO3>;
    const HAS_INERTIA: bool = true;

    fn value<S: Scalar>(&self, _: Context<S>, g: &Over<Group, S>, f: &Over<Group, S>, h: S) -> S {
        self.look::<S>();
        let moved = moved(g, f);
        let turning = -(f.0.symmetric_minus_identity() * jd().lift()).trace();
        (moved.dot(Mat3::diagonal(MASS).apply(moved)).times(0.5) + turning) / h
    }

    fn derivatives<S: Scalar>(
        &self,
        _: Context<S>,
        g: &Over<Group, S>,
        f: &Over<Group, S>,
        h: S,
        _: &mut Option<SO3>,
        out: &mut Derivatives<Group, S>,
    ) {
        self.look::<S>();
        let rate = S::one() / h;
        let momentum = Mat3::diagonal(MASS).apply(moved(g, f)) * rate;
        let spin = (jd().lift() * f.0.minus_identity()).skew_vee() * rate;
        let lever = OFFSET.lift().cross(f.0.inverse_rotate(momentum));
        out.d_f = ((spin + lever).into(), g.0.rotate(momentum).into());
        let torque = momentum.cross(g.0.inverse_rotate(f.1.vec3()));
        out.d_g = (torque.into(), Cotangent::zero());
    }

    fn factorise(&self, _: (f64, f64), g: &Group, work: &mut Option<SO3>) {
        count(&self.factorised);
        *work = Some(g.0);
    }

    fn solve(
        &self,
        work: &mut Option<SO3>,
        mu: &DualOver<Group, f64>,
        xi: &mut AlgebraOver<Group, f64>,
    ) {
        count(&self.solved);
        let r = work.expect("factorised before");
        let momentum = r.inverse_rotate(mu.1.vec3());
        let spin = mu.0.vec3() - OFFSET.cross(momentum);
        let omega = Mat3::diagonal(INERTIA.map(|j| 1.0 / j)) * spin;
        let velocity = Mat3::diagonal(MASS.map(|m| 1.0 / m)) * momentum - omega.cross(OFFSET);
        *xi = (omega.into(), r.rotate(velocity).into());
    }

    fn solve_cyclic(
        &self,
        work: &mut Option<SO3>,
        mu: &DualOver<Group, f64>,
        xi: &mut AlgebraOver<Group, f64>,
    ) {
        count(&self.solved);
        let r = work.expect("factorised before");
        let momentum = r.inverse_rotate(mu.1.vec3());
        let velocity = Mat3::diagonal(MASS.map(|m| 1.0 / m)) * momentum;
        *xi = (Tangent::zero(), r.rotate(velocity).into());
    }
}

/// The same body, of which only the value is known.
#[derive(Clone, Copy)]
struct ByValue<'a>(&'a Body);

impl System for ByValue<'_> {
    type Group = Group;

    fn cyclic(&self) -> Range<usize> {
        self.0.cyclic()
    }
}

impl DiscreteLagrangian for ByValue<'_> {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(&self, at: Context<S>, g: &Over<Group, S>, f: &Over<Group, S>, h: S) -> S {
        self.0.value(at, g, f, h)
    }
}

/// A drag on rotation and translation, of so many N m s and kg/s, on a body that counts.
#[derive(Clone, Copy)]
struct Drag<'a>(f64, &'a Body);

impl Force for Drag<'_> {
    type Group = Group;

    fn force<S: Scalar>(
        &self,
        _: Context<S>,
        _: &Over<Group, S>,
        xi: &AlgebraOver<Group, S>,
        out: &mut DualOver<Group, S>,
    ) {
        self.1.look::<S>();
        out.0 = Cotangent(xi.0.0.map(|x| x.times(-self.0)));
        out.1 = Cotangent(xi.1.0.map(|x| x.times(-self.0)));
    }
}

fn start() -> State<Group> {
    State {
        t: 0.0,
        g: (
            SO3::exp(&Tangent([0.4, -1.0, 0.3])),
            R3::from(Vec3([1.0, 2.0, 3.0])),
        ),
        mu: (Cotangent([0.4, -0.9, 2.0]), Cotangent([0.5, -0.2, 0.3])),
    }
}

#[test]
fn the_body_is_right_by_hand() {
    let body = Body::default();
    for h in [0.05, -0.02] {
        laws::check(&body, &[start()], h).unwrap_or_else(|e| panic!("{e}"));
    }
    // The inertia is that of short steps: in the direction of a velocity it answers with the momentum.
    let (State { g, mu, .. }, h) = (start(), 1e-6);
    let (mut work, mut xi) = (None, g.zero_algebra());
    body.factorise((0.0, h), &g, &mut work);
    body.solve(&mut work, &mu, &mut xi);
    let f = Group::exp(&(xi.0 * h, xi.1 * h));
    let again = dvi::legendre_plus(&body, 0.0, &g, &f, h);
    assert!((again.0.vec3() - mu.0.vec3()).norm() < 10.0 * h);
    assert!((again.1.vec3() - mu.1.vec3()).norm() < 10.0 * h);
}

const STEPS: u32 = 200;
const H: f64 = 0.01;

fn run(integrator: &mut impl Integrator<Group = Group>) -> State<Group> {
    let mut state = start();
    for _ in 0..STEPS {
        let step = integrator.step(&mut state, H);
        step.unwrap_or_else(|e| panic!("{e}"));
    }
    state
}

/// Steps by the inertia that the adapter hands on, and by Newton's matrix of the value alone.
fn solves_by_its_inertia(
    body: &Body,
    mut by_hand: impl Integrator<Group = Group>,
    mut by_value: impl Integrator<Group = Group>,
) {
    let counters = [&body.factorised, &body.solved, &body.over_duals];
    counters.iter().for_each(|counter| counter.set(0));
    let end = run(&mut by_hand);
    let [factorised, solved, over_duals] = counters.map(Cell::get);
    println!("{factorised} factorisations, {solved} solves, {over_duals} over duals");
    assert!(factorised >= STEPS && solved >= STEPS);
    assert_eq!(over_duals, 0);
    let apart = distance(&end, &run(&mut by_value));
    println!("apart from the value alone: {apart:.1e}");
    // The value alone knows no inertia.
    assert_eq!(body.factorised.get(), factorised);
    // Each of the steps is solved to 1e-13.
    assert!(apart < f64::from(STEPS) * 1e-13, "{apart:e}");
}

#[test]
fn a_force_keeps_the_inertia() {
    let body = Body::default();
    for rule in Quadrature::ALL {
        let drag = Discretised::new(Drag(0.3, &body), rule);
        solves_by_its_inertia(
            &body,
            Variational::new(Forced::new(&body, drag)),
            Variational::new(Forced::new(ByValue(&body), drag)),
        );
    }
}

#[test]
fn an_adjoint_keeps_the_inertia() {
    let body = Body::default();
    solves_by_its_inertia(
        &body,
        Variational::new(Adjoint(&body)),
        Variational::new(Adjoint(ByValue(&body))),
    );
}

#[test]
fn a_composition_keeps_the_inertia() {
    let body = Body::default();
    solves_by_its_inertia(
        &body,
        Composition::new::<4>(&body),
        Composition::new::<4>(ByValue(&body)),
    );
}

#[test]
fn all_unknowns_are_solved_to_the_same_steps() {
    let body = Body::default();
    solves_by_its_inertia(
        &body,
        Variational::new(&body).with_all_unknowns(),
        Variational::new(ByValue(&body)),
    );
    solves_by_its_inertia(
        &body,
        Composition::new::<4>(&body).with_all_unknowns(),
        Composition::new::<4>(ByValue(&body)),
    );
}

/// The momenta of the whole in space, which the exchange between position and attitude keeps.
fn momenta(state: &State<Group>) -> [Vec3; 2] {
    let (linear, spin) = (state.mu.1.vec3(), state.g.0.rotate(state.mu.0.vec3()));
    [linear, state.g.1.vec3().cross(linear) + spin]
}

fn keeps_its_momenta(mut integrator: impl Integrator<Group = Group>) {
    const STEPS: u32 = 2000;
    let (mut state, mut residual) = (start(), 0.0_f64);
    for _ in 0..STEPS {
        residual = residual.max(integrator.step(&mut state, H).unwrap().residual);
    }
    assert!(residual > 1e-9, "the tolerance was not used: {residual:e}");
    let ([linear, angular], [linear_before, angular_before]) = (momenta(&state), momenta(&start()));
    let drift = [
        (linear - linear_before).norm() / linear_before.norm(),
        (angular - angular_before).norm() / angular_before.norm(),
    ];
    println!("residual {residual:.1e}, momenta {drift:?}");
    // A random walk of rounding, 10 eps sqrt(N).
    let rounding = 10.0 * f64::EPSILON * f64::from(STEPS).sqrt();
    assert!(drift.iter().all(|drift| *drift < rounding), "{drift:?}");
}

/// Loose tolerance, tight cyclic equations, by the block of the inertia that the adapters hand on.
#[test]
fn momenta_do_not_feel_the_tolerance() {
    const TOLERANCE: f64 = 1e-6;
    let body = Body::default();
    keeps_its_momenta(Variational::new(&body).with_tolerance(TOLERANCE));
    keeps_its_momenta(Variational::new(Adjoint(&body)).with_tolerance(TOLERANCE));
    keeps_its_momenta(Composition::new::<4>(&body).with_tolerance(TOLERANCE));
}
