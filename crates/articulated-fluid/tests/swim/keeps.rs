//! What the account says that a motion keeps, it keeps: every shipped scene, and each load alone.

use std::path::{Path, PathBuf};

use articulated_fluid::{Conserved, Scene};
use dvi::laws::check_symplecticity;
use dvi::{Composition, Gauss, Integrator, Lagrangian, Variational};
use lie::{LieGroup, VectorSpace};

use crate::loads::balance;

type Boxed = Box<dyn Integrator<Group = articulated_fluid::Configuration>>;

/// The scenes that are shipped, but for the wrong ones, and for the hard ones, which are of other sizes than any check's tolerance.
fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let in_folder = |folder: PathBuf| {
        let entries = std::fs::read_dir(folder).expect("a folder");
        entries.map(|entry| entry.expect("an entry").path())
    };
    let folders = ["", "swim", "loads"].map(|name| folder.join(name));
    let paths = folders.into_iter().flat_map(in_folder);
    let mut scenes: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|end| end == "toml"))
        .collect();
    scenes.sort();
    scenes
}

/// How much of each quantity changes in a motion, relative to what is in it.
fn changes(scene: &Scene, [from, to]: [Conserved; 2], name: &str) -> f64 {
    let size = from.kinetic.max(to.kinetic).max(f64::MIN_POSITIVE);
    let masses: f64 = scene.bodies.iter().map(|body| body.total_mass[0][0]).sum();
    let momentum = (2.0 * masses * size).sqrt();
    let spin = momentum * (1.0 + lie::Vec3(scene.position).norm());
    let turned = to.angular - from.angular;
    match name {
        "energy" => (to.energy - from.energy).abs() / size,
        "linear momentum" => (to.linear - from.linear).norm() / momentum,
        "angular momentum" => turned.norm() / spin,
        "angular momentum about the vertical" => {
            let down = lie::Vec3(scene.gravity);
            turned.dot(down * (1.0 / down.norm())).abs() / spin
        }
        // Told by the tests of work, of the weight's impulse, and below.
        _ => 0.0,
    }
}

#[test]
fn what_is_said_to_be_kept_is_kept() {
    let mut counts = std::collections::BTreeMap::new();
    for path in shipped() {
        let scene = Scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
        let model = scene.model().expect("a model");
        let start = scene.initial_state().expect("a state");
        let keeps = scene.smallest().expect("a model").account.keeps;
        let mut state = start.clone();
        let mut integrator = Gauss::new::<6>(model.clone());
        let solved = (0..50).all(|_| integrator.step(&mut state, 1e-3).is_ok());
        assert!(solved, "{}", path.display());
        let ends = [&start, &state].map(|state| model.conserved(state).expect("finite"));
        for name in keeps {
            *counts.entry(name).or_insert(0) += 1;
            let off = changes(&scene, ends, name);
            // Rounding of 50 steps.
            assert!(off < 1e-9, "{}: {name} changes by {off:e}", path.display());
            if name == "symplectic form" && start.g.0.len() < 8 {
                // Of zero momentum all is zero: so with a velocity in every direction.
                let mut xi = start.g.zero_algebra();
                (0..xi.dim()).for_each(|i| xi.set(i, 0.3));
                let moving = [model.state(0.0, start.g.clone(), &xi).expect("a state")];
                let checked =
                    check_symplecticity(&mut Gauss::new::<2>(model.clone()), &moving, 1e-3);
                checked.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            }
        }
    }
    println!("{counts:?}");
    assert!(counts.len() >= 5, "scenes of every kind");
}

const BODIES: &str = "semi_axes = [0.2, 0.03, 0.1]";

/// A head and a tail on a joint of this kind, with these keys.
fn pair(on_head: &str, joint: &str) -> Scene {
    let text = format!(
        "fluid.density = 1000
        start.velocity = [0.4, 0.2, 0]
        body = [{{ name = 'head', semi_axes = [0.3, 0.05, 0.1], angular_velocity = [0.5, -0.7, 1]{on_head} }}, {{ name = 'tail', {BODIES} }}]
        joint = [{{ parent = 'head', child = 'tail', at_parent = [-0.32, 0, 0], at_child = [0.22, 0, 0]{joint} }}]"
    );
    Scene::parse(&text, "pair.toml").unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn energy_and_work_of_each_load_alone_balance_with_the_order() {
    let hinge = ", type = 'hinge', axis = [0, 0.3, 1]";
    let target = "target = { amplitude = 0.5, frequency = 1 }";
    let loads = [
        ("damper in a ball", "", ", damping = 0.3".to_owned()),
        ("damper in a hinge", "", format!("{hinge}, rate = 2, damping = 0.3")),
        ("torque in a ball", "", ", torque = { amplitude = [0.1, 0.3, 0.2], frequency = 0.7 }".to_owned()),
        ("servo in a hinge", "", format!("{hinge}, servo = {{ kp = 5, kd = 0.5, {target} }}")),
        ("servo in a ball", "", ", servo = { kp = 3, kd = 0.2, target = { amplitude = [0.1, 0.2, 0.5], frequency = 1 } }".to_owned()),
        ("linear drag", ", drag = { linear = [1, 5, 5], angular_linear = [0.01, 0.1, 0.1] }", String::new()),
        ("quadratic drag", ", drag = { quadratic = [2, 40, 25], smooth_below = 0.1 }", String::new()),
        ("thrust", ", thrust = { force = [2, 0, 0.3], at = [-0.1, 0.02, 0] }", String::new()),
    ];
    for (name, on_head, joint) in loads {
        let scene = pair(on_head, &joint);
        let model = scene.model().expect("a model");
        let methods: [(Boxed, f64); 5] = [
            (Box::new(Variational::new(model.clone())), 0.005),
            (Box::new(Composition::new::<2>(model.clone())), 0.01),
            (Box::new(Composition::new::<4>(model.clone())), 0.025),
            (Box::new(Gauss::new::<1>(model.clone())), 0.01),
            (Box::new(Gauss::new::<2>(model.clone())), 0.025),
        ];
        let mut row = String::new();
        for (mut integrator, h) in methods {
            let order = integrator.order();
            let [[long, work], [short, _]] = [h, 0.5 * h].map(|h| {
                integrator.reset();
                balance(&scene, integrator.as_mut(), h)
            });
            let observed = (long / short).log2();
            row += &format!(" | {long:.1e} {short:.1e} {observed:.2}");
            assert!(work.abs() > 1e-3, "{name} does {work} J");
            assert!(
                observed > f64::from(order) - 0.4,
                "{name}, order {order}: {row}"
            );
        }
        println!("{name:>18}{row}");
    }
}
