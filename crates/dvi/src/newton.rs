//! Newton's method with the matrix from dual numbers.

use core::ops::Range;

use lie::{
    AlgebraOver, Cayley, DualOver, Jet, LieGroup, Over, RealGroup, Retraction, Scalar, VectorSpace,
};

use crate::balance::Balance;
use crate::degenerate::without_inertia;
use crate::inertia::DENSE_LIMIT;
use crate::jets::{add_constant, for_each_chunk};
use crate::linear::Factorisation;
use crate::solver::{Algebra, Dual, StepSolver, cyclic};
use crate::{Derivatives, DiscreteLagrangian, State};

type J = <f64 as Scalar>::Jet;

/// Simplified Newton: the exact matrix of the momentum balance by dual numbers, kept until convergence slows; for a step
/// of another size in proportion to $1/h$.
///
/// Needs nothing but the discrete Lagrangian's value. The solve is dense, of the size of the group's dimension.
pub struct Newton<G: RealGroup> {
    matrix: Factorisation,
    cyclic: Option<Factorisation>,
    known: bool,
    /// The step size of the matrix, which goes as its inverse.
    h: f64,
    /// The step size now, over that of the matrix.
    scale: f64,
    balance: Balance<G, J>,
    g: Over<G, J>,
    mu: DualOver<G, J>,
    c: AlgebraOver<G, J>,
    /// Negative pivots of the matrix in the chart, and of the inertia.
    index: usize,
    inertia: Option<usize>,
    degenerate: Option<usize>,
    /// A column of the matrix: in the frame of the step's end, of its start, and in the chart.
    column: [G::Dual; 3],
    f: G,
}

impl<L: DiscreteLagrangian> StepSolver<L> for Newton<L::Group> {
    const SLOW: f64 = 0.2;

    fn allocate(lagrangian: &L, g: &L::Group) -> Self {
        let dim = g.zero_dual().dim();
        let cyclic = cyclic(lagrangian, dim);
        let (f, column) = (g.clone(), core::array::from_fn(|_| g.zero_dual()));
        let g = g.lift::<J>();
        Self {
            matrix: Factorisation::new(dim),
            cyclic: (!cyclic.is_empty()).then(|| Factorisation::new(cyclic.len())),
            known: false,
            h: 1.0,
            scale: 1.0,
            balance: Balance::new(&g),
            mu: g.zero_dual(),
            c: g.zero_algebra(),
            g,
            index: 0,
            inertia: None,
            degenerate: None,
            column,
            f,
        }
    }

    fn begin(&mut self, _: &L, _: &State<L::Group>, h: f64) {
        self.scale = h / self.h;
    }

    fn forget(&mut self) {
        self.known = false;
    }

    fn is_stale(&self) -> bool {
        !self.known
    }

    fn turns(&self) -> usize {
        self.inertia
            .map_or(0, |inertia| inertia.abs_diff(self.index))
    }

    fn renew<R: Retraction>(
        &mut self,
        lagrangian: &L,
        state: &State<L::Group>,
        h: f64,
        c: &Algebra<L>,
    ) -> bool {
        if self.inertia.is_none() {
            let [mut inertia, longer] =
                VANISHING.map(|part| inertia(lagrangian, state, part * h.abs()));
            self.degenerate = without_inertia(&inertia.square(), &longer.square());
            self.inertia = Some(inertia.index(|column, out| out.copy_from_slice(column)));
        }
        (self.h, self.scale) = (h, 1.0);
        let State { t, g, mu } = state;
        let (t, h) = (J::constant(*t), J::constant(h));
        <L::Group as LieGroup>::convert_into::<f64, J>(g, J::constant, &mut self.g);
        (0..mu.dim()).for_each(|i| self.mu.set(i, J::constant(mu.get(i))));
        for_each_chunk(mu.dim(), |first| {
            lie::seed(&mut self.c, first);
            add_constant(&mut self.c, c);
            self.balance.retract::<R>(&self.c);
            self.balance.evaluate(lagrangian, t, &self.g, &self.mu, h);
            let last = mu.dim().min(first + lie::JET_DIRECTIONS);
            for column in first..last {
                for row in 0..mu.dim() {
                    let entry = self.balance.residual.get(row).partial(column - first);
                    self.matrix.set(row, column, entry);
                }
            }
        });
        if let Some(block) = &mut self.cyclic {
            block.copy_block(&self.matrix, cyclic(lagrangian, mu.dim()));
            block.factorise();
        }
        self.index = self.index_in_chart::<R>(c);
        self.matrix.factorise();
        self.known = true;
        true
    }

