//! Methods without their types.

use dvi::{
    Composition, Discretised, FirstVariation, Gauss, Integrator, Lagrangian, Quadrature, State,
    StepError, StepReport, Variation, Variational,
};
use lie::{RealGroup, Retraction};

/// An integrator that carries first variations, chosen at run time.
pub struct Method<G: RealGroup>(Box<dyn FirstVariation<Group = G>>);

impl<G: RealGroup> Method<G> {
    /// This integrator.
    pub fn new(integrator: impl FirstVariation<Group = G> + 'static) -> Self {
        Self(Box::new(integrator))
    }
}

/// The variational integrator by a rule, through the retraction `R`.
pub fn variational<L, R>(system: L, rule: Quadrature) -> Method<L::Group>
where
    L: Lagrangian + 'static,
    R: Retraction + 'static,
{
    let discrete: Discretised<L, R> = system.discretise(rule).with_retraction();
    Method::new(Variational::new(discrete))
}

/// Gauss collocation of `S` stages in Cayley's chart.
pub fn gauss<L: Lagrangian + 'static, const S: usize>(system: L) -> Method<L::Group> {
    Method::new(Gauss::new::<S>(system.hamiltonian()))
}

/// The composition of order `P` of the midpoint rule.
pub fn composition<L: Lagrangian + Clone + 'static, const P: u32>(system: L) -> Method<L::Group> {
    Method::new(Composition::new::<P>(
        system.discretise(Quadrature::Midpoint),
    ))
}

impl<G: RealGroup> Integrator for Method<G> {
    type Group = G;

    fn order(&self) -> u32 {
        self.0.order()
    }

    fn is_symmetric(&self) -> bool {
        self.0.is_symmetric()
    }

    fn is_symplectic(&self) -> bool {
        self.0.is_symplectic()
    }

    fn step(&mut self, state: &mut State<G>, h: f64) -> Result<StepReport, StepError> {
        self.0.step(state, h)
    }

    fn peek(&mut self, state: &State<G>, h: f64) -> Result<State<G>, StepError> {
        self.0.peek(state, h)
    }

    fn reset(&mut self) {
        self.0.reset();
    }
}

impl<G: RealGroup> FirstVariation for Method<G> {
    fn step_varied(
        &mut self,
        state: &mut State<G>,
        variations: &mut [Variation<G>],
        h: f64,
    ) -> Result<StepReport, StepError> {
        self.0.step_varied(state, variations, h)
    }
}
