//! What the methods declare of themselves, measured on the paper's scene.

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::{State, laws};
use sim::method::{Conserved, Family};
use sim::{Choice, Method, Plan, SimError, Simulation, UnknownMethod};

fn paper() -> (ArticulatedBody, State<Configuration>) {
    let text = include_str!("../../../../scenes/fish-chain.toml");
    let scene = Scene::parse(text, "fish-chain.toml").unwrap();
    (scene.model().unwrap(), scene.initial_state().unwrap())
}

#[test]
fn names_are_read_as_they_are_written() {
    let names: Vec<_> = Method::all().map(Method::name).collect();
    for method in Method::all() {
        assert_eq!(method.to_string().parse(), Ok(method));
        assert_eq!(
            names.iter().filter(|name| **name == method.name()).count(),
            1
        );
    }
    assert_eq!(Method::default().name(), names[0]);
    for name in ["", "LGVI", "gauss-0", "gauss-9", "composition-3", " lgvi"] {
        let error = name.parse::<Method>().unwrap_err();
        assert_eq!(error, UnknownMethod { name: name.into() });
        let message = error.to_string();
        assert!(names.iter().all(|name| message.contains(name)), "{message}");
    }
}

#[test]
fn the_declarations_are_the_integrators_own() {
    let (model, _) = paper();
    for method in Method::all() {
        let integrator = method.integrator(model.clone());
        assert_eq!(method.order(), integrator.order(), "{method}");
        assert_eq!(method.is_symmetric(), integrator.is_symmetric(), "{method}");
        assert_eq!(
            method.is_symplectic(),
            integrator.is_symplectic(),
            "{method}"
        );
        let reversible = method.conserved().contains(&Conserved::Reversibility);
        assert_eq!(reversible, method.is_symmetric(), "{method}");
    }
}

#[track_caller]
fn order_is_as_declared(name: &str, steps: &[u32]) {
    let (model, start) = paper();
    let method: Method = name.parse().unwrap();
    let integrator = || method.integrator(model.clone());
    let order = laws::observed_order(integrator, &start, 1.0, steps).unwrap();
    println!("{name}: {order:?}");
    assert!(
        (order.slope - f64::from(method.order())).abs() < 0.2,
        "{name}: {order:?}"
    );
    // A fit through what rounding has left over would say little.
    assert_eq!(order.errors.len(), steps.len(), "{name}: {order:?}");
}

#[test]
fn the_paper_s_method_and_its_adjoint_have_order_1() {
    order_is_as_declared("lgvi", &[50, 100, 200, 400]);
    order_is_as_declared("lgvi-adjoint", &[50, 100, 200, 400]);
}

#[test]
fn compositions_have_their_order() {
    order_is_as_declared("composition-2", &[20, 40, 80]);
    order_is_as_declared("composition-4", &[10, 20, 40]);
}

#[test]
fn gauss_methods_have_their_order() {
    order_is_as_declared("gauss-1", &[40, 80, 160]);
    order_is_as_declared("gauss-2", &[20, 40, 80]);
    order_is_as_declared("gauss-3", &[20, 30, 40]);
}

#[test]
fn the_symmetric_methods_alone_are_reversible() {
    let (model, start) = paper();
    let reversible = |method: Method| {
        let mut integrator = method.integrator(model.clone());
        laws::check_reversibility(&mut integrator, core::slice::from_ref(&start), 0.1)
    };
    for method in Method::all().filter(|method| method.is_symmetric()) {
        assert!(
            reversible(method).is_ok(),
            "{method}: {:?}",
            reversible(method)
        );
    }
    // The other Gauss methods are so exact that a step of this size does not show it.
    for name in ["lgvi", "lgvi-adjoint", "gauss-1", "gauss-2", "gauss-3"] {
        assert!(reversible(name.parse().unwrap()).is_err(), "{name}");
    }
    let gauss = |method: &Method| matches!(method.family(), Family::Gauss { .. });
    assert!(!Method::all().filter(gauss).any(Method::is_symmetric));
}

#[test]
fn default_steps_are_usable_at_about_the_cost_that_is_told() {
    let (model, start) = paper();
    let kept = model.conserved(&start).unwrap();
    for method in Method::all() {
        let (mut state, mut integrator) = (start.clone(), method.integrator(model.clone()));
        let (mut steps, mut evaluations) = (0, 0);
        while state.t < 10.0 {
            let report = integrator.step(&mut state, method.default_step()).unwrap();
            (steps, evaluations) = (steps + 1, evaluations + report.evaluations);
        }
        let energy = model.conserved(&state).unwrap().energy / kept.energy - 1.0;
        assert!(energy.abs() < 1e-3, "{method}: {energy:e}");
        let each = f64::from(evaluations) / f64::from(steps);
        let ratio = each / f64::from(method.evaluations_per_step());
        println!("{method}: {each:.1} evaluations a step, energy {energy:.1e}");
        assert!((0.5..2.0).contains(&ratio), "{method}: {each}");
    }
}

/// A wheel on an axle with a damper, which brakes it at `damping / 2` a second.
fn wheel(damping: f64) -> Scene {
    let text = format!(
        "fluid.density = 0
        body = [{{ name = 'wheel', mass = 1, inertia = [1.5, 1.5, 2] }}]
        joint = [{{ parent = 'world', child = 'wheel', at_parent = [0, 0, 0], at_child = [0, 0, 0], type = 'hinge', axis = [0, 0, 1], rate = 1, damping = {damping} }}]"
    );
    Scene::parse(&text, "wheel.toml").expect("a scene")
}

#[test]
fn compositions_keep_away_from_the_poles_of_dampers() {
    let scene = wheel(20.0);
    let (model, start) = (scene.model().unwrap(), scene.initial_state().unwrap());
    let rate = model.braking_rate(0.0, &start.g).unwrap();
    // Found to six digits.
    assert!((rate - 10.0).abs() < 1e-4, "{rate}");
    let plan = |method: &str, step| Plan {
        choice: Choice::Method {
            method: method.parse().unwrap(),
            step,
        },
        until: 1.0,
        ..Plan::default()
    };
    for method in ["composition-4", "composition-6", "composition-8"] {
        let Err(SimError::DamperPole { longest, .. }) = plan(method, Some(1.0)).resolve(&scene)
        else {
            panic!("{method} takes a step over its pole");
        };
        // Half of 3.04 / 10 s at order 4.
        if method == "composition-4" {
            assert!((longest - 0.152).abs() < 1e-3, "{longest}");
        }
        let kept = plan(method, Some(0.99 * longest)).resolve(&scene).unwrap();
        assert_eq!(kept.step, 0.99 * longest);
        assert!(plan(method, None).resolve(&scene).unwrap().step <= longest);
        // With steps a quarter as long, a run is at its order: it stops as exp(-10 t).
        let mut run = Simulation::new(&scene, &plan(method, Some(0.25 * longest))).unwrap();
        let end = run.by_ref().last().unwrap().unwrap();
        let speed = end.velocity.2[0][0];
        assert!(
            (speed - (-10.0_f64).exp()).abs() < 1e-4,
            "{method}: {speed}"
        );
    }
    for method in ["lgvi", "composition-2", "gauss-4"] {
        plan(method, Some(1.0)).resolve(&scene).unwrap();
    }
}
