//! The model in a plane: its own laws, and that it is the model in space restricted.

use articulated_fluid::planar::{PlanarBody, PlanarConfiguration, Plane};
use articulated_fluid::{Configuration, Viewed};
use dvi::{
    ContinuousSystem, Derivatives, DiscreteLagrangian, Gauss, Integrator, Lagrangian, State,
    Variational, laws,
};
use lie::{LieGroup, SO3, VectorSpace};
use proptest::prelude::*;

use crate::common::{
    self, Matrix, action, alone, assert_close, at_zero, entries, largest, none, solve, spoil,
};
use crate::flat_trees::*;

const H: f64 = 1e-2;

/// A tree with a displacement.
fn any_moved() -> impl Strategy<Value = (Flat, PlanarConfiguration)> {
    let sizes = prop::sample::select(vec![1e-6, 1e-3, 0.1, 3.0]);
    (any_flat(), sizes).prop_flat_map(|(flat, size)| {
        let bodies = flat.parts.len();
        (Just(flat), displacement(bodies, size))
    })
}

/// The closed form, into storage filled with what must not survive.
fn derivatives<L: DiscreteLagrangian>(model: &L, g: &L::Group, f: &L::Group) -> [Vec<f64>; 2] {
    let mut out = Derivatives::<L::Group, f64>::new(g);
    spoil(&mut out.d_f);
    spoil(&mut out.d_g);
    model.derivatives(at_zero(), g, f, H, &mut Default::default(), &mut out);
    [out.d_f.coordinates(), out.d_g.coordinates()]
}

/// The displacement in space.
fn in_space(plane: &Plane, g: &Configuration, f: &PlanarConfiguration) -> Configuration {
    let turn = |r: &SO3, angle: f64| SO3::exp(&(r.inverse_rotate(plane.normal()) * angle).into());
    let at = |x: PlanarConfiguration| {
        let mu = x.zero_dual();
        plane.lift(&State { t: 0.0, g: x, mu }).g.1[0].vec3()
    };
    let dx = at(f.clone()) - at(f.identity_like());
    let turns = g.0.iter().zip(f.0.iter()).map(|(r, f)| turn(r, f.angle()));
    (turns.collect(), alone(dx), none())
}

/// The coordinates of a momentum in space that one in the plane is.
fn lifted(plane: &Plane, g: &PlanarConfiguration, mu: &[f64]) -> Vec<f64> {
    let mut state = State {
        t: 0.0,
        g: g.clone(),
        mu: g.zero_dual(),
    };
    state.mu.read(mu);
    plane.lift(&state).mu.coordinates()
}

fn dense_inertia(model: &PlanarBody, g: &PlanarConfiguration) -> Matrix {
    let mut unit = g.zero_algebra();
    let column = |i: usize| {
        unit.set_zero();
        unit.set(i, 1.0);
        model
            .legendre(0.0, g, &unit)
            .expect("a velocity")
            .coordinates()
    };
    (0..g.zero_algebra().dim()).map(column).collect()
}

