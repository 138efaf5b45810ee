//! The numbers of a group element, one after the other.

use core::cell::Cell;

use lie::{LieGroup, Over, RealGroup, Scalar};

/// How many numbers there are.
pub(crate) fn count<G: RealGroup>(g: &G) -> usize {
    let found = Cell::new(0);
    G::convert::<f64, f64>(g, |x| {
        found.set(found.get() + 1);
        x
    });
    found.get()
}

/// An element of the shape of `g` that has these numbers.
pub(crate) fn with_numbers<G: RealGroup, S: Scalar>(g: &G, numbers: &[S]) -> Over<G, S> {
    let next = Cell::new(0);
    G::convert::<f64, S>(g, |_| {
        let k = next.replace(next.get() + 1);
        numbers[k]
    })
}

/// The numbers of any element.
pub(super) fn numbers<G: LieGroup, S: Scalar>(g: &Over<G, S>) -> Vec<S> {
    let found = core::cell::RefCell::new(Vec::new());
    G::convert::<S, S>(g, |x| {
        found.borrow_mut().push(x);
        x
    });
    found.into_inner()
}

/// Writes the numbers of an element to `out`, by way of `scratch`; whether there are as many.
#[inline(always)]
pub(super) fn write<G: LieGroup, S: Scalar>(
    g: &Over<G, S>,
    scratch: &mut Over<G, S>,
    out: &mut [S],
) -> bool {
    let (cells, next) = (Cell::from_mut(out).as_slice_of_cells(), Cell::new(0));
    G::convert_into::<S, S>(
        g,
        #[inline(always)]
        |x| {
            let k = next.replace(next.get() + 1);
            if let Some(cell) = cells.get(k) {
                cell.set(x);
            }
            x
        },
        scratch,
    );
    next.get() == cells.len()
}
