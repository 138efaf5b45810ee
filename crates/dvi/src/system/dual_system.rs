//! Hamilton's equations of a Lagrangian by dual numbers and iteration.

use lie::{AlgebraOver, DualOver, Jet, LieGroup, Lu, Over, Scalar, VectorSpace};

use super::context::{Adapter, Context, System};
use super::continuous::{ContinuousSystem, Means};
use super::lagrangian::{Lagrangian, is_defined};
use super::lifted::Lifted;
use super::state::{State, Still};
use crate::numerics::degenerate::without_inertia;
use crate::numerics::duals::{add_constant, for_each_chunk, lift, read_partials, seeded};
use crate::numerics::numbers::{larger, relative};
use crate::numerics::sizes::Kinds;

/// Newton iterations before a momentum is taken to have no velocity.
const MAX_ITERATIONS: u32 = 50;
/// A residual of rounding, relative to the terms that it is the difference of.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// The shortest part of a correction that is tried.
const SHORTEST: f64 = 1e-6;
/// A correction this small, relative to the velocity, leaves an error of rounding: convergence is quadratic.
const CONVERGED: f64 = 1e-8;

/// The Hamiltonian system of a Lagrangian, $\mu = \mathbf D_\xi L$, by dual numbers.
///
/// The velocity comes from Newton's method on the Legendre transform, with the Hessian $\mathbf D_\xi^2 L$: exact after one
/// iteration where the kinetic energy is quadratic. Where the Hessian is singular, at the velocity or at zero, where the iteration
/// starts, or where there is no such velocity, the answer is not a number.
///
/// It asks nothing of the Lagrangian but its value. [`HamiltonianSystem`](crate::HamiltonianSystem), which is faster by far where the
/// value can be recorded, falls back on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DualSystem<L>(pub L);

/// Storage for the derivatives of a Lagrangian, made when first needed.
pub struct LegendreWorkspace<L: Lagrangian, S: Scalar>(Option<Inverse<L, S>>);

impl<L: Lagrangian, S: Scalar> Default for LegendreWorkspace<L, S> {
    fn default() -> Self {
        Self(None)
    }
}

impl<L: Lagrangian, S: Scalar> LegendreWorkspace<L, S> {
    fn for_shape_of(&mut self, g: &Over<L::Group, S>) -> &mut Inverse<L, S> {
        self.0.get_or_insert_with(|| Inverse::new(g))
    }
}

/// The inverse Legendre transform and the force.
struct Inverse<L: Lagrangian, S: Scalar> {
    lifted: Lifted<L::Group, S>,
    moved: AlgebraOver<L::Group, S::Jet>,
    rhs: Vec<S>,
    gradient: DualOver<L::Group, S>,
    newton: RealNewton<L, S::Real>,
}

impl<L: Lagrangian, S: Scalar> Inverse<L, S> {
    fn new(g: &Over<L::Group, S>) -> Self {
        let lifted = Lifted::new(g);
        Self {
            moved: lifted.zero_algebra(),
            rhs: vec![S::zero(); g.zero_dual().dim()],
            gradient: g.zero_dual(),
            newton: RealNewton::new(&L::Group::convert::<S, S::Real>(g, S::real)),
            lifted,
        }
    }

    /// Fills the gradient $\mathbf D_\xi L$.
    fn differentiate(&mut self, lagrangian: &L, xi: &AlgebraOver<L::Group, S>) {
        for_each_chunk(xi.dim(), |first| {
            lie::seed(&mut self.moved, first);
            add_constant(&mut self.moved, xi);
            let value = lagrangian.value(self.lifted.context(), self.lifted.g(), &self.moved);
            read_partials(&mut self.gradient, first, value);
        });
    }
}

/// The inverse Legendre transform without derivatives: Newton's method with the Hessian $\mathbf D_\xi^2 L$.
struct RealNewton<L: Lagrangian, S: Scalar> {
    g: Over<L::Group, S>,
    parameters: Vec<Twice<S>>,
    twice: Over<L::Group, Twice<S>>,
    moved: AlgebraOver<L::Group, Twice<S>>,
    gradient: DualOver<L::Group, S>,
    hessian: Lu<S>,
    xi: AlgebraOver<L::Group, S>,
    rhs: Vec<S>,
    /// The last correction of `xi`.
    delta: Vec<S>,
    kinds: Kinds,
    /// The largest residuals of each kind, and what they are relative to.
    sizes: Vec<f64>,
    scales: Vec<f64>,
    numbers: Vec<f64>,
}

/// Duals of duals: second derivatives.
type Twice<S> = <<S as Scalar>::Jet as Scalar>::Jet;

fn twice<S: Scalar>(x: S) -> Twice<S> {
    Twice::<S>::constant(Jet::constant(x))
}

