//! Which keys may be among others: a table of bits, small enough to stay in a
//! processor's cache where a map of the keys themselves would not.

use dalembert_model::scalar::field::Field;

/// Keys that were noted, by some of their bits. Keys are as good as random, and so
/// need no hash.
#[derive(Clone, Debug)]
pub(super) struct Sieve {
    bits: Vec<u64>,
    mask: u64,
}

/// Bits for each key: one in eight of the others passes.
const BITS: usize = 8;

impl Sieve {
    /// Makes a sieve for about so many keys.
    pub(super) fn new(keys: usize) -> Sieve {
        let bits = keys.saturating_mul(BITS).next_power_of_two().max(64);
        Sieve {
            bits: vec![0; bits / 64],
            mask: bits as u64 - 1,
        }
    }

    /// Lets a key pass from now on.
    pub(super) fn note(&mut self, key: Field) {
        let (word, bit) = self.place(key);
        self.bits[word] |= bit;
    }

    /// Returns whether the key passes: whatever was noted does, and some that was not.
    pub(super) fn passes(&self, key: Field) -> bool {
        let (word, bit) = self.place(key);
        self.bits[word] & bit != 0
    }

    fn place(&self, key: Field) -> (usize, u64) {
        let place = key.value() & self.mask;
        ((place / 64) as usize, 1 << (place % 64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn lets_through_what_was_noted_and_little_else() {
        let mut random = Random::new(3);
        let mut keys =
            || -> Vec<Field> { (0..10_000).map(|_| Field::new(random.bits())).collect() };
        let (noted, others) = (keys(), keys());
        let mut sieve = Sieve::new(noted.len());
        for &key in &noted {
            sieve.note(key);
        }
        assert!(noted.iter().all(|&key| sieve.passes(key)));
        let passed = others.iter().filter(|&&key| sieve.passes(key)).count();
        assert!(passed < others.len() / 6, "{passed} of {}", others.len());
    }
}
