//! SHA-256 (FIPS 180-4), from which the states are drawn at which a text is tried: nobody can choose
//! a text by the states, since with the text these change.

/// Returns the first bits of the roots of the first 64 primes behind the point.
fn bits(root: impl Fn(f64) -> f64) -> Vec<u32> {
    let is_prime = |n: &u32| !(2..*n).any(|k| n.is_multiple_of(k));
    let fraction = |n: u32| (root(f64::from(n)).fract() * 2f64.powi(32)) as u32;
    (2..312).filter(is_prime).map(fraction).collect()
}

/// Returns the first 64 bits of the hash of some bytes.
pub fn hash(bytes: &[u8]) -> u64 {
    // Roots of doubles have 44 bits behind the point, but for what is rounded: enough for 32.
    let (keys, start) = (bits(f64::cbrt), bits(f64::sqrt));
    let mut all = bytes.to_vec();
    all.push(0x80);
    all.resize((all.len() + 8).next_multiple_of(64) - 8, 0);
    all.extend((8 * bytes.len() as u64).to_be_bytes());
    let mut state: Vec<u32> = start[..8].to_vec();
    for block in all.chunks(64) {
        let word = |k: usize| (0..4).fold(0, |w, i| w << 8 | u32::from(block[4 * k + i]));
        let mut words: Vec<u32> = (0..16).map(word).collect();
        let mixed = |x: u32, [a, b, c]: [u32; 3]| x.rotate_right(a) ^ x.rotate_right(b) ^ x >> c;
        for k in 16..64 {
            let own = mixed(words[k - 2], [17, 19, 10]).wrapping_add(words[k - 7]);
            let other = mixed(words[k - 15], [7, 18, 3]).wrapping_add(words[k - 16]);
            words.push(own.wrapping_add(other));
        }
        let mut own = state.clone();
        for (key, word) in keys.iter().zip(words) {
            let [a, b, c, e, f, g] = [0, 1, 2, 4, 5, 6].map(|k: usize| own[k]);
            let turn = |x: u32, [a, b, c]: [u32; 3]| {
                x.rotate_right(a) ^ x.rotate_right(b) ^ x.rotate_right(c)
            };
            let chosen = turn(e, [6, 11, 25]).wrapping_add(e & f ^ !e & g);
            let first = chosen
                .wrapping_add(own[7])
                .wrapping_add(key.wrapping_add(word));
            let second = turn(a, [2, 13, 22]).wrapping_add(a & b ^ a & c ^ b & c);
            own.rotate_right(1);
            own[0] = first.wrapping_add(second);
            own[4] = own[4].wrapping_add(first);
        }
        state = state
            .iter()
            .zip(own)
            .map(|(a, b)| a.wrapping_add(b))
            .collect();
    }
    u64::from(state[0]) << 32 | u64::from(state[1])
}
