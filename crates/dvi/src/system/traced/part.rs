//! Which formula of a system is recorded.

use core::mem::size_of_val;
use core::ops::Range;

/// Where the formulas are that may be recorded: in the memory of the system that is stepped, where they stay as they are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Home {
    memory: Range<usize>,
    /// Where it begins, of a system that is borrowed; zero of one that is owned, and may be moved.
    base: usize,
}

/// Which formula of a system it is: its type, and where in the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    name: &'static str,
    base: usize,
    offset: usize,
}

impl Home {
    /// The memory of a system that an integrator owns.
    pub(crate) fn of<L: ?Sized>(system: &L) -> Self {
        let memory = memory_of(system);
        Self { memory, base: 0 }
    }

    /// The memory of what it refers to.
    pub(crate) fn behind<L: ?Sized>(reference: &L) -> Self {
        let memory = memory_of(reference);
        let base = memory.start;
        Self { memory, base }
    }

    /// Which part of the system a formula is; none where it is elsewhere, such as one made anew for each evaluation.
    pub(crate) fn part<L: ?Sized>(&self, formula: &L) -> Option<Part> {
        let (formula, Self { memory, base }) = (memory_of(formula), self);
        let part = |base: usize, offset: usize| Part {
            name: core::any::type_name::<L>(),
            base,
            offset,
        };
        // Without data its type tells all of it, wherever it is.
        if formula.is_empty() {
            return Some(part(0, 0));
        }
        let inside = memory.start <= formula.start && formula.end <= memory.end;
        inside.then(|| part(*base, formula.start - memory.start))
    }
}

fn memory_of<L: ?Sized>(of: &L) -> Range<usize> {
    let start = core::ptr::from_ref(of).addr();
    start..start + size_of_val(of)
}
