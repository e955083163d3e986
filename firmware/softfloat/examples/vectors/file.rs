//! From a file to its lines.

use crate::task::{Operation, Task};
use std::fs::File;
use std::io::BufReader;

/// One case: operands, and each expected result with its flags.
#[derive(Debug)]
pub struct Line {
    /// Counted from 1.
    pub number: usize,
    pub operands: [u32; 2],
    pub expected: Results,
}

/// One result with flags, or two: nearest even, and towards zero.
pub type Results = (Case, Option<Case>);

/// A result and its flags.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Case {
    pub result: u32,
    pub flags: u8,
}

/// The text of a file, unpacked if its name ends in `.xz`.
pub fn read(path: &str) -> Result<String, String> {
    let cannot = |error: &dyn std::fmt::Display| format!("cannot be read: {error}");
    if !path.ends_with(".xz") {
        return std::fs::read_to_string(path).map_err(|error| cannot(&error));
    }
    let file = File::open(path).map_err(|error| cannot(&error))?;
    let mut text = Vec::new();
    lzma_rs::xz_decompress(&mut BufReader::new(file), &mut text).map_err(|error| cannot(&error))?;
    String::from_utf8(text).map_err(|error| cannot(&error))
}

/// The lines of a file; empty ones are passed over.
pub fn parse(text: &str, task: &Task) -> Result<Vec<Line>, String> {
    let mut lines = Vec::new();
    for (index, text) in text.lines().enumerate() {
        if text.trim().is_empty() {
            continue;
        }
        let line = parse_line(index + 1, text, task);
        lines.push(line.map_err(|error| format!("line {}: {text:?}: {error}", index + 1))?);
    }
    if lines.is_empty() { Err("holds no test".into()) } else { Ok(lines) }
}

fn parse_line(number: usize, text: &str, task: &Task) -> Result<Line, String> {
    let mut fields = [0; 5];
    let mut count = 0;
    for field in text.split_ascii_whitespace() {
        let slot = fields.get_mut(count).ok_or("too many fields")?;
        *slot =
            u32::from_str_radix(field, 16).map_err(|_| format!("{field:?} is not a hexadecimal number"))?;
        count += 1;
    }
    let operands = task.operation.operands();
    let both = matches!(task.operation, Operation::ToInteger(_)) && task.rounding.is_none() && count == 5;
    if count != operands + 2 && !both {
        return Err(format!("{count} fields, where {} were expected", operands + 2));
    }
    let (operand_width, result_width) = widths(task);
    let case = |at: usize| -> Result<Case, String> {
        let (result, flags) = (fields[at], fields[at + 1]);
        fits(result, result_width, "the result")?;
        fits(flags, 5, "the flags")?;
        Ok(Case { result, flags: flags as u8 })
    };
    for &operand in &fields[..operands] {
        fits(operand, operand_width, "an operand")?;
    }
    let second = if operands == 2 { fields[1] } else { 0 };
    let expected = (case(operands)?, if both { Some(case(operands + 2)?) } else { None });
    Ok(Line { number, operands: [fields[0], second], expected })
}

/// Bits an operand and a result may have.
fn widths(task: &Task) -> (u32, u32) {
    let width = task.format.width();
    match task.operation {
        Operation::Lt | Operation::Le | Operation::Eq => (width, 1),
        Operation::Cmp => (width, 3),
        Operation::ToInteger(_) => (width, 32),
        Operation::FromInteger(_) => (32, width),
        Operation::Convert(to) => (width, to.width()),
        _ => (width, width),
    }
}

fn fits(value: u32, width: u32, what: &str) -> Result<(), String> {
    match value.checked_shr(width) {
        None | Some(0) => Ok(()),
        Some(_) => Err(format!("{what} {value:X} has more than {width} bits")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse_as(name: &str, text: &str) -> Result<Vec<Line>, String> {
        parse(text, &Task::of_path(name).unwrap())
    }

    #[test]
    fn forms_are_told_apart_by_operation_and_count() {
        let line = &parse_as("f24_to_i32.txt", "3F8000 00000002 01 00000001 01\n").unwrap()[0];
        assert_eq!(line.expected.1, Some(Case { result: 1, flags: 1 }));
        let line = &parse_as("f24_cmp.txt", "\n3F0000 3F0000 6 00\n").unwrap()[0];
        assert_eq!((line.number, line.operands), (2, [0x3F_0000; 2]));
    }

    #[test]
    fn malformed_lines_are_refused() {
        for (name, text) in [
            ("f24_add.txt", "3F0000 3F0000 400000"),
            ("f24_add.txt", "3F0000 3F0000 400000 00 00"),
            ("f24_add.txt", "3F0000 3F0000 01400000 00"),
            ("f24_add.txt", "3F0000 3F000G 400000 00"),
            ("f24_sqrt.txt", "3F0000 3F0000 20"),
            ("f32_lt.txt", "3F000000 3F000000 2 00"),
            ("f32_to_i32_rtz.txt", "3F000000 0 01 0 01"),
            ("f32_add.txt", "\n"),
        ] {
            assert!(parse_as(name, text).is_err(), "{name}: {text}");
        }
    }
}
