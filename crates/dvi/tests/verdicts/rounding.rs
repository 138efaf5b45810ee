//! Rounding is told from a step that is not solved by what it is the rounding of.

use dvi::{
    Cause, Context, ContinuousSystem, Gauss, Integrator, Lagrangian, Quadrature, State, System,
    Variational,
};
use lie::{
    AlgebraOver, Cotangent, DualOver, LieGroup, Over, Power, Rn, SE3, Scalar, Tangent, Vec3,
    VectorSpace,
};
use proptest::prelude::*;

/// A particle of 1 kg on a spring of 100 N/m, whose rest is far from the origin: positions and what they differ by cancel.
#[derive(Clone, Copy)]
struct Far(f64);

impl System for Far {
    type Group = Rn<1>;
}

impl Lagrangian for Far {
    fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
        let stretch = x.0[0] - S::from_f64(self.0);
        v[0] * v[0] * S::from_f64(0.5) - (stretch * stretch).times(50.0)
    }
}

/// The error of a thousand steps beside the exact motion, in units of the rounding of a place.
fn error_of_far(mut integrator: impl Integrator<Group = Rn<1>>, place: f64) -> f64 {
    let (h, steps) = (0.01, 1000);
    let mut state = Far(place)
        .state(0.0, Rn([place + 1.0]), &Tangent([0.0]))
        .unwrap();
    for _ in 0..steps {
        integrator
            .step(&mut state, h)
            .unwrap_or_else(|e| panic!("{e}"));
    }
    let exact = (10.0 * h * f64::from(steps)).cos();
    ((state.g.0[0] - place) - exact).abs() / (f64::EPSILON * place)
}

#[test]
fn gauss_solves_a_spring_far_from_the_origin() {
    for place in [7e6, 1e3, 1e9] {
        let errors = [
            error_of_far(Gauss::new::<3>(Far(place).hamiltonian()), place),
            error_of_far(Gauss::new::<4>(Far(place).hamiltonian()), place),
            error_of_far(Gauss::new::<8>(Far(place).hamiltonian()), place),
        ];
        println!("{place:e}: {errors:?}");
        // Each step adds a rounding or two of the place, which the spring turns around.
        let [_, fourth, eighth] = errors;
        assert!(fourth.max(eighth) < 3e3, "{place:e}: {errors:?}");
    }
}

/// A pendulum of 1 kg and 1 m whose length is kept by a spring of $10^8$ N/m.
#[derive(Clone, Copy)]
struct Penalty;

impl System for Penalty {
    type Group = Rn<2>;
}

impl Lagrangian for Penalty {
    fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<2, S>, v: &Tangent<2, S>) -> S {
        let ([x, y], [u, w]) = (x.0, v.0);
        let stretch = (x * x + y * y).sqrt() - S::one();
        (u * u + w * w).times(0.5) - (stretch * stretch).times(0.5e8) - y.times(9.81)
    }
}

#[test]
fn a_stiff_penalty_is_solved_by_default() {
    let mut state = Penalty
        .state(0.0, Rn([1.0, 0.0]), &Tangent([0.0, 0.0]))
        .unwrap();
    let energy = |state: &State<Rn<2>>| Penalty.hamiltonian().energy(state);
    let start = energy(&state);
    let mut integrator = Variational::new(Penalty.discretise(Quadrature::Midpoint));
    let (mut worst, mut iterations) = (0.0_f64, 0);
    for _ in 0..5000 {
        let report = integrator
            .step(&mut state, 1e-3)
            .unwrap_or_else(|e| panic!("{e}"));
        worst = worst.max((energy(&state) - start).abs());
        iterations += report.iterations;
    }
    println!(
        "energy {worst:e} J, {} iterations a step",
        f64::from(iterations) / 5000.0
    );
    // Of the falling kilogram's 9.81 J.
    assert!(worst < 0.05, "{worst:e}");
}

/// A beam of rigid nodes, 0.1 m apart: neighbours are held together by springs against extension, shear, bending and torsion,
/// $U = \sum_i \frac k2 |x_{i+1} - x_i - R_i e|^2 + \frac\kappa2 (3 - \mathrm{tr}\, R_i^T R_{i+1})$; its equations by hand.
#[derive(Clone, Copy)]
struct Beam {
    nodes: usize,
}

const LENGTH: Vec3 = Vec3([0.1, 0.0, 0.0]);
const STRETCH: f64 = 2e3;
const BEND: f64 = 5.0;
const MASS: f64 = 0.02;
const INERTIA: [f64; 3] = [2e-6, 2e-5, 2e-5];

impl System for Beam {
    type Group = Power<SE3>;
}

