//! Random trees of all kinds of joints, free and held: formulas by recursion against those from the values alone.

use std::sync::Arc;

use articulated_fluid::motion::Sinusoid;
use articulated_fluid::{ArticulatedBody, Body, Configuration, Joint, JointKind, Motion};
use dvi::laws::check_symplecticity;
use dvi::{
    Context, ContinuousSystem, Derivatives, DiscreteLagrangian, DualSystem, Gauss, Integrator,
    Lagrangian, State, System, Variational,
};
use lie::{AlgebraOver, LieGroup, Mat3, SO3, Scalar, Tangent, Vec3, VectorSpace};
use proptest::prelude::*;

/// What is told of a tree: for each body three numbers of its parent and its kind, and many for the rest.
type Told = (Vec<(usize, u8, [f64; 40])>, bool);

#[derive(Clone, Debug)]
pub struct Tree {
    pub model: ArticulatedBody,
    pub state: State<Configuration>,
    f: Configuration,
    xi: AlgebraOver<Configuration, f64>,
}

fn vec3(x: &[f64]) -> Vec3 {
    Vec3([x[0], x[1], x[2]])
}

/// Symmetric and positive definite, with eigenvalues between 1 and 2.5.
fn definite(x: &[f64], scale: f64) -> Mat3 {
    let r = *SO3::exp(&Tangent([x[0], x[1], x[2]])).matrix();
    let d = Mat3::diagonal([0, 1, 2].map(|i| scale * (1.0 + 0.75 * (1.0 + x[3 + i]))));
    let a = r * d * r.transpose();
    (a + a.transpose()) * 0.5
}

fn kind(which: u8, x: &[f64]) -> JointKind {
    let rest = SO3::exp(&Tangent([x[0], 2.0 * x[1], x[2]]));
    let axis = Vec3([x[3], x[4], 1.5 + x[5]]);
    match which {
        0 => JointKind::Ball,
        1 => JointKind::hinge(axis, rest),
        2 => JointKind::fixed(rest),
        3 => JointKind::Prescribed(Motion::Hinge {
            axis: axis * (1.0 / axis.norm()),
            rest,
            angle: Arc::new(Sinusoid {
                amplitude: [x[6]],
                frequency: 0.5 + x[7].abs(),
                phase: [x[8]],
                ..Sinusoid::constant([x[9]])
            }),
        }),
        _ => JointKind::Prescribed(Motion::Ball {
            rest,
            turn: Arc::new(Sinusoid {
                amplitude: [x[6], x[7], x[8]],
                frequency: 0.5 + x[9].abs(),
                phase: [x[10], x[11], x[12]],
                harmonics: vec![[[0.1 * x[10]; 3], [x[6]; 3]]],
                ramp: 0.5,
                ..Sinusoid::constant([x[13], x[14], x[15]])
            }),
        }),
    }
}

/// The tree, under gravity and on springs where these are asked for.
fn tree((told, held): Told, loaded: bool) -> Tree {
    let bodies: Vec<Body> = told
        .iter()
        .map(|(.., x)| Body {
            mass: definite(&x[0..6], 1.0),
            inertia: definite(&x[6..12], 0.2),
        })
        .collect();
    let joint = |(child, (parent, which, x)): (usize, &(usize, u8, [f64; 40]))| {
        let points = [vec3(&x[12..15]), vec3(&x[15..18])];
        Joint::new([parent % child, child], points, kind(*which, &x[18..34]))
    };
    let joints: Vec<Joint> = told.iter().enumerate().skip(1).map(joint).collect();
    let (_, which, x) = &told[0];
    let mut model = match held {
        false => ArticulatedBody::new(&bodies, &joints),
        true => {
            let place = Sinusoid {
                amplitude: [x[34], 0.2, x[35]],
                frequency: 0.7,
                ..Sinusoid::constant([0.1, x[36], 0.0])
            };
            let mount = (vec3(&x[15..18]), kind(*which, &x[18..34]));
            ArticulatedBody::held(&bodies, &joints, mount, Arc::new(place))
        }
    }
    .expect("a model");
    if loaded {
        let net: Vec<f64> = told.iter().map(|(.., x)| 0.5 * x[37]).collect();
        let first = usize::from(!held);
        let stiffness = |(_, which, x): &(usize, u8, [f64; 40])| match which {
            0 | 1 => x[38].abs(),
            _ => 0.0,
        };
        let stiffnesses: Vec<f64> = told[first..].iter().map(stiffness).collect();
        model = model
            .with_gravity(Vec3([0.3, -0.4, -2.0]), &net)
            .expect("a weight");
        let moments: Vec<Vec3> = told.iter().map(|(.., x)| vec3(&x[35..38]) * 0.3).collect();
        model = model.with_buoyancy(&moments).expect("points");
        model = model.with_stiffness(&stiffnesses).expect("springs");
    }
    let mut state = State {
        t: 0.37,
        g: model.aligned(),
        mu: model.aligned().zero_dual(),
    };
    let (mut f, mut xi) = (state.g.clone(), state.g.zero_algebra());
    let numbers: Vec<f64> = told.iter().flat_map(|(.., x)| x[28..40].to_vec()).collect();
    let mut turn = state.g.zero_algebra();
    for i in 0..xi.dim() {
        let at = |k: usize| numbers[(5 * i + k) % numbers.len()];
        turn.set(i, 1.3 * at(0));
        xi.set(i, at(3) - 0.5 * at(7));
    }
    state.g = state.g.compose(&Configuration::exp(&turn));
    turn.scale(0.0);
    turn.add_scaled(0.05, &xi);
    f = f.compose(&Configuration::exp(&turn));
    state.mu = model.legendre(state.t, &state.g, &xi).expect("a state");
    Tree {
        model,
        state,
        f,
        xi,
    }
}

