//! The vectors of the target as it is compiled for, of 128 bits, by the crate `wide`.

use dalembert_sines::text::{Doubles, Singles, by_pairs};

use crate::vector::{BLOCK, Vector, lanes};

macro_rules! portable {
    ($vector:ident, $float:ident, $lanes:literal) => {
        impl Vector<$float> for $vector {
            type Token = ();

            lanes!(
                $float,
                $lanes,
                |vector| vector.to_array(),
                |_token, from| { $vector::from_array(from) }
            );

            #[inline(always)]
            fn sqrt(self) -> Self {
                self.root()
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                self.fused(factor, addend)
            }
        }
    };
}

portable!(Doubles, f64, 2);
portable!(Singles, f32, 4);
