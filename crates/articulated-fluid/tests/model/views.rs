//! Other coordinates for the same motion: there and back, what the motion keeps, and runs against those of the raw model.

use articulated_fluid::{ArticulatedBody, Comoving, Configuration, Rerooted, View, Viewed};
use dvi::{Cause, Composition, Gauss, Integrator, Lagrangian, State, StepError, Variational};
use lie::{LieGroup, Mat3, Power, Tangent, Vec3, VectorSpace};
use proptest::prelude::*;

use crate::common::*;

const H: f64 = 0.01;

/// Trees of one to six bodies, dry and wet, on free and elastic joints, under gravity and without.
fn tree() -> impl Strategy<Value = Sample> {
    (0..=5_usize).prop_flat_map(|others| sample_of(Shape::Any, others, 0.1))
}

/// The same with the heaviest body at some place after the first.
fn headed() -> impl Strategy<Value = (Sample, usize)> {
    (tree(), any::<prop::sample::Index>(), any::<bool>())
        .prop_filter("a body beside the first", |(sample, ..)| {
            sample.bodies.len() > 1
        })
        .prop_map(|(mut sample, place, dry)| {
            let heaviest = 1 + place.index(sample.bodies.len() - 1);
            let body = &mut sample.bodies[heaviest];
            (body.mass, body.inertia) = (body.mass * 50.0, body.inertia * 50.0);
            let sample = if dry { sample.dry() } else { sample.rebuilt() };
            (sample, heaviest)
        })
}

/// Bodies without a fluid or spheres in one, with masses that weigh as they are or otherwise.
fn isotropic() -> impl Strategy<Value = Sample> {
    (tree(), any::<bool>()).prop_map(|(sample, vacuum)| {
        let mut dry = sample.dry();
        if let Some((_, net)) = dry.weight.as_mut().filter(|_| vacuum) {
            *net = dry.bodies.iter().map(|body| body.mass[(0, 0)]).collect();
        }
        dry.rebuilt()
    })
}

/// Energy, linear and angular momentum.
fn kept(model: &ArticulatedBody, state: &State<Configuration>) -> (f64, Vec3, Vec3) {
    let kept = model.conserved(state).expect("finite");
    (kept.energy, kept.linear, kept.angular)
}

