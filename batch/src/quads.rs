//! Four entries of as many rows as a vector has lanes, in four vectors, and back: by instructions
//! that move numbers among vectors.
//!
//! There are no closures here: what is not inlined for certain is not compiled for the vectors.

use core::arch::x86_64::{__m256, __m256d, __m512, __m512d};

use pulp::x86::{V3, V4};
use pulp::{cast, f32x4, f64x4};

/// Moves numbers of a type among its vectors.
pub(crate) trait Quads<T, Raw>: Sized {
    /// Returns the columns of four entries, from one on, in so many rows.
    fn columns<const N: usize>(self, rows: &[[T; N]], entry: usize) -> [Raw; 4];

    /// Writes four columns in rows, from an entry on.
    fn rows<const N: usize>(self, columns: [Raw; 4], rows: &mut [[T; N]], entry: usize);
}

/// Returns four entries of a row; of one that is not there, zeros.
#[inline(always)]
fn piece<T: Copy + Default, const N: usize>(rows: &[[T; N]], row: usize, entry: usize) -> [T; 4] {
    if let Some(row) = rows.get(row)
        && let Some(rest) = row.get(entry..)
        && let Some(piece) = rest.first_chunk()
    {
        return *piece;
    }
    [T::default(); 4]
}

/// Writes four entries of a row.
#[inline(always)]
fn put<T, const N: usize>(rows: &mut [[T; N]], row: usize, entry: usize, piece: [T; 4]) {
    if let Some(row) = rows.get_mut(row)
        && let Some(rest) = row.get_mut(entry..)
        && let Some(place) = rest.first_chunk_mut()
    {
        *place = piece;
    }
}

/// Returns a row's four entries and those of the second one after it.
#[inline(always)]
fn halves<const N: usize>(simd: V4, rows: &[[f64; N]], row: usize, entry: usize) -> __m512d {
    let avx = simd.avx512f;
    let low: f64x4 = cast(piece(rows, row, entry));
    let high: f64x4 = cast(piece(rows, row + 2, entry));
    avx._mm512_insertf64x4::<1>(avx._mm512_castpd256_pd512(cast(low)), cast(high))
}

impl Quads<f64, __m512d> for V4 {
    #[inline(always)]
    fn columns<const N: usize>(self, rows: &[[f64; N]], entry: usize) -> [__m512d; 4] {
        let avx = self.avx512f;
        let (a, b) = (halves(self, rows, 0, entry), halves(self, rows, 1, entry));
        let (c, d) = (halves(self, rows, 4, entry), halves(self, rows, 5, entry));
        let (ab, cd) = (avx._mm512_unpacklo_pd(a, b), avx._mm512_unpacklo_pd(c, d));
        let (next, last) = (avx._mm512_unpackhi_pd(a, b), avx._mm512_unpackhi_pd(c, d));
        [
            avx._mm512_shuffle_f64x2::<0x88>(ab, cd),
            avx._mm512_shuffle_f64x2::<0x88>(next, last),
            avx._mm512_shuffle_f64x2::<0xdd>(ab, cd),
            avx._mm512_shuffle_f64x2::<0xdd>(next, last),
        ]
    }

    #[inline(always)]
    fn rows<const N: usize>(self, columns: [__m512d; 4], rows: &mut [[f64; N]], entry: usize) {
        let avx = self.avx512f;
        let [a, b, c, d] = columns;
        let (ab, cd) = (avx._mm512_unpacklo_pd(a, b), avx._mm512_unpacklo_pd(c, d));
        let (next, last) = (avx._mm512_unpackhi_pd(a, b), avx._mm512_unpackhi_pd(c, d));
        let first_two = cast([0u64, 1, 8, 9, 2, 3, 10, 11]);
        let last_two = cast([4u64, 5, 12, 13, 6, 7, 14, 15]);
        let pairs = [
            avx._mm512_permutex2var_pd(ab, first_two, cd),
            avx._mm512_permutex2var_pd(next, first_two, last),
            avx._mm512_permutex2var_pd(ab, last_two, cd),
            avx._mm512_permutex2var_pd(next, last_two, last),
        ];
        let mut at = 0;
        while at < 4 {
            let row = at + at / 2 * 2;
            let [low, high]: [[f64; 4]; 2] = cast(pairs[at]);
            put(rows, row, entry, low);
            put(rows, row + 2, entry, high);
            at += 1;
        }
    }
}

