//! Variational Gauss and compositions on the paper's scene.

use articulated_fluid::Configuration;
use dvi::{Cause, Composition, FirstVariation, Gauss, Hint, Integrator, State, laws};
use lgvi::{articulated_fluid, dvi, lie};
use lie::Exp;

use crate::common::{attitude_error, paper, reference, run};

type Fish = Box<dyn Integrator<Group = Configuration>>;

/// Gauss with a number of stages known at run time.
fn gauss(stages: usize) -> Fish {
    let (model, _) = paper();
    Box::new(Gauss::with_stages(model, stages).unwrap())
}

/// Another family, another formulation, another program: the same motion.
#[test]
fn an_independent_method_agrees() {
    let (_, start) = paper();
    let end = reference(10.0);
    for (stages, steps) in [(6, 100), (8, 50)] {
        let apart = attitude_error(&run(gauss(stages), &start, 10.0, steps), &end);
        println!("{stages} stages, {steps} steps, against Dormand-Prince 8(5,3): {apart:.1e}");
        // The reference's own error, amplified by the motion.
        assert!(apart < 1e-9, "{apart:e}");
    }
}

fn order(name: &str, integrator: &dyn Fn() -> Fish, declared: f64, steps: &[u32]) {
    let (_, start) = paper();
    let order = laws::observed_order(integrator, &start, 2.0, steps).unwrap();
    println!(
        "{name}: order {:.3}, errors {:?}",
        order.slope, order.errors
    );
    assert!((order.slope - declared).abs() < 0.2, "{order:?}");
}

#[test]
fn orders_of_gauss() {
    order("1 stage", &|| gauss(1), 2.0, &[200, 400, 800]);
    order("2 stages", &|| gauss(2), 4.0, &[40, 80, 160]);
    order("3 stages", &|| gauss(3), 6.0, &[30, 40, 60]);
    order("4 stages", &|| gauss(4), 8.0, &[20, 24, 32]);
}

#[test]
fn orders_of_gauss_in_the_exponential_chart() {
    let cases: [(usize, [u32; 3]); 4] = [
        (1, [200, 400, 800]),
        (2, [40, 80, 160]),
        (3, [30, 40, 60]),
        (4, [20, 24, 32]),
    ];
    for (stages, steps) in cases {
        let (model, _) = paper();
        let gauss = || Gauss::with_stages(model.clone(), stages).unwrap();
        let boxed = || Box::new(gauss().with_retraction::<Exp>()) as Fish;
        let declared = 2.0 * stages as f64;
        order(&format!("{stages} stages, exp"), &boxed, declared, &steps);
    }
}

#[test]
fn orders_of_compositions() {
    let (model, _) = paper();
    let two = || Box::new(Composition::new::<2>(model.clone())) as Fish;
    order("composition of order 2", &two, 2.0, &[200, 400, 800]);
    let four = || Box::new(Composition::new::<4>(model.clone())) as Fish;
    order("composition of order 4", &four, 4.0, &[60, 90, 120]);
    let six = || Box::new(Composition::new::<6>(model.clone())) as Fish;
    order("composition of order 6", &six, 6.0, &[30, 40, 60]);
    let eight = || Box::new(Composition::new::<8>(model.clone())) as Fish;
    order("composition of order 8", &eight, 8.0, &[20, 24, 30]);
}

fn defect(integrator: &mut impl FirstVariation<Group = Configuration>, h: f64) -> f64 {
    let (model, start) = paper();
    let state = run(Gauss::new::<6>(model), &start, 1.0, 10);
    laws::symplectic_defect(integrator, &state, h).unwrap()
}

#[test]
fn steps_are_symplectic() {
    let (model, _) = paper();
    for stages in 1..=8 {
        let gauss = || Gauss::with_stages(model.clone(), stages).unwrap();
        let [short, long] = [0.1, 0.2].map(|h| defect(&mut gauss(), h));
        println!("{stages} stages: defect {short:.1e} at 0.1 s, {long:.1e} at 0.2 s");
        assert!(short.max(long) < 1e-11, "{short:e}, {long:e}");
    }
    let composed = defect(&mut Composition::new::<4>(model), 0.02);
    println!("composition of order 4: defect {composed:.1e} at 0.02 s");
    assert!(composed < 1e-11, "{composed:e}");
}

/// 1e5 loose steps: the momentum map does not feel the tolerance, the residual says how loose they are.
#[test]
fn momenta_do_not_feel_the_tolerance() {
    const STEPS: u32 = 100_000;
    let (model, start) = paper();
    let kept = model.conserved(&start).unwrap();
    let mut integrator = Gauss::new::<3>(model.clone()).with_tolerance(1e-6);
    let (mut state, mut angular, mut residual) = (start, 0.0_f64, 0.0_f64);
    let carried = state.mu.1[0];
    for step in 0..STEPS {
        residual = residual.max(integrator.step(&mut state, 0.05).unwrap().residual);
        if step % 1000 == 0 {
            let now = model.conserved(&state).unwrap();
            angular = angular.max((now.angular - kept.angular).norm() / kept.angular.norm());
        }
    }
    println!("angular momentum {angular:.1e}, residual {residual:.1e}");
    assert!(residual > 1e-9, "the tolerance was not used: {residual:e}");
    assert_eq!(
        state.mu.1[0], carried,
        "no force, no change of the linear momentum"
    );
    // A random walk of rounding, 10 eps sqrt(N).
    assert!(angular < 10.0 * f64::EPSILON * f64::from(STEPS).sqrt());
}

/// 1000 s at a tenth of a second: the energy oscillates and does not drift.
#[test]
fn energy_stays_in_its_band() {
    let (model, start) = paper();
    let energy = |state: &State<Configuration>| model.conserved(state).unwrap().energy;
    let (initial, mut state) = (energy(&start), start);
    let mut integrator = Gauss::new::<4>(model.clone());
    let mut halves = [0.0_f64; 2];
    for step in 0..10_000 {
        integrator.step(&mut state, 0.1).unwrap();
        let error = (energy(&state) / initial - 1.0).abs();
        halves[step / 5000] = halves[step / 5000].max(error);
    }
    println!("largest energy error in the first and the second half: {halves:?}");
    assert!(
        halves[1] < 1e-8 && halves[1] < 3.0 * halves[0],
        "{halves:?}"
    );
}

#[test]
fn a_refused_step_names_shorter_ones_until_one_would_do() {
    let (_, start) = paper();
    for stages in [1, 2, 4, 8] {
        let (mut state, mut integrator) = (start.clone(), gauss(stages));
        let mut h = 20.0;
        // Down to 0.16 s, which all of them take.
        for _ in 0..8 {
            let Err(error) = integrator.step(&mut state, h) else {
                break;
            };
            assert_eq!(state, start);
            h = match error.cause {
                Cause::NotConverged {
                    hint: Hint::SmallerStep { h } | Hint::AnotherBranch { h },
                    ..
                } => h,
                _ => panic!("{error}"),
            };
        }
        assert!(
            state.t > 0.0,
            "{stages} stages: no step that would do, down to {h} s"
        );
    }
}
