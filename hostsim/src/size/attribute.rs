//! Whose code it is. In: a symbol's or inlined function's name. Out: a crate. Cost: demangling.

/// Where the assembler, the linker, or a C name hides the crate.
const BY_PREFIX: [(&str, &str); 16] = [
    (".Lanon", CONSTANTS),
    (".Lswitch", CONSTANTS),
    (".L__unnamed", CONSTANTS),
    ("str.", CONSTANTS),
    ("_defmt", "defmt"),
    ("__aeabi", "compiler_builtins"),
    ("__udiv", "compiler_builtins"),
    ("mem", "compiler_builtins"),
    ("__INTERRUPTS", "cortex_m_rt"),
    ("__EXCEPTIONS", "cortex_m_rt"),
    ("__RESET_VECTOR", "cortex_m_rt"),
    ("Reset", "cortex_m_rt"),
    ("HardFault", "cortex_m_rt"),
    ("DefaultHandler", "cortex_m_rt"),
    ("DefaultPreInit", "cortex_m_rt"),
    ("__sh_syscall", "cortex_m_semihosting"),
];

/// Strings and tables, which the compiler shares between crates.
pub const CONSTANTS: &str = "(constants)";
/// The job in a program's flash: data, whatever the program's size.
pub const JOB: &str = "(job)";
/// What is left.
pub const OTHER: &str = "(other)";
/// The crate whose generic code belongs to whoever uses it.
pub const CORE: &str = "core";

/// A name as people write it, without the hash.
pub fn demangle(symbol: &str) -> String {
    format!("{:#}", rustc_demangle::demangle(symbol))
}

/// The crate of a demangled path.
pub fn crate_of(path: &str) -> &str {
    let known = || BY_PREFIX.iter().find(|(prefix, _)| path.starts_with(prefix)).map(|(_, krate)| *krate);
    if path == "lucerna_app::board::pree::JOB" {
        return JOB;
    }
    root(path).or_else(known).unwrap_or(OTHER)
}

/// The first name of a path; of `<Type as Trait>::f`, the type's, or the trait's where the type is built in.
fn root(path: &str) -> Option<&str> {
    let path = path.trim_start_matches(['&', '*', '[', '(', ' ']);
    let path = ["mut ", "const ", "dyn ", "impl "]
        .iter()
        .fold(path, |path, word| path.strip_prefix(word).unwrap_or(path));
    if let Some(inner) = path.strip_prefix('<') {
        let inner = &inner[..closing(inner)];
        return match split_as(inner) {
            Some((this, that)) => root(this).or_else(|| root(that)),
            None => root(inner),
        };
    }
    let (name, rest) =
        path.split_at(path.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(path.len()));
    // A v0 crate may carry its disambiguator.
    let rest = rest.strip_prefix('[').and_then(|rest| rest.split_once(']')).map_or(rest, |(_, rest)| rest);
    (rest.starts_with("::") && !name.is_empty() && name != "__rustc").then_some(name)
}

/// Where the bracket that was opened before `text` closes.
fn closing(text: &str) -> usize {
    let mut depth = 1;
    let mut before = ' ';
    for (place, letter) in text.char_indices() {
        match letter {
            '<' => depth += 1,
            // Not the arrow of a function type.
            '>' if before != '-' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return place;
        }
        before = letter;
    }
    text.len()
}

/// `Type as Trait` outside of inner brackets.
fn split_as(text: &str) -> Option<(&str, &str)> {
    let mut from = 0;
    while let Some(found) = text[from..].find(" as ").map(|found| from + found) {
        let before = &text[..found];
        if before.matches('<').count() == before.replace("->", "").matches('>').count() {
            return Some((before, &text[found + 4..]));
        }
        from = found + 4;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crates_of_paths() {
        for (path, expected) in [
            ("lucerna_pree::update::UpdatePass<F,_>::issue", "lucerna_pree"),
            ("lucerna_pree::fast::<impl lucerna_pree::update::UpdatePass<F,_>>::sweep", "lucerna_pree"),
            ("<lucerna_bus::model::ModelBus<T> as lucerna_bus::bus::Bus>::write", "lucerna_bus"),
            (
                "<lucerna_device::device::Device<M,P,D> as lucerna_bus::target::Target>::read",
                "lucerna_device",
            ),
            ("<core::fmt::Formatter>::pad", "core"),
            ("<&str as core::fmt::Display>::fmt", "core"),
            ("<&mut W as core::fmt::Write>::write_str", "core"),
            ("<[T] as lucerna_x::Pack>::pack", "lucerna_x"),
            ("<<A as b::C>::D as e::F>::g", "b"),
            ("<fn(u8) -> u8 as core::ops::Fn>::call", "core"),
            ("core::ptr::drop_in_place<lucerna_pree::engine::Pree<F,_>>", "core"),
            ("driver_only::program::pass", "driver_only"),
            ("compiler_builtins::mem::memcpy", "compiler_builtins"),
            ("__aeabi_memclr4", "compiler_builtins"),
            ("memmove", "compiler_builtins"),
            ("_defmt_write", "defmt"),
            (".Lanon.0b99.4", CONSTANTS),
            ("Reset", "cortex_m_rt"),
            ("__rustc::rust_begin_unwind", OTHER),
            ("lucerna_app::board::pree::JOB", JOB),
            ("main", OTHER),
        ] {
            assert_eq!(crate_of(path), expected, "{path}");
        }
    }

    #[test]
    fn both_manglings() {
        assert_eq!(
            demangle("_ZN12lucerna_pree6update5issue17h53def8ca4d5e0dafE"),
            "lucerna_pree::update::issue"
        );
        assert_eq!(crate_of(&demangle("_RNvNtCs1234_7mycrate3foo3bar")), "mycrate");
    }
}
