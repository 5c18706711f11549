//! `[[frame]]` tables: frames that are fixed to links, by their names.

use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;
use core::ops::Range;

use toml_span::Value;

use super::places::Places;
use super::report::quote;
use super::scene::{find_joint, for_joint};
use super::table::Keys;
use super::value::{Context, first_line};
use crate::robot::{Frame, Joint, Place};

/// The keys of a frame.
const KEYS: [&str; 4] = ["name", "link", "xyz", "rpy"];

/// Reads the list of frames; one that cannot be read is reported and left out.
pub(super) fn read(
    cx: &mut Context,
    places: &mut Places,
    joints: &[Joint],
    list: &Value,
) -> Vec<Frame> {
    // Without joints, every link would be unknown as well.
    if joints.is_empty() {
        return Vec::new();
    }
    let Some(items) = list.as_array() else {
        let help = "write [[frame]], with two brackets";
        cx.wanted(list, "[[frame]] tables", help);
        return Vec::new();
    };
    places.keep(Place::Frames, Context::span(list), Some(()), || ());
    let mut frames = Vec::new();
    for (index, item) in items.iter().enumerate() {
        let Some(table) = cx.table(item, "each frame is a [[frame]] table") else {
            continue;
        };
        let keys = Keys {
            table,
            span: first_line(cx.source, Context::span(item)),
            what: format!("frame {}", index + 1),
        };
        let place = Place::Frame(frames.len());
        if let Some((frame, span)) = one(cx, &keys, joints) {
            places.keep(place, span, Some(()), || ());
            frames.push(frame);
        }
    }
    frames
}

fn one(cx: &mut Context, keys: &Keys, joints: &[Joint]) -> Option<(Frame, Range<usize>)> {
    keys.reject_unknown(&KEYS, cx.sink);
    const NAME: &str = "name = \"camera\": functions are called after it, `jacobian_camera`";
    const LINK: &str = "link = 3, or the name of its joint: what the frame is fixed to";
    let name = keys.require("name", NAME, cx.sink);
    let link = keys.require("link", LINK, cx.sink);
    let placement = cx.placement_of(keys);
    let (name, link) = name.zip(link)?;
    let span = first_line(cx.source, Context::span(name));
    let (name, joint) = (cx.string(name), joint(cx, joints, link, LINK));
    let frame = Frame {
        name: name?,
        joint: joint?,
        placement: placement?,
    };
    Some((frame, span))
}

/// Returns the joint that moves a link, by its number, from one, or its name.
pub(super) fn joint(cx: &mut Context, joints: &[Joint], link: &Value, help: &str) -> Option<usize> {
    let text = match (link.as_str(), link.as_integer()) {
        (Some(name), _) => name.to_string(),
        (None, Some(number)) => number.to_string(),
        (None, None) => {
            cx.wanted(link, "a link", help);
            return None;
        }
    };
    let found = find_joint(joints, &text);
    if found.is_none() {
        let message = format!("there is no link {}", quote(&text));
        let help = format!(
            "links have the names of their joints; {}",
            for_joint(joints, &text)
        );
        cx.sink.error(Context::span(link), message, &help);
    }
    found
}
