//! What is in an image. In: an ELF file with debug information. Out: flash, RAM and the deepest frame of every crate. Cost:
//! a look-up of the inlined functions at every instruction.
//!
//! A byte of code belongs to the innermost function inlined there which is not core's, so that a generic helper counts for
//! the crate that uses it, and a unit's code for the unit, wherever the optimiser has put it. A frame, which inlined
//! functions share, belongs to the symbol.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use addr2line::gimli;
use object::{File, Object, ObjectSection, ObjectSymbol, SectionFlags, SectionKind};

use super::attribute::{CONSTANTS, CORE, OTHER, crate_of, demangle};
use super::frames::{Frame, frame};

/// A crate's share of an image, or the whole.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// Bytes of code, of constants, and of initial values of variables.
    pub flash: u64,
    /// Bytes of variables.
    pub ram: u64,
    /// The deepest stack frame.
    pub frame: Frame,
    /// The function whose frame it is.
    pub deepest: String,
}

impl Share {
    /// Takes another share in.
    pub fn add(&mut self, other: &Self) {
        self.flash += other.flash;
        self.ram += other.ram;
        self.deepen(other.frame, &other.deepest);
    }

    fn deepen(&mut self, frame: Frame, function: &str) {
        if frame > self.frame {
            self.frame = frame;
            self.deepest = function.to_owned();
        }
    }
}

/// An image by crate.
#[derive(Clone, Debug)]
pub struct Image {
    /// The program.
    pub name: String,
    /// What is whose; [`OTHER`] has the padding too.
    pub crates: BTreeMap<String, Share>,
    /// All of it.
    pub total: Share,
}

/// Why an image could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The file is not there.
    #[error("{path}: {error}: build the firmware first")]
    File {
        /// Where.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// It is not what the firmware's profile makes.
    #[error("{path}: not a readable ELF file: {error}")]
    Elf {
        /// Where.
        path: PathBuf,
        /// Why.
        error: object::Error,
    },
    /// Its debug information is not.
    #[error("{path}: unreadable debug information: {error}")]
    Dwarf {
        /// Where.
        path: PathBuf,
        /// Why.
        error: gimli::Error,
    },
}

impl Image {
    /// Reads the program `name` in `folder`.
    ///
    /// # Errors
    /// An [`ImageError`].
    pub fn read(folder: &Path, name: &str) -> Result<Self, ImageError> {
        let path = folder.join(name);
        let bytes = std::fs::read(&path).map_err(|error| ImageError::File { path: path.clone(), error })?;
        let elf = |error| ImageError::Elf { path: path.clone(), error };
        let file = File::parse(&*bytes).map_err(elf)?;
        let inlined = Inlined::new(&file).map_err(|error| ImageError::Dwarf { path: path.clone(), error })?;
        let symbols = Symbols::new(&file);

        let mut image = Self { name: name.to_owned(), crates: BTreeMap::new(), total: Share::default() };
        for section in file.sections().filter(is_loaded) {
            let place = section.address()..section.address() + section.size();
            match section.kind() {
                SectionKind::Text => {
                    let code = section.data().map_err(elf)?;
                    image.total.flash += section.size();
                    image.code(code, &place, &symbols, &inlined);
                }
                SectionKind::UninitializedData => {
                    image.total.ram += section.size();
                    image.data(&place, &symbols, |share, bytes| share.ram += bytes);
                }
                SectionKind::Data if is_variable(&section) => {
                    image.total.ram += section.size();
                    image.total.flash += section.size();
                    image.data(&place, &symbols, |share, bytes| {
                        share.ram += bytes;
                        share.flash += bytes;
                    });
                }
                _ => {
                    image.total.flash += section.size();
                    let named = image.data(&place, &symbols, |share, bytes| share.flash += bytes);
                    // Merged strings have no names.
                    image.share(CONSTANTS).flash += section.size().saturating_sub(named);
                }
            }
        }
        let mut named = Share::default();
        image.crates.values().for_each(|share| named.add(share));
        image.total.deepen(named.frame, &named.deepest);
        let flash = image.total.flash.saturating_sub(named.flash);
        let ram = image.total.ram.saturating_sub(named.ram);
        image.share(OTHER).add(&Share { flash, ram, ..Share::default() });
        Ok(image)
    }

    fn share(&mut self, name: &str) -> &mut Share {
        self.crates.entry(name.to_owned()).or_default()
    }

