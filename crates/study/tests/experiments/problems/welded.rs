//! A rigid body cut in two: halves that move as one, and halves held together by springs.

use dvi::{Context, Integrator, Lagrangian, Quadrature, State, System, Variational};
use lie::{AlgebraOver, LieGroup, Mat3, Over, SE3, SO3, Scalar, Tangent, Vec3};
use study::baseline::{Tolerance, on_group};

use super::distance;

/// A rigid part: mass, mass centre and inertia about it, in the frame of the whole body.
#[derive(Clone, Copy)]
struct Part {
    mass: f64,
    centre: Vec3,
    inertia: Mat3,
}

impl Part {
    fn kinetic_energy<S: Scalar>(&self, xi: &Tangent<6, S>) -> S {
        let (omega, v) = xi.split();
        let v = v + omega.cross(self.centre.lift());
        let twice =
            v.norm_squared() * S::from_f64(self.mass) + omega.dot(self.inertia.lift() * omega);
        twice * S::from_f64(0.5)
    }

    /// The part's inertia about a point, by the parallel axis theorem.
    fn inertia_about(&self, point: Vec3) -> Mat3 {
        let d = self.centre - point;
        self.inertia + (Mat3::identity() * d.norm_squared() - d.outer(d)) * self.mass
    }
}

fn parts() -> [Part; 2] {
    let tilted = SO3::exp(&Tangent([0.3, -0.5, 0.8]));
    [
        Part {
            mass: 1.5,
            centre: Vec3([0.4, 0.1, -0.2]),
            inertia: tilted.matrix().conjugate(Mat3::diagonal([0.2, 0.35, 0.5])),
        },
        Part {
            mass: 0.8,
            centre: Vec3([-0.5, 0.3, 0.1]),
            inertia: Mat3::diagonal([0.3, 0.1, 0.25]),
        },
    ]
}

fn whole([a, b]: [Part; 2]) -> Part {
    let mass = a.mass + b.mass;
    let centre = (a.centre * a.mass + b.centre * b.mass) * (1.0 / mass);
    Part {
        mass,
        centre,
        inertia: a.inertia_about(centre) + b.inertia_about(centre),
    }
}

/// Parts that move as one.
struct Rigid(Vec<Part>);

impl System for Rigid {
    type Group = SE3;
}

impl Lagrangian for Rigid {
    fn value<S: Scalar>(&self, _: Context<S>, _: &SE3<S>, xi: &Tangent<6, S>) -> S {
        let energies = self.0.iter().map(|part| part.kinetic_energy(xi));
        energies.fold(S::zero(), |sum, energy| sum + energy)
    }
}

/// Two parts, each with its own copy of the body's frame, tied by springs at four points.
struct Sprung {
    parts: [Part; 2],
    stiffness: f64,
}

const POINTS: [[f64; 3]; 4] = [
    [0.3, 0.3, 0.3],
    [0.3, -0.3, -0.3],
    [-0.3, 0.3, -0.3],
    [-0.3, -0.3, 0.3],
];

impl System for Sprung {
    type Group = [SE3; 2];
}

impl Lagrangian for Sprung {
    fn value<S: Scalar>(
        &self,
        _: Context<S>,
        [a, b]: &Over<[SE3; 2], S>,
        [u, v]: &AlgebraOver<[SE3; 2], S>,
    ) -> S {
        let place =
            |g: &SE3<S>, point: [f64; 3]| g.rotation.rotate(Vec3(point).lift()) + g.translation;
        let stretch = |point| (place(a, point) - place(b, point)).norm_squared();
        let squares = POINTS.into_iter().map(stretch);
        let square = squares.fold(S::zero(), |sum, square| sum + square);
        let kinetic = self.parts[0].kinetic_energy(u) + self.parts[1].kinetic_energy(v);
        kinetic - square * S::from_f64(0.5 * self.stiffness)
    }
}

const VELOCITY: Tangent<6> = Tangent([1.1, -0.6, 1.9, 0.3, -0.2, 0.5]);

fn pose() -> SE3 {
    SE3::exp(&Tangent([0.4, -1.1, 0.7, 0.3, 2.0, -1.0]))
}

#[test]
fn halves_that_move_as_one_are_the_whole() {
    let halves = Rigid(parts().to_vec());
    let body = Rigid(vec![whole(parts())]);
    let mut a = halves.state(0.0, pose(), &VELOCITY).expect("a state");
    let mut b = body.state(0.0, pose(), &VELOCITY).expect("a state");
    let mut left = Variational::new(halves.discretise(Quadrature::Midpoint)).with_tolerance(1e-15);
    let mut right = Variational::new(body.discretise(Quadrature::Midpoint)).with_tolerance(1e-15);
    let mut worst = 0.0_f64;
    for step in 0..1000 {
        left.step(&mut a, 0.02).expect("a step");
        right.step(&mut b, 0.02).expect("a step");
        worst = worst.max(distance(&a, &b));
        assert!(step > 0 || worst < 1e-15 * 4.0, "one step: {worst:e}");
    }
    println!("halves against the whole, 1000 steps: {worst:.1e}");
    // C eps sqrt(N), times the 20 s over which an error of the velocity grows.
    assert!(worst < 20.0 * 10.0 * f64::EPSILON * 1000.0_f64.sqrt());
}

/// The largest distance, over 2 s, of the first half from the rigid body.
fn error_of_springs(stiffness: f64) -> f64 {
    let tolerance = Tolerance::uniform(1e-11);
    let times: Vec<f64> = (1..=100).map(|k| 0.02 * f64::from(k)).collect();
    let body = Rigid(vec![whole(parts())]);
    let start = body.state(0.0, pose(), &VELOCITY).expect("a state");
    let exact =
        on_group::sample(&body.hamiltonian(), &start, &times, tolerance).expect("a reference");
    let sprung = Sprung {
        parts: parts(),
        stiffness,
    };
    let start = sprung
        .state(0.0, [pose(); 2], &[VELOCITY; 2])
        .expect("a state");
    let states =
        on_group::sample(&sprung.hamiltonian(), &start, &times, tolerance).expect("a motion");
    let errors = states.iter().zip(&exact).map(|(a, b)| {
        let way = |g: &SE3| b.g.inverse().compose(g).log().expect("a short way");
        a.g.iter()
            .map(|g| lie::VectorSpace::max_magnitude(&way(g)))
            .fold(0.0, f64::max)
    });
    errors.fold(0.0, f64::max)
}

#[test]
fn stiff_springs_tend_to_the_weld() {
    let errors = [1e3, 1e4, 1e5].map(error_of_springs);
    let order = (errors[0] / errors[2]).log10() / 2.0;
    println!("springs of 1e3, 1e4, 1e5 N/m: off by {errors:?}, order {order:.2}");
    assert!((order - 1.0).abs() < 0.1);
    assert!(errors[2] < 1e-3);
}

#[test]
fn a_weld_carries_the_momentum_of_both() {
    let body = Rigid(vec![whole(parts())]);
    let halves = Rigid(parts().to_vec());
    let mu =
        |rigid: &Rigid| -> State<SE3> { rigid.state(0.0, pose(), &VELOCITY).expect("a state") };
    assert!(distance(&mu(&body), &mu(&halves)) < 1e-15);
}
