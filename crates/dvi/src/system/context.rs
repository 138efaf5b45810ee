//! What all descriptions of a system have in common, and what their formulas are given beside the state.

use core::ops::Range;

use lie::{LieGroup, RealGroup};

/// A mechanical system: where it lives, and what is known of it whatever describes it.
///
/// The supertrait of [`Lagrangian`](crate::Lagrangian), [`DiscreteLagrangian`](crate::DiscreteLagrangian) and
/// [`ContinuousSystem`](crate::ContinuousSystem). Only the group is required: `impl System for Top { type Group = SO3; }`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement `dvi::System`",
    note = "write `impl System for {Self} {{ type Group = ...; }}` beside what describes it"
)]
pub trait System {
    /// The configuration group.
    type Group: RealGroup;

    /// The numbers that the motion may be differentiated by, such as masses and stiffnesses.
    ///
    /// Formulas find them in their [`Context`], as numbers of their own scalar; those that they read from `self` are constants.
    fn parameters(&self) -> &[f64] {
        &[]
    }

    /// Indices of the cyclic coordinates: those of a factor $\mathbb{R}^m$ of a direct product on which the Lagrangian does not depend.
    ///
    /// Their equation is solved to rounding in every step, so their momentum map holds whatever the tolerance.
    fn cyclic(&self) -> Range<usize> {
        0..0
    }

    /// Whether `g` is a configuration of this system; for systems whose size is known at run time.
    fn fits(&self, _g: &Self::Group) -> bool {
        true
    }

    /// Whether a part of the system moves as told, so that there are velocities without a momentum.
    ///
    /// Momenta are then compared with those of the velocities: their sum may be zero throughout.
    fn is_driven(&self) -> bool {
        false
    }

    /// How many things an evaluation adds up, where these are more than the unknowns: they round more than shaken arguments show.
    fn terms(&self) -> usize {
        0
    }

    /// Whether the motion is that of a Lagrangian, so that the flow is symplectic; not so with a [force](crate::Forced).
    fn is_symplectic(&self) -> bool {
        true
    }
}

/// What is a system by another one inside it, and differs from it in nothing that [`System`] tells but perhaps in being symplectic.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement `dvi::System`",
    note = "write `impl System for {Self} {{ type Group = ...; }}` beside what describes it"
)]
pub trait Adapter {
    /// The system inside.
    type Inner: System;

    /// Whether a Lagrangian inside stays one.
    const STAYS_SYMPLECTIC: bool = true;

    /// The system inside.
    fn inner(&self) -> &Self::Inner;
}

impl<A: Adapter> System for A {
    type Group = <A::Inner as System>::Group;

    fn parameters(&self) -> &[f64] {
        self.inner().parameters()
    }
    fn cyclic(&self) -> Range<usize> {
        self.inner().cyclic()
    }
    fn fits(&self, g: &Self::Group) -> bool {
        self.inner().fits(g)
    }
    fn is_driven(&self) -> bool {
        self.inner().is_driven()
    }
    fn terms(&self) -> usize {
        self.inner().terms()
    }
    fn is_symplectic(&self) -> bool {
        A::STAYS_SYMPLECTIC && self.inner().is_symplectic()
    }
}

impl<L: System> Adapter for &L {
    type Inner = L;

    fn inner(&self) -> &L {
        self
    }
}

/// The algebra of a system's group.
pub(crate) type Algebra<C> = <<C as System>::Group as LieGroup>::Algebra;
/// The dual of the algebra of a system's group.
pub(crate) type Dual<C> = <<C as System>::Group as LieGroup>::Dual;

/// When a formula is evaluated, and with which parameters.
///
/// ```
/// use dvi::{Context, Lagrangian, System};
/// use lie::{Rn, Scalar, Tangent};
///
/// /// A particle on a spring whose other end is shaken: mass, stiffness and amplitude are parameters.
/// struct Shaken([f64; 3]);
///
/// impl System for Shaken {
///     type Group = Rn<1>;
///     fn parameters(&self) -> &[f64] {
///         &self.0
///     }
/// }
///
/// impl Lagrangian for Shaken {
///     fn value<S: Scalar>(&self, at: Context<S>, x: &Rn<1, S>, v: &Tangent<1, S>) -> S {
///         let [mass, stiffness, amplitude] = at.parameters();
///         let stretch = x.0[0] - amplitude * at.t.sin();
///         (mass * v[0] * v[0] - stiffness * stretch * stretch) * S::from_f64(0.5)
///     }
/// }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Context<'a, S> {
    /// Time, s.
    pub t: S,
    /// The system's [parameters](System::parameters), all of them.
    pub all: &'a [S],
}

impl<'a, S: Copy> Context<'a, S> {
    /// The time `t`, and these parameters.
    #[inline(always)]
    pub fn new(t: S, parameters: &'a [S]) -> Self {
        Self { t, all: parameters }
    }

    /// The parameters, of which there are `N`.
    ///
    /// # Panics
    /// Where [`System::parameters`] gives another number of them.
    #[inline(always)]
    pub fn parameters<const N: usize>(&self) -> [S; N] {
        let found = self.all.len();
        match self.all.first_chunk() {
            Some(parameters) if found == N => *parameters,
            _ => {
                panic!("a formula asks for {N} parameters, and System::parameters() gives {found}")
            }
        }
    }

    /// The same parameters at another time.
    #[inline(always)]
    pub(crate) fn at(self, t: S) -> Self {
        Self { t, ..self }
    }
}
