//! The plane of a motion: found where there is one, refused with the cause where not; states in it and in space.

use articulated_fluid::planar::{NotPlanar, NotPlanarCause, Plane};
use articulated_fluid::{ArticulatedBody, Body, Configuration, Joint, Viewed};
use dvi::{
    Cause, Context, ContinuousSystem, Gauss, Integrator, Lagrangian, State, StepError, Variational,
};
use lie::{LieGroup, Mat3, Power, SO3, Tangent, Vec3, VectorSpace};
use proptest::prelude::*;

use crate::common::{Velocity, alone, assert_close, none};
use crate::flat_trees::*;

/// How far one thing is tilted out of the plane.
const TILT: f64 = 1e-3;

/// What a model in motion is made of, to be tilted in the frames of [`fish`].
struct Parts {
    bodies: Vec<Body>,
    joints: Vec<Joint>,
    gravity: Vec3,
    xi: Velocity,
}

/// The fish in the frame of the coordinates or elsewhere, sinking, with one thing tilted.
fn tilted(elsewhere: bool, tilt: impl Fn(&mut Parts, &Flat)) -> NotPlanar {
    let flat = if elsewhere { moved(fish()) } else { fish() };
    let model = flat.model();
    let mut parts = Parts {
        bodies: model.bodies().collect(),
        joints: model.joints().collect(),
        gravity: flat.world.rotate(Vec3([0.0, -2.0, 0.0])),
        xi: flat.velocity(),
    };
    tilt(&mut parts, &flat);
    let Parts {
        bodies,
        joints,
        gravity,
        xi,
    } = parts;
    let model = ArticulatedBody::new(&bodies, &joints).expect("a model");
    let model = model
        .with_gravity(gravity, &[0.1, 0.3, -0.2])
        .expect("a weight");
    let state = model
        .state(0.0, flat.configuration(), &xi)
        .expect("a state");
    Plane::find(&model, &state).expect_err("no plane")
}

/// `a`, turned about the first axis of a body's frame by the tilt.
fn turned(a: Mat3, flat: &Flat, body: usize) -> Mat3 {
    let axis = flat.parts[body].frame.rotate(Vec3([TILT, 0.0, 0.0]));
    SO3::exp(&axis.into()).matrix().conjugate(a)
}

fn normal(flat: &Flat, body: usize) -> Vec3 {
    flat.parts[body].frame.rotate(Vec3([0.0, 0.0, TILT]))
}

#[track_caller]
fn assert_refused(
    cause: NotPlanarCause,
    body: usize,
    defect: f64,
    tilt: impl Fn(&mut Parts, &Flat),
) {
    for elsewhere in [false, true] {
        let found = tilted(elsewhere, &tilt);
        assert_eq!((found.what, found.body), (cause, body), "{found}");
        assert!(
            (found.defect / defect - 1.0).abs() < 1e-3,
            "{} is not {defect}",
            found.defect
        );
        assert!(found.torque > 0.0 && found.torque < 1e-2, "{found}");
        let whole = matches!(
            cause,
            NotPlanarCause::VelocityOffPlane | NotPlanarCause::GravityOffPlane
        );
        let named = found.to_string().contains(&format!("(body {body})"));
        assert_eq!(named, !whole, "{found}");
        let off = cause == NotPlanarCause::GravityOffPlane;
        assert_eq!(found.force > 1e-6, off, "{found}");
    }
}

#[test]
fn what_is_off_the_plane_is_named_and_measured() {
    use NotPlanarCause::*;
    // The sizes that the defects are relative to: levers of 0.63 m and 0.9 m, the rate of 1 rad/s, and 0.63 m/s by it.
    let coupled = |a: [f64; 3]| (a[2] - a[1]) * TILT / Mat3::diagonal(a).frobenius();
    assert_refused(MassCoupling, 1, coupled([1.2, 2.2, 3.0]), |parts, flat| {
        parts.bodies[1].mass = turned(parts.bodies[1].mass, flat, 1);
    });
    let inertia = coupled([0.3, 0.5, 0.4]).abs();
    assert_refused(InertiaCoupling, 2, inertia, |parts, flat| {
        parts.bodies[2].inertia = turned(parts.bodies[2].inertia, flat, 2);
    });
    assert_refused(JointOffPlane, 1, TILT / 0.63, |parts, flat| {
        parts.joints[0].at_child += normal(flat, 1);
    });
    assert_refused(JointOffPlane, 0, TILT / 0.9, |parts, flat| {
        parts.joints[1].at_parent += normal(flat, 0);
    });
    assert_refused(SpinOffPlane, 2, TILT, |parts, flat| {
        let across = flat.parts[2].frame.rotate(Vec3([TILT, 0.0, 0.0]));
        parts.xi.0[2] += across.into();
    });
    assert_refused(VelocityOffPlane, 0, TILT / 0.63, |parts, flat| {
        let along = flat.world.rotate(Vec3([0.0, 0.0, TILT]));
        parts.xi.1[0] += along.into();
    });
    assert_refused(GravityOffPlane, 0, 0.5 * TILT, |parts, flat| {
        parts.gravity += flat.world.rotate(Vec3([0.0, 0.0, TILT]));
    });
}

