//! Names that users chose, inside documentation.

/// Returns the name as text that no reader of documentation takes for markup: a bar
/// would end a table's cell, a backtick begin code, `<` an HTML tag.
///
/// Markdown lets a backslash stand before any ASCII punctuation. It is left out
/// before what means nothing inside a word, so that usual names stay as they are.
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

#[cfg(test)]
mod tests {
    use super::escaped;

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
