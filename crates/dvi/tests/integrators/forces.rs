//! Discrete Lagrange–d'Alembert: decay at the method's order, and what a force keeps.

use dvi::{
    Adjoint, Composition, Context, DiscreteForce, Discretised, FirstVariation, Force, Forced,
    Gauss, Integrator, Lagrangian, Quadrature, State, System, Variation, Variational, laws,
};
use lie::{Cotangent, LieGroup, Mat3, SO3, Scalar, Tangent, Vec3, VectorSpace};

use crate::common::{self, Brake, Top, distance, top};

const DRAG: f64 = 0.3;
const UNTIL: f64 = 2.0;

fn damped(rule: Quadrature, steps: u32) -> State<SO3> {
    let system = Top.discretise(rule).with_force(Brake(DRAG));
    let (mut state, mut integrator) = (top(), Variational::new(system));
    for _ in 0..steps {
        integrator
            .step(&mut state, UNTIL / f64::from(steps))
            .unwrap();
    }
    state
}

fn energy(state: &State<SO3>) -> f64 {
    Top.hamiltonian().energy(state)
}

/// The damped top by classical Runge–Kutta on the matrix and the velocity, written apart.
fn reference() -> f64 {
    type Y = ([Vec3; 3], Vec3);
    let j = Mat3::diagonal(common::INERTIA);
    let rate = |(rows, m): &Y| -> Y {
        let omega = j.inverse() * *m;
        let torque = rows[2].cross(common::LEVER) - omega * DRAG;
        // Row i of R hat(omega).
        (rows.map(|row| row.cross(omega)), m.cross(omega) + torque)
    };
    let add = |(r, m): &Y, (dr, dm): &Y, a: f64| -> Y {
        ([0, 1, 2].map(|i| r[i] + dr[i] * a), *m + *dm * a)
    };
    let start = top();
    let mut y = ([0, 1, 2].map(|i| start.g.matrix().row(i)), start.mu.vec3());
    let (n, h) = (20_000, UNTIL / 20_000.0);
    for _ in 0..n {
        let a = rate(&y);
        let b = rate(&add(&y, &a, h / 2.0));
        let c = rate(&add(&y, &b, h / 2.0));
        let d = rate(&add(&y, &c, h));
        for (k, weight) in [(a, 1.0), (b, 2.0), (c, 2.0), (d, 1.0)] {
            y = add(&y, &k, h * weight / 6.0);
        }
    }
    0.5 * y.1.dot(j.inverse() * y.1) + y.0[2].dot(common::LEVER)
}

fn decay(rule: Quadrature, exact: f64) {
    let error = |steps| (energy(&damped(rule, steps)) - exact).abs();
    let (coarse, fine) = (error(200), error(1600));
    let order = (coarse / fine).log2() / 3.0;
    println!(
        "{}: energy error {coarse:.2e} -> {fine:.2e}, order {order:.3}",
        rule.name()
    );
    assert!((order - f64::from(rule.order())).abs() < 0.1, "{order}");
}

#[test]
fn the_energy_decays_at_the_method_s_order() {
    let exact = reference();
    let start = energy(&top());
    assert!(exact < 0.9 * start, "the brake brakes: {start} -> {exact}");
    for rule in Quadrature::ALL {
        decay(rule, exact);
    }
}

#[test]
fn a_forced_step_is_of_its_order_reversible_and_not_symplectic() {
    let system = Top.discretise(Quadrature::Midpoint).with_force(Brake(DRAG));
    let integrator = || Variational::new(system);
    laws::check_order(integrator, &top(), 1.0, &[64, 128, 256]).unwrap();
    laws::check_step(&mut integrator(), &system, &[top()], 0.05).unwrap();
    laws::check_reversibility(&mut integrator(), &[top()], 0.05).unwrap();
    assert!(!integrator().is_symplectic());
    let defect = laws::symplectic_defect(&mut integrator(), &top(), 0.05).unwrap();
    // The form decays with the drag: by h times the drag over the inertia.
    assert!((1e-3..1e-1).contains(&defect), "{defect:e}");
}

/// Without a force, and as a force in place of a potential, the motion is the same.
#[test]
fn a_potential_is_a_force() {
    #[derive(Clone, Copy)]
    struct Free;
    impl System for Free {
        type Group = SO3;
    }

    impl Lagrangian for Free {
        fn value<S: Scalar>(&self, _: Context<S>, _: &SO3<S>, omega: &Tangent<3, S>) -> S {
            let j = Mat3::diagonal(common::INERTIA).lift::<S>();
            omega.vec3().dot(j * omega.vec3()) * S::from_f64(0.5)
        }
    }
    struct Weight;
    impl Force for Weight {
        type Group = SO3;
        fn force<S: Scalar>(
            &self,
            _: Context<S>,
            r: &SO3<S>,
            _: &Tangent<3, S>,
            out: &mut Cotangent<3, S>,
        ) {
            *out = r.matrix().row(2).cross(common::LEVER.lift()).into();
        }
    }
    // At the ends of the step a force is a gradient to the last bit; in the middle to the order.
    for (apart, tolerance) in [
        (pair(Quadrature::LeftPoint), 1e-12),
        (pair(Quadrature::Trapezoid), 1e-12),
        (pair(Quadrature::Midpoint), 1e-4),
    ] {
        assert!(apart < tolerance, "{apart:e}");
    }
    fn pair(rule: Quadrature) -> f64 {
        let mut by_force = Variational::new(Free.discretise(rule).with_force(Weight));
        let mut by_potential = Variational::new(Top.discretise(rule));
        let (mut a, mut b) = (top(), top());
        for _ in 0..100 {
            by_force.step(&mut a, 0.01).unwrap();
            by_potential.step(&mut b, 0.01).unwrap();
        }
        distance(&a, &b)
    }
}

