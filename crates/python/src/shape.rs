//! Shapes: how Python writes them, and how leading axes are broadcast.

pub(crate) fn shown(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        _ => {
            let lengths: Vec<String> = shape.iter().map(usize::to_string).collect();
            format!("({})", lengths.join(", "))
        }
    }
}

/// Broadcasts two shapes by NumPy's rule; `None` where they do not fit.
pub(crate) fn broadcast(left: &[usize], right: &[usize]) -> Option<Vec<usize>> {
    let axes = left.len().max(right.len());
    // The length of an axis, counted from the last.
    let length = |shape: &[usize], axis: usize| {
        let place = (axis + shape.len()).checked_sub(axes);
        place.map_or(1, |place| shape[place])
    };
    let both = |axis| match (length(left, axis), length(right, axis)) {
        (1, other) | (other, 1) => Some(other),
        (one, other) => (one == other).then_some(one),
    };
    (0..axes).map(both).collect()
}
