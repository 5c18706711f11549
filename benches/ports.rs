//! The least time that a processor's ports can take for a program: its operations are counted by
//! running it, and each kind of them can go to some ports only.
//!
//! Whatever set of ports one looks at, what can go nowhere else keeps them busy for its sum over
//! their number; the largest of these is the limit. Loads, stores and moves are free here.

use std::cell::Cell;
use std::fs;
use std::ops::{Add, BitAnd, BitXor, Div, Mul, Neg, Sub};
use std::time::Instant;

use dalembert::batch::{Floats, Function, Vector};
use dalembert_sines::text::{Angle, Fused, Number, Products, Rounded, together};

/// Counts of operations: sums and differences; products; fused ones; bits; sums of integers; shifts;
/// comparisons; quotients; roots.
const KINDS: usize = 9;

struct Row {
    cores: (&'static str, u32, &'static [(u32, u32)]),
    width: u32,
    /// For each kind but the last two the ports, a bit each, of which one is taken for `cycles`.
    ports: [u8; KINDS - 2],
    cycles: f64,
    /// The cycles of quotients and of roots: those of f64 and of f32.
    divider: [[f64; 2]; 2],
}

const AMD: &str = "AuthenticAMD";
const INTEL: &str = "GenuineIntel";
const ZEN: [u8; 7] = [0b1100, 0b0011, 0b0011, 0b1111, 0b1111, 0b0110, 0b0011];
const LAKES: [u8; 7] = [0b011, 0b011, 0b011, 0b111, 0b111, 0b011, 0b011];
const COVE: [u8; 7] = [0b110, 0b011, 0b011, 0b111, 0b111, 0b011, 0b011];
const INTEL_512: [u8; 7] = [0b101, 0b101, 0b101, 0b101, 0b101, 0b001, 0b100];
/// A port of its own, for all of these processors.
const DIVIDER: u8 = 1 << 7;

/// Sources: uops.info and A. Fog's instruction tables; of Zen 4, sums, products, fused products,
/// bits and shifts were measured, too. AMD's ports are FP0 to FP3, Intel's 0, 1 and 5 (the bits
/// 1, 2 and 4).
#[rustfmt::skip]
const ROWS: &[Row] = &[
    // Zen 3 and Zen 4.
    Row { cores: (AMD, 25, &[(0, 255)]),
          width: 256, ports: ZEN, cycles: 1.0, divider: [[5.0, 3.0], [9.0, 5.0]] },
    // Zen 4.
    Row { cores: (AMD, 25, &[(16, 31), (96, 255)]),
          width: 512, ports: ZEN, cycles: 2.0, divider: [[10.0, 6.0], [18.0, 10.0]] },
    // Zen 5.
    Row { cores: (AMD, 26, &[(0, 255)]),
          width: 256, ports: ZEN, cycles: 1.0, divider: [[5.0, 3.0], [9.0, 5.0]] },
    Row { cores: (AMD, 26, &[(0, 31), (64, 255)]),
          width: 512, ports: ZEN, cycles: 1.0, divider: [[9.0, 6.0], [16.0, 10.0]] },
    // Skylake to Ice Lake.
    Row { cores: (INTEL, 6, &[(78, 78), (85, 85), (94, 94), (106, 108), (125, 126), (140, 142),
                              (158, 158), (167, 167)]),
          width: 256, ports: LAKES, cycles: 1.0, divider: [[8.0, 5.0], [9.0, 6.0]] },
    // Skylake-SP, Ice Lake-SP.
    Row { cores: (INTEL, 6, &[(85, 85), (106, 108)]),
          width: 512, ports: INTEL_512, cycles: 1.0, divider: [[16.0, 10.0], [18.0, 12.0]] },
    // Golden Cove.
    Row { cores: (INTEL, 6, &[(143, 143), (151, 151), (154, 154), (183, 183), (207, 207)]),
          width: 256, ports: COVE, cycles: 1.0, divider: [[8.0, 5.0], [9.0, 6.0]] },
    // Golden Cove: Sapphire Rapids, Emerald Rapids.
    Row { cores: (INTEL, 6, &[(143, 143), (207, 207)]),
          width: 512, ports: INTEL_512, cycles: 1.0, divider: [[16.0, 10.0], [18.0, 12.0]] },
];

pub type Operations = [usize; KINDS];

thread_local! {
    static COUNTED: Cell<Operations> = const { Cell::new([0; KINDS]) };
}

#[derive(Clone, Copy)]
pub struct Counted;

#[derive(Clone, Copy)]
pub struct CountedBits;

fn count(kind: usize) {
    COUNTED.with(|counted| {
        let mut counts = counted.get();
        counts[kind] += 1;
        counted.set(counts);
    });
}

