//! Names of frames.

/// The name by which a robot's own hand is a frame, too.
pub const HAND: &str = "hand";

/// The longest name: functions are called after it.
const MAX_BYTES: usize = 48;

/// Returns whether a frame may have this name: small letters, digits and single `_`
/// between them.
pub fn is_frame_name(name: &str) -> bool {
    let known = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let is_within = (1..=MAX_BYTES).contains(&name.len()) && name.chars().all(known);
    is_within && !name.starts_with('_') && !name.ends_with('_') && !name.contains("__")
}
