//! The bundled font: registration, and how wide a text is.

use std::sync::OnceLock;

use plotters::style::{FontDesc, FontStyle, register_font};

use crate::FigureError;

static SUBSET: &[u8] = include_bytes!("../assets/DejaVuSans-subset.ttf");

/// The bundled font under a name that, in an SVG, lists its stand-ins.
pub(crate) const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

/// Height of a line of the font (ascent and descent) in ems; the bitmap backend
/// sizes fonts by it.
pub(crate) const LINE_PER_EM: f64 = 2384.0 / 2048.0;

/// Widths are measured at this many pixels per em, they come as whole pixels.
const FINE: f64 = 100.0;

/// Makes the font known to the drawing library, once.
pub(crate) fn register() -> Result<(), FigureError> {
    static DONE: OnceLock<bool> = OnceLock::new();
    let ok = *DONE.get_or_init(|| register_font(FAMILY, FontStyle::Normal, SUBSET).is_ok());
    ok.then_some(())
        .ok_or_else(|| FigureError::draw("the bundled font is not readable"))
}

/// Width of a text whose em is `size`, in the unit of `size`.
pub(crate) fn width(text: &str, size: f64) -> Result<f64, FigureError> {
    let font = FontDesc::new(FAMILY.into(), FINE * LINE_PER_EM, FontStyle::Normal);
    let (pixels, _) = font.box_size(text).map_err(FigureError::draw)?;
    Ok(f64::from(pixels) / FINE * size)
}

/// A text and a size with which it fits into `room`: smaller at first, then cut.
pub(crate) fn fit(text: &str, size: f64, room: f64) -> Result<(String, f64), FigureError> {
    let natural = width(text, size)?;
    if natural <= room {
        return Ok((text.to_owned(), size));
    }
    let small = size * (room / natural).max(0.7);
    Ok((cut(text, small, room)?, small))
}

/// As much of a text as fits into `room`, the rest replaced by an ellipsis.
pub(crate) fn cut(text: &str, size: f64, room: f64) -> Result<String, FigureError> {
    let mut kept: Vec<char> = text.chars().collect();
    let mut shown = text.to_owned();
    while !kept.is_empty() && width(&shown, size)? > room {
        kept.pop();
        shown = kept.iter().chain(&['…']).collect();
    }
    Ok(shown)
}

/// A paragraph in lines of at most `room`.
pub(crate) fn wrap(text: &str, size: f64, room: f64) -> Result<Vec<String>, FigureError> {
    let mut lines: Vec<String> = vec![];
    for word in text.split_whitespace() {
        let longer = lines.last().map(|line| format!("{line} {word}"));
        match (longer, lines.last_mut()) {
            (Some(longer), Some(last)) if width(&longer, size)? <= room => *last = longer,
            _ => lines.push(cut(word, size, room)?),
        }
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_grow_with_text_and_size() {
        register().unwrap();
        assert_eq!(width("", 20.0).unwrap(), 0.0);
        let one = width("m", 20.0).unwrap();
        assert!((one - 0.974 * 20.0).abs() < 0.3, "{one}");
        assert!(width("mm", 20.0).unwrap() > 1.9 * one);
    }

    #[test]
    fn long_texts_shrink_and_are_then_cut() {
        register().unwrap();
        assert_eq!(fit("short", 20.0, 500.0).unwrap(), ("short".into(), 20.0));
        let room = 0.8 * width("a little long", 20.0).unwrap();
        let (text, size) = fit("a little long", 20.0, room).unwrap();
        assert!(text == "a little long" && size < 20.0);
        let (text, size) = fit(&"very long ".repeat(30), 20.0, 100.0).unwrap();
        assert!(text.ends_with('…') && width(&text, size).unwrap() <= 100.0);
    }

    #[test]
    fn paragraphs_are_broken_between_words() {
        register().unwrap();
        let room = width("a few more", 20.0).unwrap();
        let lines = wrap("a few more words", 20.0, room + 1.0).unwrap();
        assert_eq!(lines, ["a few more", "words"]);
        assert!(wrap(" ", 20.0, room).unwrap().is_empty());
    }

    #[test]
    fn the_subset_has_the_signs_of_mechanics() {
        use plotters::style::FontDesc;
        register().unwrap();
        let font = FontDesc::new(FAMILY.into(), 40.0, FontStyle::Normal);
        // A missing glyph would draw the box of .notdef, as U+E000 does.
        let picture = |c: char| {
            let mut pixels = Vec::new();
            font.draw(&c.to_string(), (0, 0), |x, y, _| {
                pixels.push((x, y));
                Ok::<(), ()>(())
            })
            .unwrap()
            .unwrap();
            pixels
        };
        let missing = picture('\u{e000}');
        for c in "‖∂Δ−×·°±≤⁰¹²³⁴⁵⁶⁷⁸⁹⁻₀₁₂₃αβθλμωξΩΣ∞√∫…–∈ℝé".chars()
        {
            assert_ne!(picture(c), missing, "{c}");
        }
    }
}
