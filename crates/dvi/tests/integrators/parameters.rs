//! Parameters of a system: the same motion as by constants, and its derivatives by them.

use dvi::{
    Composition, Context, FirstVariation, Force, Forced, Gauss, Integrator, Lagrangian, Quadrature,
    State, System, Variation, Variational, laws,
};
use lie::{Cotangent, LieGroup, Mat3, SO3, Scalar, Tangent, VectorSpace};

use crate::common::{INERTIA, LEVER, top};

/// A top on a spring that turns it to the identity, in air: its mass in kg and its stiffness in N m, of which the Lagrangian is
/// $\frac m2 \Omega \cdot J \Omega - m\, e_3 \cdot R l - \frac k2 \mathrm{tr}(I - R)$, and a drag in N m s.
#[derive(Clone, Copy)]
struct Sprung([f64; 3]);

const SPRUNG: Sprung = Sprung([1.3, 0.8, 0.25]);

fn lagrangian<S: Scalar>([mass, stiffness]: [S; 2], r: &SO3<S>, omega: &Tangent<3, S>) -> S {
    let omega = omega.vec3();
    let kinetic = omega.dot(Mat3::diagonal(INERTIA).apply(omega)).times(0.5);
    let turned = -r.minus_identity().trace();
    mass * (kinetic - r.rotate(LEVER.lift())[2]) - stiffness * turned.times(0.5)
}

impl System for Sprung {
    type Group = SO3;

    fn parameters(&self) -> &[f64] {
        &self.0
    }
}

impl Lagrangian for Sprung {
    fn value<S: Scalar>(&self, at: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
        let [mass, stiffness, _] = at.parameters();
        lagrangian([mass, stiffness], r, omega)
    }
}

/// The drag whose coefficient is the last parameter of the system that it acts on.
#[derive(Clone, Copy)]
struct Air;

impl Force for Air {
    type Group = SO3;

    fn force<S: Scalar>(
        &self,
        at: Context<S>,
        _: &SO3<S>,
        omega: &Tangent<3, S>,
        out: &mut Cotangent<3, S>,
    ) {
        let [_, _, drag] = at.parameters();
        *out = Cotangent(omega.0.map(|x| -drag * x));
    }
}

/// The same numbers as constants.
#[derive(Clone, Copy)]
struct Constants(Sprung);

impl System for Constants {
    type Group = SO3;
}

impl Lagrangian for Constants {
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
        let [mass, stiffness, _] = self.0.0.map(S::from_f64);
        lagrangian([mass, stiffness], r, omega)
    }
}

const STEPS: u32 = 50;
const H: f64 = 0.05;

fn run(mut integrator: impl Integrator<Group = SO3>) -> State<SO3> {
    let mut state = top();
    for _ in 0..STEPS {
        integrator.step(&mut state, H).unwrap();
    }
    state
}

#[test]
fn the_motion_is_that_of_constants() {
    let (named, constant) = (SPRUNG, Constants(SPRUNG));
    for rule in Quadrature::ALL {
        let by_name = run(Variational::new(named.discretise(rule)));
        let by_number = run(Variational::new(constant.discretise(rule)));
        assert_eq!(by_name, by_number, "{}", rule.name());
    }
    let rule = Quadrature::LeftPoint;
    let by_name = run(Composition::new::<4>(named.discretise(rule)));
    let by_number = run(Composition::new::<4>(constant.discretise(rule)));
    assert_eq!(by_name, by_number);
    let by_name = run(Gauss::new::<3>(named.hamiltonian()));
    let by_number = run(Gauss::new::<3>(constant.hamiltonian()));
    assert_eq!(by_name, by_number);
    let energies = (
        named.hamiltonian().energy(&by_name),
        constant.hamiltonian().energy(&by_name),
    );
    assert_eq!(energies.0, energies.1);
}

#[test]
fn the_laws_hold_with_parameters() {
    for rule in Quadrature::ALL {
        let discrete = SPRUNG.discretise(rule);
        laws::check(&discrete, &[top()], H).unwrap_or_else(|e| panic!("{e}"));
        laws::check_consistency(&discrete, &SPRUNG, &[top()]).unwrap_or_else(|e| panic!("{e}"));
    }
}