/// Turns four rows of four into columns, which is its own inverse.
#[inline(always)]
fn turned(simd: V3, [a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
    let avx = simd.avx;
    let (ab, cd) = (avx._mm256_unpacklo_pd(a, b), avx._mm256_unpacklo_pd(c, d));
    let (next, last) = (avx._mm256_unpackhi_pd(a, b), avx._mm256_unpackhi_pd(c, d));
    [
        avx._mm256_permute2f128_pd::<0x20>(ab, cd),
        avx._mm256_permute2f128_pd::<0x20>(next, last),
        avx._mm256_permute2f128_pd::<0x31>(ab, cd),
        avx._mm256_permute2f128_pd::<0x31>(next, last),
    ]
}

impl Quads<f64, __m256d> for V3 {
    #[inline(always)]
    fn columns<const N: usize>(self, rows: &[[f64; N]], entry: usize) -> [__m256d; 4] {
        let mut own: [__m256d; 4] = [cast([0.0f64; 4]); 4];
        let mut row = 0;
        while row < 4 {
            own[row] = cast(piece(rows, row, entry));
            row += 1;
        }
        turned(self, own)
    }

    #[inline(always)]
    fn rows<const N: usize>(self, columns: [__m256d; 4], rows: &mut [[f64; N]], entry: usize) {
        let own = turned(self, columns);
        let mut row = 0;
        while row < 4 {
            put(rows, row, entry, cast(own[row]));
            row += 1;
        }
    }
}

/// Floats, of which 128 bits hold four: there each column has four rows that follow each other.
macro_rules! singles {
    ($token:ident, $raw:ident, $parts:literal, |$simd:ident, $pieces:ident| $joined:expr;
     $low:ident, $high:ident, $low_two:ident, $high_two:ident, $of_two:ident, $two:ident; $avx:ident) => {
        impl Quads<f32, $raw> for $token {
            #[inline(always)]
            fn columns<const N: usize>(self, rows: &[[f32; N]], entry: usize) -> [$raw; 4] {
                let mut own: [$raw; 4] = [cast([0.0f32; 4 * $parts]); 4];
                let mut at = 0;
                while at < 4 {
                    let mut $pieces: [f32x4; $parts] = [cast([0.0f32; 4]); $parts];
                    let mut part = 0;
                    while part < $parts {
                        $pieces[part] = cast(piece(rows, at + 4 * part, entry));
                        part += 1;
                    }
                    let $simd = self;
                    own[at] = $joined;
                    at += 1;
                }
                let avx = self.$avx;
                let [a, b, c, d] = own;
                let (ab, cd) = (avx.$two(avx.$low(a, b)), avx.$two(avx.$low(c, d)));
                let (next, last) = (avx.$two(avx.$high(a, b)), avx.$two(avx.$high(c, d)));
                [
                    avx.$of_two(avx.$low_two(ab, cd)),
                    avx.$of_two(avx.$high_two(ab, cd)),
                    avx.$of_two(avx.$low_two(next, last)),
                    avx.$of_two(avx.$high_two(next, last)),
                ]
            }

            #[inline(always)]
            fn rows<const N: usize>(self, columns: [$raw; 4], rows: &mut [[f32; N]], entry: usize) {
                let avx = self.$avx;
                let [a, b, c, d] = columns;
                let (ab, cd) = (avx.$two(avx.$low(a, b)), avx.$two(avx.$low(c, d)));
                let (next, last) = (avx.$two(avx.$high(a, b)), avx.$two(avx.$high(c, d)));
                let own = [
                    avx.$low_two(ab, cd),
                    avx.$high_two(ab, cd),
                    avx.$low_two(next, last),
                    avx.$high_two(next, last),
                ];
                let mut at = 0;
                while at < 4 {
                    let pieces: [[f32; 4]; $parts] = cast(own[at]);
                    let mut part = 0;
                    while part < $parts {
                        put(rows, at + 4 * part, entry, pieces[part]);
                        part += 1;
                    }
                    at += 1;
                }
            }
        }
    };
}
singles!(
    V4, __m512, 4,
    |simd, pieces| {
        let avx = simd.avx512f;
        let own = avx._mm512_castps128_ps512(cast(pieces[0]));
        let own = avx._mm512_insertf32x4::<1>(own, cast(pieces[1]));
        let own = avx._mm512_insertf32x4::<2>(own, cast(pieces[2]));
        avx._mm512_insertf32x4::<3>(own, cast(pieces[3]))
    };
    _mm512_unpacklo_ps, _mm512_unpackhi_ps, _mm512_unpacklo_pd, _mm512_unpackhi_pd,
    _mm512_castpd_ps, _mm512_castps_pd; avx512f
);
singles!(
    V3, __m256, 2,
    |simd, pieces| {
        let own = simd.avx._mm256_castps128_ps256(cast(pieces[0]));
        simd.avx._mm256_insertf128_ps::<1>(own, cast(pieces[1]))
    };
    _mm256_unpacklo_ps, _mm256_unpackhi_ps, _mm256_unpacklo_pd, _mm256_unpackhi_pd,
    _mm256_castpd_ps, _mm256_castps_pd; avx
);

/// Implements the methods of [`Vector`](crate::Vector) that turn rows into columns and back, four
/// entries at a time; fewer have no room for that.
macro_rules! quads {
    ($float:ident, $vector:ident) => {
        #[inline(always)]
        fn columns<const N: usize>(token: Self::Token, rows: &[[$float; N]]) -> [Self; N] {
            if N < 4 {
                return columns_by_numbers(token, rows);
            }
            let mut columns = [$vector(token, cast(token.columns(rows, 0)[0])); N];
            let mut done = 0;
            while done < N {
                // The last four may begin among those that are done.
                let first = if done + 4 <= N { done } else { N - 4 };
                let four = token.columns(rows, first);
                let mut entry = 0;
                while entry < 4 {
                    columns[first + entry] = $vector(token, cast(four[entry]));
                    entry += 1;
                }
                done = first + 4;
            }
            columns
        }

        #[inline(always)]
        fn rows<const N: usize>(columns: &[Self; N], rows: &mut [[$float; N]]) {
            if N < 4 {
                return rows_by_numbers(columns, rows);
            }
            // From the last on: who reads a row reads its first four together, which must be what
            // was written together last.
            let mut left = N;
            while left > 0 {
                let first = if left > 4 { left - 4 } else { 0 };
                let mut four = [cast(columns[first].1); 4];
                let mut entry = 0;
                while entry < 4 {
                    four[entry] = cast(columns[first + entry].1);
                    entry += 1;
                }
                columns[first].0.rows(four, rows, first);
                left = first;
            }
        }
    };
}
pub(crate) use quads;
