//! The clear version: every operation on integers of any needed size, written to be plainly right and not fast, with the
//! flags and both policies.

use super::Outcome;
use lucerna_softfloat::{Float, Policy, Subnormals};

pub const INEXACT: u8 = 0x01;
pub const UNDERFLOW: u8 = 0x02;
pub const OVERFLOW: u8 = 0x04;
pub const DIVIDE_BY_ZERO: u8 = 0x08;
pub const INVALID: u8 = 0x10;

/// ±mantissa · 2^exponent, or ever so slightly more in magnitude if `more`.
#[derive(Clone, Copy, Debug)]
pub struct Exact {
    pub negative: bool,
    pub mantissa: u128,
    pub exponent: i32,
    pub more: bool,
}

impl Exact {
    /// A finite number as it is.
    pub fn of<const EXP: u32, const FRAC: u32>(x: Float<EXP, FRAC>) -> Exact {
        let magnitude = x.abs().to_bits();
        let (field, fraction) = (magnitude >> FRAC, magnitude & ((1 << FRAC) - 1));
        let mantissa = if field == 0 { fraction } else { fraction | 1 << FRAC };
        let exponent = field.max(1) as i32 - Float::<EXP, FRAC>::BIAS - FRAC as i32;
        Exact { negative: x.is_sign_negative(), mantissa: u128::from(mantissa), exponent, more: false }
    }

    /// A finite host f64 as it is.
    pub fn of_f64(x: f64) -> Exact {
        let bits = x.to_bits();
        let (field, fraction) = ((bits >> 52 & 0x7FF) as i32, bits & ((1 << 52) - 1));
        let mantissa = if field == 0 { fraction } else { fraction | 1 << 52 };
        let exponent = field.max(1) - 1075;
        Exact { negative: x.is_sign_negative(), mantissa: u128::from(mantissa), exponent, more: false }
    }

    /// In units of 2^unit: the integer to the nearest (ties to even), and whether it is exact.
    fn in_units_of(self, unit: i32) -> (u128, bool) {
        let shift = unit - self.exponent;
        if shift <= 0 {
            assert!(!self.more, "not enough bits to round");
            return (self.mantissa << -shift, true);
        }
        let shift = shift.min(127);
        let (whole, rest) = (self.mantissa >> shift, self.mantissa & ((1 << shift) - 1));
        let half = 1 << (shift - 1);
        let up = rest > half || rest == half && (self.more || whole & 1 == 1);
        (whole + u128::from(up), rest == 0 && !self.more)
    }

    /// Rounded to a format.
    pub fn round<const EXP: u32, const FRAC: u32>(self, policy: Policy) -> Outcome {
        let bias = Float::<EXP, FRAC>::BIAS;
        let sign = u32::from(self.negative) << (EXP + FRAC);
        if self.mantissa == 0 {
            return (sign, 0);
        }
        let least_normal = 1 - bias;
        let leading = self.exponent + 127 - self.mantissa.leading_zeros() as i32;
        // With exponents unbounded.
        let (kept, _) = self.in_units_of(leading - FRAC as i32);
        let leading_rounded = leading + i32::from(kept >> (FRAC + 1) != 0);
        let tiny = leading_rounded < least_normal;
        if tiny && policy.subnormals == Subnormals::Flush {
            return (sign, UNDERFLOW | INEXACT);
        }
        if leading_rounded > bias {
            return (sign | ((1 << EXP) - 1) << FRAC, OVERFLOW | INEXACT);
        }
        let unit = (leading - FRAC as i32).max(least_normal - FRAC as i32);
        let (kept, exact) = self.in_units_of(unit);
        let flags = match (exact, tiny) {
            (true, _) => 0,
            (false, false) => INEXACT,
            (false, true) => INEXACT | UNDERFLOW,
        };
        // Subnormals and the least normals share a unit; each doubling of it is one more exponent, whose hidden bit is
        // in `kept`.
        let exponents_above = (unit - (least_normal - FRAC as i32)) as u32;
        (sign | ((exponents_above << FRAC) + kept as u32), flags)
    }

    pub fn add(self, other: Exact) -> Exact {
        let (large, small) = if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        // Past 90 bits of distance the smaller operand is as good as a unit 90 bits down.
        let distance = large.exponent - small.exponent;
        let (mantissa, exponent) = match distance {
            ..90 => (small.mantissa, small.exponent),
            _ if small.mantissa == 0 || large.mantissa == 0 => (small.mantissa, large.exponent - 90),
            _ => (1, large.exponent - 90),
        };
        if large.mantissa == 0 {
            return small;
        }
        let signed = |negative, mantissa: u128| if negative { -(mantissa as i128) } else { mantissa as i128 };
        let sum = signed(large.negative, large.mantissa << (large.exponent - exponent))
            + signed(small.negative, mantissa);
        Exact { negative: sum < 0, mantissa: sum.unsigned_abs(), exponent, more: false }
    }

