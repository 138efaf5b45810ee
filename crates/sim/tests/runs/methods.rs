//! What the methods declare of themselves, measured on the paper's scene.

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::{State, laws};
use sim::method::{Conserved, Family};
use sim::{Method, UnknownMethod};

fn paper() -> (ArticulatedBody, State<Configuration>) {
    let text = include_str!("../../../../scenes/fish-chain.toml");
    let scene = Scene::parse(text, "fish-chain.toml").unwrap();
    (scene.model().unwrap(), scene.initial_state().unwrap())
}

#[test]
fn names_are_read_as_they_are_written() {
    let names: Vec<_> = Method::all().map(Method::name).collect();
    assert_eq!(names.len(), 14);
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
