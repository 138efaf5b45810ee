//! What is called a metre, a kilogram or a second changes no bit of a step by powers of two.

use dvi::{
    Composition, Context, Gauss, Integrator, Lagrangian, Quadrature, State, System, Variational,
};
use lie::{LieGroup, Mat3, R3, SO3, Scalar, Tangent, Vec3};

/// A body in a fluid with a weight off its centre, in units of its own.
#[derive(Clone, Copy)]
struct Body {
    length: f64,
    mass: f64,
    time: f64,
}

impl System for Body {
    type Group = (SO3, R3);
}

impl Lagrangian for Body {
    fn value<S: Scalar>(
        &self,
        _: Context<S>,
        g: &(SO3<S>, R3<S>),
        xi: &(Tangent<3, S>, Tangent<3, S>),
    ) -> S {
        let Self { length, mass, time } = *self;
        let (omega, v) = (xi.0.vec3(), g.0.inverse_rotate(xi.1.vec3()));
        let j = Mat3::diagonal([1.0, 1.5, 2.0].map(|j| j * mass * length * length)).lift::<S>();
        let m = Mat3::diagonal([1.0, 3.0, 2.0].map(|m| m * mass)).lift::<S>();
        let weight = mass * length / (time * time);
        let height = g.1[2].times(0.3 * weight)
            + g.0.rotate(Vec3([0.2, 0.0, 1.0]).lift())[2].times(weight * length);
        (omega.dot(j * omega) + v.dot(m * v)).times(0.5) - height
    }
}

impl Body {
    fn start(&self) -> State<(SO3, R3)> {
        let Self { length, time, .. } = *self;
        let g = (
            SO3::exp(&Tangent([0.4, -0.8, 0.3])),
            R3::from(Vec3([0.5, 0.1, -0.3]) * length),
        );
        let xi = (
            Tangent([0.3, -0.5, 1.0].map(|x| x / time)),
            Tangent([0.2, 1.3, 0.1].map(|x| x * length / time)),
        );
        self.state(0.0, g, &xi).unwrap()
    }

    fn run(&self, mut integrator: impl Integrator<Group = (SO3, R3)>, h: f64) -> Vec<SO3> {
        let mut state = self.start();
        let step = |_| {
            integrator
                .step(&mut state, h * self.time)
                .unwrap_or_else(|e| panic!("{e}"));
            state.g.0
        };
        (0..60).map(step).collect()
    }
}

#[test]
fn powers_of_two_change_no_bit() {
    let natural = Body {
        length: 1.0,
        mass: 1.0,
        time: 1.0,
    };
    let runs = |body: Body| {
        [
            body.run(
                Variational::new(body.discretise(Quadrature::LeftPoint)),
                0.01,
            ),
            body.run(Variational::new(body.discretise(Quadrature::Midpoint)), 0.1),
            body.run(
                Composition::new::<4>(body.discretise(Quadrature::LeftPoint)),
                0.1,
            ),
            body.run(Gauss::new::<2>(body.hamiltonian()), 0.1),
            // So long that Newton's method is needed.
            body.run(Gauss::new::<4>(body.hamiltonian()), 0.4),
        ]
    };
    let expected = runs(natural);
    let two = |n: i32| 2.0_f64.powi(n);
    for (length, mass, time) in [
        (20, 0, 0),
        (-30, 0, 0),
        (0, 17, 0),
        (0, 0, -13),
        (-9, 25, 6),
    ] {
        let body = Body {
            length: two(length),
            mass: two(mass),
            time: two(time),
        };
        assert_eq!(runs(body), expected, "2^({length}, {mass}, {time})");
    }
}
