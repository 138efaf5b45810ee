//! Which of the two ways an integrator takes, and that it says so.

use dvi::{
    Cause, Composition, Context, ContinuousSystem, Derivatives, DiscreteLagrangian, DualSystem,
    Gauss, Integrator, Lagrangian, Means, Quadrature, State, System, TracedError, TracedSystem,
    Variational,
};
use lie::{Cotangent, LieGroup, Mat3, Over, Rn, SO3, Scalar, Tangent, Vec3};
use trace::TraceError;

/// A heavy top.
#[derive(Clone, Copy)]
pub struct Top;

impl System for Top {
    type Group = SO3;
}

impl Lagrangian for Top {
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, w: &Tangent<3, S>) -> S {
        let kinetic = w[0] * w[0] + w[1] * w[1] * S::from_f64(2.0) + w[2] * w[2] * S::from_f64(2.5);
        kinetic.times(0.5) - r.rotate(Vec3([0.1, 0.2, 0.7]).lift())[2]
    }
}

pub fn top() -> State<SO3> {
    let turn = SO3::exp(&Tangent([0.4, -0.8, 0.3]));
    Top.state(0.0, turn, &Tangent([0.3, -0.5, 1.0])).unwrap()
}

/// A particle whose potential is chosen by a look at its place.
#[derive(Clone, Copy)]
pub struct Branching;

impl System for Branching {
    type Group = Rn<1>;
}

impl Lagrangian for Branching {
    fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
        let stiffness = if x.0[0].magnitude() > 1.0 { 2.0 } else { 1.0 };
        (v[0] * v[0] - x.0[0] * x.0[0] * S::from_f64(stiffness)).times(0.5)
    }
}

fn still() -> State<Rn<1>> {
    State {
        t: 0.0,
        g: Rn([0.5]),
        mu: Cotangent([0.1]),
    }
}

#[test]
fn what_can_be_recorded_is() {
    for report in [
        Gauss::new::<3>(Top.hamiltonian()).step(&mut top(), 0.01),
        Variational::new(Top.discretise(Quadrature::Midpoint)).step(&mut top(), 0.01),
        Variational::new(Top.discretise(Quadrature::LeftPoint)).step(&mut top(), 0.01),
        Composition::new::<4>(Top.discretise(Quadrature::LeftPoint)).step(&mut top(), 0.01),
        Variational::new(Body(1.0)).step(&mut top(), 0.01),
    ] {
        assert_eq!(report.unwrap().means, Means::Recorded);
    }
    let by_duals = Gauss::new::<3>(DualSystem(Top))
        .step(&mut top(), 0.01)
        .unwrap();
    assert_eq!(by_duals.means, Means::DualNumbers { why: None });
}

#[test]
fn a_branch_on_a_value_is_left_to_dual_numbers_and_told() {
    for report in [
        Gauss::new::<3>(Branching.hamiltonian()).step(&mut still(), 0.01),
        Variational::new(Branching.discretise(Quadrature::Midpoint)).step(&mut still(), 0.01),
    ] {
        let Means::DualNumbers { why: Some(why) } = report.unwrap().means else {
            panic!("it branches");
        };
        assert!(matches!(why, TracedError::Trace(TraceError::Branch { .. })));
        let told = Means::DualNumbers { why: Some(why) }.to_string();
        assert!(told.contains("means.rs"), "{told}");
    }
    let refused = TracedSystem::new(&Branching, &still().g).err();
    assert!(matches!(refused, Some(TracedError::Trace(_))));
}

/// A metric of mixed signs.
#[derive(Clone, Copy)]
struct Indefinite;

impl System for Indefinite {
    type Group = Rn<2>;
}

impl Lagrangian for Indefinite {
    fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<2, S>, v: &Tangent<2, S>) -> S {
        (v[0] * v[0] - v[1] * v[1]).times(0.5) - x.0[0] * x.0[0] + x.0[1] * x.0[1]
    }
}