    pub fn mul(self, other: Exact) -> Exact {
        Exact {
            negative: self.negative != other.negative,
            mantissa: self.mantissa * other.mantissa,
            exponent: self.exponent + other.exponent,
            more: false,
        }
    }

    pub fn div(self, other: Exact) -> Exact {
        let dividend = self.mantissa << 80;
        Exact {
            negative: self.negative != other.negative,
            mantissa: dividend / other.mantissa,
            exponent: self.exponent - 80 - other.exponent,
            more: !dividend.is_multiple_of(other.mantissa),
        }
    }

    pub fn sqrt(self) -> Exact {
        let square = self.mantissa << (80 + (self.exponent & 1));
        let root = square.isqrt();
        let exponent = (self.exponent - (self.exponent & 1) - 80) / 2;
        Exact { negative: false, mantissa: root, exponent, more: root * root != square }
    }
}

/// The operations with two operands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Operation {
    Add,
    Sub,
    Mul,
    Div,
}

/// An operation with its flags: special operands by the host's f64 (which is exact on them), others by integers.
pub fn binary<const EXP: u32, const FRAC: u32>(
    operation: Operation,
    a: Float<EXP, FRAC>,
    b: Float<EXP, FRAC>,
    policy: Policy,
) -> Outcome {
    let (a, b) = (read(a, policy), read(b, policy));
    let (x, y) = (to_f64(a), to_f64(b));
    let by_host = match operation {
        Operation::Add => x + y,
        Operation::Sub => x - y,
        Operation::Mul => x * y,
        Operation::Div => x / y,
    };
    let special = |x: f64| x == 0.0 || !x.is_finite();
    let cancels = matches!(operation, Operation::Add | Operation::Sub) && by_host == 0.0;
    if special(x) || special(y) || cancels {
        let signalling = a.is_signalling() || b.is_signalling();
        let made_nan = by_host.is_nan() && !x.is_nan() && !y.is_nan();
        let by_zero = operation == Operation::Div && y == 0.0 && x.is_finite() && x != 0.0;
        let invalid = if signalling || made_nan { INVALID } else { 0 };
        return (from_special(a, b, by_host), invalid | if by_zero { DIVIDE_BY_ZERO } else { 0 });
    }
    let (a, b) = (Exact::of(a), Exact::of(b));
    let exact = match operation {
        Operation::Add => a.add(b),
        Operation::Sub => a.add(Exact { negative: !b.negative, ..b }),
        Operation::Mul => a.mul(b),
        Operation::Div => a.div(b),
    };
    exact.round::<EXP, FRAC>(policy)
}

/// The square root with its flags.
pub fn sqrt<const EXP: u32, const FRAC: u32>(a: Float<EXP, FRAC>, policy: Policy) -> Outcome {
    let a = read(a, policy);
    let by_host = to_f64(a).sqrt();
    if by_host == 0.0 || !by_host.is_finite() {
        let invalid = a.is_signalling() || by_host.is_nan() && !a.is_nan();
        return (from_special(a, a, by_host), if invalid { INVALID } else { 0 });
    }
    Exact::of(a).sqrt().round::<EXP, FRAC>(policy)
}

/// The operand as the policy has it read.
pub fn read<const EXP: u32, const FRAC: u32>(x: Float<EXP, FRAC>, policy: Policy) -> Float<EXP, FRAC> {
    let flushes = policy.subnormals == Subnormals::Flush && x.is_subnormal();
    if flushes { Float::from_bits(x.to_bits() & 1 << (EXP + FRAC)) } else { x }
}

/// The value on the host, by arithmetic.
pub fn to_f64<const EXP: u32, const FRAC: u32>(x: Float<EXP, FRAC>) -> f64 {
    let sign = if x.is_sign_negative() { -1.0 } else { 1.0 };
    if x.is_nan() {
        return f64::NAN;
    }
    if x.is_infinite() {
        return sign * f64::INFINITY;
    }
    let exact = Exact::of(x);
    sign * exact.mantissa as f64 * f64::from_bits(((exact.exponent + 1023) as u64) << 52)
}

/// The bits of a zero, infinity or NaN, or of whichever operand has the value (as in 0 + x).
fn from_special<const EXP: u32, const FRAC: u32>(
    a: Float<EXP, FRAC>,
    b: Float<EXP, FRAC>,
    value: f64,
) -> u32 {
    let sign = u32::from(value.is_sign_negative()) << (EXP + FRAC);
    let infinity = ((1 << EXP) - 1) << FRAC;
    if value.is_nan() {
        infinity | 1 << (FRAC - 1)
    } else if value.is_infinite() {
        sign | infinity
    } else if value == 0.0 {
        sign
    } else {
        let same = if to_f64(a).abs() == value.abs() { a } else { b };
        same.abs().to_bits() | sign
    }
}
