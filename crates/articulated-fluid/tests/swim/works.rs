//! Work of drives: what is told of it, the balance with the energy, and its order.

use articulated_fluid::{ArticulatedBody, Configuration, Drive, DriveKind, Evaluation};
use dvi::{Composition, Gauss, Integrator, State, Variational};
use lie::Vec3;
use proptest::prelude::*;

use crate::trees::{Tree, trees};
use crate::vectors::{numbers, scene, vectors};

/// A run, and what its drives do.
struct Account {
    model: ArticulatedBody,
    integrator: Box<dyn Integrator<Group = Configuration>>,
    state: State<Configuration>,
    drives: Vec<Drive>,
    energy: f64,
    /// The largest difference of energy and work.
    worst: f64,
}

impl Account {
    fn new(
        model: &ArticulatedBody,
        state: State<Configuration>,
        integrator: Box<dyn Integrator<Group = Configuration>>,
    ) -> Self {
        Self {
            drives: model.drives(),
            energy: model.conserved(&state).expect("finite").energy,
            model: model.clone(),
            integrator,
            state,
            worst: 0.0,
        }
    }

    fn run(&mut self, until: f64, h: f64) {
        let (first, steps) = (self.state.t, ((until - self.state.t) / h).round());
        let mut work = Evaluation::default();
        for k in 1..=steps as u64 {
            let (model, drives) = (&self.model, &mut self.drives);
            let add = &mut |path: dvi::Path<_>| model.add_drives(path, &mut work, drives);
            let stepped = self.integrator.step_along(&mut self.state, h, add);
            stepped.expect("a step");
            self.state.t = first + k as f64 * h;
            let energy = self.model.conserved(&self.state).expect("finite").energy;
            let done: f64 = self.drives.iter().map(|drive| drive.work).sum();
            self.worst = self.worst.max((energy - self.energy - done).abs());
        }
    }
}

type Boxed = Box<dyn Integrator<Group = Configuration>>;

fn methods(model: &ArticulatedBody) -> Vec<(Boxed, f64)> {
    vec![
        (Box::new(Variational::new(model.clone())), 0.01),
        (Box::new(Composition::new::<2>(model.clone())), 0.02),
        (Box::new(Composition::new::<4>(model.clone())), 0.05),
        (Box::new(Gauss::new::<1>(model.clone())), 0.02),
        (Box::new(Gauss::new::<2>(model.clone())), 0.05),
        (Box::new(Gauss::new::<4>(model.clone())), 0.1),
    ]
}

#[test]
fn drives_do_the_work_that_is_told() {
    for name in ["fish-prescribed", "eel-wave"] {
        let scene = scene(name);
        let model = scene.model().expect("a model");
        let start = scene.initial_state().expect("a state");
        let integrator = Box::new(Gauss::new::<8>(model.clone()));
        let mut account = Account::new(&model, start, integrator);
        for told in vectors()[name]["at"].as_array().expect("states") {
            account.run(told["t"].as_f64().expect("a time"), 0.05);
            let works = numbers(&told["joint_work"]);
            let largest = works.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            for Drive { kind, work, .. } in &account.drives {
                let DriveKind::Joint { body } = kind else {
                    continue;
                };
                let off = (work - works[*body]).abs() / largest;
                assert!(off < 1e-9, "{name}: {body} is {off:e} off {}", works[*body]);
            }
            let off = account.worst / largest;
            assert!(off < 1e-9, "{name}: energy and work differ by {off:e}");
        }
    }
}

#[test]
fn the_balance_closes_with_the_order_of_the_method() {
    let scene = scene("fish-prescribed");
    let model = scene.model().expect("a model");
    let start = scene.initial_state().expect("a state");
    for (k, (_, h)) in methods(&model).into_iter().enumerate() {
        let [long, short] = [h, 0.5 * h].map(|h| {
            let (integrator, _) = methods(&model).swap_remove(k);
            let mut account = Account::new(&model, start.clone(), integrator);
            account.run(1.0, h);
            account.worst
        });
        let order = methods(&model)[k].0.order();
        let observed = (long / short).log2();
        println!("order {order}, {h} s: {long:.1e} J, {short:.1e} J, observed {observed:.2}");
        assert!(observed > f64::from(order) - 0.3, "{order}: {observed}");
    }
}

#[test]
fn the_impulses_of_the_drives_turn_the_head() {
    // Its angular momentum changes by what the drives of both tails put on it, as nothing else acts on it about its centre but its joints' forces:
    // with the tails on its mass centre these have no lever.
    let text = "
        fluid.density = 0
        body = [{ name = 'a', mass = 1, inertia = [1, 2, 3] }, { name = 'b', mass = 1, inertia = [1, 1.5, 2] }]
        joint = [{ parent = 'a', child = 'b', at_parent = [0, 0, 0], at_child = [0.4, 0.1, 0.2],
          motion = { amplitude = [0.3, -0.5, 0.8], frequency = 1 } }]
    ";
    let scene = articulated_fluid::Scene::parse(text, "one.toml").expect("a scene");
    let model = scene.model().expect("a model");
    let start = scene.initial_state().expect("a state");
    let spin = |state: &State<Configuration>| {
        let xi = model.velocity(state).expect("a state");
        let omega = xi.0[0].vec3();
        let own = Vec3([omega.0[0], 2.0 * omega.0[1], 3.0 * omega.0[2]]);
        state.g.0[0].rotate(own)
    };
    let before = spin(&start);
    let integrator = Box::new(Gauss::new::<4>(model.clone()));
    let mut account = Account::new(&model, start, integrator);
    account.run(0.4, 0.02);
    let gained = spin(&account.state) - before;
    let impulse = account.drives[0].impulse;
    // The force of the joint on the tail's centre keeps no torque from its own pivot: that is the head's centre.
    assert!((gained + impulse).norm() < 1e-9, "{gained:?} {impulse:?}");
    assert!(impulse.norm() > 1e-2);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn energy_and_work_balance_on_every_tree(tree in trees()) {
        let Tree { model, state, .. } = tree;
        let h = 0.005;
        let until = state.t + 16.0 * h;
        let integrator = Box::new(Gauss::new::<4>(model.clone()));
        let mut account = Account::new(&model, state, integrator);
        account.run(until, h);
        // Eighth order: 4e-11 J or less but for one tree in a few hundred, of rates up to 30 rad/s and energies up to 1e3 J.
        prop_assert!(account.worst < 1e-8, "{:e}", account.worst);
    }
}
