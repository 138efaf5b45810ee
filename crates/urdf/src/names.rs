//! Names of a scene for those of a file.

use std::collections::HashSet;

/// Names that are given already.
#[derive(Default)]
pub(crate) struct Names(HashSet<String>);

impl Names {
    /// Names that may not be given.
    pub fn without(reserved: &str) -> Self {
        Self(HashSet::from([reserved.to_owned()]))
    }

    /// The name itself where a scene may have it, else the nearest one that no other has.
    pub fn give(&mut self, name: &str) -> String {
        let is_allowed = |c: char| c.is_ascii_alphanumeric() || "-_/.".contains(c);
        let allowed = |c: char| if is_allowed(c) { c } else { '_' };
        let mut name: String = name.chars().map(allowed).collect();
        while name.is_empty() || self.0.contains(&name) {
            name.push('_');
        }
        self.0.insert(name.clone());
        name
    }
}
