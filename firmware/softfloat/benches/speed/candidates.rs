//! Who takes part, in which operations.

use crate::measure::{Best, Operands};
use const_soft_float::soft_f32::SoftF32;
use lucerna_softfloat::{F24, Float, Policy};
use std::hint::black_box;

/// A measured operation.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    Add,
    Sub,
    Mul,
    Div,
    Sqrt,
    Lt,
}

impl Operation {
    pub const ALL: [Operation; 6] =
        [Operation::Add, Operation::Sub, Operation::Mul, Operation::Div, Operation::Sqrt, Operation::Lt];

    pub const fn name(self) -> &'static str {
        match self {
            Operation::Add => "add",
            Operation::Sub => "sub",
            Operation::Mul => "mul",
            Operation::Div => "div",
            Operation::Sqrt => "sqrt",
            Operation::Lt => "lt",
        }
    }
}

pub const OURS: &str = "ours f32, no flags";
pub const OURS_FLAGS: &str = "ours f32, flags";
pub const BERKELEY: &str = "Berkeley SoftFloat (with flags, by wrapper)";

/// One implementation of one operation.
pub struct Candidate {
    pub name: &'static str,
    pub operation: Operation,
    pub best: Best,
    run: Box<dyn Fn(&Operands) -> Best>,
}

impl Candidate {
    pub fn run(&mut self, operands: &Operands) {
        let now = (self.run)(operands);
        self.best.chain = self.best.chain.min(now.chain);
        self.best.throughput = self.best.throughput.min(now.throughput);
    }

    /// `operation` on operands made by `read`, its result turned to bits by `bits`.
    fn new<T: Copy + 'static>(
        name: &'static str,
        operation: Operation,
        read: impl Fn(f32) -> T + Copy + 'static,
        bits: impl Fn(T) -> u32 + Copy + 'static,
        compute: impl Fn(T, T) -> (T, u8) + Copy + 'static,
    ) -> Candidate {
        let best = Best { chain: f64::INFINITY, throughput: f64::INFINITY };
        let run = Box::new(move |operands: &Operands| Best {
            chain: operands.chain(read, compute),
            throughput: operands.throughput(read, bits, compute),
        });
        Candidate { name, operation, best, run }
    }
}

/// The root's chain needs a new operand each time: the fraction and the low exponent bits of `y` are mixed in.
const MIX: u32 = 0x00FF_FFFF;

fn mix<const EXP: u32, const FRAC: u32>(x: Float<EXP, FRAC>, y: Float<EXP, FRAC>) -> Float<EXP, FRAC> {
    Float::from_bits(x.to_bits() ^ y.to_bits() & MIX >> (23 - FRAC))
}

fn soft<const EXP: u32, const FRAC: u32>(name: &'static str) -> Vec<Candidate> {
    macro_rules! candidate {
        ($operation:ident, $compute:expr) => {
            Candidate::new(
                name,
                Operation::$operation,
                Float::<EXP, FRAC>::from_f32,
                Float::<EXP, FRAC>::to_bits,
                |x, y| ($compute(x, y), 0),
            )
        };
    }
    vec![
        candidate!(Add, Float::add),
        candidate!(Sub, Float::sub),
        candidate!(Mul, Float::mul),
        candidate!(Div, Float::div),
        candidate!(Sqrt, |x, y| mix(x, y).sqrt()),
        candidate!(Lt, |x: Float<EXP, FRAC>, y| Float::from_bits(x.to_bits() ^ x.lt(y) as u32)),
    ]
}

fn soft_with<const EXP: u32, const FRAC: u32>(name: &'static str, policy: Policy) -> Vec<Candidate> {
    macro_rules! candidate {
        ($operation:ident, $compute:expr) => {
            Candidate::new(
                name,
                Operation::$operation,
                Float::<EXP, FRAC>::from_f32,
                Float::<EXP, FRAC>::to_bits,
                move |x, y| {
                    let result = $compute(x, y);
                    (result.value, result.flags.bits())
                },
            )
        };
    }
    vec![
        candidate!(Add, |x: Float<EXP, FRAC>, y| x.add_with(y, policy)),
        candidate!(Sub, |x: Float<EXP, FRAC>, y| x.sub_with(y, policy)),
        candidate!(Mul, |x: Float<EXP, FRAC>, y| x.mul_with(y, policy)),
        candidate!(Div, |x: Float<EXP, FRAC>, y| x.div_with(y, policy)),
        candidate!(Sqrt, |x, y| mix(x, y).sqrt_with(policy)),
        candidate!(Lt, |x: Float<EXP, FRAC>, y| {
            x.lt_with(y, policy).map(|less| Float::from_bits(x.to_bits() ^ less as u32))
        }),
    ]
}