/// The derivatives of the state after fifty steps by each parameter, against central differences of runs with others.
fn against_differences<I: FirstVariation<Group = SO3>>(make: impl Fn(Sprung) -> I) {
    /// Half-width of the differences: their error is of the order of its square, 1e-8, and of rounding over it.
    const WIDTH: f64 = 1e-4;
    let (mut state, mut carried) = (top(), Variation::parameters(&SPRUNG, &top().g));
    assert_eq!(carried.len(), 3);
    let mut integrator = make(SPRUNG);
    for _ in 0..STEPS {
        integrator.step_varied(&mut state, &mut carried, H).unwrap();
    }
    for (i, carried) in carried.iter().enumerate() {
        let [ahead, behind] = [WIDTH, -WIDTH].map(|s| {
            let mut changed = SPRUNG;
            changed.0[i] += s;
            run(make(changed))
        });
        let to = |end: &State<SO3>| state.g.inverse().compose(&end.g).log().unwrap();
        let eta = (to(&ahead) - to(&behind)) * (0.5 / WIDTH);
        let mu = (ahead.mu - behind.mu) * (0.5 / WIDTH);
        let size = carried.eta.max_magnitude() + carried.mu.max_magnitude();
        let off = (eta - carried.eta).max_magnitude() + (mu - carried.mu).max_magnitude();
        println!("parameter {i}: {size:.3}, off by {off:.1e}");
        assert!(off <= 1e-7 * size, "parameter {i}: {off:e} of {size}");
    }
}

#[test]
fn derivatives_by_parameters_are_those_of_differences() {
    let rule = Quadrature::LeftPoint;
    against_differences(|top| Variational::new(top.discretise(Quadrature::Midpoint)));
    // Its parts are those of the adjoint too.
    against_differences(|top| Composition::new::<4>(top.discretise(rule)));
    against_differences(|top| Gauss::new::<3>(top.hamiltonian()));
}

#[test]
fn a_force_reads_the_parameters_of_its_system() {
    let forced = |top: Sprung, rule| top.discretise(rule).with_force(Air);
    for rule in Quadrature::ALL {
        against_differences(|top| Variational::new(forced(top, rule)));
    }
    against_differences(|top| Composition::new::<4>(forced(top, Quadrature::LeftPoint)));
    against_differences(|top| Gauss::new::<3>(Forced::new(top.hamiltonian(), Air)));
}

/// A dual number has six directions: here parameters share one with variations of the state.
#[test]
fn variations_of_all_kinds_are_carried_together() {
    let (g, rule) = (top().g, Quadrature::Midpoint);
    let kinds = [
        Variation::parameters(&SPRUNG, &g),
        Variation::basis(&g),
        Variation::forces(&g),
    ];
    let carry = |mut columns: Vec<Variation<SO3>>| {
        let (mut state, mut integrator) = (top(), Variational::new(SPRUNG.discretise(rule)));
        for _ in 0..STEPS {
            integrator.step_varied(&mut state, &mut columns, H).unwrap();
        }
        columns
    };
    let together = carry(kinds.concat());
    let apart = kinds.map(carry).concat();
    for (a, b) in together.iter().zip(&apart) {
        let size = b.eta.max_magnitude() + b.mu.max_magnitude();
        let off = (a.eta - b.eta).max_magnitude() + (a.mu - b.mu).max_magnitude();
        // Rounding of fifty steps.
        assert!(off <= 1e-12 * size, "{off:e} of {size}");
    }
}

/// Asks for two of its three parameters.
struct Forgetful;

impl System for Forgetful {
    type Group = SO3;

    fn parameters(&self) -> &[f64] {
        &SPRUNG.0
    }
}

impl Lagrangian for Forgetful {
    fn value<S: Scalar>(&self, at: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
        lagrangian(at.parameters(), r, omega)
    }
}

#[test]
#[should_panic(expected = "a formula asks for 2 parameters, and System::parameters() gives 3")]
fn a_wrong_number_of_parameters_is_named() {
    let _ = Forgetful.state(0.0, top().g, &Tangent([0.1, 0.2, 0.3]));
}
