//! The palette.

/// Red, green and blue, 0 to 255 each.
pub(crate) type Rgb = (u8, u8, u8);

pub(crate) const PAPER: Rgb = (255, 255, 255);
/// Of texts.
pub(crate) const INK: Rgb = (26, 26, 26);
/// Of axes.
pub(crate) const FRAME: Rgb = (90, 90, 90);
/// Of the lines that lead from a curve to its name.
pub(crate) const LEADER: Rgb = (170, 170, 170);
/// Of the lines across a chart at its ticks.
pub(crate) const RULE: Rgb = (229, 229, 229);

/// A colour of the Okabe–Ito palette, whose colours can be told apart with any colour vision.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Colour {
    Black,
    Orange,
    SkyBlue,
    BluishGreen,
    Yellow,
    Blue,
    Vermillion,
    ReddishPurple,
}

impl Colour {
    /// Red, green and blue, 0 to 255 each.
    ///
    /// ```
    /// # use figure::Colour;
    /// assert_eq!(Colour::Vermillion.rgb(), (213, 94, 0));
    /// ```
    #[must_use]
    pub const fn rgb(self) -> (u8, u8, u8) {
        match self {
            Colour::Black => (0, 0, 0),
            Colour::Orange => (230, 159, 0),
            Colour::SkyBlue => (86, 180, 233),
            Colour::BluishGreen => (0, 158, 115),
            Colour::Yellow => (240, 228, 66),
            Colour::Blue => (0, 114, 178),
            Colour::Vermillion => (213, 94, 0),
            Colour::ReddishPurple => (204, 121, 167),
        }
    }
}
