//! Newton's method with the matrix from dual numbers.

use core::ops::Range;

use lie::{AlgebraOver, Cayley, DualOver, Jet, LieGroup, Lu, Over, RealGroup, Scalar, VectorSpace};

use super::balance::Balance;
use super::sparsity::Sparsity;
use crate::numerics::degenerate::without_inertia;
use crate::numerics::duals::{add_constant, for_each_chunk, in_duals, lift, seeded, set_columns};
use crate::numerics::sparse::Sparse;
use crate::system::{Algebra, DiscreteCache, Dual};
use crate::{Context, Derivatives, DiscreteLagrangian, State};

type J = <f64 as Scalar>::Jet;

/// The largest dimension for which a dense matrix is built where the inertia is not good enough, or to say why a step failed.
pub(super) const DENSE_LIMIT: usize = 128;

/// Simplified Newton: the exact matrix of the momentum balance by dual numbers, kept until convergence slows; for a step
/// of another size in proportion to $1/h$.
///
/// The matrix is sparse where the balance's [pattern](Sparsity) is, and dense elsewhere. Sparse, it is that of the residual in the chart,
/// which is eliminated without exchanges.
pub(crate) struct Newton<L: DiscreteLagrangian> {
    /// Made when first needed.
    factors: Option<Factors>,
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
    /// Where the matrix is.
    place: Algebra<L>,
    /// Negative pivots of the matrix in the chart, and of the inertia.
    index: usize,
    inertia: Option<usize>,
    degenerate: Option<usize>,
    /// A column of the matrix: in the frame of the step's end, of its start, and in the chart.
    column: [Dual<L>; 3],
    f: L::Group,
    cache: DiscreteCache<L::Group>,
}

enum Factors {
    Dense(Dense),
    Sparse(Sparsity, Sparse),
}

/// Dense matrices.
struct Dense {
    matrix: Lu<f64>,
    /// The same in the chart.
    in_chart: Lu<f64>,
    cyclic: Option<Lu<f64>>,
}

/// The cyclic coordinates of a Lagrangian, as far as there are such among `dim`.
pub(super) fn cyclic<L: DiscreteLagrangian>(lagrangian: &L, dim: usize) -> Range<usize> {
    let cyclic = lagrangian.cyclic();
    cyclic.start.min(dim)..cyclic.end.min(dim)
}