macro_rules! counted {
    ($($operation:ident, $method:ident, $own:ident, $other:ty, $kind:literal;)*) => {$(
        impl $operation<$other> for $own {
            type Output = $own;
            fn $method(self, _: $other) -> $own {
                count($kind);
                $own
            }
        }
    )*};
}
counted! {
    Add, add, Counted, Counted, 0; Add, add, Counted, f64, 0; Add, add, Counted, f32, 0;
    Sub, sub, Counted, Counted, 0; Sub, sub, Counted, f64, 0; Sub, sub, Counted, f32, 0;
    Mul, mul, Counted, Counted, 1; Mul, mul, Counted, f64, 1; Mul, mul, Counted, f32, 1;
    Div, div, Counted, Counted, 7;
    BitXor, bitxor, CountedBits, CountedBits, 3; BitAnd, bitand, CountedBits, CountedBits, 3;
    Add, add, CountedBits, CountedBits, 4; Sub, sub, CountedBits, CountedBits, 4;
}

impl Neg for Counted {
    type Output = Counted;
    fn neg(self) -> Counted {
        count(3);
        Counted
    }
}

macro_rules! number {
    ($($float:ty),*) => {$(
        impl Number<$float> for Counted {
            fn all(self, _: $float) -> Counted {
                Counted
            }
            fn fused(self, _: Counted, _: Counted) -> Counted {
                count(2);
                Counted
            }
        }

        impl Floats<$float> for Counted {
            type Bits = CountedBits;
            fn bits(self) -> CountedBits {
                CountedBits
            }
            fn of_bits(_: CountedBits) -> Counted {
                Counted
            }
            fn power(self, _: usize) -> CountedBits {
                CountedBits
            }
            fn raised(_: CountedBits) -> CountedBits {
                count(5);
                CountedBits
            }
            fn are_within(self, _: $float) -> bool {
                count(3);
                count(6);
                true
            }
        }

        impl Vector<$float> for Counted {
            type Token = ();
            const LANES: usize = 1;
            fn load((): (), _: &[$float; 64], _: usize) -> Counted {
                Counted
            }
            fn store(self, _: &mut [$float], _: usize) {}
            fn sqrt(self) -> Counted {
                count(8);
                Counted
            }
            fn each(self, _: impl Fn($float) -> $float) -> Counted {
                Counted
            }
            fn both(self, _: impl Fn($float) -> ($float, $float)) -> (Counted, Counted) {
                (Counted, Counted)
            }
            fn sincos<P: Products<$float>, const K: usize>(
                angles: &[Counted; K],
            ) -> ([Counted; K], [Counted; K], bool) {
                together::<$float, P, Counted, K>(angles)
            }
        }
    )*};
}
number!(f64, f32);

pub fn operations<F, const E: usize, const M: usize, const K: usize>() -> Operations
where
    F: Function<E, M, K>,
    Counted: Vector<F::Scalar>,
{
    COUNTED.set([0; KINDS]);
    let entries = [Counted; E];
    let angles: [Counted; K] = F::angles(&entries);
    let (sin, cos, _) = match F::FUSED {
        true => Counted::sincos::<Fused, K>(&angles),
        false => Counted::sincos::<Rounded, K>(&angles),
    };
    let _ = F::vectors(&entries, &sin, &cos);
    COUNTED.get()
}

/// In ns a state; `None` where the table has no row for this processor, or it is not known.
pub fn limit<T: Angle>(operations: &Operations, width: u32, clock: f64) -> Option<f64> {
    let about = fs::read_to_string("/proc/cpuinfo").ok()?;
    let field = |name: &str| {
        let mut fields = about.lines().filter_map(|line| line.split_once(':'));
        let (_, value) = fields.find(|(key, _)| key.trim() == name)?;
        Some(value.trim())
    };
    let vendor = field("vendor_id")?;
    let family: u32 = field("cpu family")?.parse().ok()?;
    let model: u32 = field("model")?.parse().ok()?;
    let row = ROWS.iter().find(|row| {
        let (row_vendor, of, models) = row.cores;
        let is_one = |(first, last): &(u32, u32)| (*first..=*last).contains(&model);
        (row_vendor, of, row.width) == (vendor, family, width) && models.iter().any(is_one)
    })?;
    let scalar = usize::from(size_of::<T>() == 4);
    let plain = row.ports.map(|ports| (ports, row.cycles));
    let divided = row.divider.map(|cycles| (DIVIDER, cycles[scalar]));
    let kinds = [&plain[..], &divided].concat();
    let busy = |ports: u8| {
        let pairs = kinds.iter().zip(operations);
        let port_pairs = pairs.filter(|((mask, _), _)| mask & !ports == 0);
        let cycles = port_pairs.map(|((_, cycles), count)| cycles * *count as f64);
        cycles.sum::<f64>() / f64::from(ports.count_ones())
    };
    let cycles = (1..=u8::MAX).map(busy).fold(0.0, f64::max);
    let lanes = row.width as usize / (8 * size_of::<T>());
    Some(cycles / lanes as f64 / clock)
}

/// Cycles a nanosecond, by a chain of products and exclusive ors, of 3 cycles and one.
pub fn clock() -> f64 {
    let run = || {
        let start = Instant::now();
        let mut x = std::hint::black_box(3u64);
        for _ in 0..20_000 {
            x = x.wrapping_mul(x ^ 5);
        }
        std::hint::black_box(x);
        start.elapsed().as_secs_f64() * 1e9
    };
    80_000.0 / (0..500).map(|_| run()).fold(f64::MAX, f64::min)
}
