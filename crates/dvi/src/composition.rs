//! Symmetric composition: higher order from a discrete Lagrangian and its adjoint.

use crate::{
    Adjoint, DiscreteLagrangian, FirstVariation, Integrator, Path, State, StepError, StepReport,
    Variation, Variational,
};
use lie::{LieGroup, VectorSpace};

/// Suzuki's five equal-sized steps, $\gamma = 1/(4 - 4^{1/3})$ (M. Suzuki, Phys. Lett. A 146, 1990).
const FOURTH: [f64; 5] = [
    0.414_490_771_794_375_74,
    0.414_490_771_794_375_74,
    -0.657_963_087_177_502_9,
    0.414_490_771_794_375_74,
    0.414_490_771_794_375_74,
];

/// W. Kahan, R.-C. Li, *Composition constants for raising the orders of unconventional schemes for ordinary
/// differential equations*, Math. Comp. 66 (1997): method s9odr6a, from the middle outwards.
const SIXTH: [f64; 5] = [
    0.798_543_990_934_83,
    0.082_213_596_293_550_8,
    -0.706_246_172_557_639_3,
    0.332_599_136_789_359_43,
    0.392_161_444_007_314_1,
];

/// The same authors' s17odr8a, from the middle outwards.
const EIGHTH: [f64; 9] = [
    -0.605_508_533_830_034_6,
    0.295_011_723_609_310_3,
    0.258_374_387_686_322_04,
    0.184_539_640_978_315_7,
    -0.395_903_894_133_237_57,
    0.158_841_906_555_155_6,
    -0.389_474_962_644_847_27,
    0.561_162_981_775_108_4,
    0.130_202_483_088_890_07,
];

/// A symmetric composition of order 2, 4, 6 or 8 of the steps of a discrete Lagrangian and its [adjoint](Adjoint).
///
/// It has 1, 5, 9 or 17 parts, $\gamma_j h$ long. Each is half a step of the one and half a step of the other, or one whole step of a
/// symmetric discrete Lagrangian. Some $\gamma_j$ are negative: these parts go backward in time.
///
/// ```
/// use dvi::{Composition, Context, Integrator, Lagrangian, Quadrature, System};
/// use lie::{Rn, Scalar, Tangent};
///
/// /// A particle of 1 kg on a spring of 1 N/m.
/// #[derive(Clone, Copy)]
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
/// let mut integrator = Composition::new::<6>(Spring.discretise(Quadrature::LeftPoint));
/// for _ in 0..10 {
///     integrator.step(&mut state, 0.5)?;
/// }
/// assert!((state.g.0[0] - 5.0_f64.cos()).abs() < 1e-4);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub struct Composition<L: DiscreteLagrangian> {
    order: u32,
    parts: Vec<Part<L>>,
    steps: u64,
    before: Option<State<L::Group>>,
}

/// One part. It keeps its own integrators, whose guesses and matrices are those of its length.
struct Part<L: DiscreteLagrangian> {
    /// $\gamma_j$.
    length: f64,
    method: Variational<L>,
    /// None where the method is its own adjoint.
    adjoint: Option<Variational<Adjoint<L>>>,
}

impl<L: DiscreteLagrangian + Clone> Composition<L> {
    /// The composition of order `P`; another than 2, 4, 6 or 8 does not compile.
    pub fn new<const P: u32>(lagrangian: L) -> Self {
        const {
            assert!(
                P == 2 || P == 4 || P == 6 || P == 8,
                "the order is 2, 4, 6 or 8"
            )
        };
        Self::of(lagrangian, P)
    }

    /// The composition of an order that is known at run time; none of another than 2, 4, 6 or 8.
    pub fn with_order(lagrangian: L, order: u32) -> Option<Self> {
        matches!(order, 2 | 4 | 6 | 8).then(|| Self::of(lagrangian, order))
    }

    fn of(lagrangian: L, order: u32) -> Self {
        let mirrored = |half: &[f64]| {
            let out = half.iter().skip(1);
            let ends = out.clone().rev().chain(&half[..1]).chain(out);
            ends.copied().collect()
        };
        let lengths = match order {
            2 => vec![1.0],
            4 => FOURTH.to_vec(),
            6 => mirrored(&SIXTH),
            _ => mirrored(&EIGHTH),
        };
        let adjoint = || Variational::new(Adjoint(lagrangian.clone()));
        let part = |length| Part {
            length,
            method: Variational::new(lagrangian.clone()),
            adjoint: (!lagrangian.is_symmetric()).then(adjoint),
        };
        Self {
            order,
            parts: lengths.into_iter().map(part).collect(),
            steps: 0,
            before: None,
        }
    }
}

impl<L: DiscreteLagrangian> Composition<L> {
    /// The longest step back in time of the discrete Lagrangian, in steps of the whole; zero of order 2.
    ///
    /// A damper has a pole there: it feeds the motion, and does so without bound where its rate times that step comes to one.
    pub fn longest_step_back(&self) -> f64 {
        let back = |part: &Part<L>| match part.adjoint {
            Some(_) => -0.5 * part.length,
            None => -part.length,
        };
        self.parts.iter().map(back).fold(0.0, f64::max)
    }

