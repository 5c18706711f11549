//! The ellipse that a link's inertia is seen as.

use super::page::Ellipse;
use super::view::View;

/// Returns the outline of the solid ellipsoid of uniform density with this mass and
/// inertia; none of a point or of what is no body.
///
/// With Σ = ∫ x xᵀ dm = ½ tr(I) 1 − I the ellipsoid is xᵀ (5 Σ/m)⁻¹ x ≤ 1, since a
/// half axis a has second moment m a²/5. The shadow of xᵀ M⁻¹ x ≤ 1 on a plane is
/// yᵀ N⁻¹ y ≤ 1, where N is M's block for that plane.
pub(super) fn seen(mass: f64, inertia: &[[f64; 3]; 3], view: &View) -> Option<Ellipse> {
    let half_trace = 0.5 * (inertia[0][0] + inertia[1][1] + inertia[2][2]);
    let second = |i: usize, k: usize| {
        let diagonal = if i == k { half_trace } else { 0.0 };
        5.0 * (diagonal - inertia[i][k]) / mass
    };
    let [right, up] = view.coordinates;
    ellipse(
        [second(right, right), second(right, up), second(up, up)],
        view.scale(),
    )
}

/// Returns how far the ellipsoid goes from its centre along each axis of the base; none of
/// what is no body.
pub(super) fn reach(mass: f64, inertia: &[[f64; 3]; 3]) -> Option<[f64; 3]> {
    let half_trace = 0.5 * (inertia[0][0] + inertia[1][1] + inertia[2][2]);
    let squares = [0, 1, 2].map(|k| 5.0 * (half_trace - inertia[k][k]) / mass);
    let is_body = squares.iter().all(|square| square.is_finite());
    is_body.then(|| squares.map(|square| libm::sqrt(square.max(0.0))))
}

/// Makes the ellipse of the block [[a, b], [b, c]].
fn ellipse([a, b, c]: [f64; 3], scale: f64) -> Option<Ellipse> {
    let (mean, difference) = (0.5 * (a + c), 0.5 * (a - c));
    let spread = libm::sqrt(difference * difference + b * b);
    let [large, small] = [mean + spread, mean - spread];
    // A flat body seen from its side has rounding for a thickness.
    if large <= 0.0 || small < -1e-9 * large {
        return None;
    }
    let turned = 0.5 * libm::atan2(b, difference).to_degrees();
    Some(Ellipse {
        half: [large, small.max(0.0)].map(|square| scale * libm::sqrt(square)),
        turned,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A solid ellipsoid with half axes 3, 2 along x and y.
    #[test]
    fn half_axes_come_back() {
        let found = ellipse([9.0, 0.0, 4.0], 10.0).expect("a body");
        assert_eq!((found.half, found.turned), ([30.0, 20.0], 0.0));
        let upright = ellipse([4.0, 0.0, 9.0], 1.0).expect("a body");
        assert_eq!((upright.half, upright.turned), ([3.0, 2.0], 90.0));
        // Turned by 45°: [[6.5, 2.5], [2.5, 6.5]].
        let turned = ellipse([6.5, 2.5, 6.5], 1.0).expect("a body");
        assert!((turned.turned - 45.0).abs() < 1e-12);
        assert!((turned.half[0] - 3.0).abs() < 1e-12 && (turned.half[1] - 2.0).abs() < 1e-12);
        assert_eq!(ellipse([1.0, 0.0, -1.0], 1.0), None);
        assert_eq!(ellipse([0.0, 0.0, 0.0], 1.0), None);
    }
}
