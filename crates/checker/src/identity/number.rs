//! Residues modulo a prime that a hash draws, each with two slopes and what both have together: so
//! every derivative is that of the equations themselves.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use hmac_sha256::Hash;

/// A prime p of 62 bits, with ⌊2¹²⁵/p⌋, so that a remainder takes two products. The value is 0
/// for a whole number, which every field has, and `LOST` for a result of a division by zero.
#[derive(Clone, Copy, Debug, Default)]
pub struct Prime {
    value: u64,
    reciprocal: u64,
}

const LOST: u64 = u64::MAX;

impl Prime {
    fn new(value: u64) -> Prime {
        let reciprocal = ((1u128 << 125) / u128::from(value)) as u64;
        Prime { value, reciprocal }
    }

    /// Returns the prime as a number.
    pub fn value(self) -> u64 {
        self.value
    }

    /// Returns the sum of two products of residues: modulo the prime, of whole numbers wrapped.
    fn products(self, [a, b]: [u64; 2], [c, d]: [u64; 2]) -> u64 {
        let Prime { value, reciprocal } = self;
        if value == 0 || value == LOST {
            return a.wrapping_mul(b).wrapping_add(c.wrapping_mul(d));
        }
        let sum = u128::from(a) * u128::from(b) + u128::from(c) * u128::from(d);
        // The quotient of less than 2¹²⁵ is at most two too small (Barrett 1986).
        let high = u128::from((sum >> 61) as u64);
        let quotient = ((high * u128::from(reciprocal)) >> 64) as u64;
        let rest = (sum as u64).wrapping_sub(quotient.wrapping_mul(value));
        let reduced = |rest: u64, by: u64| if rest >= by { rest - by } else { rest };
        reduced(reduced(rest, 2 * value), value)
    }

    fn sum(self, a: u64, b: u64) -> u64 {
        let sum = a.wrapping_add(b);
        let is_over = self.value > 0 && sum >= self.value;
        if is_over { sum - self.value } else { sum }
    }

    fn power(self, mut square: u64, mut exponent: u64) -> u64 {
        let mut power = 1;
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = self.products([power, square], [0, 0]);
            }
            square = self.products([square, square], [0, 0]);
            exponent >>= 1;
        }
        power
    }
}

/// A residue r + r₁ε + r₂δ + r₃εδ with ε² = δ² = 0.
#[derive(Clone, Copy, Debug, Default)]
pub struct Number {
    prime: Prime,
    parts: [u64; 4],
}

impl Number {
    /// Creates a residue.
    pub fn new(value: u64, prime: Prime) -> Number {
        let parts = [value % prime.value, 0, 0, 0];
        Number { prime, parts }
    }

    /// Returns ε for direction 1, and δ for 2.
    pub fn step(direction: usize) -> Number {
        let mut step = Number::from(0);
        step.parts[direction] = 1;
        step
    }

    fn entry(self, part: usize, prime: Prime) -> u64 {
        match self.prime.value {
            0 if prime.value > 0 => (self.parts[part] as i64).rem_euclid(prime.value as i64) as u64,
            _ => self.parts[part],
        }
    }

    /// Returns the residue modulo a prime; none of a number that is lost.
    pub fn value(self, prime: Prime) -> Option<u64> {
        (self.prime.value != LOST).then(|| self.entry(0, prime))
    }

    /// Returns true for any number but zero.
    pub fn is_nonzero(self) -> bool {
        self.parts[0] != 0
    }

    /// Returns a slope, or the mixed one, as a number.
    pub fn slope(self, part: usize) -> Number {
        let parts = [self.parts[part], 0, 0, 0];
        Number { parts, ..self }
    }

    fn common(self, other: Number) -> Prime {
        let is_first = self.prime.value >= other.prime.value;
        if is_first { self.prime } else { other.prime }
    }

    fn with(
        self,
        other: Number,
        combine: impl Fn(Prime, [u64; 4], [u64; 4]) -> [u64; 4],
    ) -> Number {
        let prime = self.common(other);
        let parts = |number: Number| match number.prime.value == prime.value {
            true => number.parts,
            false => from_fn(|part| number.entry(part, prime)),
        };
        let parts = combine(prime, parts(self), parts(other));
        Number { prime, parts }
    }
}

impl From<i64> for Number {
    fn from(whole: i64) -> Number {
        let (prime, parts) = (Prime::default(), [whole as u64, 0, 0, 0]);
        Number { prime, parts }
    }
}