impl ContinuousSystem for Beam {
    type Workspace<S: Scalar> = ();
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _: Context<S>,
        g: &Over<Self::Group, S>,
        mu: &DualOver<Self::Group, S>,
        (): &mut (),
        xi: &mut AlgebraOver<Self::Group, S>,
        tau: &mut DualOver<Self::Group, S>,
    ) {
        for i in 0..self.nodes {
            let (spin, momentum) = mu[i].split();
            let [a, b, c] = spin.0;
            let [i0, i1, i2] = INERTIA.map(|j| 1.0 / j);
            let omega = Vec3([a.times(i0), b.times(i1), c.times(i2)]);
            xi[i] = (omega, momentum * S::from_f64(1.0 / MASS)).into();
            tau[i] = Cotangent::zero();
        }
        let [stretch, bend] = [STRETCH, BEND].map(S::from_f64);
        for i in 0..self.nodes - 1 {
            let (here, next) = (&g[i], &g[i + 1]);
            let apart = next.translation - here.translation - here.rotation.rotate(LENGTH.lift());
            let (pull, pulled) = (
                here.rotation.inverse_rotate(apart) * stretch,
                next.rotation.inverse_rotate(apart) * stretch,
            );
            let (p, r) = (here.rotation.matrix(), next.rotation.matrix());
            let moment = (0..3).fold(Vec3::zero(), |sum, j| sum + p.row(j).cross(r.row(j)));
            let torque = moment * (bend * S::from_f64(0.5));
            tau[i] += (LENGTH.lift::<S>().cross(pull) - torque, pull).into();
            tau[i + 1] += (torque, -pulled).into();
        }
    }
}

/// Bent by half a radian along its length, at rest.
fn bent(nodes: usize) -> State<Power<SE3>> {
    let turn = Tangent([0.0, 0.0, 0.5 / nodes as f64, 0.1, 0.0, 0.0]);
    let step = SE3::exp(&turn);
    let mut g = vec![SE3::identity()];
    for i in 1..nodes {
        g.push(g[i - 1].compose(&step));
    }
    let g = Power::new(g);
    let mu = g.zero_dual();
    State { t: 0.0, g, mu }
}

#[test]
fn the_beam_has_the_forces_of_its_potential() {
    struct Potential;
    impl System for Potential {
        type Group = Power<SE3>;
    }

    impl Lagrangian for Potential {
        fn value<S: Scalar>(
            &self,
            _: Context<S>,
            g: &Power<SE3<S>>,
            xi: &Power<Tangent<6, S>>,
        ) -> S {
            let kinetic = xi.iter().map(|xi| {
                let (omega, v) = xi.split();
                let spins = (0..3).map(|k| omega[k] * omega[k] * S::from_f64(INERTIA[k]));
                spins
                    .fold(v.dot(v).times(MASS), |sum, term| sum + term)
                    .times(0.5)
            });
            let pairs = g.windows(2).map(|pair| {
                let (here, next) = (&pair[0], &pair[1]);
                let apart =
                    next.translation - here.translation - here.rotation.rotate(LENGTH.lift());
                let rows = (0..3).map(|j| {
                    here.rotation
                        .matrix()
                        .row(j)
                        .dot(next.rotation.matrix().row(j))
                });
                let trace = rows.fold(S::zero(), |sum, term| sum + term);
                apart.dot(apart).times(0.5 * STRETCH) + (S::from_f64(3.0) - trace).times(0.5 * BEND)
            });
            kinetic.fold(S::zero(), |a, b| a + b) - pairs.fold(S::zero(), |a, b| a + b)
        }
    }
    let mut state = bent(4);
    for (i, mu) in state.mu.iter_mut().enumerate() {
        *mu = Cotangent([1e-5, -2e-5, 3e-5, 0.01, 0.02, -0.03].map(|x| x * (1.0 + i as f64)));
    }
    state.g[2] = state.g[2].compose(&SE3::exp(&Tangent([0.3, -0.2, 0.1, 0.01, 0.02, -0.01])));
    let rates = |system: &dyn Fn(&mut Power<Tangent<6>>, &mut Power<Cotangent<6>>)| {
        let (mut xi, mut tau) = (state.g.zero_algebra(), state.g.zero_dual());
        system(&mut xi, &mut tau);
        (xi, tau)
    };
    let (by_hand, by_value) = (Beam { nodes: 4 }, Potential.hamiltonian());
    let at = Context::new(0.0, &[]);
    let a = rates(&|xi, tau| {
        by_hand.velocity_and_force::<f64>(at, &state.g, &state.mu, &mut (), xi, tau)
    });
    let b = rates(&|xi, tau| {
        let mut work = Default::default();
        by_value.velocity_and_force::<f64>(at, &state.g, &state.mu, &mut work, xi, tau);
    });
    for i in 0..a.0.dim() {
        assert!((a.0.get(i) - b.0.get(i)).abs() < 1e-10 * b.0.max_magnitude());
        assert!((a.1.get(i) - b.1.get(i)).abs() < 1e-10 * b.1.max_magnitude());
    }
}

