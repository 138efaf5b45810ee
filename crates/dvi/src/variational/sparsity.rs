//! Which equations of a step depend on which unknowns.

use lie::{Cayley, LieGroup, Over, VectorSpace};
use trace::{Graph, TraceError, Traced, record};

use super::balance::Balance;
use crate::numerics::elements;
use crate::numerics::sparse::Sparse;
use crate::system::DiscreteCache;
use crate::{Derivatives, DiscreteLagrangian, Means, State};

/// The pattern of Newton's matrix, and a partition of its columns: no two of one colour share a row.
pub(super) struct Sparsity {
    /// The columns of each row.
    pub(super) rows: Vec<Vec<usize>>,
    /// The colour of each column.
    pub(super) colours: Vec<usize>,
    pub(super) count: usize,
}

/// Fewer unknowns than these are solved as fast by a dense matrix.
const FEW: usize = 24;
/// How many times fewer products than a dense factorisation a sparse one has to take.
const GAIN: usize = 4;

impl Sparsity {
    /// That of the balance of a step in the chart, with the matrix for it.
    ///
    /// None where a dense matrix serves as well, or where the balance cannot be recorded.
    pub(super) fn of<L: DiscreteLagrangian>(
        lagrangian: &L,
        (state, h): (&State<L::Group>, f64),
        cache: &DiscreteCache<L::Group>,
    ) -> Option<(Self, Sparse)> {
        let dim = state.mu.dim();
        if dim < FEW || !lagrangian.cyclic().is_empty() || by_duals(lagrangian, (state, h), cache) {
            return None;
        }
        let graph = recorded(lagrangian, &state.g, cache).ok()?;
        let pattern = graph.pattern(graph.outputs(), &graph.inputs()[..dim]);
        let rows: Vec<Vec<usize>> = (0..dim).map(|i| pattern.row(i).to_vec()).collect();
        let matrix = Sparse::new(&rows);
        let (colours, count) = colours(&rows);
        let dense = dim.pow(3) / 3;
        let gains = count < dim && GAIN * matrix.operations() < dense;
        gains.then_some((
            Self {
                rows,
                colours,
                count,
            },
            matrix,
        ))
    }
}

impl Sparsity {
    /// Puts a column into a matrix that is the sum of those of one colour.
    pub(super) fn expand<V: VectorSpace<Scalar = f64>>(
        &self,
        colour: usize,
        sum: &V,
        matrix: &mut Sparse,
    ) {
        for (i, row) in self.rows.iter().enumerate() {
            if let Some(j) = row.iter().find(|j| self.colours[**j] == colour) {
                matrix.set(i, *j, sum.get(i));
            }
        }
    }
}

/// Whether the derivatives come from dual numbers: these would be recorded at length.
fn by_duals<L: DiscreteLagrangian>(
    lagrangian: &L,
    (state, h): (&State<L::Group>, f64),
    cache: &DiscreteCache<L::Group>,
) -> bool {
    let mut derivatives = Derivatives::with_cache(&state.g, cache.clone());
    derivatives.settle(lagrangian);
    let (at, still) = (
        crate::Context::new(state.t, lagrangian.parameters()),
        state.g.identity_like(),
    );
    let mut work = Default::default();
    derivatives.find(lagrangian, at, (&state.g, &still), h, &mut work);
    matches!(derivatives.means, Means::DualNumbers { .. })
}

/// The residual in the chart by its coordinates $c$, and by the numbers of the state, time, step size and parameters.
fn recorded<L: DiscreteLagrangian>(
    lagrangian: &L,
    g: &L::Group,
    cache: &DiscreteCache<L::Group>,
) -> Result<Graph, TraceError> {
    let (dim, numbers) = (g.zero_dual().dim(), elements::count(g));
    let parameters = lagrangian.parameters().len();
    record(2 * dim + numbers + 2 + parameters, |x| {
        let (of_c, rest) = x.split_at(dim);
        let (of_mu, rest) = rest.split_at(dim);
        let (of_g, rest) = rest.split_at(numbers);
        let g = elements::with_numbers(g, of_g);
        let (mut c, mut mu, mut end) = (g.zero_algebra(), g.zero_dual(), g.zero_dual());
        c.read(of_c);
        mu.read(of_mu);
        let mut balance = Balance::<L, Traced>::new(&g, cache.clone());
        balance.parameters = rest[2..].to_vec();
        balance.retract(&c);
        balance.evaluate(lagrangian, rest[0], &g, &mu, rest[1]);
        let (mut f, mut out) = (balance.f.clone(), g.zero_dual());
        f.inverse_coadjoint_into(&balance.residual, &mut mu);
        let places = (&mut f, &mut end, &mut out);
        Over::<L::Group, Traced>::chart_leave_into::<Cayley>(&c, &mu, places);
        out.coordinates()
    })
}

/// A colour for each column, the first that no column has which shares a row (A. R. Curtis, M. J. D. Powell, J. K. Reid, 1974).
fn colours(rows: &[Vec<usize>]) -> (Vec<usize>, usize) {
    let mut of_column = vec![Vec::new(); rows.len()];
    for (i, row) in rows.iter().enumerate() {
        row.iter().for_each(|j| of_column[*j].push(i));
    }
    let mut colours: Vec<usize> = Vec::with_capacity(rows.len());
    let mut seen_at = Vec::new();
    for (j, of_column) in of_column.iter().enumerate() {
        for k in of_column.iter().flat_map(|i| &rows[*i]) {
            if let Some(colour) = colours.get(*k) {
                seen_at[*colour] = j + 1;
            }
        }
        let free = seen_at.iter().position(|seen| *seen != j + 1);
        let colour = free.unwrap_or_else(|| {
            seen_at.push(0);
            seen_at.len() - 1
        });
        colours.push(colour);
    }
    (colours, seen_at.len())
}
