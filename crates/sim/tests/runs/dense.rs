//! Frames inside a step, interpolated between the stages.

use sim::{Choice, Frame, Method, Plan, Schedule, Simulation, distance};

use crate::{paper, scene};

fn plan(method: Method, step: f64) -> Plan {
    let step = Some(step);
    Plan {
        choice: Choice::Method { method, step },
        until: 1.0,
        schedule: Schedule::Seconds(0.013),
        ..Plan::default()
    }
}

fn frames(simulation: Simulation) -> Vec<Frame> {
    simulation.map(Result::unwrap).collect()
}

/// The largest distance of interpolated frames from the exact ones.
fn error(method: Method, step: f64) -> f64 {
    let simulation = || Simulation::new(&paper(), &plan(method, step)).unwrap();
    let (near, exact) = (frames(simulation().interpolated()), frames(simulation()));
    assert_eq!(near.len(), exact.len());
    let pairs = near.iter().zip(&exact);
    pairs
        .map(|(a, b)| {
            assert_eq!(a.t(), b.t());
            distance(&a.state.g, &b.state.g)
        })
        .fold(0.0, f64::max)
}

#[test]
fn they_have_an_order_of_one_more_than_the_stages() {
    for (stages, step) in [(2, 0.02), (4, 0.05), (6, 0.1)] {
        let method = Method::gauss(stages).unwrap();
        let [long, short] = [step, 0.5 * step].map(|h| error(method, h));
        let order = (long / short).log2();
        println!("gauss-{stages}: {long:.1e}, {short:.1e}, order {order:.2}");
        // One in part, as the worst of the frames is elsewhere.
        assert!(order > f64::from(stages) + 0.5, "{order}");
    }
}

#[test]
fn they_are_on_the_group_and_the_run_is_the_same() {
    let method = Method::gauss(8).unwrap();
    let simulation = || Simulation::new(&paper(), &plan(method, 0.26)).unwrap();
    let (near, exact) = (frames(simulation().interpolated()), frames(simulation()));
    assert!(near.iter().all(|frame| frame.sample.orthogonality < 1e-14));
    let last = |frames: &[Frame]| frames.last().unwrap().state.g.clone();
    // Shorter steps in between leave another first guess: 1 s of chaos makes less of its rounding.
    assert!(distance(&last(&near), &last(&exact)) < 1e-12);
}

#[test]
fn methods_and_scenes_without_them_give_exact_frames() {
    let composed = plan("composition-4".parse().unwrap(), 0.05);
    let driven = plan(Method::gauss(4).unwrap(), 0.05);
    for (scene, plan) in [(paper(), composed), (scene("swim/eel"), driven)] {
        let simulation = || Simulation::new(&scene, &plan).unwrap();
        assert_eq!(frames(simulation().interpolated()), frames(simulation()));
    }
}
