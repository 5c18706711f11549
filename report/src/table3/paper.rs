//! The polynomials of Table 3, over a common denominator.

use dalembert_model::equations::Formulation;

use super::Pair;

/// Returns what the paper counts for n joints.
pub fn counts(formulation: Formulation, n: u64) -> Pair {
    let powers = |[n4, n3, n2, n1, n0]: [u64; 5], denominator: u64| {
        ((((n4 * n + n3) * n + n2) * n + n1) * n + n0) / denominator
    };
    match formulation {
        Formulation::LagrangeEuler => Pair {
            mul: powers([128, 512, 739, 160, 0], 3),
            add: powers([196, 781, 1118, 245, 0], 6),
        },
        Formulation::Dalembert => Pair {
            mul: powers([0, 13, 315, 536, 414], 6),
            add: powers([0, 4, 132, 146, 135], 3),
        },
        _ => Pair {
            mul: 132 * n,
            add: (111 * n).saturating_sub(4),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_rows() {
        let rows = |formulation| (1..=7).map(|n| counts(formulation, n)).collect::<Vec<_>>();
        let pairs = |list: [(u64, u64); 7]| list.map(|(mul, add)| Pair { mul, add }).to_vec();
        assert_eq!(
            rows(Formulation::LagrangeEuler),
            pairs([
                (513, 390),
                (3140, 2391),
                (10441, 7960),
                (26000, 19838),
                (54425, 41550),
                (101348, 77405),
                (173425, 132496)
            ])
        );
        assert_eq!(
            rows(Formulation::NewtonEulerLink),
            pairs([
                (132, 107),
                (264, 218),
                (396, 329),
                (528, 440),
                (660, 551),
                (792, 662),
                (924, 773)
            ])
        );
        assert_eq!(
            rows(Formulation::Dalembert),
            pairs([
                (213, 139),
                (475, 329),
                (868, 623),
                (1405, 1029),
                (2099, 1555),
                (2963, 2209),
                (4010, 2999)
            ])
        );
    }
}
