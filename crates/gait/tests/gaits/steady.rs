//! Steady strokes: orbits that come back, multipliers, and gradients by first variations.

use articulated_fluid::Scene;
use dvi::{Gauss, Integrator};
use gait::{Chain, Fourier, GaitError, Limits, Objective, Search, Steady, Swimmer, net_motion};
use lie::{LieGroup, SE3, VectorSpace};

use crate::swimmers::Plain;

/// A fish of three ellipsoids, braked; its tail hangs on a spring or moves as told.
fn braked(tail: &str, drag: f64) -> Scene {
    braked_at(tail, drag, 1.0)
}

/// The same with all lengths times `scale`. Masses go with its cube, forces per velocity too, and moments per rate with its fifth power.
fn braked_at(tail: &str, drag: f64, scale: f64) -> Scene {
    let (linear, angular) = (drag * scale.powi(3), 0.1 * drag * scale.powi(5));
    let [b, c, long, short] = [0.1, 0.2, 0.55, 0.35].map(|x: f64| x * scale);
    let body = |name: &str, a: f64| {
        let a = a * scale;
        format!(
            "{{ name = '{name}', semi_axes = [{a}, {b}, {c}],
               drag = {{ linear = [{linear}, {0}, {0}], angular_linear = [{angular}, {angular}, {angular}] }} }}",
            4.0 * linear,
        )
    };
    let text = format!(
        "fluid.density = 10
        start.momentum = 'zero'
        body = [{}, {}, {}]
        joint = [
          {{ parent = 'trunk', child = 'head', at_parent = [{long}, 0, 0], at_child = [-{short}, 0, 0], type = 'hinge', axis = [0, 0.2, 1],
             motion = {{ amplitude = 0.4, frequency = 1 }} }},
          {{ parent = 'trunk', child = 'tail', at_parent = [-{long}, 0, 0], at_child = [{short}, 0, 0], type = 'hinge', axis = [0, 0, 1], {tail} }},
        ]",
        body("trunk", 0.5),
        body("head", 0.3),
        body("tail", 0.3),
    );
    Scene::parse(&text, "braked.toml").unwrap_or_else(|error| panic!("{error}"))
}

const DRIVEN: &str = "motion = { amplitude = 0.5, frequency = 1, phase = 1.2 }";
const SPRUNG: &str = "stiffness = 2, damping = 0.2";

/// Where many periods lead, from the scene's own start.
fn after(scene: &Scene, periods: u32) -> SE3 {
    const STEPS: u32 = 40;
    let mut state = scene.initial_state().expect("a state");
    let mut gauss = Gauss::new::<4>(Plain(scene.model().expect("a model")));
    let at = |g: &articulated_fluid::Configuration| SE3::new(g.0[0], g.1[0].vec3());
    let mut before = at(&state.g);
    for n in 0..periods {
        before = at(&state.g);
        for k in 0..STEPS {
            state.t = f64::from(n) + f64::from(k) / f64::from(STEPS);
            gauss
                .step(&mut state, 1.0 / f64::from(STEPS))
                .expect("a step");
        }
    }
    before.inverse().compose(&at(&state.g))
}

fn apart(a: &SE3, b: &SE3) -> f64 {
    let change = a.inverse().compose(b);
    change.translation.norm() + change.rotation.matrix().skew_vee().norm()
}

/// The steady stroke of a scene, which its own motion comes to: that of the 80th period, when disturbances have died out by the largest
/// multiplier to the 78th.
#[track_caller]
fn comes_to_its_stroke(scene: &Scene) -> Steady {
    let swimmer = Swimmer::new(scene).expect("a swimmer");
    let (steady, steps) = swimmer.steady().expect("a stroke");
    println!("{steps} steps, multipliers {:?}", steady.multipliers);
    assert!(steady.is_stable(), "{:?}", steady.multipliers);
    let left = steady.largest_multiplier().powi(78);
    let found = after(scene, 80);
    assert!(
        apart(&steady.net, &found) < 1e-8 + left,
        "{:?} {found:?}",
        steady.net
    );
    steady
}

#[test]
fn a_braked_swimmer_comes_to_its_steady_stroke() {
    for tail in [DRIVEN, SPRUNG] {
        comes_to_its_stroke(&braked(tail, 2.0));
    }
}

