//! Dampers in the matrix of a step, (S23).

use articulated_fluid::{ArticulatedBody, Configuration, JointLoad, Scene};
use dvi::{
    Context, Derivatives, DiscreteLagrangian, Integrator, Lagrangian, State, Still, System,
    Variational,
};
use lie::{AlgebraOver, DualOver, LieGroup, Over, Scalar, Vec3, VectorSpace};
use proptest::prelude::*;

use crate::trees::{Tree, trees};

/// A damper: the parent, if it is a body, the child, and $d$.
type Damper = (Option<usize>, usize, f64);

/// The tree with dampers in all joints that leave something free.
fn damped(Tree { told, model, .. }: &Tree) -> (ArticulatedBody, Vec<Damper>) {
    let (parts, held) = told;
    let first = usize::from(!held);
    let damping = |i: usize| match parts[i].1 {
        0 | 1 => 1.0 + 3.0 * i as f64,
        _ => 0.0,
    };
    let bodies = first..parts.len();
    let loads = bodies.clone().map(|i| JointLoad {
        damping: damping(i),
        ..JointLoad::default()
    });
    let loads: Vec<_> = loads.collect();
    let parent = |i: usize| (i > 0).then(|| parts[i].0 % i);
    let dampers = bodies.map(|i| (parent(i), i, damping(i))).collect();
    (
        model.clone().with_joint_loads(&loads).expect("loads"),
        dampers,
    )
}

/// The rates $\omega_j$ of the joints at a velocity, less those of what moves as told.
fn joint_rates(
    model: &ArticulatedBody,
    dampers: &[Damper],
    (t, g, xi): (f64, &Configuration, &AlgebraOver<Configuration, f64>),
) -> Vec<Vec3> {
    let rates = |xi| model.kinematics(t, g, xi).expect("a state").rates;
    let (moving, still) = (rates(xi), rates(&g.zero_algebra()));
    let own: Vec<Vec3> = moving.iter().zip(&still).map(|(a, b)| *a - *b).collect();
    let r = model.attitudes(t, g).expect("a state");
    let on_parent = |&(parent, child, _): &Damper| match parent {
        None => own[child],
        Some(p) => own[child] - r[child].inverse_rotate(r[p].rotate(own[p])),
    };
    dampers.iter().map(on_parent).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    /// $(\mathbb I + h D) \xi = \mu$ with $\eta \cdot D \xi = \sum_j d_j\, \omega_j(\eta) \cdot \omega_j(\xi)$.
    #[test]
    fn the_matrix_of_a_step_has_the_dampers_in_it(tree in trees(), h in 0.01..10.0) {
        let (model, dampers) = damped(&tree);
        let Tree { state: State { t, g, .. }, xi: momentum, .. } = &tree;
        let mut mu = g.zero_dual();
        (0..mu.dim()).for_each(|i| mu.set(i, momentum.get(i)));
        let (mut work, mut xi) = (Default::default(), g.zero_algebra());
        model.factorise((*t, 2.0 * h), g, &mut work);
        model.factorise((*t, h), g, &mut work);
        model.solve(&mut work, &mu, &mut xi);
        let still = model.legendre(*t, g, &g.zero_algebra()).expect("a state");
        let moving = model.legendre(*t, g, &xi).expect("a state");
        let rates = joint_rates(&model, &dampers, (*t, g, &xi));
        for i in 0..mu.dim() {
            let mut eta = g.zero_algebra();
            eta.set(i, 1.0);
            let along = joint_rates(&model, &dampers, (*t, g, &eta));
            let joints = dampers.iter().zip(rates.iter().zip(&along));
            let braked: f64 = joints.map(|((.., d), (a, b))| d * a.dot(*b)).sum();
            let balance = moving.get(i) - still.get(i) + h * braked - mu.get(i);
            // Rounding of terms up to 100, times h.
            prop_assert!(balance.abs() < 1e-11 * (1.0 + h), "{i}: {balance:e}");
        }
    }
}

/// The same without the dampers in the matrix of a step.
#[derive(Clone)]
struct Plain(ArticulatedBody);

impl System for Plain {
    type Group = Configuration;

    fn cyclic(&self) -> core::ops::Range<usize> {
        self.0.cyclic()
    }
    fn is_driven(&self) -> bool {
        self.0.is_driven()
    }
}