    /// The largest residual of the solved parts, as [`Variational::with_tolerance`].
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        let with = |part: Part<L>| Part {
            method: part.method.with_tolerance(tolerance),
            adjoint: part
                .adjoint
                .map(|adjoint| adjoint.with_tolerance(tolerance)),
            ..part
        };
        self.parts = self.parts.into_iter().map(with).collect();
        self
    }

    /// The same with all coordinates among the unknowns, as [`Variational::with_all_unknowns`].
    pub fn with_all_unknowns(mut self) -> Self {
        let with = |part: Part<L>| Part {
            method: part.method.with_all_unknowns(),
            adjoint: part.adjoint.map(Variational::with_all_unknowns),
            ..part
        };
        self.parts = self.parts.into_iter().map(with).collect();
        self
    }

    /// Takes all parts, by `half` of the method or the adjoint; the state is as before where one fails.
    fn each_part(
        &mut self,
        state: &mut State<L::Group>,
        h: f64,
        mut half: impl FnMut(Half<L>, &mut State<L::Group>, f64) -> Result<StepReport, StepError>,
    ) -> Result<StepReport, StepError> {
        let same = |before: &State<L::Group>| {
            before.g.same_shape(&state.g) && before.mu.same_shape(&state.mu)
        };
        let mut before = self
            .before
            .take()
            .filter(same)
            .unwrap_or_else(|| state.clone());
        before.copy_from(state);
        let mut total = StepReport::default();
        let mut add = |report: StepReport| {
            total.iterations += report.iterations;
            total.evaluations += report.evaluations;
            total.residual = total.residual.max(report.residual);
            total.means = report.means;
        };
        let solved = self.parts.iter_mut().try_for_each(|part| {
            let (method, length) = (Half::Method(&mut part.method), part.length * h);
            let Some(adjoint) = &mut part.adjoint else {
                return half(method, state, length).map(&mut add);
            };
            half(method, state, 0.5 * length).map(&mut add)?;
            half(Half::Adjoint(adjoint), state, 0.5 * length).map(&mut add)
        });
        let (step, t) = (self.steps, before.t);
        match solved {
            // The parts add up to h but for rounding.
            Ok(()) => state.t = t + h,
            Err(_) => state.copy_from(&before),
        }
        self.steps += u64::from(solved.is_ok());
        self.before = Some(before);
        solved
            .map(|()| total)
            .map_err(|error| error.of_whole(step, t, h))
    }
}

/// Which of the two takes a part.
enum Half<'a, L: DiscreteLagrangian> {
    Method(&'a mut Variational<L>),
    Adjoint(&'a mut Variational<Adjoint<L>>),
}

impl<L: DiscreteLagrangian> Half<'_, L> {
    fn step(self, state: &mut State<L::Group>, h: f64) -> Result<StepReport, StepError> {
        match self {
            Self::Method(method) => method.step(state, h),
            Self::Adjoint(adjoint) => adjoint.step(state, h),
        }
    }

    fn step_along(
        self,
        state: &mut State<L::Group>,
        h: f64,
        see: &mut dyn FnMut(Path<L::Group>),
    ) -> Result<StepReport, StepError> {
        match self {
            Self::Method(method) => method.step_along(state, h, see),
            Self::Adjoint(adjoint) => adjoint.step_along(state, h, see),
        }
    }

    fn peek_along(
        self,
        state: &State<L::Group>,
        h: f64,
        see: &mut dyn FnMut(Path<L::Group>),
    ) -> Result<State<L::Group>, StepError> {
        match self {
            Self::Method(method) => method.peek_along(state, h, see),
            Self::Adjoint(adjoint) => adjoint.peek_along(state, h, see),
        }
    }
}

impl<L: DiscreteLagrangian> Integrator for Composition<L> {
    type Group = L::Group;

    fn order(&self) -> u32 {
        self.order
    }

    fn is_symmetric(&self) -> bool {
        true
    }

    fn is_symplectic(&self) -> bool {
        self.parts.iter().all(|part| part.method.is_symplectic())
    }

    fn step(&mut self, state: &mut State<L::Group>, h: f64) -> Result<StepReport, StepError> {
        self.each_part(state, h, |half, state, h| half.step(state, h))
    }

    fn peek(&mut self, state: &State<L::Group>, h: f64) -> Result<State<L::Group>, StepError> {
        self.peek_along(state, h, &mut |_| ())
    }

    fn step_along(
        &mut self,
        state: &mut State<L::Group>,
        h: f64,
        see: &mut dyn FnMut(Path<L::Group>),
    ) -> Result<StepReport, StepError> {
        self.each_part(state, h, |half, state, h| half.step_along(state, h, see))
    }

    /// By looking ahead with each part: none of them counts a step.
    fn peek_along(
        &mut self,
        state: &State<L::Group>,
        h: f64,
        see: &mut dyn FnMut(Path<L::Group>),
    ) -> Result<State<L::Group>, StepError> {
        let (mut ahead, steps) = (state.clone(), self.steps);
        let peeked = self.each_part(&mut ahead, h, |half, state, h| {
            *state = half.peek_along(state, h, see)?;
            Ok(StepReport::default())
        });
        self.steps = steps;
        peeked.map(|_| ahead)
    }

    fn reset(&mut self) {
        (self.steps, self.before) = (0, None);
        for part in &mut self.parts {
            part.method.reset();
            part.adjoint.iter_mut().for_each(Integrator::reset);
        }
    }
}

impl<L: DiscreteLagrangian> FirstVariation for Composition<L> {
    fn step_varied(
        &mut self,
        state: &mut State<L::Group>,
        variations: &mut [Variation<L::Group>],
        h: f64,
    ) -> Result<StepReport, StepError> {
        let mut carried = variations.to_vec();
        let report = self.each_part(state, h, |half, state, h| match half {
            Half::Method(method) => method.step_varied(state, &mut carried, h),
            Half::Adjoint(adjoint) => adjoint.step_varied(state, &mut carried, h),
        })?;
        variations.clone_from_slice(&carried);
        Ok(report)
    }
}
