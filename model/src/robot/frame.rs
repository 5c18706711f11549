//! Names of frames.

/// The name by which a robot's own hand is a frame, too.
pub const HAND: &str = "hand";

/// The longest name: functions are called after it.
const MAX_BYTES: usize = 48;

/// The endings of the other ways to call a function.
pub(crate) const ENDINGS: [&str; 2] = ["_batch", "_columns"];

/// Returns whether a frame may have this name: small letters, digits and single `_`
/// between them, and no ending that is one of functions' own.
pub fn is_frame_name(name: &str) -> bool {
    let known = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let is_within = (1..=MAX_BYTES).contains(&name.len()) && name.chars().all(known);
    let is_own = ENDINGS.iter().any(|ending| name.ends_with(ending));
    let bars = name.starts_with('_') || name.ends_with('_') || name.contains("__");
    is_within && !bars && !is_own
}