fn told() -> impl Strategy<Value = Told> {
    let body = (
        0..8_usize,
        0..5_u8,
        prop::array::uniform32(-1.0..1.0_f64),
        prop::array::uniform8(-1.0..1.0_f64),
    );
    let body = body.prop_map(|(parent, kind, a, b)| {
        let mut x = [0.0; 40];
        x[..32].copy_from_slice(&a);
        x[32..].copy_from_slice(&b);
        (parent, kind, x)
    });
    (prop::collection::vec(body, 1..7), any::<bool>())
}

pub fn trees() -> impl Strategy<Value = Tree> {
    (told(), any::<bool>()).prop_map(|(told, loaded)| tree(told, loaded))
}

/// The Lagrangian by its value alone.
struct ByValue<'a>(&'a ArticulatedBody);

impl System for ByValue<'_> {
    type Group = Configuration;
}

impl Lagrangian for ByValue<'_> {
    fn value<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Configuration<S>,
        xi: &AlgebraOver<Configuration, S>,
    ) -> S {
        Lagrangian::value(self.0, at, g, xi)
    }
}

fn assert_close(a: &[f64], b: &[f64], tolerance: f64) -> Result<(), TestCaseError> {
    for (i, (x, y)) in a.iter().zip(b).enumerate() {
        prop_assert!(
            (x - y).abs() <= tolerance,
            "{i}: {x:e} and {y:e} differ by {:e}",
            x - y
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn the_derivatives_of_a_step_are_those_of_its_value(tree in trees(), h in prop::sample::select(vec![0.05, -0.03])) {
        let Tree { model, state: State { t, g, .. }, f, .. } = &tree;
        let at = Context::new(*t, &[]);
        let [mut closed, mut jets] = [Derivatives::new(g), Derivatives::new(g)];
        DiscreteLagrangian::derivatives(model, at, g, f, h, &mut Default::default(), &mut closed);
        jets.by_jets(model, at, g, f, h);
        // Rounding of sums of terms up to 100, over h.
        assert_close(&closed.d_f.coordinates(), &jets.d_f.coordinates(), 1e-11)?;
        assert_close(&closed.d_g.coordinates(), &jets.d_g.coordinates(), 1e-11)?;
    }

    #[test]
    fn velocity_and_force_are_those_of_the_lagrangian(tree in trees()) {
        let Tree { model, state: State { t, g, mu }, xi, .. } = &tree;
        let by_value = ByValue(model);
        let at = Context::new(*t, &[]);
        let slow = by_value.legendre(*t, g, xi).expect("a state");
        // Rounding of sums of terms up to 1e3.
        assert_close(&mu.coordinates(), &slow.coordinates(), 1e-12)?;
        let (mut velocity, mut force) = (g.zero_algebra(), g.zero_dual());
        model.velocity_and_force::<f64>(at, g, mu, &mut Default::default(), &mut velocity, &mut force);
        // Times the condition of the inertia, up to 1e3.
        assert_close(&velocity.coordinates(), &xi.coordinates(), 1e-10)?;
        let (mut other, mut slow) = (g.zero_algebra(), g.zero_dual());
        DualSystem(&by_value).velocity_and_force::<f64>(at, g, mu, &mut Default::default(), &mut other, &mut slow);
        assert_close(&force.coordinates(), &slow.coordinates(), 1e-9)?;
    }

    #[test]
    fn every_step_keeps_the_momentum_whatever_the_displacement(told in told()) {
        let (told, _) = told;
        let Tree { model, state: State { t, g, .. }, f, .. } = tree((told, false), false);
        let mut d = Derivatives::new(&g);
        DiscreteLagrangian::derivatives(&model, Context::new(t, &[]), &g, &f, 0.05, &mut Default::default(), &mut d);
        let spins = g.0.iter().zip(d.d_g.0.iter()).map(|(r, d)| r.rotate(d.vec3()));
        let sum = spins.fold(f.1[0].vec3().cross(d.d_f.1[0].vec3()), |sum, spin| sum + spin);
        // (S10): rounding of terms up to 1e3.
        prop_assert!(sum.norm() < 1e-11, "{sum:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn steps_are_symplectic_at_every_time(tree in trees()) {
        let Tree { model, state, .. } = tree;
        let states = [state];
        let h = 0.01;
        check_symplecticity(&mut Variational::new(model.clone()), &states, h).map_err(|e| TestCaseError::fail(e.to_string()))?;
        check_symplecticity(&mut Gauss::new::<2>(model), &states, h).map_err(|e| TestCaseError::fail(e.to_string()))?;
    }

    #[test]
    fn a_step_of_the_model_s_inertia_is_that_of_newton_s_matrix(tree in trees()) {
        let Tree { model, state, .. } = tree;
        let (mut fast, mut slow) = (state.clone(), state);
        Variational::new(model.clone()).step(&mut fast, 0.01).expect("a step");
        Variational::new(crate::by_duals::ByDuals(model)).step(&mut slow, 0.01).expect("a step");
        let apart = dvi::laws::distance(&fast, &slow);
        // Both are solved to 1e-12 of momenta up to 100.
        prop_assert!(apart < 1e-10, "{apart:e}");
    }
}
