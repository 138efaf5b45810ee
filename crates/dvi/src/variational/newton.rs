//! Newton's method with the matrix from dual numbers.

use core::ops::Range;

use lie::{AlgebraOver, Cayley, DualOver, Jet, LieGroup, Lu, Over, RealGroup, Scalar, VectorSpace};

use super::balance::Balance;
use crate::numerics::degenerate::without_inertia;
use crate::numerics::duals::{add_constant, for_each_chunk, lift, set_columns};
use crate::system::{Algebra, DiscreteCache, Dual};
use crate::{Context, Derivatives, DiscreteLagrangian, State};

type J = <f64 as Scalar>::Jet;

/// The largest dimension for which a dense matrix is built where the inertia is not good enough, or to say why a step failed.
pub(super) const DENSE_LIMIT: usize = 128;

/// Simplified Newton: the exact matrix of the momentum balance by dual numbers, kept until convergence slows; for a step
/// of another size in proportion to $1/h$.
///
/// Needs nothing but the discrete Lagrangian's value. The solve is dense, of the size of the group's dimension.
pub(crate) struct Newton<L: DiscreteLagrangian> {
    matrix: Lu<f64>,
    /// The same in the chart.
    in_chart: Lu<f64>,
    cyclic: Option<Lu<f64>>,
    rhs: Vec<f64>,
    known: bool,
    /// The step size of the matrix, which goes as its inverse.
    h: f64,
    /// The step size now, over that of the matrix.
    scale: f64,
    balance: Balance<L, J>,
    g: Over<L::Group, J>,
    mu: DualOver<L::Group, J>,
    c: AlgebraOver<L::Group, J>,
    /// Negative pivots of the matrix in the chart, and of the inertia.
    index: usize,
    inertia: Option<usize>,
    degenerate: Option<usize>,
    /// A column of the matrix: in the frame of the step's end, of its start, and in the chart.
    column: [Dual<L>; 3],
    f: L::Group,
    cache: DiscreteCache<L::Group>,
}

/// The cyclic coordinates of a Lagrangian, as far as there are such among `dim`.
pub(super) fn cyclic<L: DiscreteLagrangian>(lagrangian: &L, dim: usize) -> Range<usize> {
    let cyclic = lagrangian.cyclic();
    cyclic.start.min(dim)..cyclic.end.min(dim)
}

