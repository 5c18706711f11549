//! The words and signs of a text, each with its line.

use crate::fault::Fault;

/// The longest text.
const MOST_BYTES: usize = 1 << 20;

/// A word, a literal or a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token<'t> {
    /// As it stands in the text.
    pub text: &'t str,
    /// Its line, from one.
    pub line: usize,
}

/// Cuts a text into tokens: words of letters, digits, `_` and (behind a digit) points,
/// `::` and `->`, and single signs. Comments and strings are no tokens.
///
/// # Errors
/// Any other character.
pub fn tokens(text: &str) -> Result<Vec<Token<'_>>, Fault> {
    if text.len() > MOST_BYTES {
        return Err(Fault::Text(1, format!("more than {MOST_BYTES} bytes")));
    }
    let (mut tokens, mut line, mut rest) = (Vec::new(), 1, text);
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '\n' | ' ' => {
                line += usize::from(first == '\n');
                rest = &rest[1..];
                continue;
            }
            '0'..='9' => literal(rest.as_bytes()),
            'a'..='z' | 'A'..='Z' | '_' => {
                let inside = |c: char| c.is_ascii_alphanumeric() || c == '_';
                rest.find(|c| !inside(c)).unwrap_or(rest.len())
            }
            ':' if rest.starts_with("::") => 2,
            '-' if rest.starts_with("->") => 2,
            '(' | ')' | '[' | ']' | '{' | '}' | '&' | ':' | ';' | ',' | '=' | '+' | '-' | '*'
            | '#' => 1,
            other => {
                let why = format!("the character {other:?} has no place in such a text");
                return Err(Fault::Text(line, why));
            }
        };
        let (text, behind) = rest.split_at(length);
        tokens.push(Token { text, line });
        rest = behind;
    }
    Ok(tokens)
}

/// The length of a literal: digits and points, and an exponent with its sign.
fn literal(text: &[u8]) -> usize {
    let mut length = 0;
    while let Some(byte) = text.get(length) {
        let is_sign = matches!(byte, b'+' | b'-') && text[length - 1] == b'e';
        if !byte.is_ascii_digit() && !matches!(byte, b'.' | b'e') && !is_sign {
            break;
        }
        length += 1;
    }
    length
}
