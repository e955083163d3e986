//! Our results for a line, and the conventions a file follows.

use crate::Forced;
use crate::file::{Case, Line, Results};
use crate::task::{Format, Integer, Operation, Task};
use lucerna_softfloat::{F24, F32, Flagged, Flags, Float, Policy, Rounding};

/// What sources of vector files choose differently, a file at a time.
#[derive(Clone, Copy, Debug)]
pub struct Convention {
    /// Conversions to integers raise inexact.
    raises_inexact: bool,
    /// Comparisons raise invalid for signalling NaNs only.
    quiet: bool,
}

impl Convention {
    /// What the file as a whole follows, unless forced.
    pub fn of_file(task: &Task, lines: &[Line], forced: Forced) -> Convention {
        let quiet_by_name = task.quiet.unwrap_or(task.operation == Operation::Eq);
        let quiet = match task.operation {
            Operation::Cmp => forced.quiet.or(task.quiet).unwrap_or_else(|| looks_quiet(task, lines)),
            _ => quiet_by_name,
        };
        let inexact = Flags::INEXACT.bits();
        let flagged = |case: &Case| case.flags & inexact != 0;
        let seen = |line: &Line| flagged(&line.expected.0) || line.expected.1.as_ref().is_some_and(flagged);
        let raises_inexact = forced.raises_inexact.unwrap_or_else(|| lines.iter().any(seen));
        Convention { raises_inexact, quiet }
    }

    /// The convention in words, where the operation leaves a choice.
    pub fn describe(self, task: &Task) -> Option<&'static str> {
        match task.operation {
            Operation::ToInteger(_) if self.raises_inexact => Some("exact form: conversions raise inexact"),
            Operation::ToInteger(_) => {
                Some("not-exact form: no line raises inexact, so ours is left out too")
            }
            Operation::Cmp if self.quiet => Some("quiet: only signalling NaNs raise invalid"),
            Operation::Cmp => Some("signalling: any NaN raises invalid, as lt and le do"),
            _ => None,
        }
    }
}

/// Quiet if there are lines with quiet NaNs only and none of them raises invalid.
fn looks_quiet(task: &Task, lines: &[Line]) -> bool {
    let nan = |x| match task.format {
        Format::F32 => F32::from_bits(x).is_nan(),
        Format::F24 => F24::from_bits(x).is_nan(),
    };
    let signalling = |x| match task.format {
        Format::F32 => F32::from_bits(x).is_signalling(),
        Format::F24 => F24::from_bits(x).is_signalling(),
    };
    let mut telling = lines
        .iter()
        .filter(|line| line.operands.iter().any(|&x| nan(x)) && !line.operands.iter().any(|&x| signalling(x)))
        .peekable();
    telling.peek().is_some() && telling.all(|line| line.expected.0.flags == 0)
}

/// Our results for the form the line has.
pub fn line(task: &Task, convention: Convention, line: &Line) -> Results {
    let ours = |rounding| match task.format {
        Format::F32 => one::<8, 23>(task, convention, line.operands, rounding),
        Format::F24 => one::<7, 16>(task, convention, line.operands, rounding),
    };
    let first = ours(task.rounding.unwrap_or(Rounding::NearestEven));
    (first, line.expected.1.map(|_| ours(Rounding::TowardZero)))
}

/// `result flags`, once or twice, as a file has them.
pub fn show(results: &Results) -> String {
    let one = |case: &Case| format!("{:X} {:02X}", case.result, case.flags);
    match &results.1 {
        None => one(&results.0),
        Some(second) => format!("{} {}", one(&results.0), one(second)),
    }
}

