//! Two rigid pendulums in space, the second one hung from the end of the first: the velocity has a mass matrix that changes.

use dvi::{Context, ContinuousSystem, Lagrangian, State, System};
use lgvi::{dvi, lie};
use lie::{Cotangent, LieGroup, Mat3, Power, SO3, Scalar, Tangent, Vec3};

/// Inertia of the first about its hinge, with the mass of the second at its end; of the second about its own hinge; kg m².
const INERTIA: [[f64; 3]; 2] = [[1.4, 1.4, 0.1], [0.4, 0.4, 0.05]];
/// From hinge to hinge, m.
const ARM: Vec3 = Vec3([0.0, 0.0, -1.0]);
/// Mass of the second times the way to its mass centre, kg m.
const LEVER: Vec3 = Vec3([0.0, 0.0, -0.5]);
/// Of both about the first hinge, kg m.
const FIRST: Vec3 = Vec3([0.0, 0.0, -1.5]);
/// N/kg.
const GRAVITY: f64 = 9.81;

/// By its value.
#[derive(Clone, Copy)]
pub struct Pendulum;

impl System for Pendulum {
    type Group = Power<SO3>;
}

impl Lagrangian for Pendulum {
    fn value<S: Scalar>(&self, _: Context<S>, r: &Power<SO3<S>>, w: &Power<Tangent<3, S>>) -> S {
        let spin = |i: usize| {
            let squares = (0..3).map(|k| (w[i][k] * w[i][k]).times(0.5 * INERTIA[i][k]));
            squares.fold(S::zero(), |sum, term| sum + term)
        };
        let [end, centre] = [ARM, LEVER].map(Vec3::lift::<S>);
        let moves = r[0].rotate(w[0].vec3().cross(end));
        let turns = r[1].rotate(w[1].vec3().cross(centre));
        let height = r[0].rotate(FIRST.lift())[2] + r[1].rotate(centre)[2];
        spin(0) + spin(1) + moves.dot(turns) - height.times(GRAVITY)
    }
}

/// By its equations.
#[derive(Clone, Copy)]
pub struct ByHand;

impl System for ByHand {
    type Group = Power<SO3>;
}

impl ContinuousSystem for ByHand {
    type Workspace<S: Scalar> = ();
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _: Context<S>,
        r: &Power<SO3<S>>,
        mu: &Power<Cotangent<3, S>>,
        (): &mut (),
        xi: &mut Power<Tangent<3, S>>,
        tau: &mut Power<Cotangent<3, S>>,
    ) {
        let [end, centre] = [ARM.lift::<S>(), LEVER.lift::<S>()];
        let between = *r[0].inverse().compose(&r[1]).matrix();
        // The second momentum is C w2 + B^T w1, the first A w1 + B w2, with B = hat(end)^T Q hat(centre).
        let b = end.hat().transpose() * between * centre.hat();
        let light = Mat3::diagonal(INERTIA[0].map(|x| S::from_f64(1.0 / x)));
        let (first, second) = (Vec3(mu[0].0), Vec3(mu[1].0));
        let schur = Mat3::diagonal(INERTIA[1].map(S::from_f64)) + -(b.transpose() * light * b);
        let w2 = schur.inverse() * (second - b.transpose() * (light * first));
        let w1 = light * (first - b * w2);
        (xi[0], xi[1]) = (Tangent(w1.0), Tangent(w2.0));
        let (moves, turns) = (w1.cross(end), w2.cross(centre));
        let up = [0, 1].map(|i| r[i].matrix().row(2) * S::from_f64(GRAVITY));
        let pull = moves.cross(between * turns) + up[0].cross(FIRST.lift());
        let next = turns.cross(between.transpose() * moves) + up[1].cross(centre);
        (tau[0], tau[1]) = (Cotangent(pull.0), Cotangent(next.0));
    }
}

pub fn start() -> State<Power<SO3>> {
    let turns = [[0.9, 0.2, 0.0], [-0.4, 0.7, 0.3]].map(|v| SO3::exp(&Tangent(v)));
    let g = Power::new(turns.to_vec());
    let mut xi = g.zero_algebra();
    (xi[0], xi[1]) = (Tangent([0.5, 0.0, 0.2]), Tangent([0.0, 1.0, -0.3]));
    Pendulum.state(0.0, g, &xi).expect("a state")
}