proptest! {
    #[test]
    fn the_closed_form_is_the_derivative_by_dual_numbers((flat, f) in any_moved()) {
        let (model, State { g, .. }) = flat.planar();
        let [d_f, d_g] = derivatives(&model, &g, &f);
        let mut jets = Derivatives::<PlanarConfiguration, f64>::new(&g);
        jets.by_jets(&model, at_zero(), &g, &f, H);
        assert_close(&d_f, &jets.d_f.coordinates(), 1e-11);
        assert_close(&d_g, &jets.d_g.coordinates(), 1e-11);
    }

    #[test]
    fn the_discrete_lagrangian_keeps_its_laws(flat in any_flat()) {
        let (model, state) = flat.planar();
        let checks = [
            laws::check(&model, core::slice::from_ref(&state), H),
            laws::check_consistency(&model, &model, &[state]),
        ];
        for check in checks {
            check.map_err(|error| TestCaseError::fail(error.to_string()))?;
        }
    }

    #[test]
    fn the_inertia_is_solved_as_a_dense_matrix(flat in any_flat()) {
        let (model, State { g, mu, .. }) = flat.planar();
        let (mut work, mut xi) = (Default::default(), g.zero_algebra());
        spoil(&mut xi);
        model.factorise((0.0, 0.0), &g, &mut work);
        model.solve(&mut work, &mu, &mut xi);
        let dense = solve(&dense_inertia(&model, &g), &mu.coordinates());
        assert_close(&xi.coordinates(), &dense, 1e-11);
    }

    #[test]
    fn the_translation_is_eliminated_exactly((flat, mut f) in any_moved()) {
        let (model, state) = flat.planar();
        let g = &state.g;
        let (mut work, mut c, mut out) = (Default::default(), g.zero_algebra(), Derivatives::new(g));
        model.factorise((0.0, 0.0), g, &mut work);
        model.eliminate(&mut work, (&state, H), &mut f, &mut c, &mut out);
        let [d_f, d_g] = derivatives(&model, g, &f);
        prop_assert_eq!(out.d_f.coordinates(), d_f.clone());
        prop_assert_eq!(out.d_g.coordinates(), d_g.clone());
        let (x, px) = (flat.parts.len(), state.mu.1[0]);
        let wanted = [px[0] + d_g[x], px[1] + d_g[x + 1]];
        assert_close(&d_f[x..], &wanted, 1e-14 * (1.0 / H + largest(&d_f)));
        prop_assert_eq!(c.1[0].0, f.1[0].0);
    }

    #[test]
    fn the_discrete_lagrangian_is_the_one_in_space((flat, f) in any_moved()) {
        let (full, plane, state) = (flat.model(), flat.plane(), flat.state());
        let (model, planar) = (plane.model(), plane.project(&state));
        let f_3 = in_space(&plane, &state.g, &f);
        let (value, value_3) = (
            DiscreteLagrangian::value::<f64>(&model, at_zero(), &planar.g, &f, H),
            action(&full, &state.g, &f_3, H),
        );
        assert_close(&[value], &[value_3], 1e-12 * (1.0 + value.abs()));
        let full = derivatives(&full, &state.g, &f_3);
        for (flat, full) in derivatives(&model, &planar.g, &f).iter().zip(full) {
            let rounding = 1e-13 * (1.0 / H + largest(&full));
            assert_close(&lifted(&plane, &planar.g, flat), &full, rounding);
        }
    }

    #[test]
    fn the_continuous_model_is_the_one_in_space(flat in any_flat()) {
        let (full, plane, state) = (flat.model(), flat.plane(), flat.state());
        let (model, State { g, mu, .. }) = (plane.model(), plane.project(&state));
        let momenta = state.mu.coordinates();
        let rounding = 1e-14 * (1.0 + largest(&momenta));
        assert_close(&lifted(&plane, &g, &mu.coordinates()), &momenta, rounding);
        let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
        let mut work = Default::default();
        model.velocity_and_force::<f64>(at_zero(), &g, &mu, &mut work, &mut xi, &mut tau);
        let (_, tau_3) = common::velocity_and_force(&full, &state.g, &state.mu);
        assert_close(&lifted(&plane, &g, &tau.coordinates()), &tau_3.coordinates(), 1e-11);
        let back = model.legendre(0.0, &g, &xi).expect("a velocity");
        assert_close(&back.coordinates(), &mu.coordinates(), 1e-11);
        let energy = model.energy(0.0, &g, &xi).expect("a velocity");
        let found = full.conserved(&state).expect("finite");
        assert_close(&[energy], &[found.energy], 1e-12 * (1.0 + energy.abs()));
    }

    #[test]
    fn a_step_is_the_one_in_space(flat in any_flat()) {
        let (full, plane, mut state) = (flat.model(), flat.plane(), flat.state());
        let mut in_plane = Viewed::new(plane.clone(), Variational::new(plane.model()));
        let mut there = state.clone();
        Variational::new(full).step(&mut state, H).expect("a step");
        in_plane.step(&mut there, H).expect("a step");
        assert_same(&there, &state, 1e-11);
    }
}

#[track_caller]
fn assert_same(a: &State<Configuration>, b: &State<Configuration>, tolerance: f64) {
    assert_close(&numbers(a), &numbers(b), tolerance);
}

fn numbers(state: &State<Configuration>) -> Vec<f64> {
    [entries(&state.g), state.mu.coordinates(), vec![state.t]].concat()
}

type Stepper = Box<dyn Integrator<Group = Configuration>>;

fn run(integrator: &mut Stepper, state: &mut State<Configuration>, steps: u32, h: f64) {
    for _ in 0..steps {
        integrator.step(state, h).expect("a step");
    }
}

#[test]
fn ten_seconds_are_those_in_space() {
    let free = moved(fish());
    for flat in [elastic(free.clone(), &[2.0, 0.5]), free] {
        assert_ten_seconds_are_those_in_space(&flat);
    }
}

fn assert_ten_seconds_are_those_in_space(flat: &Flat) {
    let (full, plane, start) = (flat.model(), flat.plane(), flat.state());
    let lgvi = Viewed::new(plane.clone(), Variational::new(plane.model()));
    let gauss = Viewed::new(plane.clone(), Gauss::new::<4>(plane.model()));
    let pairs: [(Stepper, Stepper, u32); 2] = [
        (
            Box::new(lgvi),
            Box::new(Variational::new(full.clone())),
            10_000,
        ),
        (
            Box::new(gauss),
            Box::new(Gauss::new::<4>(full.clone())),
            100,
        ),
    ];
    for (mut planar, mut spatial, steps) in pairs {
        let (mut a, mut b) = (start.clone(), start.clone());
        run(&mut planar, &mut a, steps, 10.0 / f64::from(steps));
        run(&mut spatial, &mut b, steps, 10.0 / f64::from(steps));
        assert_same(&a, &b, 1e-9);
    }
}
