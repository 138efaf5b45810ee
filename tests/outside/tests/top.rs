//! A top on a group of one's own: its laws, and the same motion as on the group of the library.

use lgvi::dvi::{
    Gauss, Integrator, Lagrangian, LeftTranslation, Quadrature, State, Variational, laws,
    momentum_map,
};
use lgvi::lie::{Exp, LieGroup, SO3, Tangent};
use outside::{MatrixTop, QuaternionTop, UnitQuaternion};

const TURN: Tangent<3> = Tangent([0.4, -0.8, 0.3]);
const OMEGA: Tangent<3> = Tangent([0.3, -0.5, 1.0]);
const VERTICAL: LeftTranslation<Tangent<3>> = LeftTranslation(Tangent([0.0, 0.0, 1.0]));

fn quaternion() -> State<UnitQuaternion> {
    QuaternionTop
        .state(0.0, UnitQuaternion::exp(&TURN), &OMEGA)
        .expect("a state")
}

fn matrix() -> State<SO3> {
    MatrixTop
        .state(0.0, SO3::exp(&TURN), &OMEGA)
        .expect("a state")
}

/// The distance of the attitudes, as matrices, and of the momenta.
fn apart(q: &State<UnitQuaternion>, r: &State<SO3>) -> f64 {
    let turn = (*q.g.rotation().matrix() - *r.g.matrix()).frobenius();
    turn.max((q.mu.vec3() - r.mu.vec3()).norm())
}

fn run<I: Integrator>(
    mut integrator: I,
    mut state: State<I::Group>,
    h: f64,
    steps: u32,
) -> State<I::Group> {
    for _ in 0..steps {
        integrator
            .step(&mut state, h)
            .unwrap_or_else(|e| panic!("{e}"));
    }
    state
}

fn laws_of(rule: Quadrature) {
    let (discrete, states) = (QuaternionTop.discretise(rule), [quaternion()]);
    for h in [0.05, -0.02] {
        laws::check(&discrete, &states, h).unwrap_or_else(|e| panic!("{e}"));
    }
    laws::check_consistency(&discrete, &QuaternionTop, &states).unwrap_or_else(|e| panic!("{e}"));
    laws::check_symmetry(&discrete, &VERTICAL, &states, 0.05).unwrap_or_else(|e| panic!("{e}"));
    let integrator = || Variational::new(discrete);
    laws::check_order(integrator, &quaternion(), 1.0, &[64, 128, 256])
        .unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn every_rule_keeps_its_laws() {
    for rule in Quadrature::ALL {
        laws_of(rule);
    }
}

#[test]
fn a_symmetry_that_is_none_is_told() {
    let across = LeftTranslation(Tangent([1.0, 0.0, 0.0]));
    let discrete = QuaternionTop.discretise(Quadrature::Midpoint);
    let error = laws::check_symmetry(&discrete, &across, &[quaternion()], 0.05).unwrap_err();
    let law = "L_d(a g, (a g)^-1 a (g f)) = L_d(g, f)";
    assert!(error.to_string().contains(law), "{error}");
}

/// Through the exponential the discrete Lagrangians of both groups are the same function of $q$ and of $R(q)$.
#[test]
fn the_midpoint_rule_moves_both_alike() {
    let on_matrices = MatrixTop
        .discretise(Quadrature::Midpoint)
        .with_retraction::<Exp>();
    let on_quaternions = QuaternionTop
        .discretise(Quadrature::Midpoint)
        .with_retraction::<Exp>();
    let q = run(Variational::new(on_quaternions), quaternion(), 0.01, 1000);
    let r = run(Variational::new(on_matrices), matrix(), 0.01, 1000);
    let apart = apart(&q, &r);
    println!("midpoint, after 10 s: {apart:.1e}");
    assert!(apart < 1e-10, "{apart:e}");
}

#[test]
fn order_eight_moves_both_alike() {
    let quaternions = || Gauss::new::<4>(QuaternionTop.hamiltonian());
    let matrices = || Gauss::new::<4>(MatrixTop.hamiltonian());
    let order = laws::observed_order(quaternions, &quaternion(), 2.0, &[7, 9, 11]).unwrap();
    assert!((order.slope - 8.0).abs() < 0.2, "{order:?}");

    let on_matrices = run(matrices(), matrix(), 0.05, 200);
    let rounding = apart(&run(quaternions(), quaternion(), 0.05, 200), &on_matrices);
    // At long steps what differs is the charts, the exponential's and the Cayley map's: each step is off by its method.
    let [coarse, fine] = [25, 50].map(|steps| {
        let h = 10.0 / f64::from(steps);
        let q = run(quaternions(), quaternion(), h, steps);
        apart(&q, &run(matrices(), matrix(), h, steps))
    });
    let slope = (coarse / fine).log2();
    println!(
        "Gauss, after 10 s: {rounding:.1e}; at h = 0.4 s {coarse:.1e}, 0.2 s {fine:.1e}, order {slope:.2}"
    );
    assert!(rounding < 1e-12, "{rounding:e}");
    assert!((slope - 8.0).abs() < 1.0, "{coarse:e}, {fine:e}");
}

#[test]
fn order_eight_is_symplectic_and_keeps_the_vertical_momentum() {
    let mut integrator = Gauss::new::<4>(QuaternionTop.hamiltonian());
    let start = [quaternion()];
    laws::check_symplecticity(&mut integrator, &start, 0.1).unwrap_or_else(|e| panic!("{e}"));
    let end = run(integrator, quaternion(), 0.1, 2000);
    let vertical = |s: &State<UnitQuaternion>| momentum_map(&VERTICAL, &s.g, &s.mu);
    let energy = |s: &State<UnitQuaternion>| QuaternionTop.hamiltonian().energy(s);
    let drift = (vertical(&end) - vertical(&start[0])).abs();
    let change = (energy(&end) - energy(&start[0])).abs();
    println!("after 200 s: momentum {drift:.1e}, energy {change:.1e}");
    // A random walk of rounding, 10 eps sqrt(N).
    assert!(drift < 10.0 * f64::EPSILON * 2000_f64.sqrt(), "{drift:e}");
    assert!(change < 1e-12, "{change:e}");
}
