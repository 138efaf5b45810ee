//! Hamilton's equations of a Lagrangian of which only the value is given.

use lie::{AlgebraOver, DualOver, Jet, LieGroup, Over, Scalar, VectorSpace};

use crate::elimination::Elimination;
use crate::jets::{Lifted, add_constant, for_each_chunk, read_partials};
use crate::{ContinuousSystem, Lagrangian, State};

/// Newton iterations before a momentum is taken to have no velocity.
const MAX_ITERATIONS: u32 = 50;
/// A correction this small, relative to the velocity, leaves an error of rounding: convergence is quadratic.
const CONVERGED: f64 = 1e-8;

/// The Hamiltonian system of a Lagrangian, $\mu = \mathbf D_\xi L$, by dual numbers.
///
/// The velocity comes from Newton's method on the Legendre transform, with the Hessian $\mathbf D_\xi^2 L$: exact after one
/// iteration where the kinetic energy is quadratic. Where the Hessian is singular there is no velocity, and the answer is not a number.
///
/// ```
/// use dvi::{Lagrangian, State};
/// use lie::{Cotangent, Rn, Scalar, Tangent};
///
/// /// A particle of 2 kg in a field of 9.81 N/kg.
/// struct Falling;
///
/// impl Lagrangian for Falling {
///     type Group = Rn<1>;
///     fn value<S: Scalar>(&self, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         v[0] * v[0] - x.0[0] * S::from_f64(2.0 * 9.81)
///     }
/// }
///
/// let state = State { t: 0.0, g: Rn([3.0]), mu: Cotangent([4.0]) };
/// let system = Falling.hamiltonian();
/// assert_eq!(system.velocity(&state), Tangent([2.0]));
/// assert_eq!(system.energy(&state), 4.0 + 3.0 * 2.0 * 9.81);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HamiltonianSystem<L>(pub L);

/// Storage for the derivatives of a Lagrangian.
pub struct LegendreWorkspace<L: Lagrangian, S: Scalar> {
    lifted: Lifted<L::Group, S>,
    moved: AlgebraOver<L::Group, S::Jet>,
    twice: Over<L::Group, Twice<S>>,
    moved_twice: AlgebraOver<L::Group, Twice<S>>,
    gradient: DualOver<L::Group, S>,
    hessian: Elimination<S>,
}

/// Duals of duals: second derivatives.
type Twice<S> = <<S as Scalar>::Jet as Scalar>::Jet;

impl<L: Lagrangian, S: Scalar> LegendreWorkspace<L, S> {
    fn new(g: &Over<L::Group, S>) -> Self {
        let lifted = Lifted::new(g);
        let constant = |x: S| Twice::<S>::constant(Jet::constant(x));
        let twice = L::Group::convert::<S, Twice<S>>(g, constant);
        Self {
            moved: lifted.zero_algebra(),
            moved_twice: twice.zero_algebra(),
            gradient: g.zero_dual(),
            hessian: Elimination::new(g.zero_dual().dim()),
            lifted,
            twice,
        }
    }

    /// Fills the gradient $\mathbf D_\xi L$ and the Hessian $\mathbf D_\xi^2 L$.
    fn differentiate(&mut self, lagrangian: &L, t: S, xi: &AlgebraOver<L::Group, S>) {
        let t = Twice::<S>::constant(Jet::constant(t));
        let dim = xi.dim();
        for_each_chunk(dim, |column| {
            for_each_chunk(dim, |row| {
                for i in 0..dim {
                    let inner = seeded::<S::Jet>(xi.get(i), i, row);
                    self.moved_twice
                        .set(i, seeded::<Twice<S>>(inner, i, column));
                }
                let value = lagrangian.value_at(t, &self.twice, &self.moved_twice);
                read_partials(&mut self.gradient, row, value.value());
                let end = |first: usize| dim.min(first + lie::JET_DIRECTIONS);
                for j in column..end(column) {
                    let slope = value.partial(j - column);
                    for i in row..end(row) {
                        self.hessian.set(i, j, slope.partial(i - row));
                    }
                }
            });
        });
    }
}

