//! Names and sentences that users chose, inside documentation.

/// A bar would end a table's cell, a backtick begin code, `<` a tag: Markdown lets a backslash
/// stand before any ASCII punctuation. It is left out before what means nothing inside a word.
pub(super) fn escaped(name: &str) -> String {
    let harmless = |c: char| matches!(c, '_' | '-' | '.' | ',' | '\'' | '(' | ')' | '+');
    let last = name.chars().count().saturating_sub(1);
    let mut text = String::new();
    for (index, c) in name.chars().enumerate() {
        let inside = index > 0 && index < last;
        if c.is_ascii_punctuation() && !(harmless(c) && inside) {
            text.push('\\');
        }
        text.push(c);
    }
    text
}

pub(super) fn sentence(text: &str) -> String {
    let is_paired = text.matches('`').count().is_multiple_of(2);
    let (mut is_code, mut marked) = (false, String::new());
    for c in text.chars() {
        is_code ^= is_paired && c == '`';
        let is_markup = !is_code && "\\*_[]<>&|~#`".contains(c);
        if is_markup && !(is_paired && c == '`') {
            marked.push('\\');
        }
        marked.push(c);
    }
    marked
}

#[cfg(test)]
mod tests {
    use super::{escaped, sentence};

    #[test]
    fn sentences_have_names_and_no_markup() {
        for (text, shown) in [
            ("`a_b` is [held](x) at 0.1", "`a_b` is \\[held\\](x) at 0.1"),
            ("`<b>` & <b>", "`<b>` \\& \\<b\\>"),
            ("a ` b", "a \\` b"),
        ] {
            assert_eq!(sentence(text), shown);
        }
    }

    #[test]
    fn usual_names_stay_and_markup_does_not() {
        for usual in ["shoulder", "wrist_bend", "joint-1", "Épaule 2", "J1"] {
            assert_eq!(escaped(usual), usual);
        }
        for (name, text) in [
            ("a|b", "a\\|b"),
            ("`q`", "\\`q\\`"),
            ("<b>", "\\<b\\>"),
            ("_x_", "\\_x\\_"),
            ("*", "\\*"),
            ("[`N`]", "\\[\\`N\\`\\]"),
            ("\\", "\\\\"),
            ("&lt;", "\\&lt\\;"),
            ("", ""),
        ] {
            assert_eq!(escaped(name), text);
        }
    }
}
