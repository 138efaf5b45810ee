//! Steady swimming: the relative periodic orbit of a period map, and whether it attracts.
//!
//! After a period a steady swimmer is as it was, but elsewhere: $\phi_T(s) = h \cdot s$ with $h$ in SE(3). States count without the place and
//! the attitude of the first body. On those, Newton's method solves $P(z) = z$, with the exact derivative of the steps.

use articulated_fluid::Configuration;
use dvi::{FirstVariation, Gauss, State, Variation};
use faer::linalg::solvers::{Solve, SolveLstsq};
use faer::{Mat, MatRef};
use lie::{LieGroup, SE3, SO3, Tangent, Vec3, VectorSpace};

use crate::error::GaitError;
use crate::steered::SteeredTree;

/// Newton's iterations, at most.
const MOST: u32 = 30;
/// The stages of the steps.
const STAGES: usize = 4;
/// The residual of an orbit, in rad, and relative to the [scales](Scales) of the momenta.
const SOLVED: f64 = 1e-10;
/// A correction beyond this leads away.
const WILD: f64 = 10.0;

/// The period that is stepped: from when on, how long, s, and by how many steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Period {
    pub(crate) from: f64,
    pub(crate) length: f64,
    pub(crate) steps: u32,
}

/// What a swimmer's motion is compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scales {
    /// m.
    pub(crate) length: f64,
    /// Momentum of the whole at a length in a radian's part of the period, kg m/s.
    pub(crate) linear: f64,
    /// Angular momentum likewise, kg m²/s.
    pub(crate) angular: f64,
    /// Whether the momentum is kept: then the stroke is sought that has none.
    pub(crate) is_kept: bool,
}

/// A steady stroke.
#[derive(Clone, Debug)]
pub struct Steady {
    /// The state at the start of the period, the first body at the origin in the attitude of the reference frame.
    pub state: State<Configuration>,
    /// The net motion of the period.
    pub net: SE3,
    /// The Floquet multipliers of the orbit, real and imaginary parts, the largest first: how a small disturbance is after a period. Those of a
    /// momentum that is kept are one, and left out.
    pub multipliers: Vec<[f64; 2]>,
    /// $h^{-1} \partial h$ by each parameter of the system.
    pub(crate) slopes: Vec<Tangent<6>>,
}

impl Steady {
    /// The size of the largest multiplier.
    pub fn largest_multiplier(&self) -> f64 {
        self.multipliers
            .first()
            .map_or(0.0, |[re, im]| re.hypot(*im))
    }

    /// Whether small disturbances die out.
    pub fn is_stable(&self) -> bool {
        self.largest_multiplier() < 1.0
    }
}

/// What a period does to a state whose first body starts at the origin: where it is then, and all by the reduced variables and the parameters.
struct Return {
    state: State<Configuration>,
    net: SE3,
    columns: Vec<Variation<Configuration>>,
    /// $h^{-1} \partial h$ of each column.
    moves: Vec<Tangent<6>>,
}

/// The reduced variables among the coordinates of a variation: all but the place and the attitude of the first body.
fn reduced(g: &Configuration) -> Vec<usize> {
    let (turns, dim) = (3 * g.0.len(), g.zero_dual().dim());
    let is_free = |i: &usize| *i >= 3 && !(turns..turns + 3).contains(i);
    (0..2 * dim).filter(is_free).collect()
}

fn coordinate(variation: &Variation<Configuration>, i: usize) -> f64 {
    match i.checked_sub(variation.eta.dim()) {
        None => variation.eta.get(i),
        Some(i) => variation.mu.get(i),
    }
}

/// Where the first body is.
pub(crate) fn place(state: &State<Configuration>) -> SE3 {
    SE3::new(state.g.0[0], state.g.1[0].vec3())
}

