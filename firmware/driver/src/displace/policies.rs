//! How rays go up and down the pyramid. In: the paper's names. Out: the configuration register. Cost: constants.

use lucerna_regs::displace::{Ascend, Coherent, Config, LevelsDown, RayFaults, Reach, Source, Wrap};

/// The finest start grid is `1 << START_GRID_MAX` times finer than the map.
pub const START_GRID_MAX: u32 = 3;

/// The named policies of a traversal. The default is the device's reset value: the paper's hardware, a + b + c1.
///
/// ```
/// use lucerna_driver::displace::{Ascend, LevelsDown, Policies};
///
/// let four_down = Policies { levels_down: LevelsDown::Four, ..Policies::MIX };
/// assert_eq!(Policies::default(), Policies::MIX);
/// assert!(four_down.start_level && four_down.ascend == Ascend::Selective);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Policies {
    /// What lies beyond the edges of the height map; texture and normal map always repeat.
    pub wrap: Wrap,
    /// Begin at the start level of §3.1 (P7), which costs one pass, and not at the root.
    pub start_level: bool,
    /// Find the start level on a grid `1 << start_grid` times finer (P19): 0 to [`START_GRID_MAX`].
    pub start_grid: u32,
    /// Levels down at once before the first node crossing of a ray: n of §3.2 (P6).
    pub levels_down: LevelsDown,
    /// When a node crossing goes up a level (§3.3).
    pub ascend: Ascend,
    /// Which reading of (c2) is meant (P5); has no effect unless `ascend` is [`Ascend::Coherent`].
    pub coherent: Coherent,
    /// The most nodes further at which a ray may come down for (c1) to stay on its level (P23); the paper's is one (P4).
    /// Has no effect unless `ascend` is [`Ascend::Selective`].
    pub reach: Reach,
    /// Go down in the step of a crossing if the neighbour's height came with the node's (P22). Not in the paper.
    pub siblings: bool,
}

impl Policies {
    /// Oh et al., the paper's reference \[10\]: from the root, a level at a time, never up.
    pub const OH: Self = Self {
        wrap: Wrap::Repeat,
        start_level: false,
        start_grid: 0,
        levels_down: LevelsDown::One,
        ascend: Ascend::Never,
        coherent: Coherent::Toggle,
        reach: Reach::One,
        siblings: false,
    };
    /// Tevs et al., reference \[12\]: up at a parent's boundary (P3).
    pub const TEVS: Self = Self { ascend: Ascend::Parity, ..Self::OH };
    /// (a): [`OH`](Self::OH) from the start level (§3.1).
    pub const A: Self = Self { start_level: true, ..Self::OH };
    /// (b) as in Table 2: two levels down at once (§3.2).
    pub const B: Self = Self::b(LevelsDown::Two);
    /// (c1): up unless the ray surely pierces the neighbour node (§3.3, P4).
    pub const C1: Self = Self { ascend: Ascend::Selective, ..Self::OH };
    /// (c2): up by the coherence of crossings (§3.3, P5).
    pub const C2: Self = Self { ascend: Ascend::Coherent, ..Self::OH };
    /// a + b + c1: the paper's hardware (§4).
    pub const MIX: Self =
        Self { start_level: true, levels_down: LevelsDown::Two, ascend: Ascend::Selective, ..Self::OH };
    /// a + b + c2: the paper's program for a graphics processor.
    pub const MIX_GPU: Self = Self { ascend: Ascend::Coherent, ..Self::MIX };
    /// Beyond the paper: the mix with three levels down, a reach of two nodes (P23), and siblings (P22). Fewer steps
    /// than any of its algorithms.
    pub const FOLD: Self =
        Self { levels_down: LevelsDown::Three, reach: Reach::Two, siblings: true, ..Self::MIX };

    /// (b) with n levels (Table 3): [`OH`](Self::OH) with so many down at once before the first crossing.
    pub const fn b(levels_down: LevelsDown) -> Self {
        Self { levels_down, ..Self::OH }
    }

    /// The same with the start level found on a grid `1 << start_grid` times finer (P19).
    #[must_use]
    pub const fn with_start_grid(self, start_grid: u32) -> Self {
        Self { start_grid, ..self }
    }

    /// The same with other edges.
    #[must_use]
    pub const fn with_wrap(self, wrap: Wrap) -> Self {
        Self { wrap, ..self }
    }

    /// The same with another reading of (c2).
    #[must_use]
    pub const fn with_coherent(self, coherent: Coherent) -> Self {
        Self { coherent, ..self }
    }

    /// The configuration register of a job.
    pub(crate) const fn config(&self, source: Source, ray_faults: RayFaults) -> Config {
        Config::RESET
            .with_source(source)
            .with_wrap(self.wrap)
            .with_start_level(self.start_level)
            .with_start_grid(self.start_grid)
            .with_levels_down(self.levels_down)
            .with_ascend(self.ascend)
            .with_coherent(self.coherent)
            .with_ray_faults(ray_faults)
            .with_siblings(self.siblings)
            .with_reach(self.reach)
    }
}

impl Default for Policies {
    fn default() -> Self {
        Self::MIX
    }
}

/// The paper's algorithms by the names of its tables, and ours beyond it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Algorithm {
    /// [`Policies::OH`].
    Oh,
    /// [`Policies::TEVS`].
    Tevs,
    /// [`Policies::A`].
    A,
    /// [`Policies::b`].
    B(LevelsDown),
    /// [`Policies::C1`].
    C1,
    /// [`Policies::C2`].
    C2,
    /// [`Policies::MIX`].
    Mix,
    /// [`Policies::MIX_GPU`].
    MixGpu,
    /// [`Policies::FOLD`].
    Fold,
}

impl Algorithm {
    /// The rows of Table 2, in its order, then both mixes, and what is beyond the paper.
    pub const ALL: [Self; 9] = [
        Self::Oh,
        Self::Tevs,
        Self::A,
        Self::B(LevelsDown::Two),
        Self::C1,
        Self::C2,
        Self::Mix,
        Self::MixGpu,
        Self::Fold,
    ];

    /// Its name, for reports and command lines.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Oh => "oh",
            Self::Tevs => "tevs",
            Self::A => "a",
            Self::B(LevelsDown::One) => "b1",
            Self::B(LevelsDown::Two) => "b",
            Self::B(LevelsDown::Three) => "b3",
            Self::B(LevelsDown::Four) => "b4",
            Self::C1 => "c1",
            Self::C2 => "c2",
            Self::Mix => "mix",
            Self::MixGpu => "mix-gpu",
            Self::Fold => "fold",
        }
    }

    /// Its policies.
    pub const fn policies(self) -> Policies {
        match self {
            Self::Oh => Policies::OH,
            Self::Tevs => Policies::TEVS,
            Self::A => Policies::A,
            Self::B(levels_down) => Policies::b(levels_down),
            Self::C1 => Policies::C1,
            Self::C2 => Policies::C2,
            Self::Mix => Policies::MIX,
            Self::MixGpu => Policies::MIX_GPU,
            Self::Fold => Policies::FOLD,
        }
    }
}

impl From<Algorithm> for Policies {
    fn from(algorithm: Algorithm) -> Self {
        algorithm.policies()
    }
}
