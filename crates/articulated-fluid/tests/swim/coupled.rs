//! Coupled inertia, (S26)–(S27), beside the same bodies without: two welded bodies are one.

use articulated_fluid::{ArticulatedBody, Body, Joint, JointKind};
use dvi::{Context, Gauss, Integrator, Lagrangian, State, Variational};
use lie::{LieGroup, Mat3, Power, Rn, SO3, Tangent, Vec3, VectorSpace};

/// The inertia about a point from which the mass centre is at `d`, in a frame to which the body's has the attitude `c`.
fn shifted(body: &Body, c: &Mat3, d: Vec3) -> Body {
    let (mass, inertia) = (c.conjugate(body.mass), c.conjugate(body.inertia));
    let d = d.hat();
    // The centre moves at V - d^ Omega.
    Body {
        mass,
        inertia: inertia - d * mass * d,
        coupling: -(mass * d),
    }
}

fn sum(a: &Body, b: &Body) -> Body {
    Body {
        mass: a.mass + b.mass,
        inertia: a.inertia + b.inertia,
        coupling: a.coupling + b.coupling,
    }
}

/// A head with a fin, which is welded on it or a part of it, and a tail on a ball.
fn models() -> [ArticulatedBody; 2] {
    let head = Body::new(
        Mat3([[2.0, 0.3, 0.1], [0.3, 3.0, 0.2], [0.1, 0.2, 4.0]]),
        Mat3::diagonal([0.3, 0.5, 0.6]),
    );
    let fin = Body::new(
        Mat3::diagonal([0.5, 2.0, 0.7]),
        Mat3([[0.2, 0.05, 0.0], [0.05, 0.1, 0.0], [0.0, 0.0, 0.2]]),
    );
    let tail = Body::new(
        Mat3::diagonal([0.7, 1.5, 1.9]),
        Mat3::diagonal([0.1, 0.2, 0.15]),
    );
    let rest = SO3::exp(&Tangent([0.4, -0.9, 0.3]));
    let (at_head, at_fin) = (Vec3([-0.3, 0.1, 0.4]), Vec3([0.2, -0.1, 0.05]));
    let (on_head, on_tail) = (Vec3([-0.6, 0.0, 0.1]), Vec3([0.4, 0.1, 0.0]));
    let weld = Joint::new([0, 1], [at_head, at_fin], JointKind::fixed(rest));
    let ball = |child| Joint::new([0, child], [on_head, on_tail], JointKind::Ball);
    let d = at_head - rest.rotate(at_fin);
    let whole = sum(&head, &shifted(&fin, rest.matrix(), d));
    [
        ArticulatedBody::new(&[head, fin, tail], &[weld, ball(2)]).expect("a model"),
        ArticulatedBody::new(&[whole, tail], &[ball(1)]).expect("a model"),
    ]
}

fn start(model: &ArticulatedBody) -> State<articulated_fluid::Configuration> {
    let turn = |w: [f64; 3]| SO3::exp(&Tangent(w));
    let g = (
        Power::new(vec![turn([0.3, 0.2, -0.5]), turn([-0.1, 0.6, 0.2])]),
        Power::new(vec![Rn([0.5, -1.0, 2.0])]),
        Power::new(vec![]),
    );
    let xi = (
        Power::new(vec![Tangent([0.7, -0.4, 0.9]), Tangent([-0.3, 1.1, 0.5])]),
        Power::new(vec![Tangent([0.6, 0.2, -0.8])]),
        Power::new(vec![]),
    );
    model.state(0.0, g, &xi).expect("a state")
}

#[test]
fn welded_bodies_are_one_body_with_coupled_inertia() {
    let [welded, whole] = models();
    let [a, b] = [&welded, &whole].map(start);
    // Rounding of sums of terms up to 10.
    assert!(
        (a.mu.coordinates().iter().zip(b.mu.coordinates())).all(|(x, y)| (x - y).abs() < 1e-14)
    );
    let xi = welded.velocity(&a).expect("a state");
    let values = [&welded, &whole].map(|m| Lagrangian::value(m, Context::new(0.0, &[]), &a.g, &xi));
    assert!((values[0] - values[1]).abs() < 1e-14, "{values:?}");
    let [p, q] = [(&welded, &a), (&whole, &b)].map(|(m, s)| m.conserved(s).expect("finite"));
    assert!((p.energy - q.energy).abs() + (p.angular - q.angular).norm() < 1e-14 * 10.0);
    let ends = [(welded, a), (whole, b)].map(|(model, mut state)| {
        let mut integrator = Gauss::new::<6>(model);
        for _ in 0..100 {
            integrator.step(&mut state, 0.05).expect("a step");
        }
        state
    });
    // 100 steps solved to rounding, of a motion that turns once.
    let apart = dvi::laws::distance(&ends[0], &ends[1]);
    assert!(apart < 1e-11, "{apart:e}");
}

/// The discrete Lagrangians differ in what they do between nodes; both come to the motion, at order 1.
#[test]
fn the_step_of_a_body_with_coupled_inertia_comes_to_its_motion() {
    let [welded, whole] = models();
    let exact = |mut state: State<_>| {
        let mut integrator = Gauss::new::<6>(welded.clone());
        for _ in 0..20 {
            integrator.step(&mut state, 0.05).expect("a step");
        }
        state
    };
    let at = exact(start(&welded));
    let off = |h: f64| {
        let (mut integrator, mut state) = (Variational::new(whole.clone()), start(&whole));
        for _ in 0..(1.0 / h).round() as u32 {
            integrator.step(&mut state, h).expect("a step");
        }
        dvi::laws::distance(&state, &at)
    };
    let order = (off(0.002) / off(0.001)).log2();
    assert!((order - 1.0).abs() < 0.05, "{order}");
}

#[test]
fn a_coupling_that_is_too_large_is_no_inertia() {
    let body = Body {
        coupling: Mat3::diagonal([1.0, 0.0, 0.0]),
        ..Body::new(Mat3::identity(), Mat3::identity())
    };
    let refused = ArticulatedBody::new(&[body], &[]).expect_err("not definite");
    assert!(refused.to_string().contains("coupling"), "{refused}");
}
