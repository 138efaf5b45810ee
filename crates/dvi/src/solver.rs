//! How the momentum balance of a step is solved.

use core::ops::Range;

use lie::{LieGroup, Retraction};

use crate::{Derivatives, DiscreteLagrangian, State};

/// The matrix of a Newton or quasi-Newton iteration on the momentum balance, in the coordinates $c$ of $f = \tau(c)$.
///
/// [`Newton`](crate::Newton) takes it from dual numbers, [`FrozenInertia`](crate::FrozenInertia) from the model.
pub trait StepSolver<L: DiscreteLagrangian> {
    /// A contraction slower than this asks for [`renew`](Self::renew).
    const SLOW: f64;

    /// Storage for groups of the shape of `g`.
    fn allocate(lagrangian: &L, g: &L::Group) -> Self;

    /// Prepares the step of size `h` from `state`.
    fn begin(&mut self, lagrangian: &L, state: &State<L::Group>, h: f64);

    /// The derivatives at $f = \tau(c)$; the cyclic coordinates of both are solved for first, where the model does it exactly.
    #[inline(always)]
    fn derivatives(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        f: &mut L::Group,
        _c: &mut Algebra<L>,
        out: &mut Derivatives<L::Group, f64>,
    ) {
        lagrangian.derivatives(state.t, &state.g, f, h, out);
    }

    /// Forgets what steps before have left.
    fn forget(&mut self) {}

    /// Whether there is no matrix yet that fits the step's size.
    fn is_stale(&self) -> bool {
        false
    }

    /// Renews the matrix at `c`; false where it stays as it is.
    fn renew<R: Retraction>(
        &mut self,
        _lagrangian: &L,
        _state: &State<L::Group>,
        _h: f64,
        _c: &Algebra<L>,
    ) -> bool {
        false
    }

    /// How many pivots of the matrix have another sign than at $h = 0$, where it is the inertia: an odd number on another branch of solutions.
    fn turns(&self) -> usize {
        0
    }

    /// A coordinate along which the kinetic energy was seen to have no inertia, if any.
    fn degenerate(&self) -> Option<usize> {
        None
    }

    /// The correction $\delta$ that the linearised residual asks for; `c - delta` is the next iterate.
    fn solve(&mut self, lagrangian: &L, residual: &Dual<L>, delta: &mut Algebra<L>);

    /// The coordinates whose equation [`derivatives`](Self::derivatives) or [`solve_cyclic`](Self::solve_cyclic) solves to rounding: the
    /// others are judged without them, since they may have another unit and be larger by far.
    fn exact(&self, lagrangian: &L) -> Range<usize> {
        lagrangian.cyclic()
    }

    /// The correction of the cyclic coordinates alone, zero elsewhere; false where [`derivatives`](Self::derivatives) has solved them.
    fn solve_cyclic(
        &mut self,
        _residual: &Dual<L>,
        _cyclic: Range<usize>,
        _delta: &mut Algebra<L>,
    ) -> bool {
        false
    }
}

/// The cyclic coordinates of a Lagrangian, as far as there are such among `dim`.
pub(crate) fn cyclic<L: DiscreteLagrangian>(lagrangian: &L, dim: usize) -> Range<usize> {
    let cyclic = lagrangian.cyclic();
    cyclic.start.min(dim)..cyclic.end.min(dim)
}

/// The algebra of a Lagrangian's group.
pub(crate) type Algebra<L> = <<L as DiscreteLagrangian>::Group as LieGroup>::Algebra;
/// The dual of the algebra of a Lagrangian's group.
pub(crate) type Dual<L> = <<L as DiscreteLagrangian>::Group as LieGroup>::Dual;