    fn degenerate(&self) -> Option<usize> {
        self.degenerate
    }

    fn solve(&mut self, _: &L, residual: &Dual<L>, delta: &mut Algebra<L>) {
        residual.write(self.matrix.right_hand_side());
        delta.read(self.matrix.solve());
        delta.scale(self.scale);
    }

    fn solve_cyclic(
        &mut self,
        residual: &Dual<L>,
        cyclic: Range<usize>,
        delta: &mut Algebra<L>,
    ) -> bool {
        let Some(block) = &mut self.cyclic else {
            return false;
        };
        let rhs = block.right_hand_side();
        cyclic
            .clone()
            .enumerate()
            .for_each(|(k, i)| rhs[k] = residual.get(i));
        delta.set_zero();
        cyclic
            .zip(block.solve())
            .for_each(|(i, x)| delta.set(i, *x));
        delta.scale(self.scale);
        true
    }
}

impl<G: RealGroup> Newton<G> {
    /// The index of $h (\mathrm d\tau_c)^\ast A$: of the matrix with its residual in the chart too, where a turn of the body does not enter.
    fn index_in_chart<R: Retraction>(&mut self, c: &G::Algebra) -> usize {
        let Self {
            f,
            column: [end, start, chart],
            matrix,
            h,
            ..
        } = self;
        G::retract_into::<R>(c, f);
        matrix.index(|column, out| {
            end.read(column);
            f.inverse_coadjoint_into(end, start);
            G::chart_leave_into::<R>(c, start, (&mut *f, &mut *end, &mut *chart));
            chart.scale(h.signum());
            chart.write(out);
        })
    }
}

/// A coordinate along which $L_d$ has no inertia, where the dimension is small enough to look.
pub(crate) fn degenerate<L: DiscreteLagrangian>(
    lagrangian: &L,
    state: &State<L::Group>,
    h: f64,
) -> Option<usize> {
    if state.mu.dim() > DENSE_LIMIT {
        return None;
    }
    let [short, long] = VANISHING.map(|part| inertia(lagrangian, state, part * h).square());
    without_inertia(&short, &long)
}

/// Parts of a step so short that a potential is rounding beside the inertia.
const VANISHING: [f64; 2] = [1e-8, 1e-6];

/// $h\, \mathbf D_f (\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d)$ at $f = e$: for a short step the inertia.
fn inertia<L: DiscreteLagrangian>(
    lagrangian: &L,
    state: &State<L::Group>,
    h: f64,
) -> Factorisation {
    let g = state.g.lift::<J>();
    let (mut c, mut f) = (g.zero_algebra(), g.clone());
    let mut derivatives = Derivatives::new(&g);
    let dim = c.dim();
    let mut inertia = Factorisation::new(dim);
    let (t, step) = (J::constant(state.t), J::constant(h));
    for_each_chunk(dim, |first| {
        lie::seed(&mut c, first);
        Over::<L::Group, J>::retract_into::<Cayley>(&c, &mut f);
        lagrangian.derivatives(t, &g, &f, step, &mut derivatives);
        for column in first..dim.min(first + lie::JET_DIRECTIONS) {
            for row in 0..dim {
                let entry = derivatives.d_f.get(row).partial(column - first);
                inertia.set(row, column, h * entry);
            }
        }
    });
    inertia
}
