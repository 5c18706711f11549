//! Limits that hold before the TOML parser sees the text.
//!
//! The parser is recursive, keeps all prefixes of table headers and looks up dotted keys one by one.

use alloc::format;

use toml_span::tokens::{Token, Tokenizer};

use super::report::Sink;

/// The largest robot file, in bytes.
pub const MAX_BYTES: usize = 1 << 20;
/// Arrays and tables inside each other, and parts of a dotted key.
const MAX_DEPTH: usize = 16;
/// Keys and table headers of a file: 64 joints need about 1300.
const MAX_KEYS: usize = 8192;
/// The longest string or key, in bytes.
const MAX_STRING: usize = 4096;

pub(super) fn admits(source: &str, sink: &mut Sink) -> bool {
    if source.len() > MAX_BYTES {
        // The length stays unknown: no more than this is read of a file.
        let message = format!("the file is too long: a robot file has at most {MAX_BYTES} bytes");
        sink.error(0..0, message, "is this the right file?");
        return false;
    }
    let mut tokens = Tokenizer::new(source);
    let (mut depth, mut parts, mut keys) = (0usize, 0usize, 0usize);
    let mut line_starts = true;
    // An invalid token is left to the parser, which stops there as well.
    while let Ok(Some((span, token))) = tokens.step() {
        match token {
            Token::LeftBracket | Token::LeftBrace => {
                keys += usize::from(line_starts && depth == 0);
                depth += 1;
            }
            Token::RightBracket | Token::RightBrace => depth = depth.saturating_sub(1),
            Token::Period => parts += 1,
            Token::Equals => keys += 1,
            _ => {}
        }
        match token {
            Token::Period | Token::Whitespace(_) | Token::Keylike(_) | Token::String { .. } => {}
            _ => parts = 0,
        }
        line_starts = match token {
            Token::Newline => true,
            Token::Whitespace(_) => line_starts,
            _ => false,
        };
        let length = match token {
            Token::Keylike(text) => text.len(),
            Token::String { src, .. } => src.len(),
            _ => 0,
        };
        let problem = if depth > MAX_DEPTH || parts > MAX_DEPTH {
            format!("nested more than {MAX_DEPTH} levels deep")
        } else if length > MAX_STRING {
            format!("a word of more than {MAX_STRING} bytes")
        } else if keys > MAX_KEYS {
            format!("more than {MAX_KEYS} keys and tables")
        } else {
            continue;
        };
        sink.error(span.start..span.end, problem, "a robot file needs less");
        return false;
    }
    true
}
