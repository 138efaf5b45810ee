//! The bundled font: how wide a text is, and what of it fits.

use std::sync::LazyLock;

use skrifa::charmap::Charmap;
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::GlyphMetrics;
use skrifa::{FontRef, MetadataProvider};

/// A subset of DejaVu Sans: Latin, Greek and the signs of mathematics.
pub(crate) static SUBSET: &[u8] = include_bytes!("../assets/DejaVuSans-subset.ttf");

/// Its name, and stand-ins for those who view an SVG without it.
pub(crate) const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

/// From the baseline to the middle of a capital, in ems.
pub(crate) const HALF_CAPITAL: f64 = 0.3645;

/// Width of a character that the font lacks, in ems.
const UNKNOWN: f64 = 0.6;

/// Of sums of widths, in pixels.
const ROUNDING: f64 = 0.01;

/// Its characters, and their widths in ems.
static FONT: LazyLock<Option<(Charmap, GlyphMetrics)>> = LazyLock::new(|| {
    let font = FontRef::new(SUBSET).ok()?;
    let metrics = font.glyph_metrics(Size::new(1.0), LocationRef::default());
    Some((font.charmap(), metrics))
});

/// Width of a character in ems, if the font has it.
fn advance(c: char) -> Option<f64> {
    let (characters, metrics) = FONT.as_ref()?;
    let width = metrics.advance_width(characters.map(c)?)?;
    Some(f64::from(width))
}

/// Width of a text whose em is `size`, in the unit of `size`.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let ems = text.chars().map(|c| advance(c).unwrap_or(UNKNOWN));
    ems.sum::<f64>() * size
}

/// Width of the widest of some texts.
pub(crate) fn widest<'a>(texts: impl IntoIterator<Item = &'a str>, size: f64) -> f64 {
    let widths = texts.into_iter().map(|text| width(text, size));
    widths.fold(0.0, f64::max)
}

/// A text and a size with which it fits into `room`: smaller at first, then cut.
pub(crate) fn fit(text: &str, size: f64, room: f64) -> (String, f64) {
    let natural = width(text, size);
    if natural <= room {
        return (text.to_owned(), size);
    }
    let small = size * (room / natural).max(0.7);
    (cut(text, small, room), small)
}

/// As much of a text as fits into `room`, the rest replaced by an ellipsis.
pub(crate) fn cut(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room + ROUNDING {
        return text.to_owned();
    }
    let mut used = width("…", size);
    let kept = text.chars().take_while(|c| {
        used += width(c.encode_utf8(&mut [0; 4]), size);
        used <= room
    });
    kept.chain(['…']).collect()
}

/// A paragraph in lines of at most `room`.
pub(crate) fn wrap(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    for word in text.split_whitespace() {
        let longer = lines.last().map(|line| format!("{line} {word}"));
        match (longer, lines.last_mut()) {
            (Some(longer), Some(last)) if width(&longer, size) <= room => *last = longer,
            _ => lines.push(cut(word, size, room)),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_grow_with_text_and_size() {
        assert_eq!(width("", 20.0), 0.0);
        let one = width("m", 20.0);
        assert!((one - 0.974 * 20.0).abs() < 0.3, "{one}");
        assert!(width("mm", 20.0) > 1.9 * one);
    }

    #[test]
    fn long_texts_shrink_and_are_then_cut() {
        assert_eq!(fit("short", 20.0, 500.0), ("short".into(), 20.0));
        let room = 0.8 * width("a little long", 20.0);
        let (text, size) = fit("a little long", 20.0, room);
        assert!(text == "a little long" && size < 20.0);
        let (text, size) = fit(&"very long ".repeat(30), 20.0, 100.0);
        assert!(text.ends_with('…') && width(&text, size) <= 100.0);
    }

    #[test]
    fn paragraphs_are_broken_between_words() {
        let room = width("a few more", 20.0);
        let lines = wrap("a few more words", 20.0, room + 1.0);
        assert_eq!(lines, ["a few more", "words"]);
        assert!(wrap(" ", 20.0, room).is_empty());
    }

    #[test]
    fn the_subset_has_the_signs_of_mechanics() {
        assert!(advance('\u{e000}').is_none());
        for c in "‖∂Δ−×·°±≤⁰¹²³⁴⁵⁶⁷⁸⁹⁻₀₁₂₃αβθλμωξΩΣ∞√∫…–∈ℝé".chars()
        {
            assert!(advance(c).is_some(), "{c}");
        }
    }
}
