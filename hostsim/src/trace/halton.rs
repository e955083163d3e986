//! In: a dimension and a sample index. Out: the sample, in [0, 1). Cost: one division per digit.

/// The bases: the first 61 primes, enough for 20 bounces of three dimensions each.
const PRIMES: [u32; 61] = [
    2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83, 89, 97, 101, 103,
    107, 109, 113, 127, 131, 137, 139, 149, 151, 157, 163, 167, 173, 179, 181, 191, 193, 197, 199, 211, 223,
    227, 229, 233, 239, 241, 251, 257, 263, 269, 271, 277, 281, 283,
];

/// The reversed Halton sequence: the radical inverse of `index` with every non-zero digit `q` replaced by `p - q`.
///
/// The sum runs from the first digit on, `digit * f` with `f` = 1/p, 1/p², …: another order gives other last bits.
#[inline]
pub fn halton(dimension: usize, index: u32) -> f64 {
    let p = PRIMES[dimension];
    let reciprocal = 1.0 / f64::from(p);
    let (mut sum, mut f, mut rest) = (0.0, reciprocal, index);
    while rest > 0 {
        let digit = rest % p;
        let reversed = if digit == 0 { 0 } else { p - digit };
        sum += f64::from(reversed) * f;
        rest /= p;
        f *= reciprocal;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_samples() {
        // Base 2 has no other non-zero digit to swap with; base 3 swaps 1 and 2.
        assert_eq!([0, 1, 2, 3].map(|i| halton(0, i)), [0.0, 0.5, 0.25, 0.75]);
        assert_eq!(halton(1, 1), 2.0 / 3.0);
        assert_eq!(halton(1, 2), 1.0 / 3.0);
    }

    #[test]
    fn bases_are_the_first_primes() {
        let is_prime = |n: u32| (2..n).all(|d| !n.is_multiple_of(d));
        assert!((2..=283).filter(|&n| is_prime(n)).eq(PRIMES));
    }
}
