//! Recordings: what a [`Traced`] number writes to while a formula runs.

use core::panic::Location;
use core::sync::atomic::{AtomicU64, Ordering};
use std::cell::RefCell;

use crate::error::TraceError;
use crate::graph::Graph;
use crate::node::Id;

/// A number that is being recorded: a node of one recording.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Handle {
    recording: u64,
    id: Id,
}

/// What a formula computes with.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Number {
    Constant(f64),
    Recorded(Handle),
}

impl Number {
    pub(crate) fn handle(self) -> Option<Handle> {
        match self {
            Self::Constant(_) => None,
            Self::Recorded(handle) => Some(handle),
        }
    }

    /// Its node in the graph of its recording.
    pub(crate) fn place(self, graph: &mut Graph) -> Id {
        match self {
            Self::Constant(x) => graph.constant(x),
            Self::Recorded(handle) => handle.id,
        }
    }
}

struct Recording {
    number: u64,
    graph: Graph,
    /// The first thing that went wrong.
    error: Option<TraceError>,
    /// How often a number was asked for its value.
    looks: u32,
}

/// Never used twice, on no thread: a number kept after its recording is told from those of later ones.
static NEXT: AtomicU64 = AtomicU64::new(0);

thread_local! {
    /// The recordings open on this thread; a formula may record another one inside it.
    static OPEN: RefCell<Vec<Recording>> = const { RefCell::new(Vec::new()) };
}

/// An open recording; closed when dropped, also where the formula panics.
pub(crate) struct Session {
    number: u64,
    at: &'static Location<'static>,
}

impl Session {
    pub(crate) fn open(inputs: usize, at: &'static Location<'static>) -> Self {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        OPEN.with_borrow_mut(|open| {
            open.push(Recording {
                number,
                graph: Graph::new(inputs),
                error: None,
                looks: 0,
            });
        });
        Self { number, at }
    }

    pub(crate) fn inputs(&self) -> impl Iterator<Item = Handle> {
        let recording = self.number;
        let inputs = with(recording, |r| r.graph.inputs()).unwrap_or_default();
        inputs.into_iter().map(move |id| Handle { recording, id })
    }

    /// The graph, with these results, which must be constants or numbers of this recording.
    pub(crate) fn close(self, outputs: impl Iterator<Item = Number>) -> Result<Graph, TraceError> {
        let foreign = TraceError::Foreign { at: self.at };
        let own = |x: Number| x.handle().is_none_or(|h| h.recording == self.number);
        let finished = with(self.number, |r| {
            r.error.map_or(Ok(()), Err)?;
            let place = |x: Number| own(x).then(|| x.place(&mut r.graph));
            let places: Option<Vec<Id>> = outputs.map(place).collect();
            r.graph.set_outputs(&places.ok_or(foreign)?);
            Ok(core::mem::take(&mut r.graph))
        });
        finished.unwrap_or(Err(foreign))
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        OPEN.with_borrow_mut(|open| open.retain(|r| r.number != self.number));
    }
}

/// What `f` gives for an open recording; nothing where it has ended.
fn with<O>(number: u64, f: impl FnOnce(&mut Recording) -> O) -> Option<O> {
    OPEN.with_borrow_mut(|open| open.iter_mut().rev().find(|r| r.number == number).map(f))
}

/// Adds to the recording of `first`, which all of `handles` must be of, and gives the node with its constant, if it is one.
///
/// Otherwise the innermost recording is refused.
pub(crate) fn extend(
    first: Handle,
    handles: impl IntoIterator<Item = Handle>,
    at: &'static Location<'static>,
    build: impl FnOnce(&mut Graph) -> Id,
) -> (Handle, Option<f64>) {
    let recording = first.recording;
    if handles.into_iter().all(|h| h.recording == recording) {
        let built = with(recording, |r| {
            let id = build(&mut r.graph);
            (Handle { recording, id }, r.graph.as_constant(id))
        });
        if let Some(built) = built {
            return built;
        }
    }
    refuse_innermost(TraceError::Foreign { at });
    (first, None)
}

/// Refuses the recording of a number, or the innermost one where it has ended; tells how often that was done.
pub(crate) fn refuse(handle: Handle, error: TraceError) -> u32 {
    let refused = with(handle.recording, |r| {
        r.error.get_or_insert(error);
        r.looks = r.looks.saturating_add(1);
        r.looks
    });
    refused.unwrap_or_else(|| {
        refuse_innermost(TraceError::Foreign { at: error.at() });
        0
    })
}

fn refuse_innermost(error: TraceError) {
    OPEN.with_borrow_mut(|open| {
        if let Some(innermost) = open.last_mut() {
            innermost.error.get_or_insert(error);
        }
    });
}
