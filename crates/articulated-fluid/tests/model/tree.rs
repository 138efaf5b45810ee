//! Trees of up to 30 bodies, and one of 1000: the recursions against dense references, and motions that are known.

use articulated_fluid::{ArticulatedBody, Body, Configuration, Joint, Scene};
use dvi::{DiscreteLagrangian, Integrator, Lagrangian, State, Variational, laws};
use lie::{Jet, LieGroup, Mat3, Power, SO3, Tangent, Vec3, VectorSpace};
use proptest::prelude::*;

use crate::by_duals::ByDuals;
use crate::common::*;

/// Few, for the dense references cost $N^3$.
const CASES: u32 = 32;

/// Small trees are cheap, but the laws try each pair of their coordinates.
const SMALL_CASES: u32 = 32;

fn shape() -> impl Strategy<Value = Shape> {
    let shapes = [Shape::Any, Shape::Chain, Shape::Star, Shape::Comb];
    prop::sample::select(shapes.to_vec())
}

/// 1 to 30 bodies.
fn tree() -> impl Strategy<Value = Sample> {
    (shape(), 0..30_usize).prop_flat_map(|(shape, others)| sample_of(shape, others, 0.1))
}

/// 1 to 5 bodies.
fn small() -> impl Strategy<Value = Sample> {
    (0..=4_usize).prop_flat_map(|others| sample_of(Shape::Any, others, 0.1))
}

/// Steps by the model's inertia.
fn run(
    model: &ArticulatedBody,
    start: &State<Configuration>,
    h: f64,
    steps: usize,
) -> Vec<State<Configuration>> {
    states(Variational::new(model.clone()), start, h, steps)
}

/// The state at the start, and after each step.
fn states(
    mut integrator: Variational<ArticulatedBody>,
    start: &State<Configuration>,
    h: f64,
    steps: usize,
) -> Vec<State<Configuration>> {
    let mut states = vec![start.clone()];
    for _ in 0..steps {
        let mut next = states[states.len() - 1].clone();
        integrator.step(&mut next, h).expect("a step");
        states.push(next);
    }
    states
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn the_elimination_solves_the_dense_inertia(sample in tree()) {
        let (model, inertia, mu) = (&sample.model, sample.inertia(), sample.mu().coordinates());
        let size = norm(&mu);
        assert_close(&product(&inertia, &sample.xi.coordinates()), &mu, 1e-14 * size);
        let (mut work, mut xi) = (Default::default(), sample.xi.clone());
        model.factorise((0.0, 0.0), &model.aligned(), &mut work);
        model.factorise((0.0, 0.0), &sample.g, &mut work);
        // The factorisation outlives a solve.
        for _ in 0..2 {
            spoil(&mut xi);
            model.solve(&mut work, &sample.mu(), &mut xi);
            let xi = xi.coordinates();
            // Rounding, and that times the condition of the inertia, up to 1e4.
            assert_close(&product(&inertia, &xi), &mu, 1e-14 * size);
            assert_close(&xi, &solve(&inertia, &mu), 2e-12);
        }
    }

    #[test]
    fn the_derivatives_are_those_by_dual_numbers(sample in tree()) {
        const H: f64 = 0.1;
        let Sample { model, g, f, .. } = &sample;
        let (closed, jets) = (closed(model, g, f, H), by_jets(model, g, f, H));
        let (f, g) = (jets.d_f.coordinates(), jets.d_g.coordinates());
        // Rounding of sums over the bodies.
        assert_close(&closed.d_f.coordinates(), &f, 1e-14 * norm(&f));
        assert_close(&closed.d_g.coordinates(), &g, 1e-14 * norm(&g));
    }

    #[test]
    fn velocity_and_force_are_those_of_the_lagrangian(sample in tree()) {
        let (xi, tau) = velocity_and_force::<f64>(&sample.model, &sample.g, &sample.mu());
        // Rounding times the condition of the inertia, up to 1e4.
        assert_close(&xi.coordinates(), &sample.xi.coordinates(), 2e-12);
        let expected = force_by_jets(&sample);
        assert_close(&tau.coordinates(), &expected, 2e-13 * norm(&expected));
    }

    #[test]
    fn the_energy_is_constant_along_the_flow(sample in tree()) {
        let (g, mu) = flow(&sample);
        let (xi, _) = velocity_and_force::<J>(&sample.model, &g, &mu);
        let pairs = mu.coordinates().into_iter().zip(xi.coordinates());
        let twice = pairs.fold(J::constant(0.0), |sum, (p, x)| sum + p * x);
        let energy = twice * J::constant(0.5) + sample.potential(&g);
        assert_close(&[energy.partial(0)], &[0.0], 1e-13 * twice.value());
    }

    #[test]
    fn a_step_solves_the_momentum_balance(sample in tree()) {
        const H: f64 = 0.005;
        let start = sample.state();
        let size = norm(&start.mu.coordinates());
        let mut dense = Variational::new(ByDuals(&sample.model)).with_tolerance(1e-13);
        let dense = dense.peek(&start, H).expect("a step");
        let eliminated = || Variational::new(&sample.model).with_tolerance(1e-13);
        for mut integrator in [eliminated(), eliminated().with_all_unknowns()] {
            let f = integrator.displacement(&start, H).expect("a displacement");
            let mut end = start.clone();
            let report = integrator.step(&mut end, H).expect("a step");
            prop_assert!(report.residual <= 1e-13);
            // By dual numbers: what the momentum after the step is by either side of the balance.
            let found = by_jets(&sample.model, &start.g, &f, H);
            let mut before = start.mu.clone();
            before.add_scaled(1.0, &found.d_g);
            let carried = f.coadjoint(&before).coordinates();
            // The step's tolerance, then rounding; of two solutions the tolerance times a few.
            assert_close(&found.d_f.coordinates(), &carried, 2e-13 * size.max(norm(&carried)));
            assert_close(&end.mu.coordinates(), &carried, 2e-15 * size);
            assert_same(&end, &dense, 5e-12);
        }
    }
}

