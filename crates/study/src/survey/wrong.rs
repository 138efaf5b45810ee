//! Methods that are wrong on purpose: what measurements and laws must not pass.

use dvi::{
    Context, Derivatives, DiscreteLagrangian, FirstVariation, Integrator, State, StepError,
    StepReport, System, Variation, Variational, legendre_plus,
};
use lie::{LieGroup, Mat3, RealGroup, SO3, Scalar, Vec3, VectorSpace};

use super::systems::TOP;

/// What is wrong with derivatives by hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// Nothing.
    None,
    /// The sign of $\mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d$.
    SignOfDg,
    /// $\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d$ is twice what it should be.
    FactorOfDf,
    /// The first component of $\mathsf T_e^\ast \mathsf L_g \cdot \mathbf D_g L_d$ is zero.
    MissingTerm,
}

/// The top of [`systems::heavy_top`](super::systems::heavy_top) by the left rule, with derivatives by hand.
///
/// $L_d = \frac1h \mathrm{tr}((I - F) J_d) - h W (R e_3) \cdot e_3$, with $J_d = \frac12 \mathrm{tr}(J) I - J$.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ByHand(pub Mistake);

fn jd<S: Scalar>() -> Mat3<S> {
    let [a, c, _] = TOP;
    Mat3::diagonal([0.5 * c, 0.5 * c, a - 0.5 * c]).lift()
}

fn lever<S: Scalar>() -> Vec3<S> {
    Vec3([0.0, 0.0, TOP[2]]).lift()
}

impl System for ByHand {
    type Group = SO3;
}

impl DiscreteLagrangian for ByHand {
    type Workspace<S: Scalar> = ();

    fn value<S: Scalar>(&self, _: Context<S>, r: &SO3<S>, f: &SO3<S>, h: S) -> S {
        let kinetic = -(f.symmetric_minus_identity() * jd()).trace() / h;
        kinetic - h * r.rotate(lever())[2]
    }

    fn derivatives<S: Scalar>(
        &self,
        _: Context<S>,
        r: &SO3<S>,
        f: &SO3<S>,
        h: S,
        (): &mut (),
        out: &mut Derivatives<SO3, S>,
    ) {
        let factor = if self.0 == Mistake::FactorOfDf {
            2.0
        } else {
            1.0
        };
        let sign = if self.0 == Mistake::SignOfDg {
            -1.0
        } else {
            1.0
        };
        let momentum = (jd::<S>() * f.minus_identity()).skew_vee();
        out.d_f = (momentum * (S::from_f64(factor) / h)).into();
        out.d_g = (r.matrix().row(2).cross(lever()) * (h * S::from_f64(sign))).into();
        if self.0 == Mistake::MissingTerm {
            out.d_g[0] = S::zero();
        }
    }

    fn order(&self) -> u32 {
        1
    }

    fn is_symmetric(&self) -> bool {
        false
    }
}

/// Solves each step to `tolerance` and derives the momentum anew from what was found, $\mu_{k+1} = \mathbb F^+ L_d(g_k, f_k)$, in
/// place of carrying the old one.
pub struct Rederived<L: DiscreteLagrangian> {
    integrator: Variational<L>,
}

impl<L: DiscreteLagrangian> Rederived<L> {
    /// Solved to this tolerance, relative to the momentum.
    pub fn new(lagrangian: L, tolerance: f64) -> Self {
        let integrator = Variational::new(lagrangian).with_tolerance(tolerance);
        Self { integrator }
    }
}

impl<L: DiscreteLagrangian> Integrator for Rederived<L> {
    type Group = L::Group;

    fn order(&self) -> u32 {
        self.integrator.order()
    }

    fn is_symmetric(&self) -> bool {
        self.integrator.is_symmetric()
    }

    /// As it claims.
    fn is_symplectic(&self) -> bool {
        true
    }

    fn reset(&mut self) {
        self.integrator.reset();
    }

    fn step(&mut self, state: &mut State<L::Group>, h: f64) -> Result<StepReport, StepError> {
        let f = self.integrator.displacement(state, h)?;
        state.mu = legendre_plus(self.integrator.lagrangian(), state.t, &state.g, &f, h);
        state.g = state.g.compose(&f);
        state.g.normalize();
        state.t += h;
        Ok(StepReport::default())
    }
}

/// Half-width of the central difference, in units of the variation.
const WIDTH: f64 = 1e-4;

/// The variations of the map as it is, tolerance and all: by central differences.
impl<L: DiscreteLagrangian> FirstVariation for Rederived<L> {
    fn step_varied(
        &mut self,
        state: &mut State<L::Group>,
        variations: &mut [Variation<L::Group>],
        h: f64,
    ) -> Result<StepReport, StepError> {
        let mut next = state.clone();
        let report = self.step(&mut next, h)?;
        for variation in variations {
            let mut end = |side: f64| {
                let mut moved = shifted(state, variation, side * WIDTH);
                self.step(&mut moved, h).map(|_| moved)
            };
            let (ahead, behind) = (end(1.0)?, end(-1.0)?);
            *variation = difference(&next, &ahead, &behind);
        }
        *state = next;
        Ok(report)
    }
}

fn shifted<G: RealGroup>(state: &State<G>, variation: &Variation<G>, by: f64) -> State<G> {
    let (mut shifted, mut eta) = (state.clone(), variation.eta.clone());
    eta.scale(by);
    shifted.g = state.g.compose(&G::exp(&eta));
    shifted.mu.add_scaled(by, &variation.mu);
    shifted
}

fn difference<G: RealGroup>(at: &State<G>, ahead: &State<G>, behind: &State<G>) -> Variation<G> {
    let mut change = Variation::zero(&at.g);
    let turn = |state: &State<G>| {
        let turn = at.g.inverse().compose(&state.g).log();
        turn.unwrap_or_else(|half| half.representative)
    };
    for (side, state) in [(1.0, ahead), (-1.0, behind)] {
        change.eta.add_scaled(side / (2.0 * WIDTH), &turn(state));
        change.mu.add_scaled(side / (2.0 * WIDTH), &state.mu);
    }
    change
}