/// Without drag the momentum is kept, and a tail on a spring with a damper comes to its stroke all the same.
#[test]
fn a_tail_on_a_spring_comes_to_its_stroke_without_drag() {
    let steady = comes_to_its_stroke(&braked(SPRUNG, 0.0));
    assert!(steady.multipliers.len() == 2);
}

/// Lengths of a thousandth in a fluid as dense, with drag to match: the same motion, a thousand times smaller.
#[test]
fn a_small_swimmer_is_solved_as_well_as_a_large_one() {
    let net = |scale: f64| {
        let scene = braked_at(DRIVEN, 2.0, scale);
        Swimmer::new(&scene)
            .expect("a swimmer")
            .steady()
            .expect("a stroke")
            .0
            .net
    };
    let (large, small) = (net(1.0), net(1e-3));
    let off = (small.translation * 1e3 - large.translation).norm();
    assert!(off < 1e-8, "{large:?} {small:?}");
}

/// Little drag leads to the stroke without momentum.
#[test]
fn without_drag_the_steady_stroke_is_that_of_the_shape() {
    let net = |drag: f64| {
        Swimmer::new(&braked(DRIVEN, drag))
            .expect("a swimmer")
            .steady()
            .expect("a stroke")
            .0
            .net
    };
    let dry = braked(DRIVEN, 0.0);
    let told = gait::Told::new(&dry.model().expect("a model")).expect("a stroke");
    let chain = Chain::new(&dry).expect("a chain");
    let ideal = net_motion(&chain, &told).expect("a motion");
    // The momentum that drag leaves is in proportion to nothing but the stroke: the drag averages over it.
    let [much, little] = [1.0, 0.1].map(|drag| apart(&net(drag), &ideal));
    assert!(little < much, "{little} {much}");
}

/// Against central differences, whose error is some 1e-9 here.
#[test]
fn the_gradient_of_a_steady_stroke_is_that_of_differences() {
    for tail in [DRIVEN, SPRUNG] {
        let swimmer = Swimmer::new(&braked(tail, 8.0)).expect("a swimmer");
        let own = Fourier::fit(swimmer.told(), 2).expect("a stroke");
        let (net, gradient) = swimmer.steady_by(&own).expect("a gradient");
        const STEP: f64 = 1e-4;
        for k in 0..own.coefficients().len() {
            let end = |by: f64| {
                let mut coefficients = own.coefficients().to_vec();
                coefficients[k] += by;
                let moved = Fourier::new(1.0, 2, coefficients).expect("a stroke");
                let end = swimmer.steady_by(&moved).expect("a motion").0;
                net.inverse().compose(&end).log().expect("a small motion")
            };
            let mut difference = end(STEP) - end(-STEP);
            difference.scale(0.5 / STEP);
            let off = (difference - gradient[k]).max_magnitude();
            assert!(off < 1e-7, "{k}: {difference:?} {:?}", gradient[k]);
        }
    }
}

/// With drag: the best stroke within a limit is better than the scene's own.
#[test]
fn a_better_stroke_is_found_with_drag() {
    let limits = Limits {
        angle: 0.8,
        rate: f64::INFINITY,
    };
    let search = Search::new(&braked(DRIVEN, 2.0), Objective::Advance, limits).expect("a search");
    let own = search.own(1).expect("a stroke");
    let found = search
        .improve(&own, &|| true)
        .expect("an evaluation")
        .expect("a stroke");
    let rewritten = Swimmer::new(&braked(DRIVEN, 2.0)).expect("a swimmer");
    let gain = |stroke| {
        let net = rewritten.steady_by(stroke).expect("a motion").0;
        Objective::Advance.gain(search.chain(), &net)
    };
    let own = gain(&own);
    println!("{own} {} by {} evaluations", found.value, found.evaluations);
    assert!(found.value > 1.05 * own);
    // Found again from the stroke alone.
    assert!((gain(&found.stroke) - found.value).abs() < 1e-9);
    let work = Search::new(&braked(DRIVEN, 2.0), Objective::AdvancePerWork, limits);
    assert!(matches!(work, Err(GaitError::Objective)));
}
