//! Do the other forms of the map, SVD, C and Markdown, say what the Rust says? In: the committed files.

use std::collections::BTreeMap;
use std::fs;

use lucerna_regs::{REGISTERS, describe, displace, pree};
use svd_parser::svd::{Access, Field, ModifiedWriteValues, Register, RegisterCluster};
use svd_parser::{Config, ValidateLevel};

fn read(path: &str) -> String {
    fs::read_to_string(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).expect(path)
}

/// Registers of the SVD by address, blocks and arrays unrolled by the parser.
fn svd() -> BTreeMap<u32, Register> {
    let config = Config::default().validate_level(ValidateLevel::Strict).expand(true);
    let device = svd_parser::parse_with_config(&read("svd/lucerna.svd"), &config).expect("a legal SVD file");
    let [peripheral] = &device.peripherals[..] else { panic!("one peripheral") };
    let mut found = BTreeMap::new();
    for entry in peripheral.registers.as_ref().expect("registers") {
        let RegisterCluster::Register(register) = entry else { panic!("{entry:?} was not unrolled") };
        let previous = found.insert(register.address_offset, register.clone());
        assert!(previous.is_none(), "{} overlaps", register.name);
    }
    found
}

fn field_of(register: &Register, name: &str) -> Field {
    register.fields().find(|field| field.name == name).unwrap_or_else(|| panic!("{name}")).clone()
}

#[test]
fn svd_has_the_same_registers_and_fields() {
    let svd = svd();
    assert!(svd.keys().copied().eq(REGISTERS.iter().map(|register| register.offset)));
    for register in &REGISTERS {
        let found = &svd[&register.offset];
        let name = register.name.to_uppercase().replace('.', "_").replace(['[', ']'], "");
        assert_eq!(found.name, name);
        assert_eq!(found.properties.reset_value, Some(u64::from(register.reset)), "{name}");
        assert_eq!(found.fields().count(), register.fields.len(), "{name}");
        for field in register.fields {
            let place = field_of(found, field.name);
            assert_eq!(
                (place.bit_offset(), place.bit_width()),
                (field.shift, field.width),
                "{name}.{}",
                field.name
            );
            let access = match (register.readable & field.mask(), register.writable & field.mask()) {
                (_, 0) => Access::ReadOnly,
                (0, _) => Access::WriteOnly,
                _ => Access::ReadWrite,
            };
            assert_eq!(place.access, Some(access), "{name}.{}", field.name);
            let clears = place.modified_write_values == Some(ModifiedWriteValues::OneToClear);
            assert_eq!(clears, register.clears & field.mask() != 0, "{name}.{}", field.name);
        }
    }
}

#[test]
fn svd_has_the_error_codes() {
    let codes = |offset| {
        let code = field_of(&svd()[&offset], "CODE");
        let values = &code.enumerated_values[0].values;
        let named =
            values.iter().map(|v| (v.value.expect("value") as u32, v.name.to_lowercase().replace('_', " ")));
        named.collect::<Vec<_>>()
    };
    assert_eq!(codes(pree::ERROR), pree::ErrorCode::ALL.map(|code| (code.bits(), code.name().to_owned())));
    let displace = displace::ErrorCode::ALL.map(|code| (code.bits(), code.name().to_owned()));
    assert_eq!(codes(displace::ERROR), displace);
}

/// The C header gives fields by name and place, and the whole by its size.
#[test]
fn c_header_has_the_same_fields() {
    let header = read("include/lucerna.h");
    for register in &REGISTERS {
        let path = register.name.replace('.', "__").to_uppercase();
        if path.starts_with("WINDOW[") {
            continue; // an array's fields are named once, without an index
        }
        for field in register.fields {
            let line = format!("#define LUCERNA__{path}__{}_bm {:#x}\n", field.name, field.mask());
            assert!(header.contains(&line), "{line}");
        }
    }
    assert!(header.contains("sizeof(lucerna_t) == 0x530"));
    let encodings = read("include/lucerna_encodings.h");
    assert!(encodings.contains("#define LUCERNA__PREE__ERROR__CODE__TOO_LARGE 9 "));
    assert!(encodings.contains("#define LUCERNA__DISPLACE__ERROR__CODE__TOO_LARGE 3 "));
}

#[test]
fn documents_name_every_register_and_error() {
    for document in ["../../docs/registers/README.md", "../../docs/registers/index.html"] {
        let text = read(document);
        for register in &REGISTERS {
            let name = register.name.rsplit('.').next().expect("a name");
            assert!(text.contains(&format!("{name} register")), "{document}: {name}");
            assert!(text.contains(&format!("Absolute Address: {:#X}", register.offset).replace("0X", "0x")));
        }
        let names = pree::ErrorCode::ALL.map(|code| code.name());
        for name in names.into_iter().chain(displace::ErrorCode::ALL.map(|code| code.name())) {
            let name = name.to_uppercase().replace(' ', "_");
            assert!(text.contains(&name), "{document}: {name}");
        }
        assert!(!text.contains("http"), "{document} must not need a network");
    }
    assert!(describe(0x204).is_none(), "the gap before the counters stays unmapped");
}
