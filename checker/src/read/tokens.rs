//! Lines of a text in Rust or in C without comments; their words, numbers and signs.

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
/// All signs; in C, a directive begins with one more.
const SIGNS: &str = "+-*/=.,;:()[]{}<>&!? ";
const RUST_SIGNS: &str = "+-*/=.,;:()[]{}<>&!? #";

/// Returns true for a character of a name.
pub(crate) fn is_letter(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// Returns true if a text has letters and these signs alone, and no comment.
pub(crate) fn has_only(text: &str, signs: &str) -> bool {
    let known = |c: char| is_letter(c) || signs.contains(c);
    text.chars().all(known) && !text.contains("//") && !text.contains("/*")
}

/// Returns the lines that are neither empty nor comments, with their numbers.
///
/// # Errors
/// The first line that is none of generated code: a compiler might read it otherwise.
pub(crate) fn lines(source: &str, is_c: bool) -> Result<Vec<(usize, &str)>, TextError> {
    let (mut all, mut is_comment) = (Vec::new(), false);
    for (number, line) in (1..).zip(source.split('\n')) {
        let words = line.trim_matches(' ');
        // A line that goes on in the next, and three characters for one, mean something else in C.
        let is_strange = is_c && (line.contains('\\') || line.contains("??"));
        let mut is_good = !line.contains('\r') && !is_strange;
        // The star that opens a comment does not end it.
        let comment = match is_comment {
            true => Some(words),
            false => words.strip_prefix("/*").filter(|_| is_c),
        };
        if let Some(comment) = comment {
            let end = comment.split_once("*/");
            is_good &= end.is_none_or(|(_, behind)| behind.is_empty());
            is_comment = end.is_none();
        } else if !words.is_empty() && (is_c || !words.starts_with("//")) {
            is_good &= match is_c {
                true => words.starts_with('#') || has_only(words, SIGNS),
                false => has_only(words, RUST_SIGNS),
            };
            all.push((number, words));
        }
        if !is_good {
            let why = format!("nothing that is generated: `{line}`");
            return Err(TextError::new(number, why));
        }
    }
    Ok(all)
}

/// Reads a text.
///
/// # Errors
/// As [`lines`].
pub(super) fn read(source: &str, is_c: bool) -> Result<Vec<Token<'_>>, TextError> {
    let mut all = Vec::new();
    for (line, mut rest) in lines(source, is_c)? {
        while !rest.is_empty() {
            let (text, behind) = rest.split_at(length(rest, is_c));
            all.push(Token { text, line });
            rest = behind.trim_start_matches(' ');
        }
    }
    Ok(all)
}

/// Returns the length of the token that a line begins with.
fn length(line: &str, is_c: bool) -> usize {
    let is_number = line.starts_with(|c: char| c.is_ascii_digit());
    let ends = |(place, c): (usize, char)| {
        let is_exponent = line[..place].ends_with('e') && ['+', '-'].contains(&c);
        !(is_letter(c) || is_number && (c == '.' || is_exponent))
    };
    let is_pair = PAIRS.iter().any(|pair| line.starts_with(pair));
    match line.char_indices().position(ends) {
        _ if is_c && line.starts_with('#') => line.len(),
        Some(0) => 1 + usize::from(is_pair),
        end => end.unwrap_or(line.len()),
    }
}