impl<L: DiscreteLagrangian> Newton<L> {
    pub(crate) fn new(g: &L::Group, cache: DiscreteCache<L::Group>) -> Self {
        let dim = g.zero_dual().dim();
        let (f, column) = (g.clone(), core::array::from_fn(|_| g.zero_dual()));
        let place = g.zero_algebra();
        let g = g.lift::<J>();
        Self {
            factors: None,
            rhs: vec![0.0; dim],
            known: false,
            h: 1.0,
            scale: 1.0,
            balance: Balance::new(&g, cache.clone()),
            mu: g.zero_dual(),
            c: g.zero_algebra(),
            g,
            place,
            index: 0,
            inertia: None,
            degenerate: None,
            column,
            f,
            cache,
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

    /// What a matrix costs, in evaluations.
    pub(super) fn evaluations(&self) -> u32 {
        in_duals(match &self.factors {
            Some(Factors::Sparse(sparsity, _)) => sparsity.count,
            _ => self.rhs.len(),
        })
    }

    /// Renews the matrix at `c`.
    pub(crate) fn renew(
        &mut self,
        lagrangian: &L,
        state: &State<L::Group>,
        h: f64,
        c: &Algebra<L>,
    ) {
        self.set_state(lagrangian, state);
        self.place.copy_from(c);
        let factors = self.factors.take();
        let new = || Factors::new(lagrangian, (state, h), &self.cache);
        let mut factors = factors.unwrap_or_else(new);
        match &mut factors {
            Factors::Dense(dense) => self.renew_dense(lagrangian, (state, h), dense),
            Factors::Sparse(sparsity, matrix) => {
                self.renew_sparse(lagrangian, (state, h), sparsity, matrix);
            }
        }
        self.factors = Some(factors);
        (self.h, self.scale, self.known) = (h, 1.0, true);
    }

    fn set_state(&mut self, lagrangian: &L, State { g, mu, .. }: &State<L::Group>) {
        self.balance.set_parameters(lagrangian);
        <L::Group as LieGroup>::convert_into::<f64, J>(g, J::constant, &mut self.g);
        (0..mu.dim()).for_each(|i| self.mu.set(i, J::constant(mu.get(i))));
    }

    fn renew_dense(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        dense: &mut Dense,
    ) {
        if self.inertia.is_none() {
            let [mut inertia, longer] =
                VANISHING.map(|part| inertia(lagrangian, state, part * h.abs(), &self.cache));
            self.degenerate = without_inertia(&inertia, &longer);
            self.inertia = Some(index(&mut inertia));
        }
        for_each_chunk(self.rhs.len(), |first| {
            lie::seed(&mut self.c, first);
            self.evaluate(lagrangian, (state.t, h));
            let residual = &self.balance.residual;
            set_columns(dense.matrix.columns_mut(first), |row, direction| {
                residual.get(row).partial(direction)
            });
        });
        if let Some(block) = &mut dense.cyclic {
            let cyclic = cyclic(lagrangian, self.rhs.len());
            for (j, column) in cyclic.clone().enumerate() {
                let column = &dense.matrix.column_mut(column)[cyclic.clone()];
                block.column_mut(j).copy_from_slice(column);
            }
            block.factorise_form();
        }
        L::Group::retract_into::<Cayley>(&self.place, &mut self.f);
        for j in 0..self.rhs.len() {
            self.column[0].read(dense.matrix.column_mut(j));
            self.move_to_chart(h);
            self.column[2].write(dense.in_chart.column_mut(j));
        }
        self.index = index(&mut dense.in_chart);
        dense.matrix.factorise_form();
    }

    /// The balance at the place of the matrix, moved by what is in `c`.
    fn evaluate(&mut self, lagrangian: &L, (t, h): (f64, f64)) {
        add_constant(&mut self.c, &self.place);
        self.balance.retract(&self.c);
        let (t, h) = (J::constant(t), J::constant(h));
        self.balance.evaluate(lagrangian, t, &self.g, &self.mu, h);
    }

    /// Takes what is in the first column, a residual, to $h (\mathrm d\tau_c)^\ast$ of it in the last: in the chart a turn of the body does not
    /// enter.
    fn move_to_chart(&mut self, h: f64) {
        let Self {
            f,
            column: [end, start, chart],
            place,
            ..
        } = self;
        f.inverse_coadjoint_into(end, start);
        L::Group::chart_leave_into::<Cayley>(place, start, (&mut *f, &mut *end, &mut *chart));
        chart.scale(h.signum());
    }

    fn renew_sparse(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        sparsity: &Sparsity,
        matrix: &mut Sparse,
    ) {
        if self.inertia.is_none() {
            self.find_inertia(lagrangian, (state, h), sparsity, matrix);
        }
        L::Group::retract_into::<Cayley>(&self.place, &mut self.f);
        matrix.clear();
        self.for_each_colour(sparsity, |this, first| {
            this.evaluate(lagrangian, (state.t, h));
            for direction in 0..lie::JET_DIRECTIONS.min(sparsity.count - first) {
                for i in 0..this.rhs.len() {
                    let slope = this.balance.residual.get(i).partial(direction);
                    this.column[0].set(i, slope);
                }
                this.move_to_chart(h);
                sparsity.expand(first + direction, &this.column[2], matrix);
            }
        });
        matrix.factorise();
        self.index = matrix.negative_pivots();
    }

    /// Calls `body` for each chunk of colours, with the columns of each moved along a direction of its own.
    fn for_each_colour(&mut self, sparsity: &Sparsity, mut body: impl FnMut(&mut Self, usize)) {
        for_each_chunk(sparsity.count, |first| {
            for (j, colour) in sparsity.colours.iter().enumerate() {
                self.c.set(j, seeded(0.0, *colour, first));
            }
            body(self, first);
        });
    }

    /// The signs of the inertia's pivots, and a coordinate that has none.
    fn find_inertia(
        &mut self,
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        sparsity: &Sparsity,
        matrix: &mut Sparse,
    ) {
        let [short, long] = VANISHING.map(|part| {
            let h = part * h.abs();
            matrix.clear();
            self.for_each_colour(sparsity, |this, first| {
                let balance = &mut this.balance;
                balance.retract(&this.c);
                let at = Context::new(J::constant(state.t), &balance.parameters);
                let (work, out) = (&mut balance.workspace, &mut balance.derivatives);
                out.settle(lagrangian);
                out.find(lagrangian, at, (&this.g, &balance.f), J::constant(h), work);
                for direction in 0..lie::JET_DIRECTIONS.min(sparsity.count - first) {
                    for i in 0..this.rhs.len() {
                        let slope = balance.derivatives.d_f.get(i).partial(direction);
                        this.column[2].set(i, h * slope);
                    }
                    sparsity.expand(first + direction, &this.column[2], matrix);
                }
            });
            matrix.factorise();
            (0..sparsity.rows.len())
                .map(|i| matrix.pivot(i))
                .collect::<Vec<_>>()
        });
        let pairs = short.iter().zip(&long);
        self.degenerate = pairs
            .clone()
            .position(|(short, long)| has_none(*short, *long));
        self.inertia = Some(short.iter().filter(|[pivot, _]| *pivot < 0.0).count());
    }

    /// A coordinate along which the kinetic energy was seen to have no inertia, if any.
    pub(super) fn degenerate(&self) -> Option<usize> {
        self.degenerate
    }

    /// The correction $\delta$ that the linearised residual asks for; `c - delta` is the next iterate.
    pub(crate) fn solve(&mut self, residual: &Dual<L>, delta: &mut Algebra<L>) {
        let mut factors = self.factors.take();
        match &mut factors {
            Some(Factors::Dense(dense)) => {
                residual.write(&mut self.rhs);
                dense.matrix.solve(&mut self.rhs, |entry| entry);
            }
            Some(Factors::Sparse(_, matrix)) => {
                self.column[0].copy_from(residual);
                L::Group::retract_into::<Cayley>(&self.place, &mut self.f);
                self.move_to_chart(self.h);
                self.column[2].write(&mut self.rhs);
                matrix.solve(&mut self.rhs);
            }
            None => self.rhs.fill(f64::NAN),
        }
        self.factors = factors;
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
        let Some(Factors::Dense(Dense {
            cyclic: Some(block),
            ..
        })) = &mut self.factors
        else {
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
}

impl Factors {
    fn new<L: DiscreteLagrangian>(
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        cache: &DiscreteCache<L::Group>,
    ) -> Self {
        if let Some((sparsity, matrix)) = Sparsity::of(lagrangian, (state, h), cache) {
            return Self::Sparse(sparsity, matrix);
        }
        let dim = state.mu.dim();
        let cyclic = cyclic(lagrangian, dim);
        Self::Dense(Dense {
            matrix: Lu::new(dim),
            in_chart: Lu::new(dim),
            cyclic: (!cyclic.is_empty()).then(|| Lu::new(cyclic.len())),
        })
    }
}

/// Whether a coordinate has no inertia, by its pivots, with what they have come from, at a short step and at a longer one.
fn has_none([pivot, entry]: [f64; 2], [longer, _]: [f64; 2]) -> bool {
    /// Roundings that elimination may leave in place of a zero.
    const ROUNDING: f64 = 64.0 * f64::EPSILON;
    /// Inertia is what stays as the step vanishes: a pivot that shrinks by more than this is none.
    const STAYS: f64 = 0.1;
    let stays = pivot.abs() > ROUNDING * entry.abs() && pivot.abs() > STAYS * longer.abs();
    !stays
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
    derivatives.settle(lagrangian);
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
        derivatives.find(lagrangian, at, (&g, &f), step, &mut work);
        set_columns(inertia.columns_mut(first), |row, direction| {
            h * derivatives.d_f.get(row).partial(direction)
        });
    });
    inertia
}
