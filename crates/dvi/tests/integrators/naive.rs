//! The trap of high order on a group: collocation in a chart that is simply centred anew at every step.
//!
//! Gauss on Hamilton's equations in the chart about $g_k$ is symplectic in the chart; but the base point moves with the state,
//! and without its share in the balance the whole is not.

use dvi::{
    Context, ContinuousSystem, Gauss, Integrator, Lagrangian, State, StepError, StepReport,
    Variation, laws, symplectic_form,
};
use lie::{Cayley, Cotangent, LieGroup, SO3, Tangent, VectorSpace};

use crate::common::{Top, top};

/// Gauss with two stages, $\sqrt 3 / 6$.
const ROOT: f64 = 0.288_675_134_594_812_87;
const A: [[f64; 2]; 2] = [[0.25, 0.25 - ROOT], [0.25 + ROOT, 0.25]];
const SWEEPS: u32 = 200;

/// Starts its stages from $\pi_0 = \mu_k$, and ends with $\mu_{k+1} = (\mathrm d\tau_{c_1}^{-1})^\ast \pi_1$.
struct Naive;

type Rates = [(Tangent<3>, Cotangent<3>); 2];

fn sums(rates: &Rates, weights: [f64; 2], h: f64, mu: &Cotangent<3>) -> (Tangent<3>, Cotangent<3>) {
    let (mut c, mut pi) = (Tangent::zero(), *mu);
    for ((c_dot, pi_dot), weight) in rates.iter().zip(weights) {
        c.add_scaled(h * weight, c_dot);
        pi.add_scaled(h * weight, pi_dot);
    }
    (c, pi)
}

impl Integrator for Naive {
    type Group = SO3;

    fn order(&self) -> u32 {
        4
    }
    fn is_symmetric(&self) -> bool {
        false
    }
    fn is_symplectic(&self) -> bool {
        false
    }
    fn reset(&mut self) {}

    fn step(&mut self, state: &mut State<SO3>, h: f64) -> Result<StepReport, StepError> {
        let system = Top.hamiltonian();
        let (at, mut work) = (Context::new(0.0, &[]), Default::default());
        let mut rates: Rates = [(Tangent::zero(), Cotangent::zero()); 2];
        for _ in 0..SWEEPS {
            let before = rates;
            for (row, (c_dot, pi_dot)) in A.iter().zip(&mut rates) {
                let (c, pi) = sums(&before, *row, h, &state.mu);
                let (mut f, mut mu) = (SO3::identity(), Cotangent::zero());
                SO3::chart_enter_into::<Cayley>(&c, &pi, (&mut f, &mut mu));
                let (mut xi, mut tau) = (Tangent::zero(), Cotangent::zero());
                let g = state.g.compose(&f);
                system.velocity_and_force::<f64>(at, &g, &mu, &mut work, &mut xi, &mut tau);
                SO3::chart_rates_into::<Cayley>((&c, &pi), (&xi, &tau), (c_dot, pi_dot));
            }
        }
        let (c, pi) = sums(&rates, [0.5, 0.5], h, &state.mu);
        let (mut f, mut mu) = (SO3::identity(), Cotangent::zero());
        SO3::chart_enter_into::<Cayley>(&c, &pi, (&mut f, &mut mu));
        (state.g, state.mu) = (state.g.compose(&f), mu);
        state.t += h;
        Ok(StepReport::default())
    }
}

/// The top five times as fast: half a radian a step at h = 0.1 s.
fn fast() -> State<SO3> {
    Top.state(0.0, top().g, &Tangent([1.5, -2.5, 5.0])).unwrap()
}

/// The defect of the symplectic form by central differences, for an integrator that carries no variations.
fn defect(integrator: &mut impl Integrator<Group = SO3>, h: f64) -> f64 {
    /// The differences' own error is its square, and rounding over it.
    const WIDTH: f64 = 1e-4;
    let (start, units) = (fast(), Variation::basis(&fast().g));
    let mut end = start.clone();
    integrator.step(&mut end, h).unwrap();
    let mut image = |unit: &Variation<SO3>| {
        let [ahead, behind] = [WIDTH, -WIDTH].map(|s| {
            let mut state = start.clone();
            state.g = state.g.compose(&SO3::exp(&(unit.eta * s)));
            state.mu.add_scaled(s, &unit.mu);
            integrator.step(&mut state, h).unwrap();
            (end.g.inverse().compose(&state.g).log().unwrap(), state.mu)
        });
        let mut column = Variation::zero(&end.g);
        column.eta = (ahead.0 - behind.0) * (0.5 / WIDTH);
        column.mu = (ahead.1 - behind.1) * (0.5 / WIDTH);
        column
    };
    let images: Vec<_> = units.iter().map(&mut image).collect();
    let size = start.mu.norm_squared().sqrt();
    let mut worst = 0.0_f64;
    for (i, j) in (0..6).flat_map(|i| (0..i).map(move |j| (i, j))) {
        let before = symplectic_form(&start.mu, &units[i], &units[j]);
        let after = symplectic_form(&end.mu, &images[i], &images[j]);
        worst = worst.max((after - before).abs() / size);
    }
    worst
}

#[test]
fn the_naive_chart_is_not_symplectic() {
    for h in [0.1, 0.2] {
        let naive = defect(&mut Naive, h);
        let ours = defect(&mut Gauss::new::<2>(Top.hamiltonian()), h);
        let exact = laws::symplectic_defect(&mut Gauss::new::<2>(Top.hamiltonian()), &fast(), h);
        println!(
            "h = {h}: naive {naive:.1e}, variational {ours:.1e} by differences, {:.1e} by duals",
            exact.unwrap()
        );
        assert!(naive > 1e-6 && ours < 1e-8, "{naive:e}, {ours:e}");
    }
}

/// Of the same order, so that no chart of errors would tell them apart; but its momentum map drifts.
#[test]
fn the_naive_chart_has_its_order_and_loses_the_momentum() {
    let order = laws::observed_order(|| Naive, &top(), 2.0, &[16, 32, 64]).unwrap();
    println!("naive: order {:.2}", order.slope);
    assert!((order.slope - 4.0).abs() < 0.2, "{order:?}");
    let vertical = |s: &State<SO3>| s.g.rotate(s.mu.vec3())[2];
    let drift = |integrator: &mut dyn Integrator<Group = SO3>| {
        let mut state = top();
        for _ in 0..200 {
            integrator.step(&mut state, 0.3).unwrap();
        }
        (vertical(&state) / vertical(&top()) - 1.0).abs()
    };
    let (naive, ours) = (
        drift(&mut Naive),
        drift(&mut Gauss::new::<2>(Top.hamiltonian())),
    );
    println!("vertical momentum after 200 steps: naive {naive:.1e}, variational {ours:.1e}");
    assert!(naive > 1e-6 && ours < 1e-14, "{naive:e}, {ours:e}");
}