/// Brings the first body back to the origin and the attitude of the reference frame, and tells from where.
fn bring_back(
    state: &mut State<Configuration>,
    columns: &mut [Variation<Configuration>],
) -> (SE3, Vec<Tangent<6>>) {
    let net = place(state);
    let turned = |x: Vec3| net.rotation.inverse_rotate(x);
    let back = net.rotation.inverse();
    for r in state.g.0.iter_mut() {
        *r = back.compose(r);
    }
    state.g.0[0] = SO3::identity();
    state.g.1[0] = Vec3::zero().into();
    state.mu.1[0] = turned(state.mu.1[0].vec3()).into();
    let px = state.mu.1[0].vec3();
    let moves = columns.iter_mut().map(|column| {
        let (w, v) = (column.eta.0[0].vec3(), turned(column.eta.1[0].vec3()));
        for (eta, r) in column.eta.0.iter_mut().zip(state.g.0.iter()) {
            *eta = (eta.vec3() - r.inverse_rotate(w)).into();
        }
        column.eta.1[0] = Vec3::zero().into();
        let change = turned(column.mu.1[0].vec3()) - w.cross(px);
        column.mu.1[0] = change.into();
        (w, v).into()
    });
    (net, moves.collect())
}

/// How far two states are apart in the reduced variables, the first one's chart.
fn apart(a: &State<Configuration>, b: &State<Configuration>) -> Variation<Configuration> {
    let mut apart = Variation::zero(&a.g);
    let chart = a.g.inverse().compose(&b.g);
    apart.eta = chart.log().unwrap_or_else(|e| e.representative);
    apart.mu = b.mu.clone();
    apart.mu.add_scaled(-1.0, &a.mu);
    apart
}

fn after_period(
    gauss: &mut Gauss<SteeredTree>,
    start: &State<Configuration>,
    period: Period,
) -> Result<Return, GaitError> {
    let mut state = start.clone();
    let unit = Variation::basis(&state.g);
    let mut columns: Vec<_> = reduced(&state.g)
        .into_iter()
        .map(|i| unit[i].clone())
        .collect();
    columns.extend(Variation::parameters(gauss.system(), &state.g));
    let h = period.length / f64::from(period.steps);
    for k in 0..period.steps {
        state.t = period.from + f64::from(k) * h;
        gauss
            .step_varied(&mut state, &mut columns, h)
            .map_err(GaitError::Step)?;
    }
    state.t = period.from;
    let (net, moves) = bring_back(&mut state, &mut columns);
    Ok(Return {
        state,
        net,
        columns,
        moves,
    })
}

/// The steady stroke near a start.
///
/// # Errors
/// [`GaitError::Step`], [`GaitError::NotSteady`] where there is none near.
pub(crate) fn steady(
    system: SteeredTree,
    start: &State<Configuration>,
    (period, scales): (Period, Scales),
) -> Result<Steady, GaitError> {
    let gauss = &mut Gauss::with_stages(system, STAGES).ok_or(GaitError::Rigid)?;
    let mut state = start.clone();
    state.t = period.from;
    bring_back(&mut state, &mut []);
    let variables = reduced(&state.g);
    let mut residual = f64::INFINITY;
    for k in 0..MOST {
        let back = match after_period(gauss, &state, period) {
            // A correction led where no step is solved.
            Err(GaitError::Step(_)) if k > 0 => break,
            back => back?,
        };
        let map = matrix(&variables, &back);
        let off = apart(&state, &back.state);
        residual = size(&off, &scales);
        if residual < SOLVED {
            return finish(state, back, map.as_ref(), &scales);
        }
        let n = variables.len();
        let right = Mat::from_fn(n, 1, |i, _| coordinate(&off, variables[i]));
        let change = solve(&state, map.as_ref(), right.as_ref(), &scales);
        let mut step = Variation::zero(&state.g);
        let dim = step.eta.dim();
        for (k, i) in variables.iter().enumerate() {
            match i.checked_sub(dim) {
                None => step.eta.set(*i, change[(k, 0)]),
                Some(i) => step.mu.set(i, change[(k, 0)]),
            }
        }
        let far = size(&step, &scales);
        if far.is_nan() || far > WILD {
            break;
        }
        state.g = state.g.compose(&Configuration::exp(&step.eta));
        state.mu.add_scaled(1.0, &step.mu);
    }
    Err(GaitError::NotSteady { residual })
}

