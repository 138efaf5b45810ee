//! After the first step, no step allocates: with the model's inertia, and with everything from the value alone.

use allocation_counter::measure;
use articulated_fluid::Scene;
use dvi::{Composition, Gauss, Integrator, State, Variational};
use lgvi::sim::Method;
use lgvi::{articulated_fluid, dvi};

use crate::by_duals::ByDuals;
use crate::common::paper;
use crate::value_only::ValueOnly;

fn allocations<I: Integrator>(mut integrator: I, mut state: State<I::Group>) -> u64 {
    integrator.step(&mut state, 1e-3).unwrap();
    let steps = measure(|| {
        for _ in 0..1000 {
            integrator.step(&mut state, 1e-3).unwrap();
        }
        // Another step size renews the matrix, in the same storage.
        integrator.step(&mut state, 2e-3).unwrap();
    });
    steps.count_total
}

#[test]
fn steps_do_not_allocate() {
    let (model, start) = paper();
    assert_eq!(
        allocations(Variational::new(model.clone()), start.clone()),
        0
    );
    let by_duals = Variational::new(ByDuals(model.clone()));
    assert_eq!(allocations(by_duals, start.clone()), 0);
    assert_eq!(allocations(Variational::new(ValueOnly(model)), start), 0);
}

/// Steps of one size: another one makes another extrapolation, in the same storage.
#[test]
fn steps_of_high_order_do_not_allocate() {
    let (model, start) = paper();
    let gauss = Gauss::new::<4>(model.clone());
    assert_eq!(allocations(gauss, start.clone()), 0);
    let by_newton = measure(|| {
        let mut state = start.clone();
        let mut integrator = Gauss::new::<8>(model.clone());
        // So long that they take Newton's method; the first, refused, makes its storage.
        integrator.step(&mut state, 20.0).unwrap_err();
        let mut steps = |n: u32| {
            let mut solved = (0..n).map(|_| integrator.step(&mut state, 0.5));
            assert!(solved.all(|step| step.is_ok()));
        };
        steps(1);
        assert_eq!(measure(|| steps(3)).count_total, 0);
    });
    assert!(by_newton.count_total > 0);
    assert_eq!(allocations(Composition::new::<4>(model), start), 0);
}

/// In space and in a plane, with masses as matrices and as numbers, under gravity.
#[test]
fn steps_of_any_scene_do_not_allocate() {
    for name in ["eel", "branching-robot", "dry-chain", "planar-fish"] {
        let path = format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let scene = Scene::load(path.as_ref()).unwrap();
        let mut state = scene.initial_state().unwrap();
        let mut integrator = Method::default().integrator_of_smallest(&scene.smallest().unwrap());
        integrator.step(&mut state, 1e-3).unwrap();
        let steps = measure(|| {
            for _ in 0..100 {
                integrator.step(&mut state, 1e-3).unwrap();
            }
        });
        assert_eq!(steps.count_total, 0, "{name}");
    }
}

#[test]
fn the_counter_counts() {
    assert_eq!(
        measure(|| drop(std::hint::black_box(vec![1]))).count_total,
        1
    );
}