#[test]
fn a_chain_of_six_is_of_order_1() {
    let (model, start) = gentle(Shape::Chain, 6);
    let integrator = || Variational::new(model.clone());
    let order = laws::check_order(integrator, &start, 0.5, &[32, 64, 128, 256]);
    order.unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn a_chain_of_a_thousand_steps_and_keeps_its_momenta() {
    let (model, start) = gentle(Shape::Chain, 1000);
    let (xi, tau) = velocity_and_force::<f64>(&model, &start.g, &start.mu);
    let size = norm(&start.mu.coordinates());
    let back = model.legendre(0.0, &start.g, &xi).expect("a velocity");
    assert_close(&back.coordinates(), &start.mu.coordinates(), 1e-14 * size);
    assert!(tau.max_magnitude().is_finite());
    let mut end = start.clone();
    let mut integrator = Variational::new(model.clone());
    for _ in 0..3 {
        let report = integrator.step(&mut end, 1e-3).expect("a step");
        // 1e-13 times the root of the coordinates over 12.
        assert!(report.residual <= 1.6e-12, "{report:?}");
    }
    let [before, after] = [start, end].map(|state| model.conserved(&state).expect("a state"));
    let (p, q) = (before.linear, before.angular);
    assert_close(&after.linear.0, &p.0, 2e-14 * p.norm());
    assert_close(&after.angular.0, &q.0, 2e-14 * q.norm());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(SMALL_CASES))]

    #[test]
    fn the_laws_hold(sample in small()) {
        // Well within the branch of the step's equation: of long levers and strong added mass it may end at 0.02 s.
        const H: f64 = 0.005;
        let (model, states) = (&sample.model, [sample.state()]);
        laws::check(model, &states, H).unwrap_or_else(|e| panic!("{e}"));
        laws::check_consistency(model, model, &states).unwrap_or_else(|e| panic!("{e}"));
        let mut integrator = Variational::new(model.clone());
        laws::check_step(&mut integrator, model, &states, H).unwrap_or_else(|e| panic!("{e}"));
        let symplectic = laws::check_symplecticity(&mut integrator, &states, H);
        symplectic.unwrap_or_else(|e| panic!("{e}"));
    }

    #[test]
    fn the_weight_alone_changes_the_momenta(sample in small()) {
        const H: f64 = 0.005;
        let states = run(&sample.model, &sample.state(), H, 100);
        let kept = |state| sample.model.conserved(state).expect("the model's state");
        let start = kept(&states[0]);
        let mut angular = start.angular;
        for (k, state) in states.iter().enumerate() {
            let (now, t) = (kept(state), H * k as f64);
            let expected = start.linear + sample.force() * t;
            let reach = 1.0 + state.g.1[0].vec3().norm();
            let size = norm(&state.mu.coordinates()) + start.linear.norm();
            // A random walk of rounding.
            assert_close(&now.linear.0, &expected.0, 2e-14 * size);
            assert_close(&now.angular.0, &angular.0, 1e-14 * size * reach);
            let about = |angular: Vec3| angular.dot(sample.weights().0);
            assert_close(&[about(now.angular)], &[about(start.angular)], 2e-14 * size * reach);
            angular += Sample { g: state.g.clone(), ..sample.clone() }.moment() * H;
        }
    }

    #[test]
    fn in_a_vacuum_all_fall_as_one(sample in small(), gravity in vector(10.0)) {
        const H: f64 = 0.01;
        let mut dry = sample.dry();
        dry.weight = None;
        let weightless = dry.rebuilt();
        let mut heavy = weightless.clone();
        heavy.weight = Some((gravity, heavy.bodies.iter().map(|b| b.mass[(0, 0)]).collect()));
        let heavy = heavy.rebuilt();
        let start = weightless.state();
        let falls = run(&heavy.model, &start, H, 50);
        let floats = run(&weightless.model, &start, H, 50);
        for (k, (falls, floats)) in falls.iter().zip(&floats).enumerate() {
            // The first order moves the fall by half a step: g t (t + h) / 2, here without another error.
            let t = H * k as f64;
            let way = gravity * (t * (t + H) / 2.0);
            let expected = (floats.g.0.clone(), alone(floats.g.1[0].vec3() + way), none());
            // The steps' tolerances, and what the motion makes of them: over a hundred steps, up to this.
            assert_close(&entries(&falls.g), &entries(&expected), 1e-11);
            if weightless.joints.is_empty() {
                let (x, v) = (start.g.1[0].vec3(), weightless.xi.1[0].vec3());
                assert_close(&falls.g.1[0].0, &(x + v * t + way).0, 5e-14);
            }
        }
    }

    #[test]
    fn the_order_of_the_bodies_is_a_matter_of_names(
        sample in tree(),
        keys in prop::collection::vec(any::<u32>(), 30),
    ) {
        const H: f64 = 0.005;
        // order[new] = old: of the bodies whose parents have a place, that of the least key is next.
        let mut order = vec![0];
        while order.len() < sample.bodies.len() {
            let ready = |j: &&Joint| order.contains(&j.parent) && !order.contains(&j.child);
            let next = sample.joints.iter().filter(ready).min_by_key(|j| keys[j.child]);
            order.push(next.expect("a body").child);
        }
        let place = |old: usize| order.iter().position(|o| *o == old).expect("a place");
        let bodies: Vec<_> = order.iter().map(|old| sample.bodies[*old]).collect();
        let renamed = |j: &Joint| Joint { parent: place(j.parent), child: place(j.child), ..j.clone() };
        let joints: Vec<_> = sample.joints.iter().map(renamed).collect();
        let weight = sample.weight.clone();
        let weight = weight.map(|(g, m)| (g, order.iter().map(|old| m[*old]).collect()));
        let rename = |state: &State<Configuration>| {
            let ((r, x, _), (p, px, _)) = (&state.g, &state.mu);
            State {
                t: state.t,
                g: (order.iter().map(|i| r[*i]).collect(), x.clone(), state.g.2.clone()),
                mu: (order.iter().map(|i| p[*i]).collect(), px.clone(), state.mu.2.clone()),
            }
        };
        let start = sample.state();
        let here = run(&sample.model, &start, H, 5);
        let stiffnesses: Vec<f64> = order[1..].iter().map(|old| sample.stiffnesses[old - 1]).collect();
        let model = build(&bodies, &joints, &weight).with_stiffness(&stiffnesses).expect("springs");
        let there = run(&model, &rename(&start), H, 5);
        for (here, there) in here.iter().zip(&there) {
            assert_same(there, &rename(here), 1e-12);
        }
    }
}

