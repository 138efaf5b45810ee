//! The derivative of a solved step.

use lie::{AlgebraOver, Jet, LieGroup, Scalar, VectorSpace};

use super::balance::Balance;
use super::newton::Newton;
use crate::numerics::duals::add_constant;
use crate::system::{Algebra, DiscreteCache, Dual};
use crate::variation::Varied;
use crate::{DiscreteLagrangian, State, Variation};

type J = <f64 as Scalar>::Jet;

/// The derivative of a solved step by the implicit-function rule: with $r(c; g, \mu) = 0$, $\delta c = -(\partial_c r)^{-1} \delta r$.
pub(super) struct Linearised<L: DiscreteLagrangian> {
    newton: Newton<L>,
    balance: Balance<L, J>,
    varied: Varied<L::Group>,
    c: AlgebraOver<L::Group, J>,
    delta: Algebra<L>,
    delta_residual: Dual<L>,
}

impl<L: DiscreteLagrangian> Linearised<L> {
    pub(super) fn new(state: &L::Group, cache: DiscreteCache<L::Group>) -> Self {
        let varied = Varied::new(state);
        Self {
            newton: Newton::new(state, cache.clone()),
            balance: Balance::new(&varied.g, cache),
            c: varied.g.zero_algebra(),
            delta: state.zero_algebra(),
            delta_residual: state.zero_dual(),
            varied,
        }
    }

    /// Whether the storage is for states of the shape of `g`.
    pub(super) fn fits(&self, g: &L::Group) -> bool {
        self.varied.same_shape(g)
    }

    /// Carries variations of `state` over the step of size `h` whose solution is `c`.
    pub(super) fn carry(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        c: &Algebra<L>,
        variations: &mut [Variation<L::Group>],
    ) {
        self.newton.renew(lagrangian, state, h, c);
        for chunk in variations.chunks_mut(lie::JET_DIRECTIONS) {
            self.varied.enter((lagrangian.parameters(), state), chunk);
            self.balance.parameters.clone_from(&self.varied.parameters);
            let (mu, force) = (&mut self.varied.mu, &self.varied.force);
            mu.add_scaled(J::constant(0.5 * h), force);
            self.c.set_zero();
            add_constant(&mut self.c, c);
            self.evaluate(lagrangian, state.t, h);
            for direction in 0..chunk.len() {
                self.follow(direction);
            }
            self.evaluate(lagrangian, state.t, h);
            let (f, mu) = (&self.balance.f, &self.balance.transported);
            self.varied.leave(f, mu, chunk);
            for variation in chunk {
                variation.mu.add_scaled(0.5 * h, &variation.force);
            }
        }
    }

    fn evaluate(&mut self, lagrangian: &L, t: f64, h: f64) {
        self.balance.retract(&self.c);
        let (t, h) = (J::constant(t), J::constant(h));
        let Varied { g, mu, .. } = &self.varied;
        self.balance.evaluate(lagrangian, t, g, mu, h);
    }

    /// Moves `c` along with one direction of the variations, so that the residual stays zero to first order.
    fn follow(&mut self, direction: usize) {
        for i in 0..self.delta_residual.dim() {
            let slope = self.balance.residual.get(i).partial(direction);
            self.delta_residual.set(i, slope);
        }
        self.newton.solve(&self.delta_residual, &mut self.delta);
        for i in 0..self.delta.dim() {
            let moved = J::variable(0.0, direction).times(self.delta.get(i));
            self.c.set(i, self.c.get(i) - moved);
        }
    }
}