/// The state in the view's coordinates, and from there back.
fn there_and_back<V: View>(
    view: &V,
    state: &State<Configuration>,
) -> (State<V::Inner>, State<Configuration>) {
    let (frame, inner) = view.enter(state).expect("a state of the view");
    let mut back = State {
        t: f64::NAN,
        g: state.g.identity_like(),
        mu: state.g.zero_dual(),
    };
    view.leave(&frame, &inner, &mut back);
    (inner, back)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_tree_on_its_heaviest_body_is_the_same_tree((sample, heaviest) in headed()) {
        let (state, view) = (sample.state(), Rerooted::new(&sample.model).expect("a heavier body"));
        prop_assert_eq!(view.root(), heaviest);
        let (inner, back) = there_and_back(&view, &state);
        assert_same(&back, &state, 1e-14);
        let model = view.model();
        // The velocities of the new momenta are those of the bodies.
        let velocity = model.velocity(&inner).expect("a state");
        let tolerance = 1e-11;
        assert_close(&velocity.1[0].0, &sample.centre_velocities()[heaviest].0, tolerance);
        let rates = |xi: &Velocity| {
            let mut rates: Vec<_> = xi.0.iter().map(|w| w.vec3().norm()).collect();
            rates.sort_by(f64::total_cmp);
            rates
        };
        assert_close(&rates(&velocity), &rates(&sample.xi), tolerance);
        assert_close(&inner.g.1[0].0, &sample.centres(&sample.g)[heaviest].0, 1e-14);
        let ((e, p, l), (energy, linear, angular)) = (kept(&model, &inner), kept(&sample.model, &state));
        let size = norm(&state.mu.coordinates());
        assert_close(&[e], &[energy], 1e-12 * (1.0 + size * size));
        assert_close(&p.0, &linear.0, 1e-12 * size);
        assert_close(&l.0, &angular.0, 1e-13 * size * (1.0 + state.g.1[0].vec3().norm()));
    }

    #[test]
    fn a_run_on_the_heaviest_body_is_the_same_run((sample, _) in headed()) {
        let (start, view) = (sample.state(), Rerooted::new(&sample.model).expect("a heavier body"));
        let steps = (H, 10);
        let raw = run(Gauss::new::<8>(sample.model.clone()), &start, steps);
        let viewed = Viewed::new(view.clone(), Gauss::new::<8>(view.model()));
        assert_same(&run(viewed, &start, steps), &raw, 1e-10);
        let viewed = Viewed::new(view.clone(), Gauss::new::<4>(view.model()));
        assert_same(&run(viewed, &start, steps), &raw, 1e-8);
    }

    #[test]
    fn a_boost_takes_the_mass_centre_s_motion_and_no_more(sample in isotropic()) {
        let (state, view) = (sample.state(), Comoving::new(&sample.model).expect("isotropic masses"));
        let (inner, back) = there_and_back(&view, &state);
        assert_same(&back, &state, 1e-14);
        prop_assert_eq!(inner.mu.1[0].0, [0.0; 3]);
        let masses: Vec<f64> = sample.bodies.iter().map(|body| body.mass[(0, 0)]).collect();
        let mass: f64 = masses.iter().sum();
        let mean = |of: &[Vec3]| {
            let sum = masses.iter().zip(of).fold(Vec3::zero(), |sum, (m, x)| sum + *x * *m);
            sum * (1.0 / mass)
        };
        let (centre, v) = (mean(&sample.centres(&state.g)), mean(&sample.centre_velocities()));
        // The velocities of the new momenta are the old ones less the mass centre's.
        let velocity = view.model().velocity(&inner).expect("a state");
        let mut expected = sample.xi.clone();
        expected.1[0] = (expected.1[0].vec3() - v).into();
        assert_close(&velocity.coordinates(), &expected.coordinates(), 1e-11);
        // König: kinetic energy and angular momentum are those about the mass centre, and its own.
        let (at_rest, whole) = (view.model().conserved(&inner), sample.model.conserved(&state));
        let (at_rest, whole) = (at_rest.expect("finite"), whole.expect("finite"));
        let kinetic = at_rest.kinetic + 0.5 * mass * v.norm_squared();
        assert_close(&[whole.kinetic], &[kinetic], 1e-12 * (1.0 + kinetic));
        let angular = at_rest.angular + centre.cross(v * mass);
        let size = norm(&state.mu.coordinates()) * (1.0 + state.g.1[0].vec3().norm());
        assert_close(&whole.angular.0, &angular.0, 1e-13 * size);
    }

    #[test]
    fn a_step_beside_the_mass_centre_is_the_same_step(sample in isotropic()) {
        let (start, view) = (sample.state(), Comoving::new(&sample.model).expect("isotropic masses"));
        let raw = run(Variational::new(sample.model.clone()), &start, (H, 1));
        let viewed = Viewed::new(view.clone(), Variational::new(view.model()));
        let mut found = run(viewed, &start, (H, 1));
        // The first order falls by a h^2, and the view by half of it, as the mass centre does.
        let mass: f64 = sample.bodies.iter().map(|body| body.mass[(0, 0)]).sum();
        let fall = sample.force() * (1.0 / mass);
        found.g.1[0] = (found.g.1[0].vec3() + fall * (0.5 * H * H)).into();
        // Two solutions of the step's tolerance.
        assert_same(&found, &raw, 5e-13);
    }

    #[test]
    fn a_run_beside_the_mass_centre_is_the_same_run(sample in isotropic()) {
        let (start, view) = (sample.state(), Comoving::new(&sample.model).expect("isotropic masses"));
        let steps = (H, 10);
        let raw = run(Gauss::new::<8>(sample.model.clone()), &start, steps);
        let viewed = Viewed::new(view.clone(), Gauss::new::<8>(view.model()));
        assert_same(&run(viewed, &start, steps), &raw, 1e-11);
        let viewed = Viewed::new(view.clone(), Gauss::new::<4>(view.model()));
        assert_same(&run(viewed, &start, steps), &raw, 1e-9);
        let viewed = Viewed::new(view.clone(), Composition::new::<4>(view.model()));
        assert_same(&run(viewed, &start, steps), &raw, 1e-5);
    }

    #[test]
    fn a_mass_that_differs_by_direction_has_no_such_frame(sample in isotropic(), place in any::<prop::sample::Index>(), part in 0..6_usize) {
        let mut sample = sample;
        let (i, j) = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)][part];
        let body = place.index(sample.bodies.len());
        let mass = &mut sample.bodies[body].mass;
        mass[(i, j)] += mass[(0, 0)] * 4e-16;
        mass[(j, i)] = mass[(i, j)];
        prop_assert!(Comoving::new(&sample.rebuilt().model).is_none());
    }
}