fn has_slopes(parts: [u64; 4]) -> bool {
    parts[1] | parts[2] | parts[3] != 0
}

impl Add for Number {
    type Output = Number;
    fn add(self, other: Number) -> Number {
        self.with(other, |p, a, b| from_fn(|k| p.sum(a[k], b[k])))
    }
}

impl Neg for Number {
    type Output = Number;
    fn neg(self) -> Number {
        let parts = self.parts.map(|x| match (self.prime.value, x) {
            (0, x) => x.wrapping_neg(),
            (_, 0) => 0,
            (prime, x) => prime - x,
        });
        Number { parts, ..self }
    }
}

impl Sub for Number {
    type Output = Number;
    fn sub(self, other: Number) -> Number {
        self + -other
    }
}

impl Mul for Number {
    type Output = Number;
    fn mul(self, other: Number) -> Number {
        self.with(other, |p, a, b| {
            let slope = |[i, k]: [usize; 2]| p.products([a[i], b[k]], [a[k], b[i]]);
            let value = p.products([a[0], b[0]], [0, 0]);
            if !has_slopes(a) && !has_slopes(b) {
                return [value, 0, 0, 0];
            }
            let mixed = p.sum(slope([0, 3]), slope([1, 2]));
            [value, slope([0, 1]), slope([0, 2]), mixed]
        })
    }
}

impl Div for Number {
    type Output = Number;
    fn div(self, other: Number) -> Number {
        let prime = self.common(other);
        let divisor = other.entry(0, prime);
        if prime.value == 0 || prime.value == LOST || divisor == 0 {
            let (value, parts) = (LOST, [0; 4]);
            let prime = Prime { value, ..prime };
            return Number { prime, parts };
        }
        let mut inverse = Number::new(prime.power(divisor, prime.value - 2), prime);
        if has_slopes(other.parts) {
            // 1/(x + e) is y (2 − (x + e) y), twice, with y = 1/x: squares of slopes vanish.
            for _ in 0..2 {
                inverse = inverse * (Number::from(2) - other * inverse);
            }
        }
        self * inverse
    }
}

/// Numbers that follow from a statement: whoever changes a digit of it gets others.
pub struct Draws {
    seed: [u8; 32],
    count: u64,
    /// The words of the last hash that are not taken yet.
    words: Vec<u64>,
}

impl Draws {
    /// Returns the numbers of a statement, given as texts.
    pub fn new(statement: &[&str]) -> Draws {
        let mut hash = Hash::new();
        for text in statement {
            hash.update((text.len() as u64).to_le_bytes());
            hash.update(text.as_bytes());
        }
        Draws::of(hash.finalize())
    }

    fn of(seed: [u8; 32]) -> Draws {
        let (count, words) = (0, Vec::new());
        Draws { seed, count, words }
    }

    /// Returns the hash that all follow from, in hexadecimal.
    pub fn text(&self) -> String {
        self.seed.iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// Returns draws that are independent of all others of these.
    pub fn split(&mut self) -> Draws {
        Draws::of(self.next_hash())
    }

    fn next_hash(&mut self) -> [u8; 32] {
        self.count += 1;
        Hash::hash(&[self.seed.as_slice(), &self.count.to_le_bytes()].concat())
    }

    fn next(&mut self) -> u64 {
        if self.words.is_empty() {
            let hash = self.next_hash();
            let word = |place: usize| u64::from_be_bytes(from_fn(|k| hash[8 * place + k]));
            self.words.extend((0..4).map(word));
        }
        self.words.pop().unwrap_or_default()
    }

    /// Returns the next number from zero to one.
    pub fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns the next prime of 62 bits.
    pub fn prime(&mut self) -> Prime {
        loop {
            let number = Prime::new(self.next() >> 2 | 1 << 61 | 1);
            if is_prime(number) {
                return number;
            }
        }
    }

    /// Returns the next residue.
    pub fn residue(&mut self, prime: Prime) -> Number {
        Number::new(self.next(), prime)
    }
}

/// Tests an odd number for being prime, by Miller and Rabin; these bases suffice below 2⁶⁴.
fn is_prime(number: Prime) -> bool {
    let minus_one = number.value - 1;
    let twos = minus_one.trailing_zeros();
    let bases = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    bases.into_iter().all(|base| {
        let mut power = number.power(base, minus_one >> twos);
        let mut passes = [1, minus_one].contains(&power);
        for _ in 1..twos {
            power = number.products([power, power], [0, 0]);
            passes |= power == minus_one;
        }
        passes
    })
}
