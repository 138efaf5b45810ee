//! A beam of rigid nodes, by its value alone.

use dvi::{Context, Lagrangian, State, System};
use lie::{LieGroup, Power, RealGroup, SE3, Scalar, Tangent, Vec3, VectorSpace};

/// Nodes 0.1 m apart; neighbours are held together by springs against extension, shear, bending and torsion. A ring where the last is the
/// first one's neighbour. The first stiffness is a parameter.
#[derive(Clone, Debug)]
pub struct Beam {
    pub parameters: [f64; 2],
    pub ring: bool,
}

pub const BEAM: Beam = Beam {
    parameters: [2e3, 5.0],
    ring: false,
};
const LENGTH: Vec3 = Vec3([0.1, 0.0, 0.0]);
const MASS: f64 = 0.02;
const INERTIA: [f64; 3] = [2e-6, 2e-5, 2e-5];

impl System for Beam {
    type Group = Power<SE3>;

    fn parameters(&self) -> &[f64] {
        &self.parameters
    }
}

impl Lagrangian for Beam {
    fn value<S: Scalar>(&self, at: Context<S>, g: &Power<SE3<S>>, xi: &Power<Tangent<6, S>>) -> S {
        let [stretch, bend] = at.parameters();
        let kinetic = xi.iter().fold(S::zero(), |sum, xi| {
            let (omega, v) = xi.split();
            let spins = (0..3).map(|k| omega[k] * omega[k] * S::from_f64(INERTIA[k]));
            sum + spins.fold(v.dot(v).times(MASS), |sum, term| sum + term)
        });
        let around = g.len().min(g.len() - 1 + usize::from(self.ring));
        let energy = (0..around).fold(S::zero(), |sum, i| {
            let (here, next) = (&g[i], &g[(i + 1) % g.len()]);
            let apart = next.translation - here.translation - here.rotation.rotate(LENGTH.lift());
            let row = |j: usize| {
                let (a, b) = (here.rotation.matrix().row(j), next.rotation.matrix().row(j));
                a.dot(b)
            };
            let trace = row(0) + row(1) + row(2);
            sum + apart.dot(apart) * stretch + (S::from_f64(3.0) - trace) * bend
        });
        (kinetic - energy).times(0.5)
    }
}

/// Bent by half a radian along its length, or closed; moving.
pub fn bent(nodes: usize, ring: bool) -> State<Power<SE3>> {
    let angle = if ring { core::f64::consts::TAU } else { 0.5 };
    let step = SE3::exp(&Tangent([0.0, 0.0, angle / nodes as f64, 0.1, 0.0, 0.0]));
    let mut g = vec![SE3::identity()];
    for i in 1..nodes {
        g.push(g[i - 1].compose(&step));
    }
    let g = Power::new(g);
    let mut xi = g.zero_algebra();
    for i in 0..xi.dim() {
        xi.set(i, 0.1 * (i as f64).sin());
    }
    let beam = Beam { ring, ..BEAM };
    beam.state(0.0, g, &xi).unwrap()
}

/// How far two states are apart, relative to numbers of the size of one.
pub fn apart<G: RealGroup>(a: &State<G>, b: &State<G>) -> f64 {
    let turn =
        a.g.inverse()
            .compose(&b.g)
            .log()
            .unwrap_or_else(|e| e.representative);
    let mut momentum = a.mu.clone();
    momentum.add_scaled(-1.0, &b.mu);
    turn.max_magnitude().max(momentum.max_magnitude())
}