impl<L: DiscreteLagrangian> Newton<L> {
    pub(crate) fn new(lagrangian: &L, g: &L::Group, cache: DiscreteCache<L::Group>) -> Self {
        let dim = g.zero_dual().dim();
        let cyclic = cyclic(lagrangian, dim);
        let (f, column) = (g.clone(), core::array::from_fn(|_| g.zero_dual()));
        let g = g.lift::<J>();
        Self {
            matrix: Lu::new(dim),
            in_chart: Lu::new(dim),
            cyclic: (!cyclic.is_empty()).then(|| Lu::new(cyclic.len())),
            rhs: vec![0.0; dim],
            known: false,
            h: 1.0,
            scale: 1.0,
            balance: Balance::new(&g, cache.clone()),
            cache,
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

    /// Prepares the step of size `h`.
    pub(super) fn begin(&mut self, h: f64) {
        self.scale = h / self.h;
    }

    pub(super) fn forget(&mut self) {
        self.known = false;
    }

    /// Whether there is no matrix yet that fits the step's size.
    pub(super) fn is_stale(&self) -> bool {
        !self.known
    }

    /// How many pivots of the matrix have another sign than at $h = 0$, where it is the inertia: an odd number on another branch of solutions.
    pub(super) fn turns(&self) -> usize {
        self.inertia
            .map_or(0, |inertia| inertia.abs_diff(self.index))
    }

    /// Renews the matrix at `c`.
    pub(crate) fn renew(
        &mut self,
        lagrangian: &L,
        state: &State<L::Group>,
        h: f64,
        c: &Algebra<L>,
    ) {
        if self.inertia.is_none() {
            let [mut inertia, longer] =
                VANISHING.map(|part| inertia(lagrangian, state, part * h.abs(), &self.cache));
            self.degenerate = without_inertia(&inertia, &longer);
            self.inertia = Some(index(&mut inertia));
        }
        (self.h, self.scale) = (h, 1.0);
        self.balance.set_parameters(lagrangian);
        let State { t, g, mu } = state;
        let (t, h) = (J::constant(*t), J::constant(h));
        <L::Group as LieGroup>::convert_into::<f64, J>(g, J::constant, &mut self.g);
        (0..mu.dim()).for_each(|i| self.mu.set(i, J::constant(mu.get(i))));
        for_each_chunk(mu.dim(), |first| {
            lie::seed(&mut self.c, first);
            add_constant(&mut self.c, c);
            self.balance.retract(&self.c);
            self.balance.evaluate(lagrangian, t, &self.g, &self.mu, h);
            let residual = &self.balance.residual;
            set_columns(self.matrix.columns_mut(first), |row, direction| {
                residual.get(row).partial(direction)
            });
        });
        if let Some(block) = &mut self.cyclic {
            let cyclic = cyclic(lagrangian, mu.dim());
            for (j, column) in cyclic.clone().enumerate() {
                let column = &self.matrix.column_mut(column)[cyclic.clone()];
                block.column_mut(j).copy_from_slice(column);
            }
            block.factorise_form();
        }
        self.index = self.index_in_chart(c);
        self.matrix.factorise_form();
        self.known = true;
    }

    /// A coordinate along which the kinetic energy was seen to have no inertia, if any.
    pub(super) fn degenerate(&self) -> Option<usize> {
        self.degenerate
    }

    /// The correction $\delta$ that the linearised residual asks for; `c - delta` is the next iterate.
    pub(crate) fn solve(&mut self, residual: &Dual<L>, delta: &mut Algebra<L>) {
        residual.write(&mut self.rhs);
        self.matrix.solve(&mut self.rhs, |entry| entry);
        delta.read(&self.rhs);
        delta.scale(self.scale);
    }

    /// The correction of the cyclic coordinates alone, zero elsewhere.
    pub(super) fn solve_cyclic(
        &mut self,
        residual: &Dual<L>,
        cyclic: Range<usize>,
        delta: &mut Algebra<L>,
    ) {
        let Some(block) = &mut self.cyclic else {
            return;
        };
        let x = &mut self.rhs[..cyclic.len()];
        for (x, i) in x.iter_mut().zip(cyclic.clone()) {
            *x = residual.get(i);
        }
        block.solve(x, |entry| entry);
        delta.set_zero();
        cyclic.zip(x).for_each(|(i, x)| delta.set(i, *x));
        delta.scale(self.scale);
    }

    /// The index of $h (\mathrm d\tau_c)^\ast A$: of the matrix with its residual in the chart too, where a turn of the body does not enter.
    fn index_in_chart(&mut self, c: &Algebra<L>) -> usize {
        let Self {
            f,
            column: [end, start, chart],
            matrix,
            in_chart,
            h,
            ..
        } = self;
        L::Group::retract_into::<Cayley>(c, f);
        for j in 0..matrix.dim() {
            end.read(matrix.column_mut(j));
            f.inverse_coadjoint_into(end, start);
            L::Group::chart_leave_into::<Cayley>(c, start, (&mut *f, &mut *end, &mut *chart));
            chart.scale(h.signum());
            chart.write(in_chart.column_mut(j));
        }
        index(in_chart)
    }
}

/// How many pivots are negative as the matrix is eliminated without exchanges; its factors replace it.
fn index(matrix: &mut Lu<f64>) -> usize {
    matrix.factorise_by(|_, k| k);
    matrix.negative_pivots()
}

/// A coordinate along which $L_d$ has no inertia, where the dimension is small enough to look.
pub(crate) fn degenerate<L: DiscreteLagrangian>(
    lagrangian: &L,
    state: &State<L::Group>,
    h: f64,
    cache: &DiscreteCache<L::Group>,
) -> Option<usize> {
    if state.mu.dim() > DENSE_LIMIT {
        return None;
    }
    let [short, long] = VANISHING.map(|part| inertia(lagrangian, state, part * h, cache));
    without_inertia(&short, &long)
}

/// Parts of a step so short that a potential is rounding beside the inertia.
const VANISHING: [f64; 2] = [1e-8, 1e-6];

/// $h\, \mathbf D_f (\mathsf T_e^\ast \mathsf L_f \cdot \mathbf D_f L_d)$ at $f = e$: for a short step the inertia.
fn inertia<L: DiscreteLagrangian>(
    lagrangian: &L,
    state: &State<L::Group>,
    h: f64,
    cache: &DiscreteCache<L::Group>,
) -> Lu<f64> {
    let g = state.g.lift::<J>();
    let (mut c, mut f) = (g.zero_algebra(), g.clone());
    let mut derivatives = Derivatives::with_cache(&g, cache.clone());
    let mut work = Default::default();
    let mut parameters = Vec::new();
    lift(lagrangian.parameters(), J::constant, &mut parameters);
    let dim = c.dim();
    let mut inertia = Lu::new(dim);
    let (at, step) = (
        Context::new(J::constant(state.t), &parameters),
        J::constant(h),
    );
    for_each_chunk(dim, |first| {
        lie::seed(&mut c, first);
        Over::<L::Group, J>::retract_into::<Cayley>(&c, &mut f);
        lagrangian.derivatives(at, &g, &f, step, &mut work, &mut derivatives);
        set_columns(inertia.columns_mut(first), |row, direction| {
            h * derivatives.d_f.get(row).partial(direction)
        });
    });
    inertia
}