#[test]
fn a_long_beam_is_solved_to_rounding_in_few_sweeps() {
    let nodes = 80;
    let mut integrator = Gauss::new::<3>(Beam { nodes });
    let (mut state, mut iterations) = (bent(nodes), vec![]);
    for _ in 0..40 {
        let report = integrator
            .step(&mut state, 5e-5)
            .unwrap_or_else(|e| panic!("{e}"));
        iterations.push(report.iterations);
    }
    println!("{iterations:?}");
    let most = iterations.iter().max().copied().unwrap_or(0);
    assert!(most <= 30, "{iterations:?}");
    let loose = {
        let mut integrator = Gauss::new::<3>(Beam { nodes }).with_tolerance(1e-13);
        let mut state = bent(nodes);
        for _ in 0..40 {
            integrator.step(&mut state, 5e-5).unwrap();
        }
        state
    };
    for (a, b) in state.g.iter().zip(loose.g.iter()) {
        assert!((a.translation - b.translation).norm() < 1e-12);
    }
}

#[test]
fn a_system_too_large_for_a_dense_matrix_is_refused_at_once() {
    let nodes = 80;
    let mut integrator = Gauss::new::<4>(Beam { nodes });
    let error = integrator.step(&mut bent(nodes), 0.1).unwrap_err();
    let Cause::NotConverged { iterations, .. } = error.cause else {
        panic!("{error}");
    };
    assert!(iterations < 100, "{error}");
}

/// Masses in a row between two walls, on springs under one tension: at rest all forces balance, whatever they are.
#[derive(Clone, Debug)]
struct Row {
    /// N/m, of one spring more than masses.
    stiffnesses: Vec<f64>,
    /// m.
    lengths: Vec<f64>,
    tension: f64,
}

impl System for Row {
    type Group = Power<Rn<1>>;
}

impl Lagrangian for Row {
    fn value<S: Scalar>(&self, _: Context<S>, x: &Power<Rn<1, S>>, v: &Power<Tangent<1, S>>) -> S {
        let kinetic = v.iter().fold(S::zero(), |sum, v| sum + v[0] * v[0]);
        let wall = S::from_f64(self.places().sum());
        let ends = x.iter().map(|x| x.0[0]).chain([wall]);
        let mut before = S::zero();
        let springs = self.stiffnesses.iter().zip(&self.lengths).zip(ends);
        let elastic = springs.fold(S::zero(), |sum, ((stiffness, length), end)| {
            let stretch = end - before - S::from_f64(*length);
            before = end;
            sum + (stretch * stretch).times(*stiffness)
        });
        (kinetic - elastic).times(0.5)
    }
}

impl Row {
    /// How long each spring is at rest.
    fn places(&self) -> impl Iterator<Item = f64> {
        let springs = self.stiffnesses.iter().zip(&self.lengths);
        springs.map(|(stiffness, length)| length + self.tension / stiffness)
    }

    fn at_rest(&self) -> State<Power<Rn<1>>> {
        let mut x = 0.0;
        let sums = self.places().map(|length| {
            x += length;
            Rn([x])
        });
        let g = Power::new(sums.take(self.stiffnesses.len() - 1).collect());
        let mu = g.zero_dual();
        State { t: 0.0, g, mu }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn what_is_at_rest_under_forces_that_balance_stays(
        springs in prop::collection::vec((1.0..1e4_f64, 0.01..1.0_f64), 3..12),
        tension in 1.0..1e4_f64,
    ) {
        let (stiffnesses, lengths) = springs.into_iter().unzip();
        let row = Row { stiffnesses, lengths, tension };
        let discrete = row.clone().discretise(Quadrature::Midpoint);
        let moves = |integrator: &mut dyn Integrator<Group = Power<Rn<1>>>| {
            let mut state = row.at_rest();
            for _ in 0..100 {
                integrator.step(&mut state, 1e-3).unwrap_or_else(|e| panic!("{e}"));
            }
            let start = row.at_rest();
            let moved = start.g.iter().zip(state.g.iter()).map(|(a, b)| (a.0[0] - b.0[0]).abs());
            moved.fold(0.0, f64::max)
        };
        // Forces are rounded by 1e-16 of 1e4 N; springs of 1 N/m are as much softer, and time is short.
        prop_assert!(moves(&mut Variational::new(discrete)) < 1e-11);
        prop_assert!(moves(&mut Gauss::new::<3>(row.clone().hamiltonian())) < 1e-11);
    }
}