#[test]
fn an_inertia_with_negative_pivots_is_left_to_dual_numbers() {
    let system = Indefinite.hamiltonian();
    let mut state = State {
        t: 0.0,
        g: Rn([0.3, 0.2]),
        mu: Cotangent([0.1, 0.4]),
    };
    let mut other = state.clone();
    let report = Gauss::new::<3>(system).step(&mut state, 0.1).unwrap();
    let why = Some(TracedError::Indefinite { coordinate: 1 });
    assert_eq!(report.means, Means::DualNumbers { why });
    let by_duals = Gauss::new::<3>(DualSystem(Indefinite))
        .step(&mut other, 0.1)
        .unwrap();
    assert_eq!((state, report.iterations), (other, by_duals.iterations));
    // The velocity is right without an integrator too.
    let state = still();
    let state = State {
        t: 0.0,
        g: Rn([state.g.0[0], 0.0]),
        mu: Cotangent([1.0, 1.0]),
    };
    assert_eq!(
        Indefinite.hamiltonian().velocity(&state),
        Tangent([1.0, -1.0])
    );
}

/// A logarithm has a derivative where it has no value.
#[derive(Clone, Copy)]
struct Logarithm;

impl System for Logarithm {
    type Group = Rn<1>;
}

impl Lagrangian for Logarithm {
    fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
        v[0] * v[0] - x.0[0].ln()
    }
}

#[test]
fn outside_the_domain_there_are_no_rates() {
    let (mut xi, mut tau) = (Tangent([0.0]), Cotangent([0.0]));
    let mut finite = |x: f64| {
        let at = Context::new(0.0, &[]);
        let (g, mu) = (Rn([x]), Cotangent([1.0]));
        Logarithm.hamiltonian().velocity_and_force::<f64>(
            at,
            &g,
            &mu,
            &mut Default::default(),
            &mut xi,
            &mut tau,
        );
        xi[0].is_finite() && tau[0].is_finite()
    };
    assert!(finite(0.5));
    assert!(!finite(-0.5));
    let mut state = State {
        t: 0.0,
        g: Rn([0.05]),
        mu: Cotangent([-4.0]),
    };
    for _ in 0..3 {
        let before = state.clone();
        for error in [
            Gauss::new::<3>(Logarithm.hamiltonian())
                .step(&mut state, 0.1)
                .unwrap_err(),
            Variational::new(Logarithm.discretise(Quadrature::Midpoint))
                .step(&mut state, 0.1)
                .unwrap_err(),
        ] {
            let refused = matches!(error.cause, Cause::NotFinite | Cause::NotConverged { .. });
            assert!(refused, "{error}");
            assert_eq!(state, before);
        }
        state.g.0[0] *= 0.5;
    }
}

/// A free body of some size.
#[derive(Clone, Copy)]
pub struct Body(pub f64);

impl System for Body {
    type Group = SO3;
}

impl DiscreteLagrangian for Body {
    type Workspace<S: Scalar> = ();
    fn value<S: Scalar>(&self, _: Context<S>, _: &SO3<S>, f: &SO3<S>, h: S) -> S {
        let jd = Mat3::diagonal([2.0, 1.0, 0.5]).lift::<S>();
        -(f.minus_identity() * jd).trace().times(self.0) / h
    }
}

/// Two bodies of one type in one: each is asked for its derivatives with the same storage.
#[derive(Clone, Copy)]
struct Welded([Body; 2]);

impl System for Welded {
    type Group = SO3;
}

impl DiscreteLagrangian for Welded {
    type Workspace<S: Scalar> = ();
    fn value<S: Scalar>(&self, at: Context<S>, g: &SO3<S>, f: &SO3<S>, h: S) -> S {
        self.0[0].value(at, g, f, h) + self.0[1].value(at, g, f, h)
    }
    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<SO3, S>,
        f: &Over<SO3, S>,
        h: S,
        (): &mut (),
        out: &mut Derivatives<SO3, S>,
    ) {
        self.0[0].derivatives(at, g, f, h, &mut (), out);
        let first = out.d_f;
        self.0[1].derivatives(at, g, f, h, &mut (), out);
        out.d_f += first;
    }
}

#[test]
fn a_formula_is_never_taken_for_another_of_its_type() {
    let welded = Welded([Body(1.0), Body(2.0)]);
    let (mut one, mut two) = (top(), top());
    let (mut by_parts, mut whole) = (Variational::new(welded), Variational::new(Body(3.0)));
    for _ in 0..20 {
        by_parts.step(&mut one, 0.01).unwrap();
        whole.step(&mut two, 0.01).unwrap();
    }
    assert!(super::beam::apart(&one, &two) < 1e-12);
}
