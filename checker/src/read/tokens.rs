//! Words, numbers and signs of a text in Rust or in C, without comments.

use super::TextError;

/// A word, a number or a sign; of a directive in C the whole line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token<'t> {
    /// The characters.
    pub text: &'t str,
    /// The line, from one.
    pub line: usize,
}

/// Signs of two characters.
const PAIRS: [&str; 7] = ["::", "->", "<=", "==", "!=", "&&", "++"];

/// Reads a text.
///
/// # Errors
/// The first character that is none of generated code: a compiler might read it otherwise.
pub(super) fn read(source: &str, is_c: bool) -> Result<Vec<Token<'_>>, TextError> {
    let (mut all, mut is_comment) = (Vec::new(), false);
    for (index, whole) in source.split('\n').enumerate() {
        let line = index + 1;
        let strange = || TextError::new(line, format!("nothing that is generated: `{whole}`"));
        let mut rest = whole.trim_start_matches(' ');
        // A line that goes on in the next, and three characters for one, mean something else.
        if whole.contains('\r') || is_c && (whole.contains('\\') || whole.contains("??")) {
            return Err(strange());
        }
        if is_c && !is_comment && rest.starts_with('#') {
            let text = rest.trim_end_matches(' ');
            all.push(Token { text, line });
            continue;
        }
        if !is_c && rest.starts_with("//") {
            continue;
        }
        while !rest.is_empty() {
            if is_comment {
                match rest.split_once("*/") {
                    Some((_, behind)) => (rest, is_comment) = (behind, false),
                    None => break,
                }
            } else if is_c && rest.starts_with("/*") {
                // The star that opens a comment does not end it.
                (rest, is_comment) = (&rest[2..], true);
            } else {
                let text = &rest[..length(rest).ok_or_else(strange)?];
                all.push(Token { text, line });
                rest = &rest[text.len()..];
            }
            rest = rest.trim_start_matches(' ');
        }
    }
    Ok(all)
}

/// Returns the length of the token that a text begins with.
fn length(text: &str) -> Option<usize> {
    let first = text.chars().next()?;
    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if first.is_ascii_digit() {
        let goes_on = |(place, c): (usize, char)| {
            let is_exponent = text[..place].ends_with('e') && ['+', '-'].contains(&c);
            !(is_letter(c) || c == '.' || is_exponent)
        };
        let mut characters = text.char_indices();
        return Some(characters.position(goes_on).unwrap_or(text.len()));
    }
    if is_letter(first) {
        return Some(text.find(|c| !is_letter(c)).unwrap_or(text.len()));
    }
    if text.starts_with("//") || text.starts_with("/*") {
        return None;
    }
    let is_pair = PAIRS.iter().any(|pair| text.starts_with(pair));
    let is_sign = "+-*/=.,;:()[]{}<>&#!?".contains(first);
    is_sign.then_some(if is_pair { 2 } else { 1 })
}
