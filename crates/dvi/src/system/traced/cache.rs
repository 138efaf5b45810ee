//! What was recorded, kept for the configurations of one shape.

use std::sync::{Arc, Mutex, PoisonError};

use lie::RealGroup;

use super::error::TracedError;

/// How often another formula is recorded before none is any more.
const MOST: u32 = 64;

/// What was recorded last, or why it was not; of a formula that the key `K` tells from others. Clones share it.
#[derive(Debug)]
pub(crate) struct Cache<G, K, T>(Arc<Mutex<Kept<G, K, T>>>);

type Found<T> = Result<Arc<T>, TracedError>;

#[derive(Debug)]
struct Kept<G, K, T> {
    last: Option<(G, K, Found<T>)>,
    count: u32,
}

impl<G, K, T> Clone for Cache<G, K, T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<G, K, T> Default for Cache<G, K, T> {
    fn default() -> Self {
        let kept = Kept {
            last: None,
            count: 0,
        };
        Self(Arc::new(Mutex::new(kept)))
    }
}

impl<G: RealGroup, K: Copy + PartialEq, T> Cache<G, K, T> {
    /// What is recorded of a formula for the shape of `g`; `record` is called where another was.
    pub(crate) fn find(
        &self,
        g: &G,
        key: K,
        record: impl FnOnce() -> Result<T, TracedError>,
    ) -> Found<T> {
        // A formula that panicked has left what was before it.
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match &kept.last {
            Some((shape, of, found)) if *of == key && shape.same_shape(g) => return found.clone(),
            _ => kept.count += 1,
        }
        let found = match kept.count > MOST {
            true => Err(TracedError::Changes { times: MOST }),
            false => record().map(Arc::new),
        };
        kept.last = Some((g.clone(), key, found.clone()));
        found
    }

    /// Takes nothing for recorded from now on, of a formula for the shape of `g`.
    pub(crate) fn refuse(&self, g: &G, key: K, why: TracedError) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.last = Some((g.clone(), key, Err(why)));
    }
}
