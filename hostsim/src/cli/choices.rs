//! The words an option takes; in: text, out: the library's types; cost: none.

use std::str::FromStr;

use clap::ValueEnum;
use lucerna_bus::Timing;
use lucerna_displace::engine::Geometry;
use lucerna_driver::{Allocation, Busy, Hazard, InputWidth, NumberFormat, Scheduler};

use crate::accelerate::{Arith, Units};
use crate::displace::setup::MOST_LINES;

/// An option's words, each the name of a value of a library type.
macro_rules! choice {
    ($(#[$doc:meta])* $name:ident => $target:ty { $($(#[$word_doc:meta])* $word:ident = $text:literal => $value:expr),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
        pub enum $name {
            $($(#[$word_doc])* #[value(name = $text)] $word),+
        }

        impl From<$name> for $target {
            fn from(choice: $name) -> Self {
                match choice { $($name::$word => $value),+ }
            }
        }
    };
}

choice! {
    /// PREUs.
    UnitsChoice => Units {
        /// As in the paper's chip.
        Four = "4" => Units::Four,
        /// Table II, second row.
        Eight = "8" => Units::Eight,
        /// Table II, third row.
        Sixteen = "16" => Units::Sixteen,
    }
}
choice! {
    /// Number format.
    FormatChoice => NumberFormat {
        /// IEEE 754 single precision.
        F32 = "f32" => NumberFormat::F32,
        /// 1-7-16.
        F24 = "f24" => NumberFormat::F24,
    }
}
choice! {
    /// What computes the numbers.
    ArithChoice => Arith {
        /// The host's floating-point unit.
        Fast = "fast" => Arith::Fast,
        /// Soft-float, as on a Cortex-M.
        Soft = "soft" => Arith::Soft,
    }
}
choice! {
    /// How cycles are gone through.
    TimingChoice => Timing {
        /// Regular cycles at once.
        Fast = "fast" => Timing::Fast,
        /// One by one.
        Tick = "tick" => Timing::Tick,
    }
}
choice! {
    /// D7 and D12.
    HazardChoice => Hazard {
        /// Hold an operation until the one before is written back.
        Interlock = "interlock" => Hazard::Interlock,
        /// Hold it until the result can be forwarded.
        Forward = "forward" => Hazard::Forward,
        /// As the paper has it: no protection.
        Published = "published" => Hazard::Published,
    }
}
choice! {
    /// D4.
    BusyChoice => Busy {
        /// While the buffer was full at the cycle's start.
        Registered = "registered" => Busy::Registered,
        /// While it is full after dispatch and shift.
        Combinational = "combinational" => Busy::Combinational,
    }
}
choice! {
    /// D5.
    InputWidthChoice => InputWidth {
        /// The paper's port.
        One = "1" => InputWidth::One,
        /// Twice as wide.
        Two = "2" => InputWidth::Two,
        /// As wide as the buffer.
        Four = "4" => InputWidth::Four,
    }
}
choice! {
    /// Who fills the PREUs.
    SchedulerChoice => Scheduler {
        /// The paper's controller.
        Aftso = "aftso" => Scheduler::Aftso,
        /// The baseline without it.
        OnePhoton = "one-photon" => Scheduler::OnePhoton,
    }
}
choice! {
    /// The order of evaluation.
    AllocationChoice => Allocation {
        /// ADISO-REC.
        Leaping = "leaping" => Allocation::Leaping,
        /// Figs. 3 and 4.
        Sequential = "sequential" => Allocation::Sequential,
    }
}
choice! {
    /// Yes or no.
    Switch => bool {
        /// Yes.
        On = "on" => true,
        /// No.
        Off = "off" => false,
    }
}

pub(crate) use choice;

/// A picture's size.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Size {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
}

/// The longest side of a picture: its hit points still fit 32-bit addresses at a few a pixel.
const LONGEST: u32 = 4096;

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || format!("write WIDTHxHEIGHT, each 1 to {LONGEST}, for example 320x240");
        let (width, height) = text.split_once(['x', 'X']).ok_or_else(form)?;
        let side =
            |text: &str| text.parse().ok().filter(|side| (1..=LONGEST).contains(side)).ok_or_else(form);
        Ok(Self { width: side(width)?, height: side(height)? })
    }
}

/// The longest cache line in bytes: what maps are aligned to.
const LONGEST_LINE: u32 = 64;

/// A cache as SIZE,WAYS,LINE.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct CacheSize(pub Geometry);

impl FromStr for CacheSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form =
            || "write SIZE,WAYS,LINE in bytes (K for 1024), powers of two, for example 16K,4,32".to_owned();
        let mut parts = text.split(',').map(|part| {
            let part = part.trim().to_ascii_uppercase();
            let part = part.strip_suffix('B').unwrap_or(&part);
            let (digits, unit) = part.strip_suffix('K').map_or((part, 1), |digits| (digits, 1024));
            digits.parse::<u32>().ok().and_then(|number| number.checked_mul(unit))
        });
        let (Some(Some(bytes)), Some(Some(ways)), Some(Some(line_bytes)), None) =
            (parts.next(), parts.next(), parts.next(), parts.next())
        else {
            return Err(form());
        };
        let geometry = Geometry { bytes, ways, line_bytes };
        match geometry.lines() {
            Ok(_) if line_bytes > LONGEST_LINE => {
                Err(format!("a cache line may have at most {LONGEST_LINE} bytes: {}", form()))
            }
            Ok(lines) if lines as usize > MOST_LINES => {
                Err(format!("the cache would have {lines} lines, and {MOST_LINES} is the most: {}", form()))
            }
            Ok(_) => Ok(Self(geometry)),
            Err(error) => Err(format!("{error}: {}", form())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_or_explained() {
        for good in ["320x240", "320X240"] {
            assert_eq!(good.parse(), Ok(Size { width: 320, height: 240 }));
        }
        for bad in ["", "320", "0x3", "3x0", "axb", "9999x1", "1x1x1", "-1x2"] {
            assert!(bad.parse::<Size>().unwrap_err().contains("WIDTHxHEIGHT"), "{bad}");
        }
    }

    #[test]
    fn caches_are_read_or_explained() {
        let geometry = Geometry { bytes: 16384, ways: 4, line_bytes: 32 };
        for good in ["16K,4,32", "16384,4,32", "16kb, 4, 32b"] {
            assert_eq!(good.parse(), Ok(CacheSize(geometry)), "{good}");
        }
        for bad in
            ["", "16K", "16K,4", "16K,4,32,1", "16K,3,32", "16,4,32", "0,0,0", "99999999K,4,32", "x,4,32"]
        {
            assert!(bad.parse::<CacheSize>().unwrap_err().contains("SIZE,WAYS,LINE"), "{bad}");
        }
    }
}
