//! Operands, and the two ways to time an operation.

use crate::candidates::Operation;
use std::hint::black_box;
use std::time::Instant;

/// Many, so that no branch predictor learns them by heart.
const COUNT: usize = 1 << 16;

/// Random operands as `f32`.
pub struct Operands {
    a: Vec<f32>,
    b: Vec<f32>,
    /// Operands which keep a dependent chain where it began: each undoes the one before.
    chain: Vec<f32>,
}

/// Best ns an operation.
#[derive(Clone, Copy)]
pub struct Best {
    pub chain: f64,
    pub throughput: f64,
}

impl Operands {
    pub fn new(operation: Operation) -> Operands {
        let mut state = 0x9E37_79B9_7F4A_7C15_u64;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 32) as u32
        };
        // Magnitudes of 2^-8 to 2^8; both signs, but for the root.
        let mut number = || {
            let bits = random();
            let exponent = 127 - 8 + (bits >> 24 & 15);
            let sign = if operation == Operation::Sqrt { 0 } else { bits & 1 << 31 };
            f32::from_bits(sign | exponent << 23 | bits & 0x7F_FFFF)
        };
        let a = (0..COUNT).map(|_| number()).collect();
        let b: Vec<f32> = (0..COUNT).map(|_| number()).collect();
        let undo = |x: f32| match operation {
            Operation::Add | Operation::Sub => -x,
            _ => 1.0 / x,
        };
        let chain = (0..COUNT).map(|i| if i % 2 == 0 { b[i] } else { undo(b[i - 1]) }).collect();
        Operands { a, b, chain }
    }

    /// ns an operation where none waits for another. An operation gives its result and its flags, gathered as a program
    /// would.
    pub fn throughput<T: Copy>(
        &self,
        read: impl Fn(f32) -> T,
        bits: impl Fn(T) -> u32,
        operation: impl Fn(T, T) -> (T, u8),
    ) -> f64 {
        let (a, b): (Vec<T>, Vec<T>) =
            (self.a.iter().map(|&x| read(x)).collect(), self.b.iter().map(|&x| read(x)).collect());
        let (mut sum, mut flags) = (0, 0);
        let start = Instant::now();
        for (&x, &y) in a.iter().zip(&b) {
            // The operand passes through memory, so that no loop becomes a vector one.
            let result = operation(black_box(x), y);
            sum ^= bits(result.0);
            flags |= result.1;
        }
        black_box((sum, flags));
        start.elapsed().as_nanos() as f64 / COUNT as f64
    }

    /// ns an operation where each waits for the one before.
    pub fn chain<T: Copy>(&self, read: impl Fn(f32) -> T, operation: impl Fn(T, T) -> (T, u8)) -> f64 {
        let chain: Vec<T> = self.chain.iter().map(|&x| read(x)).collect();
        let (mut x, mut flags) = (read(self.a[0]), 0);
        let start = Instant::now();
        for &y in &chain {
            let result = operation(x, y);
            x = result.0;
            flags |= result.1;
        }
        black_box((x, flags));
        start.elapsed().as_nanos() as f64 / COUNT as f64
    }
}
