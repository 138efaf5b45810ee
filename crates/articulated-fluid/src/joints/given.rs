//! A joint that leaves nothing free: a weld, or a motion as told. $A, K, H$ are handed up as they are, (S12).

use lie::{Scalar, Vec3};

use super::link::Link;

impl<S: Scalar> Link<S> {
    /// $\beta^\ast = \beta + \Lambda (a; 0)$ of the rate $a$ that is told.
    #[inline(always)]
    pub(crate) fn drive(&mut self, rate: Vec3<S>) {
        self.force -= self.x * rate;
        self.w -= self.h * rate;
    }
}
