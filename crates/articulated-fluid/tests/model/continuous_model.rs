//! The kinetic energy (6), its inertia (4), the Legendre transform (10) and the forces (11)–(13).

use articulated_fluid::{ArticulatedBody, Configuration};
use dvi::{Context, Derivatives, DiscreteLagrangian, Lagrangian, State, System};
use lie::{Jet, LieGroup, Scalar, VectorSpace};
use proptest::prelude::*;

use crate::common::*;

/// The Lagrangian by its value alone: the rest by dual numbers.
struct ByValue<'a>(&'a ArticulatedBody);

impl System for ByValue<'_> {
    type Group = Configuration;
}

impl Lagrangian for ByValue<'_> {
    fn value<S: Scalar>(&self, _: Context<S>, g: &Configuration<S>, xi: &Velocity<S>) -> S {
        lagrangian(self.0, g, xi)
    }
}

proptest! {
    #[test]
    fn the_printed_inertia_is_the_hessian_of_the_energy(sample in three_bodies()) {
        let Sample { model, g, xi, .. } = &sample;
        let printed = Paper::new(&sample).inertia(matrices(g));
        // Rounding of sums of a few terms up to 1e2.
        let hessian = hessian(model, g, xi);
        assert_close(&printed.concat(), &hessian.concat(), 1e-13);
        let momentum = sample.mu().coordinates();
        assert_close(&momentum, &product(&printed, &xi.coordinates()), 1e-13);
        // (7): the energy is its quadratic form.
        let energy = lagrangian(model, g, xi);
        let half: f64 = momentum.iter().zip(xi.coordinates()).map(|(p, x)| 0.5 * p * x).sum();
        assert_close(&[energy], &[half], 1e-13);
    }

    #[test]
    fn the_legendre_transform_is_the_derivative_by_dual_numbers(sample in any_sample()) {
        let Sample { model, g, xi, .. } = &sample;
        let closed = sample.mu().coordinates();
        let by_jets = ByValue(model).legendre(0.0, g, xi).expect("a velocity");
        // Rounding of sums up to 1e2.
        assert_close(&closed, &by_jets.coordinates(), 1e-13);
    }

    #[test]
    fn velocity_and_force_are_those_of_the_lagrangian(sample in any_sample()) {
        let Sample { model, g, xi, .. } = &sample;
        let (velocity, force) = velocity_and_force::<f64>(model, g, &sample.mu());
        // Rounding times the condition of the inertia, up to a few hundred.
        assert_close(&velocity.coordinates(), &xi.coordinates(), 1e-12);
        assert_close(&force.coordinates(), &force_by_jets(&sample), 1e-12);
    }

    #[test]
    fn velocity_and_force_hold_over_dual_numbers(sample in any_sample(), first in 0..18_usize) {
        let Sample { model, g, xi, .. } = &sample;
        // Along a path of the configuration at constant velocity, the momentum's path gives the velocity back.
        let g = moved(g, first);
        let still = along(&g.zero_algebra(), xi, &xi.zero_like());
        let basis = |i: usize| {
            let mut e = xi.zero_like();
            e.set(i, 1.0);
            along(&g.zero_algebra(), &e, &e.zero_like())
        };
        let mut mu = g.zero_dual();
        for i in 0..xi.dim() {
            let value = |xi: &Velocity<J>| lagrangian(model, &g, xi);
            // A quadratic form's derivative, without error: L(xi + e) - L(xi) - L(e) + L(0).
            let mut sum = still.clone();
            sum.add_scaled(J::constant(1.0), &basis(i));
            let at_rest = value(&g.zero_algebra());
            mu.set(i, value(&sum) - value(&still) - value(&basis(i)) + at_rest);
        }
        let (velocity, _) = velocity_and_force::<J>(model, &g, &mu);
        for (i, x) in velocity.coordinates().into_iter().enumerate() {
            // As above.
            assert_close(&[x.value()], &[xi.get(i)], 1e-12);
            let slopes: Vec<f64> = (0..lie::JET_DIRECTIONS).map(|d| x.partial(d)).collect();
            assert_close(&slopes, &[0.0; lie::JET_DIRECTIONS], 1e-12);
        }
    }

    #[test]
    fn the_reduced_solve_is_the_dense_one(sample in any_sample()) {
        let Sample { model, g, xi, .. } = &sample;
        let mu = sample.mu();
        let dense = solve(&hessian(model, g, xi), &mu.coordinates());
        let mut work = Default::default();
        let mut reduced = g.zero_algebra();
        spoil(&mut reduced);
        model.factorise((0.0, 0.0), &model.aligned(), &mut work);
        model.factorise((0.0, 0.0), g, &mut work);
        model.solve(&mut work, &mu, &mut reduced);
        // Rounding times the condition, in both.
        assert_close(&reduced.coordinates(), &dense, 1e-12);
        assert_close(&reduced.coordinates(), &solve(&sample.inertia(), &mu.coordinates()), 1e-12);
    }

    #[test]
    fn the_inertia_of_the_moving_centres_is_the_hessian_of_the_energy(sample in any_sample()) {
        let Sample { model, g, xi, .. } = &sample;
        let (inertia, hessian) = (sample.inertia(), hessian(model, g, xi));
        // Rounding of sums of a few terms up to 1e2.
        assert_close(&inertia.concat(), &hessian.concat(), 1e-13);
    }

    #[test]
    fn the_eliminated_displacement_solves_the_linear_momentum(sample in any_sample()) {
        const H: f64 = 0.1;
        let Sample { model, g, f, .. } = &sample;
        let (mut work, mut f, mu) = (Default::default(), f.clone(), sample.mu());
        let state = State { t: 0.0, g: g.clone(), mu };
        model.factorise((0.0, 0.0), g, &mut work);
        f.1[0].0 = [f64::NAN; 3];
        let (mut c, mut out) = (f.zero_algebra(), Derivatives::new(g));
        model.eliminate(&mut work, (&state, H), &mut f, &mut c, &mut out);
        assert_eq!(c.1[0].vec3(), f.1[0].vec3(), "element and coordinates agree");
        // Rounding of masses times lengths up to 1e2, over H.
        assert_close(&out.d_f.1[0].0, &(state.mu.1[0].vec3() + sample.force() * H).0, 1e-12);
        // The derivatives are those at that displacement.
        let there = closed(model, g, &f, H);
        prop_assert_eq!((&out.d_f, &out.d_g), (&there.d_f, &there.d_g));
    }
}
