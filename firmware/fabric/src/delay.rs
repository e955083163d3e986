//! A delay line; in: one value a cycle or none, out: the same, `LATENCY` cycles later; cost: one slot a stage.

/// `LATENCY` registers in a row: what [`shift`](Delay::shift) takes in cycle `t` it gives back in cycle `t + LATENCY`.
///
/// It moves only when it is shifted, so a part that is held (no clock enable) simply does not shift it.
#[derive(Clone, Debug)]
pub struct Delay<T, const LATENCY: usize> {
    stages: [Option<T>; LATENCY],
    oldest: usize,
    held: usize,
}

impl<T, const LATENCY: usize> Delay<T, LATENCY> {
    /// An empty line.
    pub const fn new() -> Self {
        const { assert!(LATENCY > 0, "a delay of no cycle is a wire") };
        Self { stages: [const { None }; LATENCY], oldest: 0, held: 0 }
    }

    /// One clock: `input` enters, and what entered `LATENCY` clocks ago leaves.
    #[inline]
    pub fn shift(&mut self, input: Option<T>) -> Option<T> {
        self.held += usize::from(input.is_some());
        let output = core::mem::replace(&mut self.stages[self.oldest], input);
        self.held -= usize::from(output.is_some());
        self.oldest = if self.oldest + 1 == LATENCY { 0 } else { self.oldest + 1 };
        output
    }

    /// Whether every stage holds a bubble.
    #[inline]
    pub const fn is_empty(&self) -> bool {
        self.held == 0
    }
}

impl<T, const LATENCY: usize> Default for Delay<T, LATENCY> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::Delay;

    #[test]
    fn leaves_at_the_latency_and_not_one_cycle_before() {
        let mut line: Delay<u8, 4> = Delay::new();
        line.shift(Some(9));
        for _ in 0..3 {
            assert!(!line.is_empty());
            assert_eq!(line.shift(None), None);
        }
        assert_eq!(line.shift(None), Some(9));
        assert!(line.is_empty());
    }

    #[test]
    fn keeps_order_and_bubbles() {
        let mut line: Delay<usize, 3> = Delay::new();
        let input = [Some(1), None, Some(2), Some(3), None, None, None];
        let output = input.map(|value| line.shift(value));
        assert_eq!(output, [None, None, None, Some(1), None, Some(2), Some(3)]);
    }
}
