//! What a file asks for, read from its name.

use lucerna_softfloat::{Policy, Rounding};

/// A number format.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Format {
    F32,
    F24,
}

impl Format {
    fn of_name(name: &str) -> Option<Format> {
        match name {
            "f32" => Some(Format::F32),
            "f24" => Some(Format::F24),
            _ => None,
        }
    }

    pub const fn width(self) -> u32 {
        match self {
            Format::F32 => 32,
            Format::F24 => 24,
        }
    }
}

/// An integer type.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Integer {
    I32,
    U32,
}

impl Integer {
    fn of_name(name: &str) -> Option<Integer> {
        match name {
            "i32" => Some(Integer::I32),
            "u32" | "ui32" => Some(Integer::U32),
            _ => None,
        }
    }
}

/// What is computed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Operation {
    Add,
    Sub,
    Mul,
    Div,
    Min,
    Max,
    Square,
    Sqrt,
    Lt,
    Le,
    Eq,
    /// All three at once: lt | le << 1 | eq << 2.
    Cmp,
    ToInteger(Integer),
    FromInteger(Integer),
    Convert(Format),
}

impl Operation {
    fn of_name(name: &str) -> Option<Operation> {
        Some(match name {
            "add" => Operation::Add,
            "sub" => Operation::Sub,
            "mul" => Operation::Mul,
            "div" => Operation::Div,
            "min" => Operation::Min,
            "max" => Operation::Max,
            "square" => Operation::Square,
            "sqrt" => Operation::Sqrt,
            "lt" => Operation::Lt,
            "le" => Operation::Le,
            "eq" => Operation::Eq,
            "cmp" => Operation::Cmp,
            _ => return None,
        })
    }

    pub const fn operands(self) -> usize {
        match self {
            Operation::Square | Operation::Sqrt => 1,
            Operation::ToInteger(_) | Operation::FromInteger(_) | Operation::Convert(_) => 1,
            _ => 2,
        }
    }
}

/// An operation with all that qualifies it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Task {
    /// The operands' format; the result's, from an integer.
    pub format: Format,
    pub operation: Operation,
    pub policy: Policy,
    /// Said by the name; `None` is nearest even, or both where a line has room for both.
    pub rounding: Option<Rounding>,
    /// Whether the name says that quiet NaNs raise nothing in a comparison (or that they do).
    pub quiet: Option<bool>,
}

impl Task {
    /// Reads the name up to its first dot: `FORMAT_OPERATION`, `FROM_to_TO`, and suffixes.
    pub fn of_path(path: &str) -> Result<Task, String> {
        let file = path.rsplit(['/', '\\']).next().unwrap_or(path);
        let name = file.split('.').next().unwrap_or(file).to_ascii_lowercase();
        Task::of_name(&name).ok_or_else(|| {
            format!(
                "no operation named {name:?}; known: f32 or f24 _add _sub _mul _div _min _max _square _sqrt _lt _le \
                 _eq _cmp _to_i32 _to_u32, i32_to_ u32_to_ f32 or f24, f32_to_f24, f24_to_f32; with _ftz, _quiet, \
                 _signaling, _r_minMag or _rtz after it where they apply"
            )
        })
    }

    fn of_name(name: &str) -> Option<Task> {
        let (mut base, mut policy, mut rounding, mut quiet) = (name, Policy::GRADUAL, None, None);
        loop {
            base = if let Some(rest) = cut(base, &["_ftz", "_flush", "_flushed"]) {
                policy = Policy::FLUSH;
                rest
            } else if let Some(rest) = cut(base, &["_r_minmag", "_rx_minmag", "_rtz", "_rz", "_trunc"]) {
                rounding = Some(Rounding::TowardZero);
                rest
            } else if let Some(rest) = cut(base, &["_r_near_even", "_rx_near_even", "_rne"]) {
                rounding = Some(Rounding::NearestEven);
                rest
            } else if let Some(rest) = cut(base, &["_quiet"]) {
                quiet = Some(true);
                rest
            } else if let Some(rest) = cut(base, &["_signaling", "_signalling"]) {
                quiet = Some(false);
                rest
            } else {
                break;
            };
        }
        let (format, operation) = match base.split_once("_to_") {
            Some((from, to)) => match (Format::of_name(from), Integer::of_name(from)) {
                (Some(format), _) => match (Format::of_name(to), Integer::of_name(to)) {
                    (Some(to), _) => (format, Operation::Convert(to)),
                    (_, Some(to)) => (format, Operation::ToInteger(to)),
                    _ => return None,
                },
                (_, Some(from)) => (Format::of_name(to)?, Operation::FromInteger(from)),
                _ => return None,
            },
            None => {
                let (format, operation) = base.split_once('_')?;
                (Format::of_name(format)?, Operation::of_name(operation)?)
            }
        };
        // Towards zero is a way to integers only, and a quiet addition means nothing: better refused than misread.
        let compares = matches!(operation, Operation::Lt | Operation::Le | Operation::Eq | Operation::Cmp);
        let truncates = rounding == Some(Rounding::TowardZero);
        if truncates && !matches!(operation, Operation::ToInteger(_)) || quiet.is_some() && !compares {
            return None;
        }
        Some(Task { format, operation, policy, rounding, quiet })
    }
}

fn cut<'a>(name: &'a str, suffixes: &[&str]) -> Option<&'a str> {
    suffixes.iter().find_map(|suffix| name.strip_suffix(suffix))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn task(path: &str) -> Task {
        Task::of_path(path).unwrap()
    }

    #[test]
    fn a_name_gives_format_operation_and_what_qualifies_them() {
        assert_eq!(task("x/f32_add.rv.txt").operation, Operation::Add);
        assert_eq!(task("f24_mul_ftz.txt.xz").policy, Policy::FLUSH);
        assert_eq!(task("f24_mul_ftz.txt").format, Format::F24);
        assert_eq!(task("f32_to_ui32.l2.rv.txt").operation, Operation::ToInteger(Integer::U32));
        assert_eq!(task("i32_to_f24.txt").operation, Operation::FromInteger(Integer::I32));
        assert_eq!(task("f32_to_f24_ftz.txt").operation, Operation::Convert(Format::F24));
        assert_eq!(task("f32_to_i32_r_minMag.txt").rounding, Some(Rounding::TowardZero));
        assert_eq!(task("f32_le_quiet.txt").quiet, Some(true));
        assert_eq!(task("f32_eq_signaling.txt").quiet, Some(false));
    }

    #[test]
    fn an_unknown_name_is_refused() {
        for path in
            ["f32_fma.txt", "f64_add.txt", "add.txt", "f32_add_rtz.txt", "f32_add_quiet.txt", "f32_to_.txt"]
        {
            assert!(Task::of_path(path).is_err(), "{path}");
        }
    }
}