/// Two bodies that brake each other: no torque on the whole.
#[derive(Clone, Copy)]
struct Pair;

impl System for Pair {
    type Group = (SO3, SO3);
}

impl Lagrangian for Pair {
    fn value<S: Scalar>(
        &self,
        _: Context<S>,
        _: &(SO3<S>, SO3<S>),
        xi: &(Tangent<3, S>, Tangent<3, S>),
    ) -> S {
        let j = Mat3::diagonal(common::INERTIA).lift::<S>();
        let twice = xi.0.vec3().dot(j * xi.0.vec3()) + xi.1.vec3().dot(j * xi.1.vec3());
        twice * S::from_f64(0.5)
    }
}

impl Force for Pair {
    type Group = (SO3, SO3);
    fn force<S: Scalar>(
        &self,
        _: Context<S>,
        (a, b): &(SO3<S>, SO3<S>),
        xi: &(Tangent<3, S>, Tangent<3, S>),
        out: &mut (Cotangent<3, S>, Cotangent<3, S>),
    ) {
        let relative = b.rotate(xi.1.vec3()) - a.rotate(xi.0.vec3());
        let torque = relative * S::from_f64(DRAG);
        *out = (
            a.inverse_rotate(torque).into(),
            (-b.inverse_rotate(torque)).into(),
        );
    }
}

fn keeps_the_total(rule: Quadrature) {
    let g = (
        SO3::exp(&Tangent([0.3, 0.2, 0.1])),
        SO3::exp(&Tangent([-1.0, 0.5, 0.0])),
    );
    let mut state = Pair
        .state(
            0.0,
            g,
            &(Tangent([1.0, 0.2, -0.5]), Tangent([0.1, -2.0, 0.3])),
        )
        .unwrap();
    let force = Discretised::new(Pair, rule);
    let system = Forced::new(Pair.discretise(rule), force);
    let mut integrator = Variational::new(system);
    let total = |s: &State<(SO3, SO3)>| s.g.0.rotate(s.mu.0.vec3()) + s.g.1.rotate(s.mu.1.vec3());
    let (start, mut residual) = (total(&state), 0.0_f64);
    let energy = Pair.hamiltonian().energy(&state);
    for _ in 0..2000 {
        residual = residual.max(integrator.step(&mut state, 0.01).unwrap().residual);
    }
    assert!(Pair.hamiltonian().energy(&state) < 0.8 * energy);
    // A random walk of rounding, 10 eps sqrt(N).
    let drift = (total(&state) - start).norm() / start.norm();
    println!("{}: total momentum {drift:.1e}", rule.name());
    assert!(drift < 10.0 * f64::EPSILON * 2000_f64.sqrt(), "{drift:e}");
}

#[test]
fn an_internal_force_keeps_the_total_momentum() {
    for rule in Quadrature::ALL {
        keeps_the_total(rule);
    }
}

/// A torque across the spin, which writes over what it is given or adds to it; and as impulses.
#[derive(Clone, Copy)]
struct Torque {
    adds: bool,
}

impl Torque {
    fn put<S: Scalar>(&self, torque: Cotangent<3, S>, out: &mut Cotangent<3, S>) {
        assert_eq!(out.max_magnitude(), 0.0, "it comes in as zero");
        if self.adds {
            out.add_scaled(S::one(), &torque);
        } else {
            *out = torque;
        }
    }
}

fn across<S: Scalar>(omega: Vec3<S>) -> Vec3<S> {
    (common::LEVER.lift().cross(omega) - omega) * S::from_f64(DRAG)
}

impl Force for Torque {
    type Group = SO3;

    fn force<S: Scalar>(
        &self,
        _: Context<S>,
        _: &SO3<S>,
        omega: &Tangent<3, S>,
        out: &mut Cotangent<3, S>,
    ) {
        self.put(across(omega.vec3()).into(), out);
    }
}

impl DiscreteForce for Torque {
    type Group = SO3;
    type Workspace<S: Scalar> = ();

    fn impulses<S: Scalar>(
        &self,
        _: Context<S>,
        _: &SO3<S>,
        f: &SO3<S>,
        h: S,
        (): &mut (),
        [minus, plus]: [&mut Cotangent<3, S>; 2],
    ) {
        let turned = f.minus_identity().skew_vee();
        self.put((across(turned) * S::from_f64(0.3)).into(), minus);
        self.put((across(turned) * (S::from_f64(0.5) + h)).into(), plus);
    }
}

/// Fifty steps of the top and of its variations, which evaluate forces over dual numbers too.
fn carried(mut integrator: impl FirstVariation<Group = SO3>) -> (State<SO3>, Vec<Variation<SO3>>) {
    let (mut state, mut columns) = (top(), Variation::basis(&top().g));
    for _ in 0..50 {
        integrator
            .step_varied(&mut state, &mut columns, 0.05)
            .unwrap();
    }
    (state, columns)
}

#[test]
fn a_force_comes_in_as_zero() {
    let by_every_adapter = |adds: bool| {
        let force = Torque { adds };
        let mut runs = vec![];
        for rule in Quadrature::ALL {
            let forced = Top.discretise(rule).with_force(force);
            let twice = Forced::new(forced, force);
            runs.push(carried(Variational::new(forced)));
            runs.push(carried(Variational::new(twice)));
            runs.push(carried(Variational::new(Adjoint(forced))));
            runs.push(carried(Composition::new::<4>(forced)));
        }
        let forced = || Forced::new(Top.hamiltonian(), force);
        runs.push(carried(Gauss::new::<3>(forced())));
        runs.push(carried(Gauss::new::<3>(Forced::new(forced(), force))));
        runs
    };
    assert_eq!(by_every_adapter(true), by_every_adapter(false));
}
