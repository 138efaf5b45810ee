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

/// Sets `out` to the element of the shape of `g` whose numbers these are.
pub(crate) fn read<G: RealGroup, S: Scalar>(
    g: &G,
    number: impl Fn(usize) -> S,
    out: &mut Over<G, S>,
) {
    let next = Cell::new(0);
    G::convert_into::<f64, S>(g, |_| number(next.replace(next.get() + 1)), out);
}

/// The numbers of any element.
pub(crate) fn numbers<G: LieGroup, S: Scalar>(g: &Over<G, S>) -> Vec<S> {
    let found = core::cell::RefCell::new(Vec::new());
    G::convert::<S, S>(g, |x| {
        found.borrow_mut().push(x);
        x
    });
    found.into_inner()
}

/// Writes the numbers of an element to `out`, by way of `scratch`; whether there are as many.
#[inline(always)]
pub(crate) fn write<G: LieGroup, S: Scalar>(
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