/// The paper's method on another root is another method, by its own error: half as large at half the step.
#[test]
fn the_root_matters_to_the_first_order_by_its_error() {
    let joint = articulated_fluid::Joint {
        parent: 0,
        child: 1,
        at_parent: Vec3([0.5, 0.1, 0.0]),
        at_child: Vec3([-0.7, 0.0, 0.2]),
        kind: Default::default(),
    };
    let body = |m: f64| {
        articulated_fluid::Body::new(
            Mat3::diagonal([m, 2.0 * m, 2.5 * m]),
            Mat3::diagonal([0.2 * m, 0.3 * m, 0.4 * m]),
        )
    };
    let model = ArticulatedBody::new(&[body(1.0), body(3.0)], &[joint]).expect("a model");
    let start = spinning(&model, [0.1, 0.2, 0.0]);
    let view = Rerooted::new(&model).expect("a heavier body");
    let apart = |steps: u32| {
        let steps = (1.0 / steps as f64, steps);
        let raw = run(Variational::new(model.clone()), &start, steps);
        let viewed = Viewed::new(view.clone(), Variational::new(view.model()));
        let viewed = run(viewed, &start, steps);
        let differences = entries(&raw.g)
            .into_iter()
            .zip(entries(&viewed.g))
            .map(|(a, b)| a - b);
        largest(&differences.collect::<Vec<_>>())
    };
    let (coarse, fine) = (apart(100), apart(200));
    assert!(
        coarse > 1e-5 && (coarse / fine - 2.0).abs() < 0.1,
        "{coarse:e} {fine:e}"
    );
}

/// Two bodies, aligned, that spin while the first moves at this velocity.
fn spinning(model: &ArticulatedBody, velocity: [f64; 3]) -> State<Configuration> {
    let rates = [[0.5, -0.3, 0.8], [-0.4, 0.6, 0.1]].map(Tangent);
    let xi = (Power::new(rates.to_vec()), alone(Tangent(velocity)), none());
    model.state(0.0, model.aligned(), &xi).expect("a state")
}

/// Two bodies in a vacuum that drift and fall.
fn falling() -> (ArticulatedBody, State<Configuration>) {
    let body = |m: f64| {
        articulated_fluid::Body::new(
            Mat3::diagonal([m; 3]),
            Mat3::diagonal([0.2 * m, 0.3 * m, 0.4 * m]),
        )
    };
    let joint = articulated_fluid::Joint {
        parent: 0,
        child: 1,
        at_parent: Vec3([0.5, 0.1, 0.0]),
        at_child: Vec3([-0.7, 0.0, 0.2]),
        kind: Default::default(),
    };
    let model = ArticulatedBody::new(&[body(3.0), body(1.0)], &[joint]).expect("a model");
    let model = model
        .with_gravity(Vec3([0.0, 0.0, -9.81]), &[3.0, 1.0])
        .expect("a weight");
    let start = spinning(&model, [7600.0, 0.0, 0.0]);
    (model, start)
}