fn one<const EXP: u32, const FRAC: u32>(
    task: &Task,
    convention: Convention,
    [a, b]: [u32; 2],
    rounding: Rounding,
) -> Case {
    let (x, y) = (Float::<EXP, FRAC>::from_bits(a), Float::<EXP, FRAC>::from_bits(b));
    let (policy, quiet) = (task.policy, convention.quiet);
    match task.operation {
        Operation::Add => number(x.add_with(y, policy)),
        Operation::Sub => number(x.sub_with(y, policy)),
        Operation::Mul => number(x.mul_with(y, policy)),
        Operation::Div => number(x.div_with(y, policy)),
        Operation::Min => number(x.min_with(y, policy)),
        Operation::Max => number(x.max_with(y, policy)),
        Operation::Square => number(x.square_with(policy)),
        Operation::Sqrt => number(x.sqrt_with(policy)),
        Operation::Lt => truth(if quiet { x.lt_quiet_with(y, policy) } else { x.lt_with(y, policy) }),
        Operation::Le => truth(if quiet { x.le_quiet_with(y, policy) } else { x.le_with(y, policy) }),
        Operation::Eq => truth(if quiet { x.eq_with(y, policy) } else { x.eq_signalling_with(y, policy) }),
        Operation::Cmp => compare(x, y, quiet, policy),
        Operation::ToInteger(to) => {
            let case = match to {
                Integer::I32 => x.to_i32_with(rounding, policy).map(|value| value as u32),
                Integer::U32 => x.to_u32_with(rounding, policy),
            };
            let kept = if convention.raises_inexact { 0xFF } else { !Flags::INEXACT.bits() };
            Case { result: case.value, flags: case.flags.bits() & kept }
        }
        Operation::FromInteger(Integer::I32) => number(Float::<EXP, FRAC>::from_i32_with(a as i32, policy)),
        Operation::FromInteger(Integer::U32) => number(Float::<EXP, FRAC>::from_u32_with(a, policy)),
        Operation::Convert(Format::F32) => number(x.convert_with::<8, 23>(policy)),
        Operation::Convert(Format::F24) => number(x.convert_with::<7, 16>(policy)),
    }
}

/// lt | le << 1 | eq << 2, with the flags of all three.
fn compare<const EXP: u32, const FRAC: u32>(
    x: Float<EXP, FRAC>,
    y: Float<EXP, FRAC>,
    quiet: bool,
    policy: Policy,
) -> Case {
    let (lt, le) = match quiet {
        true => (x.lt_quiet_with(y, policy), x.le_quiet_with(y, policy)),
        false => (x.lt_with(y, policy), x.le_with(y, policy)),
    };
    let eq = x.eq_with(y, policy);
    let result = lt.value as u32 | (le.value as u32) << 1 | (eq.value as u32) << 2;
    Case { result, flags: (lt.flags | le.flags | eq.flags).bits() }
}

fn number<const EXP: u32, const FRAC: u32>(x: Flagged<Float<EXP, FRAC>>) -> Case {
    Case { result: x.value.to_bits(), flags: x.flags.bits() }
}

fn truth(x: Flagged<bool>) -> Case {
    Case { result: x.value as u32, flags: x.flags.bits() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::parse;

    fn agrees(name: &str, text: &str, forced: Forced) -> Vec<bool> {
        let task = Task::of_path(name).unwrap();
        let lines = parse(text, &task).unwrap();
        let convention = Convention::of_file(&task, &lines, forced);
        lines.iter().map(|case| line(&task, convention, case) == case.expected).collect()
    }

    #[test]
    fn results_and_flags_are_both_compared() {
        let text =
            "3F800000 40400000 3EAAAAAB 01\n3F800000 40400000 3EAAAAAB 00\n3F800000 40400000 3EAAAAAA 01";
        assert_eq!(agrees("f32_div.txt", text, Forced::default()), [true, false, false]);
    }

    #[test]
    fn inexact_is_left_out_only_when_the_whole_file_does() {
        let not_exact = "3FC00000 00000002 00\n7FC00000 7FFFFFFF 10";
        assert_eq!(agrees("f32_to_i32.txt", not_exact, Forced::default()), [true, true]);
        let exact = "3FC00000 00000002 01\n3FC00000 00000002 00";
        assert_eq!(agrees("f32_to_i32.txt", exact, Forced::default()), [true, false]);
        let forced = Forced { raises_inexact: Some(true), ..Forced::default() };
        assert_eq!(agrees("f32_to_i32.txt", not_exact, forced), [false, true]);
        assert_eq!(agrees("f24_to_i32.txt", "3F8000 2 01 1 01", Forced::default()), [true]);
    }

    #[test]
    fn a_compare_file_is_quiet_only_if_every_quiet_nan_line_is() {
        let (quiet, signalling) = ("7F8000 3F0000 0 00", "7F8000 3F0000 0 10");
        assert_eq!(agrees("f24_cmp.txt", quiet, Forced::default()), [true]);
        assert_eq!(agrees("f24_cmp.txt", signalling, Forced::default()), [true]);
        let mixed = format!("{quiet}\n{signalling}");
        assert_eq!(agrees("f24_cmp.txt", &mixed, Forced::default()), [false, true]);
        assert_eq!(agrees("f24_cmp.txt", "3F0000 3F0000 6 00", Forced::default()), [true]);
    }

    #[test]
    fn flushing_is_taken_from_the_name() {
        assert_eq!(agrees("f24_mul.txt", "010000 3E0000 008000 00", Forced::default()), [true]);
        assert_eq!(agrees("f24_mul_ftz.txt", "010000 3E0000 000000 03", Forced::default()), [true]);
    }
}
