//! Variational Gauss integrators of order `2 S` on a Lie group.

mod extrapolation;
mod newton;
mod predictor;
mod solve;
mod stages;
mod sweep;
mod tableau;
mod update;
mod work;

use core::marker::PhantomData;

use lie::lanes::InstructionSet;
use lie::{Cayley, LieGroup, Retraction, VectorSpace};

use crate::{
    ContinuousSystem, FirstVariation, Integrator, State, StepError, StepReport, Variation,
};
use solve::{Failure, Limits};
use tableau::Tableau;
use work::{Stepper, stepper};

/// A variational integrator of order `2 S` by Gauss collocation with `S` stages, `S` from 1 to 8.
///
/// It is the extremum of the discrete Lagrangian
/// $L_d(g_k, f) = \operatorname{ext} h \sum_i b_i L(t_i, g_k \tau(c_i), \mathrm d\tau_{c_i} \dot c_i)$ over the rates $\dot c_i$ with
/// $c_i = h \sum_j a_{ij} \dot c_j$ and $f = \tau(h \sum_j b_j \dot c_j)$: symplectic by construction, and with the momentum maps of the
/// symmetries that it inherits: translations of the group, and its automorphisms that the retraction commutes with, such as a turn of space on a direct product. In the Hamiltonian form that it is solved in, with velocities $\xi_i$ and forces $\tau_i$ of the
/// [`ContinuousSystem`] at $(g_i, \mu_i)$:
///
/// $$ P = \mu_k + h \sum_i b_i \mathrm{Ad}^\ast_{f_i^{-1}} \tau_i, \qquad \mu_{k+1} = \mathrm{Ad}^\ast_f P, \qquad \pi_1 = (\mathrm d\tau_{c_1})^\ast \mu_{k+1}, $$
/// $$ \pi_i = \pi_1 - h \sum_j (b_j - a_{ij}) \dot\pi_j, \qquad \mu_i = (\mathrm d\tau_{c_i}^{-1})^\ast \pi_i, $$
/// $$ \dot c_i = \mathrm d\tau_{c_i}^{-1} \xi_i, \qquad \dot\pi_i = (\mathrm d\tau_{c_i})^\ast \tau_i - \partial_c \langle \pi_i, \mathrm d\tau_c^{-1} \xi_i \rangle. $$
///
/// The chart is centred anew at every $g_k$. That $P$, and not $\mu_k$, goes with it is what keeps the symplectic form: the
/// base point moves with the state, and its derivative is part of the balance.
///
/// The stages of a sweep are evaluated side by side, in the widest SIMD [lanes](lie::lanes) that the processor has, where the system
/// [allows it](ContinuousSystem::INLINE). The integrator owns its system, which borrows nothing: clone it, or share it.
///
/// The stages are iterated to rounding, unless a [tolerance](Self::with_tolerance) is set: all of them in one sweep, starting from the velocities and forces of
/// the step before. A step too long for that is solved by Newton's method. Momenta are summed in the frame of the
/// identity with compensation (but where $x \times p$ outweighs the rest, far from the origin), and so are the numbers of the configuration. After the first step none allocates, but for the first that needs Newton's method.
///
/// ```
/// use dvi::{Gauss, Integrator, Lagrangian};
/// use lie::{Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg on a spring of 1 N/m.
/// struct Spring;
///
/// impl Lagrangian for Spring {
///     type Group = Rn<1>;
///     fn value<S: Scalar>(&self, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         (v[0] * v[0] - x.0[0] * x.0[0]) * S::from_f64(0.5)
///     }
/// }
///
/// let mut state = Spring.state(0.0, Rn([1.0]), &Tangent([0.0]))?;
/// let mut integrator = Gauss::<_, 4>::new(Spring.hamiltonian());
/// assert_eq!(integrator.order(), 8);
/// for _ in 0..10 {
///     integrator.step(&mut state, 0.5)?;
/// }
/// assert!((state.g.0[0] - 5.0_f64.cos()).abs() < 1e-8);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct Gauss<C: ContinuousSystem, const S: usize, R = Cayley> {
    system: C,
    tableau: &'static Tableau,
    limits: Limits,
    instructions: InstructionSet,
    steps: u64,
    work: Option<Box<dyn Stepper<C>>>,
    retraction: PhantomData<R>,
}

impl<C: ContinuousSystem + 'static, const S: usize> Gauss<C, S> {
    /// The integrator of a system, in the Cayley map's chart; for a Lagrangian, `Gauss::<_, 4>::new(top.hamiltonian())`.
    pub fn new(system: C) -> Self {
        const { assert!(S >= 1 && S <= 8, "Gauss has from 1 to 8 stages") };
        Self {
            system,
            tableau: Tableau::gauss(S),
            limits: Limits {
                tolerance: 0.0,
                sweeps_only: false,
            },
            instructions: InstructionSet::widest(S),
            steps: 0,
            work: None,
            retraction: PhantomData,
        }
    }
}

