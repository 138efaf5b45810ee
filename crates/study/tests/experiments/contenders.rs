//! What the baselines declare of themselves, measured on the paper's scene; names.

use dvi::{Integrator, laws};
use sim::Method;
use study::contender::{Contender, Control, Failure, Problem, Setting, UnknownContender};
use study::work_precision::{Errors, Reference, SAMPLES};

use crate::common::{named, paper};

#[track_caller]
fn order_is_as_declared(name: &str, steps: &[u32]) {
    let (problem, contender) = (paper(1.0), named(name));
    let integrator = || contender.integrator(&problem).unwrap();
    assert_eq!(integrator().order(), contender.order());
    assert!(!integrator().is_symmetric() && !integrator().is_symplectic());
    let order = laws::check_order(integrator, &problem.start, 1.0, steps).unwrap();
    println!("{name}: {order:?}");
    assert_eq!(order.errors.len(), steps.len(), "{name}: {order:?}");
}

#[test]
fn fixed_steps_have_their_order_and_the_negative_control_has_2() {
    for name in ["rk4", "rkmk4", "cf4"] {
        order_is_as_declared(name, &[20, 40, 80]);
    }
    assert_eq!(named("rkmk4-plain").order(), 2);
    order_is_as_declared("rkmk4-plain", &[80, 160, 320]);
}

#[test]
fn adaptive_pairs_work_at_their_order() {
    let problem = paper(10.0);
    for (name, tolerances) in [("dp54", [1e-6, 1e-9]), ("dp853", [1e-7, 1e-11])] {
        let contender = named(name);
        let [loose, tight] = tolerances.map(|tolerance| {
            let cost = contender.run(&problem, Setting::Tolerance(tolerance));
            cost.unwrap().steps as f64
        });
        // The error of a step is of one order more than the error estimate's, 4 and 7.
        let order = (tolerances[0] / tolerances[1]).ln() / (tight / loose).ln();
        println!("{name}: {order:.2}");
        assert!(
            (order - f64::from(contender.order())).abs() < 0.6,
            "{name}: {order}"
        );
    }
}

#[test]
fn names_are_read_as_they_are_written() {
    let names: Vec<_> = Contender::all().map(Contender::name).collect();
    assert!(Method::all().all(|method| names.contains(&method.name())));
    // A name that two have is read as the first of them.
    for contender in Contender::all() {
        assert_eq!(contender.to_string().parse(), Ok(contender));
    }
    for name in ["", "RK4", "dp45", "rkmk"] {
        let error = name.parse::<Contender>().unwrap_err();
        assert_eq!(error, UnknownContender { name: name.into() });
        let message = error.to_string();
        assert!(names.iter().all(|name| message.contains(name)), "{message}");
    }
}

#[test]
fn a_setting_is_for_its_own_control() {
    let problem = paper(1.0);
    for contender in Contender::all() {
        let other = match contender.control() {
            Control::Step => Setting::Tolerance(1e-6),
            Control::Tolerance => Setting::Accuracy(1e-6),
            Control::Accuracy => Setting::Steps(100),
        };
        let refused = contender.run(&problem, other);
        assert!(
            matches!(refused, Err(Failure::Control { .. })),
            "{contender}"
        );
    }
}

/// The largest attitude error is below `bound`, rad, and no smaller than a thousandth of what is asked for: the setting is heeded.
#[track_caller]
fn error_is_within(
    name: &str,
    setting: Setting,
    (problem, exact): (&Problem, &Reference),
    bound: f64,
) {
    let states = named(name).sample(problem, setting, SAMPLES).unwrap();
    let errors = Errors::new(&problem.model, &states, &exact.states).unwrap();
    let least = 1e-3 * setting.value(problem.until);
    assert!(errors.attitude < bound, "{name}, {setting}: {errors:?}");
    assert!(errors.attitude > least, "{name}, {setting}: {errors:?}");
}

/// Against the same pair in charts: what all ratios of time are measured by goes where the motion goes, and no further from it
/// than its tolerance says.
#[test]
fn the_yardstick_is_accurate() {
    let problem = paper(2.0);
    let exact = Reference::new(&problem).unwrap();
    for (name, tolerance) in [
        ("dp853", 1e-6),
        ("dp853", 1e-9),
        ("dp853", 1e-12),
        ("dp54", 1e-9),
    ] {
        let setting = Setting::Tolerance(tolerance);
        error_is_within(name, setting, (&problem, &exact), 100.0 * tolerance);
    }
}

/// Over 100 s a difference grows a millionfold, and what a step leaves unsolved with it.
#[test]
fn a_pilot_is_as_accurate_as_asked_where_errors_grow() {
    let problem = paper(100.0);
    let exact = Reference::new(&problem).unwrap();
    for accuracy in [1e-3, 1e-4, 1e-6] {
        let setting = Setting::Accuracy(accuracy);
        error_is_within("pilot", setting, (&problem, &exact), accuracy);
    }
}

#[test]
fn samples_are_those_of_the_run() {
    let problem = paper(1.0);
    for (name, setting) in [
        ("gauss-2", Setting::Steps(12)),
        ("rk4", Setting::Steps(12)),
        ("dp54", Setting::Tolerance(1e-8)),
        ("dp853", Setting::Tolerance(1e-8)),
        ("pilot", Setting::Accuracy(1e-6)),
    ] {
        let few = named(name).sample(&problem, setting, 4).unwrap();
        let many = named(name).sample(&problem, setting, 20).unwrap();
        let times: Vec<_> = few.iter().map(|state| state.t).collect();
        assert_eq!(times, [0.0, 0.25, 0.5, 0.75, 1.0]);
        for (a, b) in few.iter().zip(many.iter().step_by(5)) {
            assert!(laws::distance(a, b) < 1e-6, "{name}");
        }
    }
}