    /// Counts a section's symbols; gives the bytes they have.
    fn data(&mut self, place: &Range<u64>, symbols: &Symbols, mut count: impl FnMut(&mut Share, u64)) -> u64 {
        let mut named = 0;
        for (_, symbol) in symbols.named.range(place.clone()) {
            count(self.share(crate_of(&symbol.path)), symbol.size);
            named += symbol.size;
        }
        named
    }

    fn code(&mut self, code: &[u8], place: &Range<u64>, symbols: &Symbols, inlined: &Inlined<'_>) {
        let halfwords = code.as_chunks::<2>().0;
        let mut done = place.start;
        for (address, symbol) in symbols.named.range(place.clone()) {
            let addresses = || (done.max(*address)..address + symbol.size).step_by(2);
            let krate = crate_of(&symbol.path);
            for address in addresses() {
                self.share(inlined.krate(address).as_deref().unwrap_or(krate)).flash += 2;
            }
            let instructions: Vec<u16> = addresses()
                .filter(|address| symbols.is_code(*address))
                .filter_map(|address| halfwords.get((address - place.start) as usize / 2))
                .map(|bytes| u16::from_le_bytes(*bytes))
                .collect();
            self.share(krate).deepen(frame(&instructions), &symbol.path);
            done = done.max(address + symbol.size);
        }
    }
}

/// Whether a section is on the board, in flash or RAM.
fn is_loaded<'a>(section: &impl ObjectSection<'a>) -> bool {
    /// SHF_ALLOC
    const ALLOCATED: u64 = 2;
    section.size() > 0
        && matches!(section.flags(), SectionFlags::Elf { sh_flags } if sh_flags & ALLOCATED != 0)
}

/// Whether a section with contents is copied to RAM.
fn is_variable<'a>(section: &impl ObjectSection<'a>) -> bool {
    /// SHF_WRITE
    const WRITABLE: u64 = 1;
    matches!(section.flags(), SectionFlags::Elf { sh_flags } if sh_flags & WRITABLE != 0)
}

struct Symbol {
    path: String,
    size: u64,
}

/// The symbols by address.
struct Symbols {
    /// Those with a size; of several at one address, the first.
    named: BTreeMap<u64, Symbol>,
    /// The Arm mapping symbols: whether code (`$t`) or a literal pool (`$d`) begins.
    mapping: BTreeMap<u64, bool>,
}

impl Symbols {
    fn new(file: &File<'_>) -> Self {
        let mut symbols = Self { named: BTreeMap::new(), mapping: BTreeMap::new() };
        for symbol in file.symbols() {
            let Ok(name) = symbol.name() else { continue };
            if name.starts_with("$t") || name.starts_with("$d") {
                symbols.mapping.insert(symbol.address(), name.starts_with("$t"));
            } else if symbol.size() > 0 {
                // The lowest bit of a function's address only says that it is Thumb code.
                let entry = symbols.named.entry(symbol.address() & !1);
                entry.or_insert_with(|| Symbol { path: demangle(name), size: symbol.size() });
            }
        }
        symbols
    }

    fn is_code(&self, address: u64) -> bool {
        self.mapping.range(..=address).next_back().is_none_or(|(_, code)| *code)
    }
}

/// The inlined functions by address.
struct Inlined<'a>(addr2line::Context<gimli::EndianSlice<'a, gimli::LittleEndian>>);

impl<'a> Inlined<'a> {
    fn new(file: &File<'a>) -> Result<Self, gimli::Error> {
        let dwarf = gimli::Dwarf::load(|id| {
            let section = file.section_by_name(id.name()).and_then(|section| section.data().ok());
            Ok::<_, gimli::Error>(gimli::EndianSlice::new(section.unwrap_or_default(), gimli::LittleEndian))
        })?;
        addr2line::Context::from_dwarf(dwarf).map(Self)
    }

    /// The crate at work at this address; `None` if only core is, or nothing is known.
    fn krate(&self, address: u64) -> Option<String> {
        let mut frames = self.0.find_frames(address).skip_all_loads().ok()?;
        while let Ok(Some(frame)) = frames.next() {
            let Some(function) = frame.function else { continue };
            let Ok(name) = function.raw_name() else { continue };
            let path = demangle(&name);
            let krate = crate_of(&path);
            if krate != CORE && krate != OTHER {
                return Some(krate.to_owned());
            }
        }
        None
    }
}
