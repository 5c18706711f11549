//! What functions in CUDA have besides those of C: they are for host and device.
//!
//! A compiler for the device makes one operation of a product and a sum unless the product says
//! that it is rounded, so products are a macro: an intrinsic on the device, `*` elsewhere.

use super::dialect::Dialect;
use crate::program::ScalarType;

/// What headers define, once the one of the robot's names is there.
pub(crate) const PRODUCTS: &str = "
/* Each operation is rounded, on the device too: no product becomes one with a sum. */
#if defined(__CUDA_ARCH__)
#define DALEMBERT_MUL(a, b) __dmul_rn((a), (b))
#define DALEMBERT_MULF(a, b) __fmul_rn((a), (b))
#else
#define DALEMBERT_MUL(a, b) ((a) * (b))
#define DALEMBERT_MULF(a, b) ((a) * (b))
#endif
";

/// What they define no more at their end.
pub(crate) const NO_PRODUCTS: &str = "
#undef DALEMBERT_MUL
#undef DALEMBERT_MULF
";

impl Dialect {
    /// Returns CUDA: C, but for what a function begins with and for products.
    pub(crate) const fn cuda(scalar: ScalarType) -> Dialect {
        Dialect {
            function: "static __host__ __device__ inline",
            product: scalar.of("DALEMBERT_MUL({}, {})", "DALEMBERT_MULF({}, {})"),
            ..Dialect::c99(scalar)
        }
    }
}