fn native() -> Vec<Candidate> {
    macro_rules! candidate {
        ($operation:ident, $compute:expr) => {
            Candidate::new(
                "native f32",
                Operation::$operation,
                |x| x,
                f32::to_bits,
                |x: f32, y: f32| ($compute(x, y), 0),
            )
        };
    }
    vec![
        candidate!(Add, |x, y| x + y),
        candidate!(Sub, |x, y| x - y),
        candidate!(Mul, |x, y| x * y),
        candidate!(Div, |x, y| x / y),
        candidate!(Sqrt, |x: f32, y: f32| f32::from_bits(x.to_bits() ^ y.to_bits() & MIX).sqrt()),
        candidate!(Lt, |x: f32, y| f32::from_bits(x.to_bits() ^ (x < y) as u32)),
    ]
}

fn compiler_builtins() -> Vec<Candidate> {
    macro_rules! candidate {
        ($operation:ident, $compute:expr) => {
            Candidate::new(
                "compiler_builtins (port: const_soft_float)",
                Operation::$operation,
                SoftF32::from_f32,
                SoftF32::to_bits,
                |x, y| ($compute(x, y), 0),
            )
        };
    }
    vec![
        candidate!(Add, SoftF32::add),
        candidate!(Sub, SoftF32::sub),
        candidate!(Mul, SoftF32::mul),
        candidate!(Div, SoftF32::div),
    ]
}

/// F24 by the hardware's f64, rounded once.
fn by_f64() -> Vec<Candidate> {
    macro_rules! candidate {
        ($operation:ident, $compute:expr) => {
            Candidate::new(
                "F24 by way of hardware f64",
                Operation::$operation,
                F24::from_f32,
                F24::to_bits,
                |x: F24, y: F24| (F24::from_f64($compute(x, y)), 0),
            )
        };
    }
    vec![
        candidate!(Add, |x: F24, y: F24| x.to_f64() + y.to_f64()),
        candidate!(Sub, |x: F24, y: F24| x.to_f64() - y.to_f64()),
        candidate!(Mul, |x: F24, y: F24| x.to_f64() * y.to_f64()),
        candidate!(Div, |x: F24, y: F24| x.to_f64() / y.to_f64()),
        candidate!(Sqrt, |x, y| mix(x, y).to_f64().sqrt()),
    ]
}

#[cfg(feature = "berkeley")]
fn berkeley() -> Vec<Candidate> {
    use softfloat_wrapper::{F32 as Berkeley, Float as _, RoundingMode::TiesToEven};
    macro_rules! candidate {
        ($operation:ident, $compute:expr) => {
            Candidate::new(
                BERKELEY,
                Operation::$operation,
                |x: f32| Berkeley::from_bits(x.to_bits()),
                |x| x.to_bits(),
                |x: Berkeley, y: Berkeley| ($compute(x, y), 0),
            )
        };
    }
    vec![
        candidate!(Add, |x: Berkeley, y| x.add(y, TiesToEven)),
        candidate!(Sub, |x: Berkeley, y| x.sub(y, TiesToEven)),
        candidate!(Mul, |x: Berkeley, y| x.mul(y, TiesToEven)),
        candidate!(Div, |x: Berkeley, y| x.div(y, TiesToEven)),
        candidate!(Sqrt, |x: Berkeley, y: Berkeley| Berkeley::from_bits(x.to_bits() ^ y.to_bits() & MIX)
            .sqrt(TiesToEven)),
        candidate!(Lt, |x: Berkeley, y| Berkeley::from_bits(x.to_bits() ^ x.lt(y) as u32)),
    ]
}

/// What the wrapper's setting of the rounding mode costs: a call which stores to a thread-local, as the public setter
/// of the exception flags is too.
#[cfg(feature = "berkeley")]
pub fn rounding_mode_ns() -> Option<f64> {
    const COUNT: u32 = 100_000;
    let flags = softfloat_wrapper::ExceptionFlags::default();
    let time = |_| {
        let start = std::time::Instant::now();
        for _ in 0..COUNT {
            black_box(&flags).set();
        }
        start.elapsed().as_nanos() as f64 / f64::from(COUNT)
    };
    Some((0..20).map(time).fold(f64::INFINITY, f64::min))
}

#[cfg(not(feature = "berkeley"))]
fn berkeley() -> Vec<Candidate> {
    Vec::new()
}

#[cfg(not(feature = "berkeley"))]
pub fn rounding_mode_ns() -> Option<f64> {
    None
}

pub fn all() -> Vec<Candidate> {
    let mut all = Vec::new();
    all.extend(soft::<8, 23>(OURS));
    all.extend(soft_with::<8, 23>(OURS_FLAGS, Policy::GRADUAL));
    all.extend(soft_with::<8, 23>("ours f32, flags, flushed", black_box(Policy::FLUSH)));
    all.extend(native());
    all.extend(compiler_builtins());
    all.extend(berkeley());
    all.extend(soft::<7, 16>("ours F24, no flags"));
    all.extend(soft_with::<7, 16>("ours F24, flags", Policy::GRADUAL));
    all.extend(by_f64());
    all
}
