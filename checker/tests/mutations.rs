//! A hundred mutations each of constants, operators and indices of a text, and of the
//! claim's numbers: each is refused, or true as the closed form of the planar arm judges.

use dalembert_checker::{Claim, audit};

use crate::support::{claim, file};

/// Numbers below another, the same on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % count
    }
}

/// Returns the torques of two links of 1 m and 1 kg that are thin rods.
fn closed_form(q: [f64; 2], qd: [f64; 2], qdd: [f64; 2]) -> [f64; 2] {
    let (g, (s, c), inertia) = (9.81, q[1].sin_cos(), 0.083_333_333_333_333_33);
    let (one, two) = (q[0].cos(), (q[0] + q[1]).cos());
    let own = 0.25 + inertia;
    let both = own + 0.5 * c;
    let first =
        (own + 1.0 + c + own) * qdd[0] + both * qdd[1] - 0.5 * s * (2.0 * qd[0] + qd[1]) * qd[1];
    [
        first + g * (1.5 * one + 0.5 * two),
        both * qdd[0] + own * qdd[1] + 0.5 * s * qd[0] * qd[0] + 0.5 * g * two,
    ]
}

/// Returns what the text returns, read by means of the test's own.
fn run(text: &str, state: &[[f64; 2]; 3]) -> Option<Vec<f64>> {
    let mut values = std::collections::HashMap::new();
    let value = |word: &str, values: &std::collections::HashMap<String, f64>| -> Option<f64> {
        let (sign, word) = word
            .strip_prefix('-')
            .map_or((1.0, word), |rest| (-1.0, rest));
        let entry = |(name, joint): (&str, &str)| {
            let place = ["q", "qd", "qdd"].iter().position(|known| *known == name)?;
            state[place]
                .get(joint.trim_end_matches(']').parse::<usize>().ok()?)
                .copied()
        };
        let found = values.get(word).copied().or_else(|| word.parse().ok());
        Some(sign * found.or_else(|| entry(word.split_once('[')?))?)
    };
    for line in text.lines().map(str::trim) {
        if let Some(statement) = line.strip_prefix("let ") {
            let (names, right) = statement.trim_end_matches(';').split_once(" = ")?;
            if let Some(angle) = right.strip_prefix("libm::sincos(") {
                let (sin, cos) = value(angle.trim_end_matches(')'), &values)?.sin_cos();
                let (one, other) = names.trim_matches(['(', ')']).split_once(", ")?;
                values.extend([(one.to_owned(), sin), (other.to_owned(), cos)]);
                continue;
            }
            let words: Vec<&str> = right.split(' ').collect();
            let (a, b) = (value(words[0], &values)?, value(words[2], &values)?);
            let result = match words[1] {
                "+" => a + b,
                "-" => a - b,
                _ => a * b,
            };
            values.insert(names.to_owned(), result);
        } else if line.starts_with('[') {
            return line
                .trim_matches(['[', ']'])
                .split(", ")
                .map(|word| value(word, &values))
                .collect();
        }
    }
    None
}

/// Returns whether the text is within a share of T at many states of the box.
fn is_true(claim: &Claim, allowed: &[f64]) -> bool {
    let mut random = Random(3);
    (0..600).all(|_| {
        let lists = [&claim.position, &claim.velocity, &claim.acceleration];
        let state = lists.map(|list| {
            [0, 1].map(|joint: usize| {
                let [low, high] = list[joint];
                low + (high - low) * random.below(17) as f64 / 16.0
            })
        });
        let expected = closed_form(state[0], state[1], state[2]);
        let found = run(&claim.text, &state).unwrap();
        let near = |k: usize| (found[k] - expected[k]).abs() <= allowed[k] * claim.scale[k] + 1e-12;
        near(0) && near(1)
    })
}

/// Audits a mutant; whether it was shown, after judging that it then is true.
fn judged(mutant: &Claim, robot: &str) -> bool {
    let Ok(verdict) = audit(mutant, robot, None) else {
        return false;
    };
    if verdict.is_shown() {
        assert!(is_true(mutant, &[5e-2; 2]), "{}\n{verdict:?}", mutant.text);
    }
    if verdict.outputs.iter().all(|output| output.holds()) {
        let total: Vec<f64> = mutant.total.iter().map(|x| x.unwrap()).collect();
        assert!(is_true(mutant, &total), "{}\n{verdict:?}", mutant.text);
    }
    verdict.is_shown()
}