impl<C: ContinuousSystem + 'static, const S: usize, R: Retraction> Gauss<C, S, R> {
    /// The same in another retraction's chart: another method of the same order.
    pub fn with_retraction<Q: Retraction>(self) -> Gauss<C, S, Q> {
        Gauss {
            system: self.system,
            tableau: self.tableau,
            limits: self.limits,
            instructions: self.instructions,
            steps: self.steps,
            work: None,
            retraction: PhantomData,
        }
    }

    /// The largest error of a solved step that is left by iterating, estimated and relative; zero, the default, iterates to rounding.
    ///
    /// Momentum maps of left translations, and of cyclic coordinates, do not feel it; those of other symmetries and the energy do, where it
    /// is looser than the method's own error of a step.
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.limits.tolerance = tolerance;
        self
    }

    /// The same without Newton's method: a step too long for the plain iteration is refused at once.
    pub(crate) fn by_sweeps_only(mut self) -> Self {
        self.limits.sweeps_only = true;
        self
    }

    /// The same by other instructions than the widest that the processor has; where it lacks them, by the baseline.
    ///
    /// The steps differ by rounding alone.
    pub fn with_instructions(mut self, instructions: InstructionSet) -> Self {
        self.instructions = instructions;
        self.work = None;
        self
    }

    /// The system.
    pub fn system(&self) -> &C {
        &self.system
    }

    fn check(&self, state: &State<C::Group>, h: f64) -> Result<(), StepError> {
        let (step, t) = (self.steps, state.t);
        if !(h.is_finite() && h != 0.0) {
            return Err(StepError::InvalidStep { step, t, h });
        }
        if !self.system.fits(&state.g) {
            return Err(StepError::Misfit { step, t });
        }
        let finite = t.is_finite() && state.g.is_finite() && state.mu.max_magnitude().is_finite();
        finite
            .then_some(())
            .ok_or(StepError::NotFinite { step, t, h })
    }

    /// Solves the stages of a step; the state stays as it is.
    fn solve(
        &mut self,
        state: &State<C::Group>,
        h: f64,
    ) -> Result<(StepReport, &mut dyn Stepper<C>), StepError> {
        self.check(state, h)?;
        let (system, tableau) = (&self.system, self.tableau);
        let (step, t) = (self.steps, state.t);
        let work = match self.work.take() {
            Some(work) if work.fits(&state.g) => work,
            _ => match system.without_inertia(t, &state.g) {
                Some(coordinate) => {
                    return Err(StepError::Degenerate {
                        step,
                        t,
                        coordinate,
                    });
                }
                None => stepper::<C, R>(self.instructions, system, tableau, &state.g),
            },
        };
        let work = self.work.insert(work);
        if !work.shape().same_shape(&state.mu) {
            let (expected, found) = (work.shape().dim(), state.mu.dim());
            return Err(StepError::Shape {
                step,
                t,
                expected,
                found,
            });
        }
        let solved = work.solve((system, tableau), (state, h), self.limits);
        let report = solved.map_err(|failure| match failure {
            Failure::NotFinite => match system.without_inertia(t, &state.g) {
                Some(coordinate) => StepError::Degenerate {
                    step,
                    t,
                    coordinate,
                },
                None => StepError::NotFinite { step, t, h },
            },
            Failure::NotConverged(report, hint) => StepError::NotConverged {
                step,
                t,
                h,
                residual: report.residual,
                iterations: report.iterations,
                hint,
            },
        })?;
        Ok((report, &mut **work))
    }

    /// Takes the step that was solved.
    fn accept(&mut self, state: &mut State<C::Group>, h: f64) -> Result<(), StepError> {
        let (step, t) = (self.steps, state.t);
        let (system, work) = (&self.system, self.work.as_mut());
        let accepted = work.and_then(|work| work.accept(system, state, h));
        accepted.ok_or(StepError::NotFinite { step, t, h })?;
        self.steps += 1;
        Ok(())
    }
}

impl<C: ContinuousSystem + 'static, const S: usize, R: Retraction> Integrator for Gauss<C, S, R> {
    type Group = C::Group;

    fn order(&self) -> u32 {
        2 * S as u32
    }

    /// In general not: the chart is centred at the step's start, and the same step backwards is another of the same order.
    fn is_symmetric(&self) -> bool {
        false
    }

    fn is_symplectic(&self) -> bool {
        self.system.is_symplectic()
    }

    fn step(&mut self, state: &mut State<C::Group>, h: f64) -> Result<StepReport, StepError> {
        let (report, _) = self.solve(state, h)?;
        self.accept(state, h)?;
        Ok(report)
    }

    fn peek(&mut self, state: &State<C::Group>, h: f64) -> Result<State<C::Group>, StepError> {
        let step = self.steps;
        let (_, work) = self.solve(state, h)?;
        let (t, ahead) = (state.t, work.ahead((state, h)));
        if !self.system.is_defined(ahead.t, &ahead.g) {
            return Err(StepError::NotFinite { step, t, h });
        }
        ahead.if_finite(step, t, h)
    }

    fn reset(&mut self) {
        (self.steps, self.work) = (0, None);
    }
}

impl<C: ContinuousSystem + 'static, const S: usize, R: Retraction> FirstVariation
    for Gauss<C, S, R>
{
    fn step_varied(
        &mut self,
        state: &mut State<C::Group>,
        variations: &mut [Variation<C::Group>],
        h: f64,
    ) -> Result<StepReport, StepError> {
        let (report, _) = self.solve(state, h)?;
        let mut carried = variations.to_vec();
        if let Some(work) = &mut self.work {
            work.carry((&self.system, self.tableau), (state, h), &mut carried);
        }
        if !carried.iter().all(Variation::is_finite) {
            let (step, t) = (self.steps, state.t);
            return Err(StepError::NotFinite { step, t, h });
        }
        self.accept(state, h)?;
        variations.clone_from_slice(&carried);
        Ok(report)
    }
}