/// At a loose tolerance: what is solved for exactly holds to rounding, and what is among the unknowns does not.
#[test]
fn a_translation_among_the_unknowns_is_solved_to_the_tolerance() {
    const H: f64 = 0.02;
    let (model, start) = gentle(Shape::Comb, 7);
    let left = |mut integrator: Variational<&ArticulatedBody>| {
        let f = integrator.displacement(&start, H).expect("a displacement");
        let after = closed(&model, &start.g, &f, H).d_f.1[0].vec3();
        (after - start.mu.1[0].vec3()).norm() / start.mu.1[0].vec3().norm()
    };
    let loose = || Variational::new(&model).with_tolerance(1e-4);
    let (exact, unknown) = (left(loose()), left(loose().with_all_unknowns()));
    assert!(exact < 1e-14, "{exact:e}");
    assert!(unknown > 1e-9, "{unknown:e}");
}

#[test]
fn ten_seconds_with_the_translation_kept_are_the_same() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/fish-chain.toml");
    let scene = Scene::load(path.as_ref()).expect("the paper's fish");
    let (model, start) = (
        scene.model().expect("a model"),
        scene.initial_state().expect("a state"),
    );
    let kept = Variational::new(model.clone()).with_all_unknowns();
    let (a, b) = (
        run(&model, &start, 1e-3, 10_000),
        states(kept, &start, 1e-3, 10_000),
    );
    assert_same(&a[10_000], &b[10_000], 1e-11);
}

