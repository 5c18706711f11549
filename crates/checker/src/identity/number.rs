//! Residues modulo a prime that a hash draws, each with two slopes and what both have together: so
//! every derivative is that of the equations themselves.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use hmac_sha256::Hash;

/// A residue r + r₁ε + r₂δ + r₃εδ with ε² = δ² = 0. Without a prime it is a whole number that every
/// field has; a result of a division by zero is lost.
#[derive(Clone, Copy, Debug, Default)]
pub struct Number {
    prime: u64,
    parts: [u64; 4],
}

const LOST: u64 = u64::MAX;

impl Number {
    /// Creates a residue.
    pub fn new(value: u64, prime: u64) -> Number {
        let parts = [value % prime, 0, 0, 0];
        Number { prime, parts }
    }

    /// Returns ε for direction 1, and δ for 2.
    pub fn step(direction: usize) -> Number {
        let mut step = Number::from(0);
        step.parts[direction] = 1;
        step
    }

    fn entry(self, part: usize, prime: u64) -> u64 {
        match self.prime {
            0 if prime > 0 => (self.parts[part] as i64).rem_euclid(prime as i64) as u64,
            _ => self.parts[part],
        }
    }

    /// Returns the residue modulo a prime; none of a number that is lost.
    pub fn value(self, prime: u64) -> Option<u64> {
        (self.prime != LOST).then(|| self.entry(0, prime))
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

    fn with(self, other: Number, combine: impl Fn(u64, [u64; 4], [u64; 4]) -> [u64; 4]) -> Number {
        let prime = self.prime.max(other.prime);
        let parts = |own: Number| match own.prime == prime {
            true => own.parts,
            false => from_fn(|part| own.entry(part, prime)),
        };
        let parts = combine(prime, parts(self), parts(other));
        Number { prime, parts }
    }

    fn power(self, mut exponent: u64) -> Number {
        let (mut square, mut power) = (self, Number::from(1));
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = power * square;
            }
            square = square * square;
            exponent >>= 1;
        }
        power
    }
}

impl From<i64> for Number {
    fn from(whole: i64) -> Number {
        let (prime, parts) = (0, [whole as u64, 0, 0, 0]);
        Number { prime, parts }
    }
}

fn times(prime: u64, a: u64, b: u64) -> u64 {
    match prime {
        0 => a.wrapping_mul(b),
        // So it is of most, and quotients of 128 bits are slow.
        _ if a == 0 || b == 0 => 0,
        _ => (u128::from(a) * u128::from(b) % u128::from(prime)) as u64,
    }
}

fn plus(prime: u64, a: u64, b: u64) -> u64 {
    let sum = a.wrapping_add(b);
    let is_over = prime > 0 && sum >= prime;
    if is_over { sum - prime } else { sum }
}

impl Add for Number {
    type Output = Number;
    fn add(self, other: Number) -> Number {
        self.with(other, |p, a, b| from_fn(|k| plus(p, a[k], b[k])))
    }
}

impl Neg for Number {
    type Output = Number;
    fn neg(self) -> Number {
        let parts = self.parts.map(|x| match (self.prime, x) {
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
            if a[1] | a[2] | a[3] | b[1] | b[2] | b[3] == 0 {
                return [times(p, a[0], b[0]), 0, 0, 0];
            }
            // The bits of a part's number are the slopes that it has: those of i and of the rest.
            from_fn(|k| {
                let pairs = (0..=k).filter(|i| i & k == *i);
                pairs.fold(0, |all, i| plus(p, all, times(p, a[i], b[k - i])))
            })
        })
    }
}

impl Div for Number {
    type Output = Number;
    fn div(self, other: Number) -> Number {
        let prime = self.prime.max(other.prime);
        let own = other.entry(0, prime);
        if prime == 0 || prime == LOST || own == 0 {
            return Number::new(0, LOST);
        }
        // 1/(x + e) is y (2 − (x + e) y), twice, with y = 1/x: squares of slopes vanish.
        let mut inverse = Number::new(own, prime).power(prime - 2);
        for _ in 0..2 {
            inverse = inverse * (Number::from(2) - other * inverse);
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
    pub fn prime(&mut self) -> u64 {
        loop {
            let number = self.next() >> 2 | 1 << 61 | 1;
            if is_prime(number) {
                return number;
            }
        }
    }

    /// Returns the next residue.
    pub fn residue(&mut self, prime: u64) -> Number {
        Number::new(self.next(), prime)
    }
}

/// Tests an odd number for being prime, by Miller and Rabin; these bases suffice below 2⁶⁴.
fn is_prime(number: u64) -> bool {
    let twos = (number - 1).trailing_zeros();
    let bases = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    bases.into_iter().all(|base| {
        let mut power = Number::new(base, number).power((number - 1) >> twos);
        let mut passes = [1, number - 1].contains(&power.parts[0]);
        for _ in 1..twos {
            power = power * power;
            passes |= power.parts[0] == number - 1;
        }
        passes
    })
}