/// The largest change of an angle, rad, or of a momentum on its scale.
fn size(change: &Variation<Configuration>, scales: &Scales) -> f64 {
    let linear = change.mu.1.iter().map(|p| p.vec3().norm() / scales.linear);
    let spins = change.mu.0.iter().map(|p| p.vec3().norm());
    let hinges = change.mu.2.iter().map(|p| p[0].abs());
    let angular = spins.chain(hinges).map(|p| p / scales.angular);
    let all = linear.chain(angular).chain([change.eta.max_magnitude()]);
    // What is not a number stays one.
    all.fold(0.0, |m: f64, x| if m.is_nan() || x <= m { m } else { x })
}

/// Solves $(1 - P_z) x = b$. A momentum that is kept stays what it is, by six further rows: then $1 - P_z$ alone is singular.
fn solve(
    state: &State<Configuration>,
    map: MatRef<'_, f64>,
    right: MatRef<'_, f64>,
    scales: &Scales,
) -> Mat<f64> {
    let n = map.nrows();
    let left = Mat::<f64>::identity(n, n) - map.subcols(0, n);
    if !scales.is_kept {
        return left.partial_piv_lu().solve(right);
    }
    let rows = momentum_rows(state);
    let all = Mat::from_fn(n + 6, n, |i, k| match i.checked_sub(n) {
        None => left[(i, k)],
        Some(i) => rows[i][k],
    });
    let wanted = Mat::from_fn(n + 6, right.ncols(), |i, k| {
        if i < n { right[(i, k)] } else { 0.0 }
    });
    all.col_piv_qr().solve_lstsq(wanted)
}

/// How the momenta of the whole, $p_x$ and $\sum R_i p_i$, change with the reduced variables, at the origin.
fn momentum_rows(state: &State<Configuration>) -> [Vec<f64>; 6] {
    let unit = Variation::basis(&state.g);
    let columns = reduced(&state.g).into_iter().map(|i| {
        let change = &unit[i];
        let roots = state.g.0.iter().zip(state.mu.0.iter());
        let roots = roots.zip(change.eta.0.iter().zip(change.mu.0.iter()));
        let spin = roots.fold(Vec3::zero(), |sum, ((r, p), (eta, by))| {
            sum + r.rotate(by.vec3() + eta.vec3().cross(p.vec3()))
        });
        [change.mu.1[0].vec3().0, spin.0].concat()
    });
    let columns: Vec<Vec<f64>> = columns.collect();
    [0, 1, 2, 3, 4, 5].map(|row| columns.iter().map(|column| column[row]).collect())
}

/// The derivative of the reduced state by the reduced variables, and then by the parameters.
fn matrix(variables: &[usize], back: &Return) -> Mat<f64> {
    Mat::from_fn(variables.len(), back.columns.len(), |i, k| {
        coordinate(&back.columns[k], variables[i])
    })
}

/// Multipliers, and how the net motion changes with the parameters: $(1 - P_z) z_p = P_p$.
fn finish(
    state: State<Configuration>,
    back: Return,
    map: MatRef<'_, f64>,
    scales: &Scales,
) -> Result<Steady, GaitError> {
    let n = map.nrows();
    let found = map.subcols(0, n).eigenvalues().map_err(|_| {
        let quantity = "derivative";
        GaitError::NotFinite { quantity }
    })?;
    let mut multipliers: Vec<[f64; 2]> = found.iter().map(|value| [value.re, value.im]).collect();
    if scales.is_kept {
        // Those of the momentum, which are one.
        multipliers.sort_by(|a, b| {
            (a[0] - 1.0)
                .hypot(a[1])
                .total_cmp(&(b[0] - 1.0).hypot(b[1]))
        });
        multipliers.drain(..multipliers.len().min(6));
    }
    let size = |value: &[f64; 2]| value[0].hypot(value[1]);
    multipliers.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let by_parameters = map.subcols(n, map.ncols() - n);
    let moved = solve(&state, map, by_parameters, scales);
    let slope = |p: usize| {
        let through = back.moves[..n].iter().enumerate();
        through.fold(back.moves[n + p], |sum, (i, by)| sum + *by * moved[(i, p)])
    };
    Ok(Steady {
        slopes: (0..map.ncols() - n).map(slope).collect(),
        state,
        net: back.net,
        multipliers,
    })
}
