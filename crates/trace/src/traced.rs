//! The scalar that records.

use core::ops::{
    Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign,
};
use core::panic::Location;

use lie::{DualNumber, Scalar};
use num_traits::{One, Zero};

use crate::error::TraceError;
use crate::graph::Graph;
use crate::node::{Binary, Id, Unary};
use crate::recording::{self, Number, Session};

/// A number of a formula that is being recorded: a constant, or a node of the recording's graph.
///
/// It has no value, so nothing may depend on one. What asks for it, such as `==` or [`magnitude`](Scalar::magnitude), refuses the
/// recording; so does a number of another one. Choose by [`less`](Scalar::less) and [`select`](Scalar::select), which are recorded.
#[derive(Clone, Copy, Debug)]
pub struct Traced(Number);

/// Records a formula of `inputs` numbers: its graph, with the numbers it returns as [outputs](Graph::outputs).
///
/// Whatever the formula does not take from its inputs is a constant of the graph: hand over time and parameters as well.
///
/// ```
/// use lie::Scalar;
/// use trace::Degree;
///
/// fn energy<S: Scalar>(x: &[S]) -> Vec<S> {
///     let [angle, rate] = [x[0], x[1]];
///     vec![rate * rate * S::from_f64(0.5) - angle.cos()]
/// }
/// let graph = trace::record(2, energy)?;
/// let [angle, rate] = [graph.input(0), graph.input(1)];
/// assert_eq!(graph.degree(graph.outputs()[0], &[rate]), Degree::Quadratic);
/// assert_eq!(graph.degree(graph.outputs()[0], &[angle]), Degree::More);
/// # Ok::<(), trace::TraceError>(())
/// ```
///
/// # Errors
/// [`TraceError::Branch`] where the formula asks for the value of a number, [`TraceError::Smooth`] where it calls [`Scalar::smooth`],
/// [`TraceError::Foreign`] where it uses a number of another recording.
#[track_caller]
pub fn record(
    inputs: usize,
    formula: impl FnOnce(&[Traced]) -> Vec<Traced>,
) -> Result<Graph, TraceError> {
    let session = Session::open(inputs, Location::caller());
    let inputs: Vec<Traced> = session
        .inputs()
        .map(|x| Traced(Number::Recorded(x)))
        .collect();
    let outputs = formula(&inputs);
    session.close(outputs.iter().map(|x| x.0))
}

impl Traced {
    fn constant(x: f64) -> Self {
        Self(Number::Constant(x))
    }

    /// The number that `build` makes of the nodes of `x`, one of which at least is recorded.
    fn extend<const N: usize>(
        x: [Self; N],
        at: &'static Location<'static>,
        build: impl FnOnce(&mut Graph, [Id; N]) -> Id,
    ) -> Self {
        let mut handles = x.iter().filter_map(|x| x.0.handle());
        let Some(first) = handles.next() else {
            return Self::constant(f64::NAN);
        };
        let (handle, constant) = recording::extend(first, handles, at, |graph| {
            let places = x.map(|x| x.0.place(graph));
            build(graph, places)
        });
        constant.map_or(Self(Number::Recorded(handle)), Self::constant)
    }

    #[track_caller]
    fn unary(self, op: Unary) -> Self {
        match self.0 {
            Number::Constant(x) => Self::constant(op.apply(x)),
            Number::Recorded(_) => {
                Self::extend([self], Location::caller(), |graph, [x]| graph.unary(op, x))
            }
        }
    }

    #[track_caller]
    fn binary(self, op: Binary, y: Self) -> Self {
        match (self.0, y.0) {
            (Number::Constant(x), Number::Constant(y)) => Self::constant(op.apply(x, y)),
            _ => Self::extend([self, y], Location::caller(), |graph, [x, y]| {
                graph.binary(op, x, y)
            }),
        }
    }

    fn guarded_by_constant(self, by: f64, least: f64) -> Option<Self> {
        let outside = by.abs() <= least;
        (!outside).then_some(self)
    }

    /// The value of a constant; the recording of any other number is refused.
    ///
    /// A number that is asked for its value again and again is then now zero, now infinite: so that a loop which waits for a value ends.
    fn value(self, operation: &'static str, at: &'static Location<'static>) -> Option<f64> {
        const PATIENCE: u32 = 1000;
        match self.0 {
            Number::Constant(x) => Some(x),
            Number::Recorded(handle) => {
                let looks = recording::refuse(handle, TraceError::Branch { operation, at });
                // Bits without a period that a loop could be in step with.
                let any = looks.wrapping_mul(0x9e37_79b9) >> 31 == 0;
                (looks > PATIENCE).then_some(if any { 0.0 } else { f64::INFINITY })
            }
        }
    }
}

impl PartialEq for Traced {
    /// Refuses the recording where one of the two is no constant.
    #[track_caller]
    fn eq(&self, y: &Self) -> bool {
        let at = Location::caller();
        match (self.value("==", at), y.value("==", at)) {
            (Some(x), Some(y)) => x == y,
            _ => false,
        }
    }
}