/// `x`, the variable of its own direction where the chunk from `first` on holds it.
fn seeded<J: Jet>(x: J::Value, i: usize, first: usize) -> J {
    match i.checked_sub(first) {
        Some(direction) if direction < lie::JET_DIRECTIONS => J::variable(x, direction),
        _ => J::constant(x),
    }
}

impl<L: Lagrangian> HamiltonianSystem<L> {
    /// The velocity of a state; not a number where there is none.
    pub fn velocity(&self, state: &State<L::Group>) -> <L::Group as LieGroup>::Algebra {
        let mut workspace = LegendreWorkspace::new(&state.g);
        let mut xi = state.g.zero_algebra();
        self.invert(state.t, &state.g, &state.mu, &mut workspace, &mut xi);
        xi
    }

    /// The energy of a state, in joules; not a number where there is no velocity.
    pub fn energy(&self, state: &State<L::Group>) -> f64 {
        let xi = self.velocity(state);
        self.0.energy(state.t, &state.g, &xi)
    }

    /// The inverse Legendre transform, by Newton's method from $\xi = 0$.
    fn invert<S: Scalar>(
        &self,
        t: S,
        g: &Over<L::Group, S>,
        mu: &DualOver<L::Group, S>,
        work: &mut LegendreWorkspace<L, S>,
        xi: &mut AlgebraOver<L::Group, S>,
    ) {
        let constant = |x: S| Twice::<S>::constant(Jet::constant(x));
        L::Group::convert_into::<S, Twice<S>>(g, constant, &mut work.twice);
        xi.set_zero();
        // Derivatives follow the value by one iteration for every doubling of their order.
        let mut more = S::DUAL_LEVELS.checked_ilog2().map_or(0, |log| log + 1);
        for _ in 0..MAX_ITERATIONS {
            work.differentiate(&self.0, t, xi);
            for i in 0..mu.dim() {
                work.hessian.right_hand_side()[i] = mu.get(i) - work.gradient.get(i);
            }
            let (mut correction, mut size) = (0.0_f64, 0.0_f64);
            for (i, delta) in work.hessian.solve().iter().enumerate() {
                xi.set(i, xi.get(i) + *delta);
                correction = correction.max(delta.magnitude());
                size = size.max(xi.get(i).magnitude());
            }
            if correction <= CONVERGED * size {
                if more == 0 {
                    return;
                }
                more -= 1;
            }
        }
        (0..xi.dim()).for_each(|i| xi.set(i, S::from_f64(f64::NAN)));
    }
}

impl<L: Lagrangian> ContinuousSystem for HamiltonianSystem<L> {
    type Group = L::Group;
    type Workspace<S: Scalar> = LegendreWorkspace<L, S>;

    fn workspace<S: Scalar>(&self, g: &Over<L::Group, S>) -> LegendreWorkspace<L, S> {
        LegendreWorkspace::new(g)
    }

    fn velocity_and_force<S: Scalar>(
        &self,
        t: S,
        g: &Over<L::Group, S>,
        mu: &DualOver<L::Group, S>,
        work: &mut LegendreWorkspace<L, S>,
        xi: &mut AlgebraOver<L::Group, S>,
        tau: &mut DualOver<L::Group, S>,
    ) {
        self.invert(t, g, mu, work, xi);
        let t = S::Jet::constant(t);
        work.moved.set_zero();
        add_constant(&mut work.moved, xi);
        work.lifted.set_g(g);
        for_each_chunk(tau.dim(), |first| {
            let g = work.lifted.moved_g(first);
            read_partials(tau, first, self.0.value_at(t, g, &work.moved));
        });
    }

    fn fits(&self, g: &L::Group) -> bool {
        self.0.fits(g)
    }
}
