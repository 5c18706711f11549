//! Seeded random numbers, the same on every machine.

pub use dalembert_codegen::workspace::Random;

/// Returns a number of the standard normal distribution (Marsaglia's polar method).
pub fn normal(random: &mut Random) -> f64 {
    loop {
        let [x, y] = [(); 2].map(|()| 2.0 * random.unit() - 1.0);
        let square = x * x + y * y;
        if square > 0.0 && square < 1.0 {
            return x * libm::sqrt(-2.0 * libm::log(square) / square);
        }
    }
}

/// Returns a number between −`largest` and `largest`.
pub fn within(random: &mut Random, largest: f64) -> f64 {
    largest * (2.0 * random.unit() - 1.0)
}
