//! Variational Gauss integrators of order $2 s$ on a Lie group.

mod abreast;
mod change;
mod ensemble;
mod extrapolation;
mod newton;
mod predictor;
mod progress;
mod solve;
mod solver;
mod stages;
mod stepper;
mod sweep;
mod tableau;
mod update;
mod work;

use lie::Retraction;
use lie::lanes::InstructionSet;

use crate::{
    ContinuousSystem, FirstVariation, Integrator, Path, State, StepError, StepReport, Variation,
};
pub use ensemble::Ensemble;
use solver::Solver;

/// A variational integrator of order $2 s$ by Gauss collocation with $s$ stages, from 1 to 8.
///
/// It is the extremum of the discrete Lagrangian
/// $L_d(g_k, f) = \operatorname{ext} h \sum_i b_i L(t_i, g_k \tau(c_i), \mathrm d\tau_{c_i} \dot c_i)$ over the rates $\dot c_i$ with
/// $c_i = h \sum_j a_{ij} \dot c_j$ and $f = \tau(h \sum_j b_j \dot c_j)$. So it is symplectic by construction, and keeps the momentum maps of the
/// symmetries that it inherits. These are translations of the group, and its automorphisms that the retraction commutes with, such as a turn of space on a
/// direct product. It is solved in the Hamiltonian form, with velocities $\xi_i$ and forces $\tau_i$ of the
/// [`ContinuousSystem`] at $(g_i, \mu_i)$:
///
/// $$ P = \mu_k + h \sum_i b_i \mathrm{Ad}^\ast_{f_i^{-1}} \tau_i, \qquad \mu_{k+1} = \mathrm{Ad}^\ast_f P, \qquad \pi_1 = (\mathrm d\tau_{c_1})^\ast \mu_{k+1}, $$
/// $$ \pi_i = \pi_1 - h \sum_j (b_j - a_{ij}) \dot\pi_j, \qquad \mu_i = (\mathrm d\tau_{c_i}^{-1})^\ast \pi_i, $$
/// $$ \dot c_i = \mathrm d\tau_{c_i}^{-1} \xi_i, \qquad \dot\pi_i = (\mathrm d\tau_{c_i})^\ast \tau_i - \partial_c \langle \pi_i, \mathrm d\tau_c^{-1} \xi_i \rangle. $$
///
/// The chart is centred anew at every $g_k$. Using $P$ instead of $\mu_k$ makes the step symplectic: it accounts for the chart's
/// base point moving with the state.
///
/// The stages of a sweep are evaluated side by side, in the widest SIMD [lanes](lie::lanes) that the processor has, where the system
/// [allows it](ContinuousSystem::INLINE) or is [recorded](ContinuousSystem::recorded). The integrator owns its system, which borrows nothing: clone it, or share it.
///
/// The stages are iterated to rounding, unless a [tolerance](Self::with_tolerance) is set: all of them in one sweep, starting from the velocities and forces of
/// the step before. A step too long for that is solved by Newton's method. Momenta are summed in the frame of the
/// identity with compensation (but where $x \times p$ outweighs the rest, far from the origin), and so are the numbers of the configuration. After the first step none allocates, but for the first that needs Newton's method.
///
/// ```
/// use dvi::{Context, Gauss, Integrator, Lagrangian, System};
/// use lie::{Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg on a spring of 1 N/m.
/// struct Spring;
///
/// impl System for Spring {
///     type Group = Rn<1>;
/// }
///
/// impl Lagrangian for Spring {
///     fn value<S: Scalar>(&self, _: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         (v[0] * v[0] - x.0[0] * x.0[0]) * S::from_f64(0.5)
///     }
/// }
///
/// let mut state = Spring.state(0.0, Rn([1.0]), &Tangent([0.0]))?;
/// let mut integrator = Gauss::new::<4>(Spring.hamiltonian());
/// assert_eq!(integrator.order(), 8);
/// for _ in 0..10 {
///     integrator.step(&mut state, 0.5)?;
/// }
/// assert!((state.g.0[0] - 5.0_f64.cos()).abs() < 1e-8);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct Gauss<C: ContinuousSystem> {
    system: C,
    solver: Solver<C>,
}

