//! A Lagrangian recorded once is the same system as by dual numbers.

use dvi::{
    Context, ContinuousSystem, Gauss, Integrator, Lagrangian, State, System, TracedError,
    TracedSystem,
};
use lie::{Jet, LieGroup, Power, RealGroup, Rn, SO3, Scalar, Tangent, Vec3, VectorSpace};

use crate::common::{Driven, Sinking, Top, distance, driven, sinking, top};
use crate::hamiltonian::Relativistic;

/// Two balls on a rod that swings: the first on a rail, its place and the rod's attitude; masses and gravity are parameters.
#[derive(Clone, Copy)]
struct Crane([f64; 3]);

impl System for Crane {
    type Group = (Rn<1>, SO3);

    fn parameters(&self) -> &[f64] {
        &self.0
    }
}

impl Lagrangian for Crane {
    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        (x, r): &(Rn<1, S>, SO3<S>),
        (v, w): &(Tangent<1, S>, Tangent<3, S>),
    ) -> S {
        let [cart, load, gravity] = at.parameters();
        let rod = Vec3([0.3, 0.0, -1.0]).lift();
        let along = Vec3([v[0], S::zero(), S::zero()]);
        let u = along + r.rotate(w.vec3().cross(rod));
        let turning = w.vec3().norm_squared() * S::from_f64(0.1);
        let spring = x.0[0] * x.0[0] * (S::one() + at.t.sin() * S::from_f64(0.2));
        (cart * v[0] * v[0] + load * u.dot(u) + turning - spring) * S::from_f64(0.5)
            + v[0] * x.0[0] * at.t.cos()
            - load * gravity * r.rotate(rod)[2]
    }
}

const CRANE: Crane = Crane([2.0, 0.7, 9.81]);

fn crane() -> State<(Rn<1>, SO3)> {
    let g = (Rn([0.4]), SO3::exp(&Tangent([0.5, -0.8, 0.3])));
    CRANE
        .state(0.6, g, &(Tangent([0.7]), Tangent([1.0, -0.4, 0.2])))
        .unwrap()
}

/// The largest difference of velocities and forces, over any scalar.
fn apart<L: Lagrangian + Copy, S: Scalar>(
    lagrangian: L,
    state: &State<L::Group>,
    mu_of: impl Fn(usize, f64) -> S,
) -> f64 {
    let traced = TracedSystem::new(&lagrangian, &state.g).unwrap();
    let by_duals = lagrangian.hamiltonian();
    let g = state.g.lift::<S>();
    let mut mu = g.zero_dual();
    (0..mu.dim()).for_each(|i| mu.set(i, mu_of(i, state.mu.get(i))));
    let parameters: Vec<S> = lagrangian
        .parameters()
        .iter()
        .map(|p| S::from_f64(*p))
        .collect();
    let at = Context::new(S::from_f64(state.t), &parameters);
    let [mut one, mut two] = [(); 2].map(|()| (g.zero_algebra(), g.zero_dual()));
    traced.velocity_and_force::<S>(at, &g, &mu, &mut Default::default(), &mut one.0, &mut one.1);
    by_duals.velocity_and_force::<S>(at, &g, &mu, &mut Default::default(), &mut two.0, &mut two.1);
    let xi = (0..mu.dim()).map(|i| (one.0.get(i) - two.0.get(i)).magnitude());
    let tau = (0..mu.dim()).map(|i| (one.1.get(i) - two.1.get(i)).magnitude());
    xi.chain(tau)
        .fold(0.0, |max, d| if d <= max { max } else { d })
}

/// Rounding of some hundred operations on numbers of size ten.
const ROUNDING: f64 = 1e-13;

fn agrees<L: Lagrangian + Copy>(lagrangian: L, state: &State<L::Group>) {
    assert!(apart(lagrangian, state, |_, mu| mu) < ROUNDING);
    type J = <f64 as Scalar>::Jet;
    let moving = |i: usize, mu: f64| J::variable(mu, i % lie::JET_DIRECTIONS);
    assert!(apart(lagrangian, state, moving) < ROUNDING);
}