#[test]
fn each_plane_of_the_coordinates_is_found_exactly() {
    let z = Vec3([0.0, 0.0, 1.0]);
    assert_eq!(fish().plane().normal(), z);
    for k in 0..24 {
        let mut flat = fish();
        flat.world = turn_of_axes(k);
        let normal = flat.world.rotate(z);
        assert_eq!(flat.plane().normal().dot(normal).abs(), 1.0);
    }
}

#[test]
fn bodies_without_a_preferred_direction_at_rest_have_a_plane() {
    let ball = Body::new(Mat3::diagonal([1.0; 3]), Mat3::diagonal([0.1; 3]));
    let off = |at: Vec3| Joint {
        parent: 0,
        child: 1,
        at_parent: at,
        at_child: at,
        kind: Default::default(),
    };
    let alone = ArticulatedBody::new(&[ball], &[]).expect("a model");
    let pair = ArticulatedBody::new(&[ball; 2], &[off(Vec3([0.1, 0.2, 0.0]))]).expect("a model");
    let concentric = ArticulatedBody::new(&[ball; 2], &[off(Vec3::zero())]).expect("a model");
    for model in [alone, pair, concentric] {
        let g = model.aligned();
        let rest = State {
            t: 0.0,
            mu: g.zero_dual(),
            g,
        };
        let plane = Plane::find(&model, &rest).expect("a plane");
        assert!(plane.contains(&rest));
    }
}

/// A body of which lengths are about `size`.
fn sized(size: f64) -> Body {
    let mass = size.powi(3);
    Body::new(
        Mat3::diagonal([mass, 2.0 * mass, 3.0 * mass]),
        Mat3::diagonal([0.3, 0.5, 0.6]) * (mass * size * size),
    )
}

/// A body of 1 m on one of `size`, its joint `off` the plane in which it spins.
fn attached(size: f64, off: f64, spin: [f64; 3]) -> Result<Plane, NotPlanar> {
    let joint = Joint {
        parent: 0,
        child: 1,
        at_parent: Vec3([size, 0.0, 0.0]),
        at_child: Vec3([0.5, 0.0, off]),
        kind: Default::default(),
    };
    let model = ArticulatedBody::new(&[sized(size), sized(1.0)], &[joint]).expect("a model");
    let rates = vec![Tangent::zero(), Tangent(spin)];
    let xi = (Power::new(rates), alone(Tangent::zero()), none());
    Plane::find(
        &model,
        &model.state(0.0, model.aligned(), &xi).expect("a state"),
    )
}

#[test]
fn a_small_body_on_a_large_one_is_judged_by_its_own_size() {
    for size in [1.0, 1e3, 1e6, 1e9] {
        let normal = attached(size, 0.0, [0.0, 0.0, 2.0])
            .expect("a plane")
            .normal();
        assert_eq!(normal, Vec3([0.0, 0.0, 1.0]));
        let joint = attached(size, 0.9e-3, [0.0, 0.0, 2.0]).expect_err("no plane");
        assert_eq!(joint.what, NotPlanarCause::JointOffPlane);
        let spin = attached(size, 0.0, [2e-9, 0.0, 2.0]).expect_err("no plane");
        assert_eq!((spin.what, spin.body), (NotPlanarCause::SpinOffPlane, 1));
    }
}