impl<C: ContinuousSystem + 'static> Gauss<C> {
    /// The integrator of `S` stages of a system, in the Cayley map's chart; for a Lagrangian, `Gauss::new::<4>(top.hamiltonian())`.
    ///
    /// Less than one stage, or more than eight, do not compile.
    pub fn new<const S: usize>(system: C) -> Self {
        const { assert!(S >= 1 && S <= 8, "Gauss has from 1 to 8 stages") };
        Self::of(system, S)
    }

    /// The integrator of so many stages, known at run time; none of less than one or more than eight.
    pub fn with_stages(system: C, stages: usize) -> Option<Self> {
        (1..=8).contains(&stages).then(|| Self::of(system, stages))
    }

    /// Of 1 to 8 stages.
    pub(crate) fn of(system: C, stages: usize) -> Self {
        let solver = Solver::new(stages);
        Self { system, solver }
    }

    /// The same in another retraction's chart: another method of the same order.
    pub fn with_retraction<R: Retraction>(mut self) -> Self {
        self.solver.set_retraction::<R>();
        self
    }

    /// The largest error of a solved step that is left by iterating, estimated and relative; zero, the default, iterates to rounding.
    ///
    /// Momentum maps of left translations, and of cyclic coordinates, do not feel it. Those of other symmetries and the energy do, where it
    /// is looser than the method's own error of a step.
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.solver.limits.tolerance = tolerance;
        self
    }

    /// The same without Newton's method: a step too long for the plain iteration is refused at once.
    pub fn by_sweeps_only(mut self) -> Self {
        self.solver.limits.sweeps_only = true;
        self
    }

    /// The same by other instructions than the widest that the processor has; where it lacks them, by the baseline.
    ///
    /// The steps differ by rounding alone.
    pub fn with_instructions(mut self, instructions: InstructionSet) -> Self {
        self.solver.set_instructions(instructions);
        self
    }

    /// The system.
    pub fn system(&self) -> &C {
        &self.system
    }
}

impl<C: ContinuousSystem + 'static> Integrator for Gauss<C> {
    type Group = C::Group;

    fn order(&self) -> u32 {
        2 * self.solver.stages() as u32
    }

    /// In general not: the chart is centred at the step's start, and the same step backwards is another of the same order.
    fn is_symmetric(&self) -> bool {
        false
    }

    fn is_symplectic(&self) -> bool {
        self.system.is_symplectic()
    }

    fn step(&mut self, state: &mut State<C::Group>, h: f64) -> Result<StepReport, StepError> {
        self.solver.step(&self.system, state, h)
    }

    fn peek(&mut self, state: &State<C::Group>, h: f64) -> Result<State<C::Group>, StepError> {
        self.solver.peek(&self.system, state, h)
    }

    fn step_along(
        &mut self,
        state: &mut State<C::Group>,
        h: f64,
        see: &mut dyn FnMut(Path<C::Group>),
    ) -> Result<StepReport, StepError> {
        let start = state.clone();
        let report = self.step(state, h)?;
        self.solver.show((&start, h), state, see);
        Ok(report)
    }

    fn peek_along(
        &mut self,
        state: &State<C::Group>,
        h: f64,
        see: &mut dyn FnMut(Path<C::Group>),
    ) -> Result<State<C::Group>, StepError> {
        let ahead = self.peek(state, h)?;
        self.solver.show((state, h), &ahead, see);
        Ok(ahead)
    }

    fn reset(&mut self) {
        self.solver.reset();
    }
}

impl<C: ContinuousSystem + 'static> FirstVariation for Gauss<C> {
    fn step_varied(
        &mut self,
        state: &mut State<C::Group>,
        variations: &mut [Variation<C::Group>],
        h: f64,
    ) -> Result<StepReport, StepError> {
        self.solver.step_varied(&self.system, state, variations, h)
    }
}