/// Replaces one of the places in a text where a word stands.
fn replaced(
    text: &str,
    places: &[(usize, usize)],
    random: &mut Random,
    with: impl Fn(&str, &mut Random) -> String,
) -> String {
    let (start, end) = places[random.below(places.len())];
    let new = with(&text[start..end], random);
    format!("{}{new}{}", &text[..start], &text[end..])
}

/// Finds where words of a kind stand in the body of a text.
fn places(text: &str, is: impl Fn(&str) -> bool) -> Vec<(usize, usize)> {
    let body = text.find("{\n").unwrap();
    let mut found = Vec::new();
    let mut start = body;
    for (at, c) in text.char_indices().skip_while(|(at, _)| *at < body) {
        if " ;,()[]\n".contains(c) {
            if start < at && is(&text[start..at]) {
                found.push((start, at));
            }
            start = at + 1;
        }
    }
    found
}

fn mutated(kind: &str) -> usize {
    let (original, robot) = (
        claim("checker/tests/data/planar2r-pick.json"),
        file("cli/tests/data/attacks/r2_conf.toml"),
    );
    assert!(judged(&original, &robot));
    let mut random = Random(11);
    let text = &original.text;
    let constants = places(text, |word| {
        word.starts_with(|c: char| c.is_ascii_digit()) && word.contains('.')
    });
    let operators = places(text, |word| ["+", "-", "*"].contains(&word));
    let indices = places(text, |word| {
        word.starts_with(['t', 's', 'c']) && word[1..].parse::<u32>().is_ok()
            || ["0", "1"].contains(&word)
    });
    let mut shown = 0;
    for _ in 0..100 {
        let mut mutant = original.clone();
        match kind {
            "constants" => {
                mutant.text = replaced(text, &constants, &mut random, |word, random| {
                    let share = [1e-17, 1e-12, 1e-6, 1e-3, 0.1, 2.0, -1.0][random.below(7)];
                    format!("{:?}", word.parse::<f64>().unwrap() * (1.0 + share))
                });
            }
            "operators" => {
                mutant.text = replaced(text, &operators, &mut random, |_, random| {
                    ["+", "-", "*"][random.below(3)].into()
                })
            }
            "indices" => {
                mutant.text = replaced(text, &indices, &mut random, |word, random| {
                    match word.parse::<usize>() {
                        Ok(index) => format!("{}", 1 - index),
                        Err(_) => {
                            format!(
                                "{}{}",
                                ["t", "s", "c"][random.below(3)],
                                1 + random.below(24)
                            )
                        }
                    }
                });
            }
            _ => {
                let factor = [1e-3, 0.5, 0.9, 1.1, 2.0, 1e3, -1.0][random.below(7)];
                let k = random.below(2);
                match random.below(6) {
                    0 => mutant.total[k] = Some(mutant.total[k].unwrap() * factor),
                    1 => mutant.scale[k] *= factor,
                    2 => mutant.position[k] = mutant.position[k].map(|x| x * factor),
                    3 => mutant.velocity[k] = mutant.velocity[k].map(|x| x * factor),
                    4 => mutant.acceleration[k] = mutant.acceleration[k].map(|x| x * factor),
                    _ => mutant.rows[k] = random.below(4),
                }
            }
        }
        shown += usize::from(judged(&mutant, &robot));
    }
    shown
}

#[test]
fn constants() {
    // What is changed by a millionth or less is within the scene's tolerance.
    let shown = mutated("constants");
    assert!((10..80).contains(&shown), "{shown}");
}

#[test]
fn operators() {
    // One in three is the same again.
    assert!((20..60).contains(&mutated("operators")));
}

#[test]
fn indices() {
    assert!(mutated("indices") < 40);
}

#[test]
fn numbers() {
    let shown = mutated("numbers");
    assert!((5..70).contains(&shown), "{shown}");
}
