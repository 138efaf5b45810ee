//! Quadrature rules over one step.

/// A quadrature rule over one step, $\int_0^h \varphi \approx h \sum_i b_i \varphi_i$.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quadrature {
    /// $\varphi$ at the start of the step: order 1, the rule of (22).
    LeftPoint,
    /// $\varphi$ at the end of the step: order 1, the adjoint of [`LeftPoint`](Self::LeftPoint).
    RightPoint,
    /// $\varphi$ in the middle of the step: order 2, symmetric.
    Midpoint,
    /// The mean of $\varphi$ at both ends of the step: order 2, symmetric.
    Trapezoid,
}

/// Where along a step from $g$ to $g f$ a rule looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// $g$, at $t$.
    Start,
    /// $g f^{1/2}$, at $t + h/2$: on the group, the same from both ends.
    Middle,
    /// $g f$, at $t + h$.
    End,
}

impl Quadrature {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::LeftPoint,
        Self::RightPoint,
        Self::Midpoint,
        Self::Trapezoid,
    ];

    /// Weights $b_i$, which sum to one, and places.
    pub(crate) fn nodes(self) -> &'static [(f64, Place)] {
        match self {
            Self::LeftPoint => &[(1.0, Place::Start)],
            Self::RightPoint => &[(1.0, Place::End)],
            Self::Midpoint => &[(1.0, Place::Middle)],
            Self::Trapezoid => &[(0.5, Place::Start), (0.5, Place::End)],
        }
    }

    /// The order of the variational integrator.
    pub fn order(self) -> u32 {
        match self {
            Self::LeftPoint | Self::RightPoint => 1,
            Self::Midpoint | Self::Trapezoid => 2,
        }
    }

    /// Whether the rule is the same read backwards.
    pub fn is_symmetric(self) -> bool {
        matches!(self, Self::Midpoint | Self::Trapezoid)
    }

    /// The name to print.
    pub fn name(self) -> &'static str {
        match self {
            Self::LeftPoint => "left",
            Self::RightPoint => "right",
            Self::Midpoint => "midpoint",
            Self::Trapezoid => "trapezoidal",
        }
    }
}