#[test]
fn velocity_and_force_are_those_by_dual_numbers() {
    agrees(Top, &top());
    agrees(Sinking, &sinking());
    agrees(CRANE, &crane());
}

#[test]
fn steps_are_those_by_dual_numbers() {
    let traced = TracedSystem::new(&Top, &top().g).unwrap();
    let (mut one, mut two) = (top(), top());
    let (mut fast, mut slow) = (Gauss::new::<4>(traced), Gauss::new::<4>(Top.hamiltonian()));
    for _ in 0..50 {
        fast.step(&mut one, 0.02).unwrap();
        slow.step(&mut two, 0.02).unwrap();
    }
    // Fifty solutions to rounding.
    assert!(distance(&one, &two) < 1e-12);
}

/// Two tops beside each other, as many as are told at run time.
#[derive(Clone, Copy)]
struct Tops;

impl System for Tops {
    type Group = Power<SO3>;
}

impl Lagrangian for Tops {
    fn value<S: Scalar>(&self, at: Context<S>, g: &Power<SO3<S>>, xi: &Power<Tangent<3, S>>) -> S {
        let tops = g.iter().zip(xi.iter());
        tops.fold(S::zero(), |sum, (g, xi)| sum + Top.value(at, g, xi))
    }
}

#[test]
fn another_size_gives_no_numbers() {
    let state = |n: usize| {
        Tops.state(
            0.0,
            Power::new(vec![top().g; n]),
            &Power::new(vec![Tangent([0.1, 0.2, 0.3]); n]),
        )
        .unwrap()
    };
    agrees(Tops, &state(2));
    let system = TracedSystem::new(&Tops, &state(2).g).unwrap();
    let mut work = Default::default();
    let mut finite = |n: usize| {
        let State { t, g, mu } = state(n);
        let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
        system.velocity_and_force::<f64>(
            Context::new(t, &[]),
            &g,
            &mu,
            &mut work,
            &mut xi,
            &mut tau,
        );
        xi.max_magnitude().is_finite() && tau.max_magnitude().is_finite()
    };
    assert_eq!([2, 3, 1, 2].map(&mut finite), [true, false, false, true]);
}

#[test]
fn what_is_not_quadratic_is_refused() {
    let refused = TracedSystem::new(&Relativistic, &Rn([0.0])).err();
    assert_eq!(refused, Some(TracedError::NotQuadratic { coordinate: 0 }));
    let refused = TracedSystem::new(&Driven, &driven().g).err();
    assert_eq!(refused, Some(TracedError::NotQuadratic { coordinate: 0 }));
}

/// Inertia of the wrong sign has pivots that are not positive: no elimination goes on in silence.
#[derive(Clone, Copy)]
struct Indefinite;

impl System for Indefinite {
    type Group = Rn<2>;
}

impl Lagrangian for Indefinite {
    fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<2, S>, v: &Tangent<2, S>) -> S {
        x.0[0] * v[0] * v[0] + v[0] * v[1] + v[1] * v[1]
    }
}

#[test]
fn where_the_inertia_is_not_positive_there_is_no_velocity() {
    let system = TracedSystem::new(&Indefinite, &Rn([1.0, 0.0])).unwrap();
    let velocity = |x: f64| {
        let (mut xi, mut tau) = (Tangent([0.0; 2]), lie::Cotangent([0.0; 2]));
        let (g, mu) = (Rn([x, 0.0]), lie::Cotangent([1.0, 2.0]));
        system.velocity_and_force::<f64>(
            Context::new(0.0, &[]),
            &g,
            &mu,
            &mut Default::default(),
            &mut xi,
            &mut tau,
        );
        xi
    };
    assert!(velocity(1.0).max_magnitude().is_finite());
    assert!(velocity(-1.0).max_magnitude().is_nan());
    assert!(velocity(0.1).max_magnitude().is_nan());
}
