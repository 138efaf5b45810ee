//! The text of a URDF, before it is parsed.

use crate::error::UrdfError;

/// The most elements inside each other: a URDF has six, and parsers call themselves for each.
const DEEPEST: usize = 64;

/// What is between `<` and `>` and is no element, by its ends.
const OTHERS: [[&str; 2]; 3] = [["!--", "-->"], ["![CDATA[", "]]>"], ["?", "?>"]];

/// The robot that the text describes.
pub(crate) fn parse(text: &str) -> Result<urdf_rs::Robot, UrdfError> {
    let no_urdf = |reason: String| UrdfError::Text { reason };
    if depth(text) > DEEPEST {
        let reason = format!("more than {DEEPEST} elements are inside each other");
        return Err(no_urdf(reason));
    }
    urdf_rs::read_from_string(text).map_err(|error| no_urdf(error.to_string()))
}

/// How many elements are inside each other at most, or more where the text is no XML.
fn depth(text: &str) -> usize {
    let (mut rest, mut depth, mut deepest) = (text, 0_usize, 0);
    while let Some((_, after)) = rest.split_once('<') {
        let other = OTHERS.iter().find(|[start, _]| after.starts_with(start));
        let end = other.map_or(">", |[_, end]| end);
        let (inner, next) = after.split_once(end).unwrap_or((after, ""));
        match (other, inner.starts_with('/'), inner.ends_with('/')) {
            (Some(_), ..) => {}
            (None, true, _) => depth = depth.saturating_sub(1),
            (None, false, true) => deepest = deepest.max(depth + 1),
            (None, false, false) => {
                depth += 1;
                deepest = deepest.max(depth);
            }
        }
        rest = next;
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_ends_are_no_elements() {
        let text =
            "<?xml version='1.0'?><a><!-- <b><b> --><b c='1'/><b><c>d</c></b><![CDATA[<b>]]></a>";
        assert_eq!(depth(text), 3);
    }

    #[test]
    fn a_text_that_goes_deep_is_refused() {
        let deep = |depth: usize| "<a>".repeat(depth) + &"</a>".repeat(depth);
        let error = parse(&deep(1_000_000)).unwrap_err();
        assert!(error.to_string().contains("64"), "{error}");
        assert!(parse(&deep(DEEPEST)).is_ok());
    }
}
