//! What is known of the joints before the tree is seen: what they do not have is not compiled.

use super::Role;
use crate::tree::ArticulatedBody;

/// What is known of a tree's joints.
pub(crate) trait Kinds {
    /// Whether the tree is of the paper's kind: body `i` has the attitude number `i`.
    const ARE_BALLS: bool;
    /// Whether dampers are in the matrix of a step.
    const ARE_DAMPED: bool;
}

/// Nothing: each joint is asked.
pub(crate) enum Any {}

/// Nothing, and there may be dampers in the matrix of a step.
pub(crate) enum Damped {}

/// Balls and a free base, on which nothing acts but weight and springs, and no inertia is coupled.
pub(crate) enum Balls {}

impl Kinds for Any {
    const ARE_BALLS: bool = false;
    const ARE_DAMPED: bool = false;
}

impl Kinds for Damped {
    const ARE_BALLS: bool = false;
    const ARE_DAMPED: bool = true;
}

impl Kinds for Balls {
    const ARE_BALLS: bool = true;
    const ARE_DAMPED: bool = false;
}

impl ArticulatedBody {
    /// What the attitude of body `i` comes from.
    #[inline(always)]
    pub(crate) fn role<K: Kinds>(&self, i: usize) -> Role {
        match K::ARE_BALLS {
            true => Role::Ball(i),
            false => self.nodes[i].role,
        }
    }

    /// Whether the first body is on nothing.
    #[inline(always)]
    pub(crate) fn floats<K: Kinds>(&self) -> bool {
        K::ARE_BALLS || self.is_free()
    }

    /// Whether it is a simple tree on which nothing acts but weight and springs.
    #[inline(always)]
    pub(crate) fn is_plain(&self) -> bool {
        self.is_simple() && !self.is_coupled && !self.has_forces()
    }

    /// Whether inertia is coupled.
    #[inline(always)]
    pub(crate) fn couples<K: Kinds>(&self) -> bool {
        !K::ARE_BALLS && self.is_coupled
    }
}