#[test]
fn a_slow_spin_of_a_fast_body_is_judged_as_a_spin() {
    let model = ArticulatedBody::new(&[sized(1.0)], &[]).expect("a model");
    for (speed, rate) in [(1.0, 1.0), (1e3, 1.0), (1e3, 0.0)] {
        let found = |off: f64| {
            let omega = Tangent([off, 0.0, rate]);
            let xi = (alone(omega), alone(Tangent([speed, 0.0, 0.0])), none());
            Plane::find(
                &model,
                &model.state(0.0, model.aligned(), &xi).expect("a state"),
            )
        };
        assert!(found(0.0).is_ok());
        if rate > 0.0 {
            let refused = found(1e-9).expect_err("no plane");
            assert_eq!(refused.what, NotPlanarCause::SpinOffPlane);
        }
    }
}

/// A chain along its first axis at rest, the vertical plane in which it falls at this angle about z.
fn falling(azimuth: f64, mut check: impl FnMut(Result<Plane, NotPlanar>)) {
    let tilted = SO3::exp(&Tangent([0.0, 0.3, 0.0]));
    let attitude = SO3::exp(&Tangent([0.0, 0.0, azimuth])).compose(&tilted);
    let link = |i: usize| Joint {
        parent: i,
        child: i + 1,
        at_parent: Vec3([1.0, 0.0, 0.0]),
        at_child: Vec3([-1.0, 0.0, 0.0]),
        kind: Default::default(),
    };
    for inertia in [[0.1; 3], [0.1, 0.4, 0.4], [0.1, 0.4, 0.45]] {
        for net in [[-2.0, 1.0, 1.0], [0.1, 1.0, 1.0]] {
            let body = Body::new(Mat3::diagonal([1.0; 3]), Mat3::diagonal(inertia));
            let model = ArticulatedBody::new(&[body; 3], &[link(0), link(1)]).expect("a model");
            let model = model.with_gravity(Vec3([0.0, 0.0, -9.81]), &net);
            let model = model.expect("a weight");
            let mut g = model.aligned();
            g.0.fill(attitude);
            let mu = g.zero_dual();
            check(Plane::find(&model, &State { t: 0.0, g, mu }));
        }
    }
}

#[test]
fn the_vertical_plane_of_a_chain_released_from_rest_is_found() {
    let y = Vec3([0.0, 1.0, 0.0]);
    falling(0.0, |found| assert_eq!(found.expect("a plane").normal(), y));
}

#[test]
fn a_plane_that_is_no_coordinate_plane_is_not_taken() {
    falling(core::f64::consts::FRAC_PI_6, |found| {
        let refused = found.expect_err("a tilted plane");
        assert_eq!(refused.what, NotPlanarCause::AttitudeOffPlane);
        assert!((refused.defect - 0.5).abs() < 1e-15, "{refused}");
    });
}

/// Three bodies pinned by their centres to a float that carries them: their weights balance, but for rounding.
#[test]
fn weights_that_balance_have_no_part_along_the_normal() {
    let body = Body::new(Mat3::diagonal([1.0; 3]), Mat3::diagonal([0.1, 0.4, 0.45]));
    let pin = |(i, x): (usize, f64)| Joint {
        parent: 0,
        child: i + 1,
        at_parent: Vec3([x, 0.0, 0.0]),
        at_child: Vec3::zero(),
        kind: Default::default(),
    };
    let pinned = |xs: [f64; 3]| {
        let joints: Vec<Joint> = xs.into_iter().enumerate().map(pin).collect();
        let model = ArticulatedBody::new(&[body; 4], &joints).expect("a model");
        let model = model
            .with_gravity(Vec3([0.0, 0.0, -9.81]), &[-3.0, 1.0, 1.0, 1.0])
            .expect("a weight");
        let spin = |rate: f64| Tangent([0.0, 0.0, rate]);
        let rates = [1.0, 2.0, 2.0, 2.0].map(spin);
        let xi = (Power::new(rates.to_vec()), alone(Tangent::zero()), none());
        Plane::find(
            &model,
            &model.state(0.0, model.aligned(), &xi).expect("a state"),
        )
    };
    let plane = pinned([0.3, -0.1, -0.2]).expect("a plane");
    assert_eq!(plane.normal(), Vec3([0.0, 0.0, 1.0]));
    let off = pinned([0.3, -0.1, -0.2 + 1e-9]).expect_err("no balance");
    assert_eq!(off.what, NotPlanarCause::GravityOffPlane);
}

