//! What is shown of a run.

use crate::recording::Recording;

/// A motion on a page.
#[derive(Clone, Copy, Debug)]
pub struct Motion<'a> {
    /// The method's name.
    pub name: &'a str,
    /// What is told of it, in a line.
    pub facts: &'a str,
    /// What was seen of it.
    pub recording: &'a Recording,
}
