//! A heavy top.

use dvi::{Context, ContinuousSystem, Lagrangian, State, System};
use lgvi::{dvi, lie};
use lie::{Cotangent, LieGroup, SO3, Scalar, Tangent, Vec3};

/// By its value.
#[derive(Clone, Copy)]
pub struct Top;

const INERTIA: [f64; 3] = [1.0, 2.0, 2.5];
const LEVER: Vec3 = Vec3([0.1, 0.2, 0.7]);

impl System for Top {
    type Group = SO3;
}

impl Lagrangian for Top {
    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, w: &Tangent<3, S>) -> S {
        let kinetic = (0..3).fold(S::zero(), |sum, k| sum + (w[k] * w[k]).times(INERTIA[k]));
        kinetic.times(0.5) - r.rotate(LEVER.lift())[2]
    }
}

/// The same with its equations by hand.
#[derive(Clone, Copy)]
pub struct ByHand;

impl System for ByHand {
    type Group = SO3;
}

impl ContinuousSystem for ByHand {
    type Workspace<S: Scalar> = ();
    const INLINE: bool = true;

    #[inline(always)]
    fn velocity_and_force<S: Scalar>(
        &self,
        _: Context<S>,
        r: &SO3<S>,
        mu: &Cotangent<3, S>,
        (): &mut (),
        xi: &mut Tangent<3, S>,
        tau: &mut Cotangent<3, S>,
    ) {
        let mut i = 0;
        while i < 3 {
            xi.0[i] = mu.0[i].times(1.0 / INERTIA[i]);
            i += 1;
        }
        *tau = r.matrix().row(2).cross(LEVER.lift()).into();
    }
}

pub fn start() -> State<SO3> {
    let turn = SO3::exp(&Tangent([0.4, -0.8, 0.3]));
    Top.state(0.0, turn, &Tangent([0.3, -0.5, 1.0]))
        .expect("a state")
}
