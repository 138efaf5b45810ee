//! What was recorded, kept for the configurations of one shape.

use std::sync::{Arc, Mutex, PoisonError};

use lie::RealGroup;

use super::error::TracedError;

/// What was recorded of a system last, or why it was not; clones share it.
#[derive(Debug)]
pub(crate) struct Cache<G, T>(Arc<Mutex<Option<(G, Found<T>)>>>);

type Found<T> = Result<Arc<T>, TracedError>;

impl<G, T> Clone for Cache<G, T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<G, T> Default for Cache<G, T> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<G: RealGroup, T> Cache<G, T> {
    /// What is recorded for the shape of `g`; `record` is called where another shape was.
    pub(crate) fn of_shape(
        &self,
        g: &G,
        record: impl FnOnce() -> Result<T, TracedError>,
    ) -> Found<T> {
        // A formula that panicked has left what was before it.
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match &*kept {
            Some((shape, found)) if shape.same_shape(g) => found.clone(),
            _ => {
                let found = record().map(Arc::new);
                *kept = Some((g.clone(), found.clone()));
                found
            }
        }
    }

    /// Takes nothing for recorded from now on, for the shape of `g`.
    pub(crate) fn refuse(&self, g: &G, why: TracedError) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        *kept = Some((g.clone(), Err(why)));
    }
}
