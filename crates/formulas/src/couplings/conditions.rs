//! The conditions on a robot's bodies under which a coefficient vanishes, for its geometry.
//!
//! A coefficient is linear in base parameters: Σ_b f_b(q) B_b. It is zero if and only if Σ_b c_b B_b = 0
//! for the coefficients c of each of its monomials in q. In echelon form these are as few conditions as
//! there can be.

use std::collections::BTreeMap;

use dalembert_model::equations::chain::MomentBody;
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};

use crate::bodies::{BaseMoments, MOMENTS, body_of};
use crate::canonical::add;
use crate::number::Number;
use crate::ring::Polynomial;
use crate::write::signed_sum;

/// A linear condition on base parameters: the sum of each times its factor is zero. The last one has
/// the factor one.
pub(crate) type Condition = BTreeMap<usize, Number>;

/// Returns the conditions of a coefficient whose parameters are base parameters.
pub(crate) fn conditions(coefficient: &Polynomial) -> Vec<Condition> {
    let mut rows: BTreeMap<u128, Condition> = BTreeMap::new();
    for (monomial, x) in coefficient.terms() {
        if let Some(parameter) = monomial.symbols.parameter_index() {
            rows.entry(monomial.motion)
                .or_default()
                .insert(parameter, *x);
        }
    }
    let mut echelon: Vec<Condition> = Vec::new();
    for mut row in rows.into_values() {
        for other in &echelon {
            subtract(&mut row, other);
        }
        let Some((&lead, &x)) = row.last_key_value() else {
            continue;
        };
        for factor in row.values_mut() {
            *factor = factor.over(&x).unwrap_or_else(Number::zero);
        }
        for other in &mut echelon {
            if other.contains_key(&lead) {
                subtract(other, &row);
            }
        }
        echelon.push(row);
    }
    echelon.sort_by_key(|row| row.keys().next_back().copied());
    echelon
}

/// Takes away a multiple of a condition, so that its last parameter is gone.
fn subtract(row: &mut Condition, other: &Condition) {
    let Some((lead, _)) = other.last_key_value() else {
        return;
    };
    let Some(factor) = row.get(lead).copied() else {
        return;
    };
    for (parameter, x) in other {
        add(row, *parameter, factor.mul(x).neg());
    }
}

/// Returns random base parameters that meet conditions, as bodies.
pub(crate) fn bodies_that_meet(
    conditions: &[Condition],
    moments: &BaseMoments,
    kinds: &[JointKind],
    seed: u64,
) -> Vec<MomentBody<Field>> {
    let mut points = Points::new(seed);
    let mut values: Vec<Field> = (0..moments.len()).map(|_| points.field()).collect();
    for condition in conditions {
        let Some((&lead, _)) = condition.last_key_value() else {
            continue;
        };
        let others = condition.range(..lead);
        let terms = others.map(|(parameter, x)| values[*parameter].mul(&x.residue()));
        let sum = terms.fold(Field::ZERO, |sum, x| sum.add(&x));
        values[lead] = sum.neg();
    }
    let body = |(link, kind): (usize, &JointKind)| {
        let mut moments_of_link = [Field::ZERO; MOMENTS.len()];
        for (parameter, (of, moment)) in moments.iter().enumerate() {
            if *of == link {
                moments_of_link[*moment] = values[parameter];
            }
        }
        body_of(*kind, moments_of_link)
    };
    kinds.iter().enumerate().map(body).collect()
}

/// Writes conditions in words: of link i* the body with what has moved into it.
pub(crate) fn in_words(
    conditions: &[Condition],
    moments: &BaseMoments,
    numbers: &[usize],
    kinds: &[JointKind],
) -> Vec<String> {
    let is_single = |condition: &&Condition| condition.len() == 1;
    let (singles, sums): (Vec<_>, Vec<_>) = conditions.iter().partition(is_single);
    let mut alone: Vec<(usize, &str)> = Vec::new();
    for &parameter in singles.into_iter().flat_map(Condition::keys) {
        alone.push((moments[parameter].0, MOMENTS[moments[parameter].1]));
    }
    let mut words = Vec::new();
    for (link, &number) in numbers.iter().enumerate() {
        let of_link = alone.iter().filter(|(of, _)| *of == link);
        let mut zero_moments: Vec<&str> = of_link.map(|(_, moment)| *moment).collect();
        let patterns = [
            (
                ["MX", "MY"],
                format!("the centre of link {number}* is on axis {number}"),
            ),
            (
                ["XZ", "YZ"],
                format!("axis {number} is a principal axis of link {number}*"),
            ),
            (
                ["XX", "XY"],
                format!("link {number}* has equal moments across axis {number}"),
            ),
        ];
        for (pattern, text) in patterns {
            let is_whole = pattern.iter().all(|moment| zero_moments.contains(moment));
            if is_whole && kinds[link] == JointKind::Revolute {
                zero_moments.retain(|moment| !pattern.contains(moment));
                words.push(text);
            }
        }
        let zeros = zero_moments.iter();
        words.extend(zeros.map(|moment| format!("{moment}{number} = 0")));
    }
    words.extend(sums_in_words(sums, moments, numbers));
    words
}

/// Writes conditions that combine base parameters. XZ + r MX = 0 and YZ + r MY = 0 say that the axis is
/// principal at the point r along it.
fn sums_in_words(
    mut sums: Vec<&Condition>,
    moments: &BaseMoments,
    numbers: &[usize],
) -> Vec<String> {
    let mut words = Vec::new();
    while let Some(condition) = sums.first().copied() {
        sums.remove(0);
        let partner = along_axis(condition, moments).and_then(|(link, product, r)| {
            let other = if product == "XZ" { "YZ" } else { "XZ" };
            let is_partner = |next: &&Condition| {
                along_axis(next, moments).is_some_and(|(at, its, place)| {
                    at == link && its == other && place.residue() == r.residue()
                })
            };
            Some((link, r, sums.iter().position(is_partner)?))
        });
        match partner {
            Some((link, r, place)) => {
                sums.remove(place);
                let (number, sign) = (numbers[link], if r.is_negative() { "−" } else { "" });
                let size = r.abs().rounded(6);
                words.push(format!(
                    "axis {number} is a principal axis of link {number}* at the point {sign}{size} m along it"
                ));
            }
            None => words.push(equation(condition, moments, numbers)),
        }
    }
    words
}

/// Returns the link, the product of inertia and r of a condition XZ + r MX = 0 or YZ + r MY = 0.
fn along_axis(
    condition: &Condition,
    moments: &BaseMoments,
) -> Option<(usize, &'static str, Number)> {
    let mut terms = condition.iter();
    let ((first, r), (second, one)) = (terms.next()?, terms.next()?);
    let [(link, moment), (other, product)] = [moments[*first], moments[*second]];
    let pair = [MOMENTS[moment], MOMENTS[product]];
    let fits = pair == ["MX", "XZ"] || pair == ["MY", "YZ"];
    let is_along = fits && link == other && one.is_one() && terms.next().is_none();
    is_along.then_some((link, MOMENTS[product], *r))
}

fn equation(condition: &Condition, moments: &BaseMoments, numbers: &[usize]) -> String {
    let terms = condition.iter().map(|(&parameter, x)| {
        let (link, moment) = moments[parameter];
        let name = format!("{}{}", MOMENTS[moment], numbers[link]);
        let size = x.abs();
        let factor = match size.is_one() {
            true => String::new(),
            false => size.rounded(6) + "·",
        };
        (x.is_negative(), factor + &name)
    });
    signed_sum(terms, "−") + " = 0"
}