impl<L: Lagrangian, S: Scalar<Real = S>> RealNewton<L, S> {
    fn new(g: &Over<L::Group, S>) -> Self {
        let lifted = L::Group::convert::<S, Twice<S>>(g, twice);
        let (dim, kinds) = (g.zero_dual().dim(), Kinds::of(g));
        Self {
            sizes: vec![0.0; kinds.count],
            scales: vec![0.0; kinds.count],
            numbers: vec![0.0; dim],
            kinds,
            moved: lifted.zero_algebra(),
            parameters: Vec::new(),
            twice: lifted,
            gradient: g.zero_dual(),
            hessian: Lu::new(dim),
            xi: g.zero_algebra(),
            rhs: vec![S::zero(); dim],
            delta: vec![S::zero(); dim],
            g: g.clone(),
        }
    }

    /// Fills `xi` and factorises the Hessian near it; false where the iteration does not converge.
    ///
    /// A correction that makes the residual larger, or leaves the domain of $L$, is halved.
    fn invert(&mut self, lagrangian: &L, t: S, mu: impl Fn(usize) -> S) -> bool {
        L::Group::convert_into::<S, Twice<S>>(&self.g, twice, &mut self.twice);
        self.xi.set_zero();
        let (mut last, mut part) = (f64::INFINITY, 1.0);
        for iteration in 0..MAX_ITERATIONS {
            self.differentiate(lagrangian, t);
            for (i, entry) in self.rhs.iter_mut().enumerate() {
                *entry = mu(i) - self.gradient.get(i);
            }
            if iteration == 0 {
                // Not those at later iterates: where these go astray, any residual is small beside them.
                self.set_scales(&mu);
            }
            let residual = self.relative_residual();
            let rounded = self.is_rounding(&mu);
            if residual.is_nan() && last.is_infinite() {
                return false;
            }
            if part > SHORTEST && (residual.is_nan() || residual > 2.0 * last) {
                part *= 0.5;
                self.correct(-part);
                continue;
            }
            self.hessian.factorise_form();
            self.hessian.solve(&mut self.rhs, |entry| entry);
            self.delta.copy_from_slice(&self.rhs);
            self.correct(1.0);
            (last, part) = (residual, 1.0);
            if rounded || self.is_converged() {
                return self.delta.iter().all(|d| !d.magnitude().is_nan());
            }
        }
        false
    }

    /// Takes the momentum, or the gradient where the iteration starts, for the scale of each kind; of a kind without either, those of all.
    fn set_scales(&mut self, mu: &impl Fn(usize) -> S) {
        self.scales.fill(0.0);
        for (i, number) in self.numbers.iter_mut().enumerate() {
            *number = larger(mu(i).magnitude(), self.gradient.get(i).magnitude());
        }
        self.kinds.raise(&mut self.scales, &self.numbers);
        let largest = self.scales.iter().copied().fold(0.0, larger);
        for scale in &mut self.scales {
            *scale = if *scale == 0.0 { largest } else { *scale };
        }
    }

    /// The residual relative to the scales, in the kind where that is largest.
    fn relative_residual(&mut self) -> f64 {
        let rhs = self.rhs.iter().map(|x| x.magnitude());
        self.numbers.iter_mut().zip(rhs).for_each(|(n, x)| *n = x);
        self.sizes.fill(0.0);
        self.kinds.raise(&mut self.sizes, &self.numbers);
        let kinds = self.sizes.iter().zip(&self.scales);
        kinds.fold(0.0, |max, (size, scale)| {
            larger(max, relative(*size, *scale))
        })
    }

    /// Whether each residual is rounding of the terms that it is the difference of.
    fn is_rounding(&self, mu: &impl Fn(usize) -> S) -> bool {
        (0..self.rhs.len()).all(|i| {
            let term = |j: usize| (self.hessian.at(i, j) * self.xi.get(j)).magnitude();
            let terms = (0..self.rhs.len()).map(term);
            let size = mu(i).magnitude() + self.gradient.get(i).magnitude() + terms.sum::<f64>();
            self.rhs[i].magnitude() <= ROUNDING * size
        })
    }

    /// Whether the last correction is small beside the velocity, in each kind.
    fn is_converged(&self) -> bool {
        self.kinds.runs.iter().all(|(run, _)| {
            let largest = |x: &dyn Fn(usize) -> S| {
                run.clone()
                    .fold(0.0, |max, i| larger(max, x(i).magnitude()))
            };
            let correction = largest(&|i| self.delta[i]);
            correction <= CONVERGED * largest(&|i| self.xi.get(i))
        })
    }

    /// Moves the iterate by a part of the correction.
    fn correct(&mut self, part: f64) {
        for (i, delta) in self.delta.iter().enumerate() {
            self.xi.set(i, self.xi.get(i) + delta.times(part));
        }
    }

    /// Fills the gradient and the Hessian at `xi`.
    fn differentiate(&mut self, lagrangian: &L, t: S) {
        let (at, dim) = (Context::new(twice(t), &self.parameters), self.xi.dim());
        for_each_chunk(dim, |column| {
            for_each_chunk(dim, |row| {
                for i in 0..dim {
                    let inner = seeded::<S::Jet>(self.xi.get(i), i, row);
                    self.moved.set(i, seeded::<Twice<S>>(inner, i, column));
                }
                let value = lagrangian.value(at, &self.twice, &self.moved);
                read_partials(&mut self.gradient, row, value.value());
                let end = |first: usize| dim.min(first + lie::JET_DIRECTIONS);
                for j in column..end(column) {
                    let slope = value.partial(j - column);
                    for i in row..end(row) {
                        self.hessian.column_mut(j)[i] = slope.partial(i - row);
                    }
                }
            });
        });
    }
}