impl DiscreteLagrangian for Plain {
    type Workspace<S: Scalar> = <ArticulatedBody as DiscreteLagrangian>::Workspace<S>;
    const HAS_INERTIA: bool = true;

    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<Configuration, S>,
        f: &Over<Configuration, S>,
        h: S,
    ) -> S {
        DiscreteLagrangian::value(&self.0, at, g, f, h)
    }
    fn derivatives<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<Configuration, S>,
        f: &Over<Configuration, S>,
        h: S,
        work: &mut Self::Workspace<S>,
        out: &mut Derivatives<Configuration, S>,
    ) {
        self.0.derivatives(at, g, f, h, work, out);
    }
    fn is_defined(&self, t: f64, g: &Configuration, still: &Still<Configuration>) -> bool {
        DiscreteLagrangian::is_defined(&self.0, t, g, still)
    }
    fn factorise(&self, (t, _): (f64, f64), g: &Configuration, work: &mut Self::Workspace<f64>) {
        self.0.factorise((t, 0.0), g, work);
    }
    fn solve(
        &self,
        work: &mut Self::Workspace<f64>,
        mu: &DualOver<Configuration, f64>,
        xi: &mut AlgebraOver<Configuration, f64>,
    ) {
        self.0.solve(work, mu, xi);
    }
    fn solve_cyclic(
        &self,
        work: &mut Self::Workspace<f64>,
        mu: &DualOver<Configuration, f64>,
        xi: &mut AlgebraOver<Configuration, f64>,
    ) {
        self.0.solve_cyclic(work, mu, xi);
    }
}

/// An eel of `n` by motors, on balls or on hinges, whose damping takes `stiffness` times its least inertia in a step of 0.01 s.
fn stiff(kind: &str, n: usize, stiffness: f64) -> (ArticulatedBody, State<Configuration>) {
    let scene = |kd: f64| Scene::parse(&eel(kind, n, kd), "stiff.toml").expect("a scene");
    let inertia = scene(1.0).bodies[0].total_inertia;
    let least = (0..3).map(|i| inertia[i][i]).fold(f64::INFINITY, f64::min);
    let scene = scene(stiffness * least / 0.01);
    let (model, state) = (scene.model(), scene.initial_state());
    (model.expect("a model"), state.expect("a state"))
}

fn eel(kind: &str, n: usize, kd: f64) -> String {
    // The whole bends as much, and its ends are as fast, however many there are.
    let bend = 3.0 / n as f64;
    let body = |i: usize| {
        let turning = match (i, kind) {
            (0, _) | (_, "") => format!(
                ", angular_velocity = [{}, {}, {bend}]",
                0.2 * bend,
                0.4 * bend
            ),
            _ => String::new(),
        };
        format!("{{ name = '{i}', semi_axes = [0.2, 0.05, 0.1]{turning} }}")
    };
    let target = match kind {
        "" => format!("[{}, {}, {bend}]", 0.2 * bend, 0.4 * bend),
        _ => bend.to_string(),
    };
    let joint = |i: usize| {
        let servo = format!(
            "kp = {}, kd = {kd}, target = {{ amplitude = {target}, frequency = 1 }}",
            5.0 * kd
        );
        let on = i - 1;
        format!(
            "{{ parent = '{on}', child = '{i}', at_parent = [-0.22, 0, 0], at_child = [0.22, 0, 0]{kind}, servo = {{ {servo} }} }}"
        )
    };
    let bodies: Vec<String> = (0..n).map(body).collect();
    let joints: Vec<String> = (1..n).map(joint).collect();
    let (bodies, joints) = (bodies.join(", "), joints.join(", "));
    format!("fluid.density = 1000\nbody = [{bodies}]\njoint = [{joints}]")
}

/// The iterations of a step in the middle, over 100 steps; none where one is not solved.
fn iterations<L: DiscreteLagrangian<Group = Configuration>>(
    lagrangian: L,
    mut state: State<Configuration>,
) -> Option<f64> {
    let mut integrator = Variational::new(lagrangian);
    let mut sum = 0;
    for _ in 0..100 {
        sum += integrator.step(&mut state, 0.01).ok()?.iterations;
    }
    Some(f64::from(sum) / 100.0)
}

#[test]
fn a_stiff_motor_takes_few_iterations_more_than_a_soft_one() {
    // Of more than 1000 unknowns there is no Newton's matrix to fall back on.
    for (kind, n) in [
        ("", 6),
        (", type = 'hinge', axis = [0, 0, 1]", 6),
        ("", 400),
    ] {
        let count = |stiffness: f64| {
            let (model, state) = stiff(kind, n, stiffness);
            let plain = iterations(Plain(model.clone()), state.clone());
            (iterations(model, state), plain)
        };
        let [soft, stiff] = [0.1, 300.0].map(count);
        println!("{n} bodies{kind}: soft {soft:?}, stiff {stiff:?} iterations with, without");
        let [soft, stiff] = [soft.0, stiff.0].map(|count| count.expect("all steps are solved"));
        assert!(stiff < 2.0 * soft);
    }
    let (model, state) = stiff("", 400, 300.0);
    assert_eq!(
        iterations(Plain(model), state),
        None,
        "it is the matrix that solves it"
    );
}
