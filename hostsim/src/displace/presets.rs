//! What a map's name brings with it; in: a name, out: height scale, repeat, size and the paper's oddities; cost: none.

use super::map::HeightMap;

/// How a map was used.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Preset {
    /// Depth of the displacement in texture units.
    pub scale: f64,
    /// How often the map lies along each side of the surface.
    pub repeat: f64,
    /// The longest side it is used at (P2).
    pub longest: u32,
    /// The paper's row (b) goes this many levels down (P19).
    pub levels_down: u32,
    /// The paper's row (a) finds the start level on a grid `1 << start_grid` times finer (P19).
    pub start_grid: u32,
}

/// What most maps have in common.
const COMMON: Preset = Preset { scale: 0.10, repeat: 1.0, longest: 4096, levels_down: 2, start_grid: 0 };

/// The maps of the paper, in its order.
pub const PAPER: [(&str, Preset); 7] = [
    ("rocks", Preset { scale: 0.20, repeat: 4.0, ..COMMON }),
    ("stones", Preset { scale: 0.025, ..COMMON }),
    ("four", Preset { scale: 0.15, ..COMMON }),
    ("saint", Preset { scale: 0.10, ..COMMON }),
    ("wall", Preset { scale: 0.04, levels_down: 4, ..COMMON }),
    ("bump", Preset { scale: 0.20, repeat: 4.0, longest: 128, start_grid: 3, ..COMMON }),
    ("dent", Preset { scale: 0.20, repeat: 4.0, longest: 128, start_grid: 3, ..COMMON }),
];

/// The built-in maps, where they differ.
const BUILT_IN: [(&str, Preset); 5] = [
    ("bricks", Preset { scale: 0.04, repeat: 2.0, ..COMMON }),
    ("waves", Preset { repeat: 2.0, ..COMMON }),
    ("ridges", Preset { scale: 0.15, ..COMMON }),
    ("noise", Preset { scale: 0.05, ..COMMON }),
    ("maze", Preset { scale: 0.08, ..COMMON }),
];

impl Preset {
    /// The preset of a name; any other name has the common one.
    pub fn of(name: &str) -> Self {
        Self::named(name).unwrap_or(COMMON)
    }

    /// The preset of a name that has one of its own.
    pub fn named(name: &str) -> Option<Self> {
        let mut all = PAPER.iter().chain(&BUILT_IN);
        all.find(|(preset, _)| *preset == name).map(|(_, preset)| *preset)
    }

    /// The map at the size it was used at.
    pub fn apply(&self, map: HeightMap) -> HeightMap {
        map.reduced(self.longest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_bring_their_settings() {
        assert_eq!((Preset::of("rocks").scale, Preset::of("rocks").repeat), (0.2, 4.0));
        assert_eq!(Preset::of("my own"), COMMON);
        let map = HeightMap::new("dent", 256, 256, vec![7; 65536]).unwrap();
        let map = Preset::of("dent").apply(map);
        assert_eq!((map.width(), map.height(), map.notes().len()), (128, 128, 1));
    }
}
