//! The vectors of the compiled target, of 128 bits, by the crate `wide`; without any, numbers.

use dalembert_sines::text::{self, Products};

use crate::vector::{BLOCK, Vector, lanes};

#[cfg(any(
    target_arch = "x86",
    target_arch = "x86_64",
    target_arch = "aarch64",
    target_arch = "wasm32"
))]
mod vectors {
    use dalembert_sines::text::{Doubles, Singles};

    use super::{BLOCK, Products, Vector, lanes, text};

    macro_rules! portable {
        ($vector:ident, $float:ident, $lanes:literal) => {
            impl Vector<$float> for $vector {
                type Token = ();

                lanes!($float, $lanes; |vector| vector.to_array(); |_vector| ();
                       |_token, from| $vector::from_array(from));

                #[inline(always)]
                fn sqrt(self) -> Self {
                    self.root()
                }
            }
        };
    }
    portable!(Doubles, f64, 2);
    portable!(Singles, f32, 4);
}

#[cfg(not(any(
    target_arch = "x86",
    target_arch = "x86_64",
    target_arch = "aarch64",
    target_arch = "wasm32"
)))]
mod numbers {
    use super::{BLOCK, Products, Vector, lanes, text};

    macro_rules! number {
        ($float:ident, $sqrt:ident) => {
            impl Vector<$float> for $float {
                type Token = ();

                lanes!($float, 1; |number| [number]; |_number| (); |_token, from| from[0]);

                #[inline(always)]
                fn sqrt(self) -> Self {
                    dalembert_sines::$sqrt(self)
                }
            }
        };
    }
    number!(f64, sqrt);
    number!(f32, sqrtf);
}
