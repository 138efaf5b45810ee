//! Two dumbbells that attract each other, in space.

use dvi::{Context, ContinuousSystem, Lagrangian, State, System};
use lgvi::{dvi, lie};
use lie::{Cotangent, LieGroup, Power, SE3, SO3, Scalar, Tangent, Vec3};

/// kg m², about the axes of a dumbbell; kg.
const INERTIA: [f64; 3] = [0.1, 0.6, 0.6];
const MASS: f64 = 2.0;
/// From the centre to each end, m; N m², of two ends.
const HALF: Vec3 = Vec3([0.5, 0.0, 0.0]);
const PULL: f64 = 1.5;

/// The ends, by their signs.
const ENDS: [f64; 2] = [1.0, -1.0];

/// By its value.
#[derive(Clone, Copy)]
pub struct Dumbbells;

impl System for Dumbbells {
    type Group = Power<SE3>;
}

impl Lagrangian for Dumbbells {
    fn value<S: Scalar>(&self, _: Context<S>, g: &Power<SE3<S>>, xi: &Power<Tangent<6, S>>) -> S {
        let kinetic = xi.iter().fold(S::zero(), |sum, xi| {
            let (omega, v) = xi.split();
            let spins = (0..3).map(|k| (omega[k] * omega[k]).times(INERTIA[k]));
            spins.fold(sum + v.dot(v).times(MASS), |sum, term| sum + term)
        });
        let place =
            |i: usize, sign: f64| g[i].translation + g[i].rotation.rotate((HALF * sign).lift());
        let pairs = ENDS.iter().flat_map(|a| ENDS.iter().map(move |b| (*a, *b)));
        let potential = pairs.fold(S::zero(), |sum, (a, b)| {
            let apart = place(0, a) - place(1, b);
            sum - S::from_f64(PULL) / apart.dot(apart).sqrt()
        });
        kinetic.times(0.5) - potential
    }
}

/// By its equations.
#[derive(Clone, Copy)]
pub struct ByHand;

impl System for ByHand {
    type Group = Power<SE3>;
}

impl ContinuousSystem for ByHand {
    type Workspace<S: Scalar> = ();
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _: Context<S>,
        g: &Power<SE3<S>>,
        mu: &Power<Cotangent<6, S>>,
        (): &mut (),
        xi: &mut Power<Tangent<6, S>>,
        tau: &mut Power<Cotangent<6, S>>,
    ) {
        for (xi, mu) in xi.iter_mut().zip(mu.iter()) {
            for k in 0..3 {
                xi[k] = mu[k].times(1.0 / INERTIA[k]);
                xi[3 + k] = mu[3 + k].times(1.0 / MASS);
            }
        }
        let zero = Vec3([S::zero(); 3]);
        let (mut force, mut torques) = (zero, [zero; 2]);
        let arms = [0, 1].map(|i| g[i].rotation.rotate(HALF.lift::<S>()));
        let between = g[0].translation - g[1].translation;
        for a in ENDS {
            for b in ENDS {
                let [arm, other] = [arms[0] * S::from_f64(a), arms[1] * S::from_f64(b)];
                let apart = between + arm - other;
                let square = apart.dot(apart);
                let pull = apart * (-S::from_f64(PULL) / (square * square.sqrt()));
                force += pull;
                torques[0] += arm.cross(pull);
                torques[1] -= other.cross(pull);
            }
        }
        for (i, force) in [force, -force].into_iter().enumerate() {
            let turn = g[i].rotation.inverse();
            let (torque, force) = (turn.rotate(torques[i]), turn.rotate(force));
            for k in 0..3 {
                (tau[i][k], tau[i][3 + k]) = (torque[k], force[k]);
            }
        }
    }
}

pub fn start() -> State<Power<SE3>> {
    let turns = [[0.3, 0.2, 0.1], [-0.4, 0.7, 0.3]].map(|v| SO3::exp(&Tangent(v)));
    let places = [Vec3([1.5, 0.0, 0.2]), Vec3([-1.5, 0.1, 0.0])];
    let g = Power::new((0..2).map(|i| SE3::new(turns[i], places[i])).collect());
    let mut xi = g.zero_algebra();
    (xi[0], xi[1]) = (
        Tangent([0.5, 0.0, 0.2, 0.0, 0.6, 0.0]),
        Tangent([0.0, 0.4, 0.0, 0.0, -0.6, 0.1]),
    );
    Dumbbells.state(0.0, g, &xi).expect("a state")
}