/// A float and what hangs on it, which all in all weigh nothing: it swings, and stays where it is.
fn buoy() -> (ArticulatedBody, State<Configuration>) {
    let mass = Mat3([[2.0, 0.1, 0.0], [0.1, 3.0, 0.2], [0.0, 0.2, 2.5]]);
    let inertia = Mat3::diagonal([0.3, 0.4, 0.2]);
    let joint = |parent: usize, child: usize, at_parent: [f64; 3]| Joint {
        parent,
        child,
        at_parent: Vec3(at_parent),
        at_child: Vec3([0.0, 0.1, 0.6]),
        kind: Default::default(),
    };
    let joints = [
        joint(0, 1, [0.1, 0.2, -0.4]),
        joint(1, 2, [0.0, 0.1, -0.5]),
        joint(1, 3, [0.2, -0.1, -0.5]),
    ];
    let weight = Some((Vec3([0.0, 0.0, -9.81]), vec![-1.0, 0.25, 0.25, 0.5]));
    let model = build(&[Body::new(mass, inertia); 4], &joints, &weight);
    let tilt = |x: f64, y: f64| SO3::exp(&Tangent([x, y, 0.0]));
    let tilts = [(0.3, 0.1), (-0.2, 0.3), (0.4, 0.0), (0.1, -0.5)].map(|(x, y)| tilt(x, y));
    let g = (
        Power::new(tilts.to_vec()),
        alone(lie::R3::identity()),
        none(),
    );
    let start = model
        .state(0.0, g, &model.aligned().zero_algebra())
        .expect("a state");
    (model, start)
}

#[test]
fn the_energy_of_a_buoy_stays_within_the_order() {
    let (model, start) = buoy();
    let worst = |h: f64| {
        let steps = (10.0 / h).round() as usize;
        let states = run(&model, &start, h, steps);
        let energy = |state| model.conserved(state).expect("a state").energy;
        let energies: Vec<_> = states.iter().map(energy).collect();
        let half = |half: &[f64]| {
            let defects = half.iter().map(|e| (e - energies[0]).abs());
            defects.fold(0.0, f64::max)
        };
        [half(&energies[..steps / 2]), half(&energies[steps / 2..])]
    };
    let ([early, late], [finer, _]) = (worst(4e-3), worst(2e-3));
    assert!(late < 1.5 * early, "{early:e} {late:e}");
    assert!((early / finer - 2.0).abs() < 0.2, "{early:e} {finer:e}");
}
