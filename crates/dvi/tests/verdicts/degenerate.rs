//! No inertia in some direction: one answer from every integrator, which names the direction.

use dvi::{
    Cause, Composition, Context, Gauss, Integrator, Lagrangian, Quadrature, StepError, System,
    Variational,
};
use lie::{Cotangent, LieGroup, RealGroup, Rn, SO3, Scalar, Tangent};

/// Every integrator refuses the first step, and all name this coordinate.
fn all_name<L>(lagrangian: L, state: &dvi::State<L::Group>, coordinate: usize)
where
    L: Lagrangian + Copy + 'static,
    L::Group: RealGroup,
{
    let refuses = |name: &str, mut integrator: Box<dyn Integrator<Group = L::Group>>| {
        for h in [0.1, 1e-3, 1e-5] {
            let mut stepped = state.clone();
            let error = integrator.step(&mut stepped, h).unwrap_err();
            let expected = StepError {
                step: 0,
                t: 0.0,
                h,
                cause: Cause::Degenerate { coordinate },
            };
            assert_eq!(error, expected, "{name}, h = {h}: {error}");
            assert_eq!(&stepped, state);
        }
    };
    for rule in Quadrature::ALL {
        let variational = Variational::new(lagrangian.discretise(rule));
        refuses(rule.name(), Box::new(variational));
    }
    refuses(
        "composition",
        Box::new(Composition::new::<4>(
            lagrangian.discretise(Quadrature::LeftPoint),
        )),
    );
    refuses("gauss", Box::new(Gauss::new::<2>(lagrangian.hamiltonian())));
}

/// A body that has no inertia about one axis, under a weight.
#[derive(Clone, Copy)]
struct Needle;

impl System for Needle {
    type Group = SO3;
}

impl Lagrangian for Needle {
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, omega: &Tangent<3, S>) -> S {
        let [_, b, c] = omega.0;
        (b * b + c * c.times(2.0)).times(0.5) - r.matrix()[(2, 0)]
    }
}

#[test]
fn a_zero_inertia_is_named_by_its_axis() {
    let state = dvi::State {
        t: 0.0,
        g: SO3::exp(&Tangent([0.4, -0.8, 0.3])),
        mu: Cotangent([0.0, 0.3, -0.2]),
    };
    all_name(Needle, &state, 0);
}

/// Two coordinates of which only the sum has inertia.
#[derive(Clone, Copy)]
struct Together;

impl System for Together {
    type Group = Rn<2>;
}

impl Lagrangian for Together {
    fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<2, S>, v: &Tangent<2, S>) -> S {
        let ([x, y], sum) = (x.0, v[0] + v[1]);
        (sum * sum).times(0.5) - (x * x + y * y).times(0.5)
    }
}

#[test]
fn a_direction_between_coordinates_is_found() {
    let state = Together
        .state(0.0, Rn([1.0, 0.5]), &Tangent([0.2, 0.1]))
        .unwrap();
    all_name(Together, &state, 1);
}

/// A first-order Lagrangian, linear in the velocity: a point vortex about another.
#[derive(Clone, Copy)]
struct Vortex;

impl System for Vortex {
    type Group = Rn<2>;
}

impl Lagrangian for Vortex {
    fn value<S: Scalar>(&self, _: Context<S>, q: &Rn<2, S>, v: &Tangent<2, S>) -> S {
        let ([x, y], [u, w]) = (q.0, v.0);
        (x * w - y * u).times(0.5) - (x * x + y * y).times(0.5)
    }
}

#[test]
fn a_first_order_lagrangian_is_refused_outright() {
    let state = Vortex
        .state(0.0, Rn([1.0, 0.0]), &Tangent([0.0, 0.0]))
        .unwrap();
    let mut integrator = Variational::new(Vortex.discretise(Quadrature::Midpoint));
    let error = integrator.step(&mut state.clone(), 0.1).unwrap_err();
    assert!(
        error.to_string().contains("linear in a velocity"),
        "{error}"
    );
    let mut coordinates = vec![];
    let mut push = |error: StepError| match error.cause {
        Cause::Degenerate { coordinate } => coordinates.push(coordinate),
        _ => panic!("{error}"),
    };
    push(error);
    push(
        Variational::new(Vortex.discretise(Quadrature::LeftPoint))
            .step(&mut state.clone(), 0.1)
            .unwrap_err(),
    );
    push(
        Variational::new(Vortex.discretise(Quadrature::Trapezoid))
            .step(&mut state.clone(), 0.1)
            .unwrap_err(),
    );
    push(
        Gauss::new::<2>(Vortex.hamiltonian())
            .step(&mut state.clone(), 0.1)
            .unwrap_err(),
    );
    assert_eq!(coordinates.len(), 4);
}