impl<L: Lagrangian> DualSystem<L> {
    /// The velocity of a state; not a number where there is none.
    pub fn velocity(&self, state: &State<L::Group>) -> <L::Group as LieGroup>::Algebra {
        let mut inverse = Inverse::new(&state.g);
        let mut xi = state.g.zero_algebra();
        let at = Context::new(state.t, self.0.parameters());
        invert(&self.0, (at, &state.g, &state.mu), &mut inverse, &mut xi);
        xi
    }

    /// The energy of a state, in joules; not a number where there is no velocity.
    pub fn energy(&self, state: &State<L::Group>) -> f64 {
        let xi = self.velocity(state);
        let energy = self.0.energy(state.t, &state.g, &xi);
        // A velocity that was found has the shape of its configuration.
        energy.unwrap_or(f64::NAN)
    }
}

/// The inverse Legendre transform; the derivatives that a dual number carries follow with the Hessian kept, a level each time.
fn invert<L: Lagrangian, S: Scalar>(
    lagrangian: &L,
    (at, g, mu): At<L, S>,
    work: &mut Inverse<L, S>,
    xi: &mut AlgebraOver<L::Group, S>,
) {
    work.lifted.set_g(at, g);
    L::Group::convert_into::<S, S::Real>(g, S::real, &mut work.newton.g);
    lift(at.all, |p: S| twice(p.real()), &mut work.newton.parameters);
    let newton = &mut work.newton;
    let solved = newton.invert(lagrangian, at.t.real(), |i| mu.get(i).real());
    for i in 0..xi.dim() {
        let real = S::from_real(work.newton.xi.get(i));
        xi.set(i, if solved { real } else { S::from_f64(f64::NAN) });
    }
    // One more than the levels: the Hessian is that of the last iterate but one.
    let levels = match S::DUAL_LEVELS {
        0 => 0,
        levels => levels + 1,
    };
    for _ in 0..levels {
        work.differentiate(lagrangian, xi);
        for (i, entry) in work.rhs.iter_mut().enumerate() {
            *entry = mu.get(i) - work.gradient.get(i);
        }
        work.newton.hessian.solve(&mut work.rhs, S::from_real);
        for (i, delta) in work.rhs.iter().enumerate() {
            xi.set(i, xi.get(i) + *delta);
        }
    }
}

/// When, where, and with which momentum.
type At<'a, L, S> = (
    Context<'a, S>,
    &'a Over<<L as System>::Group, S>,
    &'a DualOver<<L as System>::Group, S>,
);

/// Where a velocity and a force go.
type Rates<'a, L, S> = (
    &'a mut AlgebraOver<<L as System>::Group, S>,
    &'a mut DualOver<<L as System>::Group, S>,
);

/// The velocity and the force of a Lagrangian.
pub(super) fn velocity_and_force<L: Lagrangian, S: Scalar>(
    lagrangian: &L,
    (at, g, mu): At<L, S>,
    work: &mut LegendreWorkspace<L, S>,
    (xi, tau): Rates<L, S>,
) {
    let work = work.for_shape_of(g);
    invert(lagrangian, (at, g, mu), work, xi);
    work.moved.set_zero();
    add_constant(&mut work.moved, xi);
    for_each_chunk(tau.dim(), |first| {
        let (at, (g, _), _) = work.lifted.moving_g(first);
        read_partials(tau, first, lagrangian.value(at, g, &work.moved));
    });
}

impl<L: System> Adapter for DualSystem<L> {
    type Inner = L;

    fn inner(&self) -> &L {
        &self.0
    }
}

impl<L: Lagrangian> ContinuousSystem for DualSystem<L> {
    type Workspace<S: Scalar> = LegendreWorkspace<L, S>;

    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Over<L::Group, S>,
        mu: &DualOver<L::Group, S>,
        work: &mut LegendreWorkspace<L, S>,
        xi: &mut AlgebraOver<L::Group, S>,
        tau: &mut DualOver<L::Group, S>,
    ) {
        velocity_and_force(&self.0, (at, g, mu), work, (xi, tau));
    }

    fn is_defined(&self, t: f64, g: &L::Group) -> bool {
        is_defined(&self.0, t, g, &Still::at(g))
    }

    fn means(&self, _: f64, _: &L::Group) -> Means {
        Means::DualNumbers { why: None }
    }

    fn without_inertia(&self, t: f64, g: &L::Group) -> Option<usize> {
        let mut newton = RealNewton::<L, f64>::new(g);
        L::Group::convert_into::<f64, Twice<f64>>(g, twice, &mut newton.twice);
        lift(self.0.parameters(), twice, &mut newton.parameters);
        newton.differentiate(&self.0, t);
        without_inertia(&newton.hessian, &newton.hessian)
    }
}