#[test]
fn a_state_of_another_model_and_one_not_finite_are_refused() {
    let (model, state) = (fish().model(), fish().state());
    let mut short = state.clone();
    short.g.0 = short.g.0.iter().take(2).copied().collect();
    let mut lost = state.clone();
    lost.mu.1[0][0] = f64::NAN;
    for state in [short, lost] {
        let error = Plane::find(&model, &state).expect_err("no state");
        assert_eq!(error.what, NotPlanarCause::State);
        let plane = fish().plane();
        let mut integrator = Viewed::new(plane.clone(), Variational::new(plane.model()));
        let mut stepped = state.clone();
        assert!(matches!(
            integrator.step(&mut stepped, 1e-3),
            Err(StepError {
                cause: Cause::Misfit,
                ..
            })
        ));
        assert!(integrator.peek(&state, 1e-3).is_err());
    }
}

proptest! {
    #[test]
    fn states_go_to_the_plane_and_back(flat in any_flat()) {
        let (model, plane, state) = (flat.model(), flat.plane(), flat.state());
        prop_assert!(plane.contains(&state));
        let back = plane.lift(&plane.project(&state));
        prop_assert!(model.orthogonality_error(&back.g) < 4e-15);
        let joints = |g: &Configuration| model.centre_positions(0.0, g).expect("a state").iter().flat_map(|x| x.0).collect::<Vec<_>>();
        assert_close(&joints(&back.g), &joints(&state.g), 1e-12);
        assert_close(&back.mu.coordinates(), &state.mu.coordinates(), 1e-12);
    }

    #[test]
    fn the_plane_of_bodies_of_any_sizes_is_found(
        flat in any_flat(),
        sizes in prop::collection::vec(-3.0..0.0_f64, 5),
        rest in any::<bool>(),
    ) {
        let flat = scaled(flat, &sizes, rest);
        let found = Plane::find(&flat.model(), &flat.state());
        prop_assert!(found.is_ok(), "{}", found.unwrap_err());
    }

    #[test]
    fn the_plane_of_a_long_chain_is_found(flat in chain(30)) {
        prop_assert!(Plane::find(&flat.model(), &flat.state()).is_ok());
    }
}

/// The bodies of sizes of these powers of ten, the largest first; perhaps without spin.
///
/// Of a light body that carries heavy ones, the momenta tell no velocity.
fn scaled(mut flat: Flat, powers: &[f64], rest: bool) -> Flat {
    let mut powers = powers.to_vec();
    powers.sort_by(|a, b| b.total_cmp(a));
    let size = |i: usize| 10.0_f64.powf(powers[i]);
    for i in 0..flat.parts.len() {
        let parent = flat.parts[i].parent % i.max(1);
        let part = &mut flat.parts[i];
        part.mass = part.mass * size(i).powi(3);
        part.inertia = part.inertia * size(i).powi(5);
        part.at_child = part.at_child.map(|x| x * size(i));
        part.at_parent = part.at_parent.map(|x| x * size(parent));
        part.rate *= f64::from(!rest);
    }
    flat
}

/// A chain with angles and rates up to 1.
fn chain(bodies: usize) -> impl Strategy<Value = Flat> {
    let motion = prop::collection::vec((-1.0..1.0, -1.0..1.0, 0..24_usize), bodies);
    (motion, 0..24_usize).prop_map(|(motion, world)| {
        let [_, tail, _] = <[Part; 3]>::try_from(fish().parts).expect("three");
        let link = |(i, (angle, rate, frame))| Part {
            parent: usize::saturating_sub(i, 1),
            at_parent: [-0.9, 0.0],
            at_child: [0.9, 0.0],
            angle,
            rate,
            frame: turn_of_axes(frame),
            ..tail.clone()
        };
        Flat {
            parts: motion.into_iter().enumerate().map(link).collect(),
            world: turn_of_axes(world),
            ..fish()
        }
    })
}