fn viewed(model: &ArticulatedBody) -> Viewed<Comoving, Gauss<ArticulatedBody>> {
    let view = Comoving::new(model).expect("a vacuum");
    Viewed::new(view.clone(), Gauss::new::<4>(view.model()))
}

#[test]
fn a_time_reset_by_rounding_changes_no_digit_and_another_one_is_another_state() {
    let (model, start) = falling();
    let (mut plain, mut reset) = (viewed(&model), viewed(&model));
    let (mut a, mut b) = (start.clone(), start.clone());
    for k in 1..=50 {
        plain.step(&mut a, 0.02).expect("a step");
        reset.step(&mut b, 0.02).expect("a step");
        // Where it lies between steps is computed from the time that it has been given.
        b.t = f64::from(k) / 50.0;
        assert_eq!(a.g.0, b.g.0, "{k}");
    }
    assert_ne!(a.t, b.t);
    // The state of another time goes on from its own place.
    let before = b.clone();
    b.t += 100.0;
    reset.step(&mut b, 0.02).expect("a step");
    let way = b.g.1[0].vec3() - before.g.1[0].vec3();
    assert!((way[0] - 152.0).abs() < 0.1, "{way:?}");
}

#[test]
fn a_start_known_in_both_coordinates_is_taken_up_again() {
    let (model, start) = falling();
    let (view, other) = (Comoving::new(&model).expect("a vacuum"), falling().1);
    let (_, mut inner) = view.enter(&start).expect("a state");
    // A digit that the drift does not show.
    inner.mu.0[0][0] *= 1.0 + f64::EPSILON;
    let made = || viewed(&model).starting(&start, &inner);
    let once = run(made(), &start, (0.02, 10));
    let mut integrator = made();
    run(&mut integrator, &start, (0.02, 3));
    assert_eq!(run(&mut integrator, &other, (0.02, 0)), start);
    integrator.reset();
    let again = run(&mut integrator, &start, (0.02, 10));
    // The inner integrator keeps its guesses.
    assert_same(&again, &once, 1e-12);
}

#[test]
fn what_does_not_fit_or_overflows_is_refused_and_left_as_it_was() {
    let (model, start) = falling();
    let mut integrator = viewed(&model);
    let mut short = start.clone();
    short.mu.0 = Power::new(short.mu.0[..1].to_vec());
    let before = short.clone();
    let refused = integrator.step(&mut short, 0.02);
    assert!(
        matches!(
            refused,
            Err(StepError {
                cause: Cause::Misfit,
                ..
            })
        ),
        "{refused:?}"
    );
    assert_eq!(short, before);
    let mut fast = start.clone();
    fast.g.1[0] = Vec3([f64::MAX, 0.0, 0.0]).into();
    fast.mu.1[0][0] = f64::MAX;
    let before = fast.clone();
    let refused = integrator.step(&mut fast, 1.0);
    assert!(
        matches!(
            refused,
            Err(StepError {
                cause: Cause::NotFinite,
                ..
            })
        ),
        "{refused:?}"
    );
    assert_eq!(fast, before);
    // And the next state is stepped.
    integrator.step(&mut start.clone(), 0.02).expect("a step");
}

#[test]
fn a_look_ahead_leaves_the_steps_as_they_are() {
    let (model, start) = falling();
    let (mut plain, mut disturbed) = (viewed(&model), viewed(&model));
    let (mut a, mut b) = (start.clone(), start.clone());
    for _ in 0..20 {
        plain.step(&mut a, 0.02).expect("a step");
        disturbed.peek(&start, 0.01).expect("a step");
        let ahead = disturbed.peek(&b, 0.02).expect("a step");
        disturbed.step(&mut b, 0.02).expect("a step");
        assert_same(&ahead, &b, 1e-12);
    }
    assert_same(&a, &b, 1e-12);
}