macro_rules! operator {
    ($($trait:ident $method:ident $assign:ident $assign_method:ident),+) => { $(
        impl $trait for Traced {
            type Output = Self;
            #[track_caller]
            fn $method(self, y: Self) -> Self {
                self.binary(Binary::$trait, y)
            }
        }

        impl $assign for Traced {
            #[track_caller]
            fn $assign_method(&mut self, y: Self) {
                *self = self.binary(Binary::$trait, y);
            }
        }
    )+ };
}

operator!(
    Add add AddAssign add_assign,
    Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign,
    Div div DivAssign div_assign,
    Rem rem RemAssign rem_assign
);

impl Neg for Traced {
    type Output = Self;
    #[track_caller]
    fn neg(self) -> Self {
        self.unary(Unary::Neg)
    }
}

impl Zero for Traced {
    fn zero() -> Self {
        Self::constant(0.0)
    }
    #[track_caller]
    fn is_zero(&self) -> bool {
        self.value("is_zero", Location::caller()) == Some(0.0)
    }
}

impl One for Traced {
    fn one() -> Self {
        Self::constant(1.0)
    }
}

/// Two numbers to be compared when the formula is evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Comparison([Traced; 2]);

impl Scalar for Traced {
    type Mask = Comparison;
    type Real = Self;
    type Jet = DualNumber<Self>;
    const EPSILON: f64 = f64::EPSILON;
    const DUAL_LEVELS: u32 = 0;

    fn from_f64(x: f64) -> Self {
        Self::constant(x)
    }
    #[track_caller]
    fn mul_add(self, a: Self, b: Self) -> Self {
        match (self.0, a.0, b.0) {
            (Number::Constant(x), Number::Constant(a), Number::Constant(b)) => {
                Self::constant(Scalar::mul_add(x, a, b))
            }
            _ => Self::extend([self, a, b], Location::caller(), Graph::mul_add),
        }
    }
    #[track_caller]
    fn neg_mul_add(self, a: Self, b: Self) -> Self {
        match (self.0, a.0, b.0) {
            (Number::Constant(x), Number::Constant(a), Number::Constant(b)) => {
                Self::constant(x.neg_mul_add(a, b))
            }
            _ => Self::extend([self, a, b], Location::caller(), Graph::neg_mul_add),
        }
    }
    #[track_caller]
    fn real(self) -> Self {
        self.unary(Unary::Real)
    }
    fn from_real(x: Self) -> Self {
        x
    }
    #[track_caller]
    fn sqrt(self) -> Self {
        self.unary(Unary::Sqrt)
    }
    #[track_caller]
    fn exp(self) -> Self {
        self.unary(Unary::Exp)
    }
    #[track_caller]
    fn ln(self) -> Self {
        self.unary(Unary::Ln)
    }
    #[track_caller]
    fn tanh(self) -> Self {
        self.unary(Unary::Tanh)
    }
    #[track_caller]
    fn sin_cos(self) -> (Self, Self) {
        (self.unary(Unary::Sin), self.unary(Unary::Cos))
    }
    #[track_caller]
    fn atan2(self, x: Self) -> Self {
        self.binary(Binary::Atan2, x)
    }
    /// Refuses the recording, but at a constant: the function is lent for the call alone.
    #[track_caller]
    fn smooth<const N: usize>(self, f: &dyn Fn(f64, u32) -> [f64; N]) -> [Self; N] {
        match self.0 {
            Number::Constant(x) => f(x, 0).map(Self::constant),
            Number::Recorded(handle) => {
                let at = Location::caller();
                recording::refuse(handle, TraceError::Smooth { at });
                [self; N]
            }
        }
    }
    fn less(self, rhs: Self) -> Comparison {
        Comparison([self, rhs])
    }
    #[track_caller]
    fn select(Comparison([l, r]): Comparison, yes: Self, no: Self) -> Self {
        match (l.0, r.0) {
            (Number::Constant(l), Number::Constant(r)) => {
                if l < r {
                    yes
                } else {
                    no
                }
            }
            _ => Self::extend(
                [l, r, yes, no],
                Location::caller(),
                |graph, [l, r, y, n]| graph.select([l, r], y, n),
            ),
        }
    }
    /// A domain is recorded: outside it there is no number.
    #[track_caller]
    fn guarded(self, by: Self, least: f64) -> Option<Self> {
        if let Number::Constant(by) = by.0 {
            return self.guarded_by_constant(by, least);
        }
        let outside = Self::constant(f64::NAN);
        let inside = Self::constant(least * least).less(by * by);
        Some(Self::select(inside, self, outside))
    }
    /// Refuses the recording, but of a constant; not a number then.
    #[track_caller]
    fn magnitude(self) -> f64 {
        let value = self.value("magnitude", Location::caller());
        value.map_or(f64::NAN, f64::abs)
    }
}