#[test]
fn what_the_motion_keeps_is_the_same_in_the_plane() {
    let flat = moved(fish());
    let (full, plane, mut state) = (flat.model(), flat.plane(), flat.state());
    let model = plane.model();
    let mut integrator = Viewed::new(plane.clone(), Gauss::new::<4>(plane.model()));
    let start = full.conserved(&state).expect("finite");
    for _ in 0..200 {
        integrator.step(&mut state, 0.05).expect("a step");
        assert!(full.orthogonality_error(&state.g) < 4e-15);
    }
    let found = full.conserved(&state).expect("finite");
    assert_close(&found.angular.0, &start.angular.0, 1e-13);
    assert_close(&found.linear.0, &start.linear.0, 1e-13);
    let State { g, mu, t } = plane.project(&state);
    let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
    let (at, mut work) = (Context::new(t, &[]), Default::default());
    model.velocity_and_force::<f64>(at, &g, &mu, &mut work, &mut xi, &mut tau);
    assert_close(
        &[model.energy(t, &g, &xi).expect("a state")],
        &[found.energy],
        1e-13,
    );
    assert_close(&[found.energy], &[start.energy], 1e-9);
    let spins: f64 = mu.0.iter().map(|p| p[0]).sum();
    let (x, p) = (g.1[0].0, mu.1[0].0);
    let orbital = x[0] * p[1] - x[1] * p[0];
    // About the point of the plane nearest the origin, which the offset along the normal does not change.
    assert_close(
        &[spins + orbital],
        &[found.angular.dot(plane.normal())],
        1e-13,
    );
}

#[test]
fn a_step_refused_or_seen_ahead_leaves_all_as_it_was() {
    let (plane, start) = (fish().plane(), fish().state());
    let made = || Viewed::new(plane.clone(), Gauss::new::<4>(plane.model()));
    let (mut plain, mut disturbed) = (made(), made());
    let (mut a, mut b) = (start.clone(), start.clone());
    for _ in 0..20 {
        plain.step(&mut a, 0.05).expect("a step");
        let before = b.clone();
        assert!(disturbed.step(&mut b, 1e6).is_err());
        assert_eq!(b, before);
        disturbed.peek(&start, 0.03).expect("a step");
        let ahead = disturbed.peek(&b, 0.05).expect("a step");
        disturbed.step(&mut b, 0.05).expect("a step");
        assert_close(&ahead.mu.coordinates(), &b.mu.coordinates(), 1e-12);
    }
    assert_close(&a.mu.coordinates(), &b.mu.coordinates(), 1e-12);
    assert_eq!(
        (plain.order(), plain.is_symmetric(), plain.is_symplectic()),
        (8, false, true)
    );
    // Another state is taken as it is; one off the plane is not.
    let mut again = start.clone();
    disturbed.step(&mut again, 0.05).expect("a step");
    let mut first = start.clone();
    made().step(&mut first, 0.05).expect("a step");
    assert_close(&again.mu.coordinates(), &first.mu.coordinates(), 1e-12);
    let mut off = start.clone();
    off.g.0[0] = off.g.0[0].compose(&SO3::exp(&Tangent([1e-6, 0.0, 0.0])));
    let before = off.clone();
    assert!(matches!(
        disturbed.step(&mut off, 0.05),
        Err(StepError {
            cause: Cause::Misfit,
            ..
        })
    ));
    assert_eq!(off, before);
}

/// What may lead out of the plane of [`fish`], however little.
#[test]
fn no_part_out_of_the_plane_is_too_small() {
    use NotPlanarCause::*;
    for size in [1e-300, 1e-200, 1e-100, 1e-30, 1e-17, 1e-12] {
        let refused = |tilt: &dyn Fn(&mut Parts)| tilted(false, |parts, _| tilt(parts)).what;
        let out = Vec3([0.0, 0.0, size]);
        let coupling = Mat3([[0.0, 0.0, size], [0.0; 3], [size, 0.0, 0.0]]);
        let causes = [
            refused(&|parts| parts.bodies[1].mass += coupling),
            refused(&|parts| parts.bodies[2].inertia += coupling),
            refused(&|parts| parts.joints[0].at_child += out),
            refused(&|parts| parts.joints[1].at_parent += out),
            refused(&|parts| parts.xi.0[2][0] = size),
            refused(&|parts| parts.xi.1[0][2] = size),
            refused(&|parts| parts.gravity += out),
        ];
        let expected = [
            MassCoupling,
            InertiaCoupling,
            JointOffPlane,
            JointOffPlane,
            SpinOffPlane,
            VelocityOffPlane,
            GravityOffPlane,
        ];
        assert_eq!(causes, expected, "{size:e}");
    }
}
