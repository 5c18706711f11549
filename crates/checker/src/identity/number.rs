//! Residues modulo a prime that a hash draws, each with two slopes and what both have together: so
//! every derivative is that of the equations themselves.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use hmac_sha256::Hash;

/// A prime p of 126 bits, with −1/p modulo 2¹²⁸ and the remainder of 2²⁵⁶: residues x stand as
/// 2¹²⁸ x, so that a remainder takes two products (Montgomery 1985). The value is 0 for a whole
/// number, which every field has, and `LOST` for a result of a division by zero.
#[derive(Clone, Copy, Debug, Default)]
pub struct Prime {
    value: u128,
    inverse: u128,
    square: u128,
}

const LOST: u128 = u128::MAX;

fn wide(a: u128, b: u128) -> [u128; 2] {
    let half = |x: u128| [x >> 64, x & u128::from(u64::MAX)];
    let ([a, b], [c, d]) = (half(a), half(b));
    let middle = a * d + ((b * d) >> 64);
    let [carry, low] = half(middle);
    let middle = low + b * c;
    [
        a * c + carry + (middle >> 64),
        (middle << 64) | ((b * d) & u128::from(u64::MAX)),
    ]
}

impl Prime {
    fn new(value: u128) -> Prime {
        // Each step doubles the digits that are right (Newton).
        let step = |x: u128, _| x.wrapping_mul(2u128.wrapping_sub(value.wrapping_mul(x)));
        let inverse = (0..7).fold(1, step).wrapping_neg();
        let square = (0..256).fold(1 % value, |x: u128, _| (2 * x) % value);
        Prime {
            value,
            inverse,
            square,
        }
    }

    /// Returns the prime as a number.
    pub fn value(self) -> u128 {
        self.value
    }

    fn is_field(self) -> bool {
        self.value != 0 && self.value != LOST
    }

    /// Returns the sum of two products of residues: modulo the prime, of whole numbers wrapped.
    fn products(self, [a, b]: [u128; 2], [c, d]: [u128; 2]) -> u128 {
        if !self.is_field() {
            return a.wrapping_mul(b).wrapping_add(c.wrapping_mul(d));
        }
        let ([high, low], [other_high, other_low]) = (wide(a, b), wide(c, d));
        let (low, carry) = low.overflowing_add(other_low);
        // Below 2 p², and with the multiple of p below 2¹²⁸ (p + 2 p²/2¹²⁸).
        let high = high + other_high + u128::from(carry);
        let [more, _] = wide(low.wrapping_mul(self.inverse), self.value);
        // The low halves add up to 2¹²⁸, or both are nothing.
        self.sum(high + more, u128::from(low != 0))
    }

    /// Returns a number as residues stand.
    fn inward(self, value: u128) -> u128 {
        match value {
            0 => 0,
            value => self.products([value, self.square], [0, 0]),
        }
    }

    fn outward(self, residue: u128) -> u128 {
        self.products([residue, 1], [0, 0])
    }

    fn sum(self, a: u128, b: u128) -> u128 {
        let sum = a.wrapping_add(b);
        let is_over = self.value > 0 && sum >= self.value;
        if is_over { sum - self.value } else { sum }
    }

    fn power(self, mut square: u128, mut exponent: u128) -> u128 {
        let mut power = self.inward(1);
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
    parts: [u128; 4],
}

impl Number {
    /// Creates a residue.
    pub fn new(value: u128, prime: Prime) -> Number {
        let parts = [prime.inward(value % prime.value), 0, 0, 0];
        Number { prime, parts }
    }

    /// Returns ε for direction 1, and δ for 2.
    pub fn step(direction: usize) -> Number {
        let mut step = Number::from(0);
        step.parts[direction] = 1;
        step
    }

    fn entry(self, part: usize, prime: Prime) -> u128 {
        match self.prime.value {
            0 if prime.is_field() => {
                let whole = self.parts[part] as i128;
                prime.inward(whole.rem_euclid(prime.value as i128) as u128)
            }
            _ => self.parts[part],
        }
    }

    /// Returns the residue modulo a prime; none of a number that is lost.
    pub fn value(self, prime: Prime) -> Option<u128> {
        (self.prime.value != LOST).then(|| prime.outward(self.entry(0, prime)))
    }

    /// Returns the square root of a residue that has one, modulo a prime of the form 4 k − 1.
    pub fn root(self) -> Number {
        let prime = self.prime;
        let power = prime.power(self.parts[0], prime.value.div_ceil(4));
        let parts = [power, 0, 0, 0];
        Number { parts, ..self }
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
        combine: impl Fn(Prime, [u128; 4], [u128; 4]) -> [u128; 4],
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
        let (prime, parts) = (Prime::default(), [i128::from(whole) as u128, 0, 0, 0]);
        Number { prime, parts }
    }
}

fn has_slopes(parts: [u128; 4]) -> bool {
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
        if !prime.is_field() || divisor == 0 {
            let (value, parts) = (LOST, [0; 4]);
            let prime = Prime { value, ..prime };
            return Number { prime, parts };
        }
        let parts = [prime.power(divisor, prime.value - 2), 0, 0, 0];
        let mut inverse = Number { prime, parts };
        if has_slopes(other.parts) {
            // 1/(x + e) is y (2 − (x + e) y), twice, with y = 1/x: squares of slopes vanish.
            for _ in 0..2 {
                inverse = inverse * (Number::from(2) - other * inverse);
            }
        }
        self * inverse
    }
}

/// Numbers that follow from a statement: a change of any digit gives others.
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

    fn pair(&mut self) -> u128 {
        u128::from(self.next()) << 64 | u128::from(self.next())
    }

    /// Returns the next prime of 126 bits of the form 24 k − 1, modulo which 2 and 3 have roots.
    pub fn prime(&mut self) -> Prime {
        loop {
            let number = self.pair() >> 2 | 1 << 125;
            let number = number - number % 24 + 23;
            let is_small = |small: &u128| number.is_multiple_of(*small);
            if SMALL.iter().any(is_small) {
                continue;
            }
            let number = Prime::new(number);
            if is_prime(number) {
                return number;
            }
        }
    }

    /// Returns the next residue.
    pub fn residue(&mut self, prime: Prime) -> Number {
        Number::new(self.pair(), prime)
    }
}

const SMALL: [u128; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];

/// Tests an odd number for being prime, by Miller and Rabin: of random numbers of so many bits that
/// pass, less than one in 2¹⁰⁰ is not prime (Damgård, Landrock and Pomerance 1993).
fn is_prime(number: Prime) -> bool {
    let minus_one = number.value - 1;
    let twos = minus_one.trailing_zeros();
    let ends = [1, minus_one].map(|end| number.inward(end));
    SMALL.into_iter().all(|base| {
        let mut power = number.power(number.inward(base), minus_one >> twos);
        let mut passes = ends.contains(&power);
        for _ in 1..twos {
            power = number.products([power, power], [0, 0]);
            passes |= power == ends[1];
        }
        passes
    })
}
