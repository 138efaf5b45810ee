//! Marks at the points of a line.

/// What is drawn at each point of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Marker {
    Circle,
    Square,
    Diamond,
    Triangle,
    TriangleDown,
    Plus,
    Cross,
}

impl Marker {
    /// The path of the mark, from its middle; it is filled, and stroked two pixels wide.
    pub(crate) fn outline(self) -> &'static str {
        match self {
            Self::Circle => "m-3.5 0a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0-7 0z",
            Self::Square => "m-3.1-3.1h6.2v6.2h-6.2z",
            Self::Diamond => "m0-4.8l4.8 4.8-4.8 4.8-4.8-4.8z",
            Self::Triangle => "m0-4.6l4 6.9h-8z",
            Self::TriangleDown => "m0 4.6l4-6.9h-8z",
            Self::Plus => "m-5 0h10m-5-5v10",
            Self::Cross => "m-4-4l8 8m0-8l-8 8",
        }
    }
}
