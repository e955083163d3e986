//! In: a ray and a pyramid of heights. Out: the column it hits and the steps to it, in f64. Cost: about 10 ns a step.
//!
//! The traversal of §3 with the decisions P1 to P15, written down once more: rows instead of Morton order, and for every
//! policy one branch in one loop. It says what the counts are where arithmetic is not the question.

/// When a crossing goes up a level.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum LevelUp {
    /// Never.
    #[default]
    Never,
    /// On a parent's boundary (P3).
    Parity,
    /// The same, unless the ray comes down within so many nodes from here (P4: 1, P23: more).
    Selective(i64),
    /// By a flag (P5): set by a crossing that stays, cleared by one that goes up.
    Coherent {
        /// Going down clears the flag as well.
        consecutive: bool,
        /// Going up needs a parent's boundary as well.
        parity: bool,
    },
}

/// How to go up and down.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Rules {
    /// Begin at the start level (P7), found on a grid `1 << this` times finer (P19), not at the root.
    pub start: Option<u32>,
    /// Levels down at once before the first crossing (P6).
    pub down: u32,
    /// Levels up.
    pub up: LevelUp,
    /// A crossing between two nodes of one parent looks at the second at once, and goes down if the ray is below it (P22). For
    /// square maps: only there are the nodes that come in one word those of one parent.
    pub siblings: bool,
}

/// A map and the maxima over it.
#[derive(Clone, Debug)]
pub struct Pyramid {
    log2: [u32; 2],
    /// Depths of each level, row by row.
    levels: Vec<Vec<f64>>,
    repeat: bool,
}

/// How a traversal ended.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Walk {
    /// Column.
    pub texel: [i64; 2],
    /// The ray's depth there.
    pub t: f64,
    /// Steps, or as many as were allowed.
    pub steps: u32,
    /// Steps that crossed.
    pub crossings: u32,
    /// It ended within the steps that were allowed.
    pub ended: bool,
}

/// P11.
const WATCHDOG: u32 = 4096;

impl Pyramid {
    /// Of a map of `1 << log2` texels, row by row; beyond its edges the map again (`repeat`) or heights of 0.
    pub fn new(log2: [u32; 2], heights: &[u8], repeat: bool) -> Self {
        let depth = |height: &u8| f64::from(255 - height) / 255.0;
        let mut levels = vec![heights.iter().map(depth).collect::<Vec<_>>()];
        let mut sides = log2.map(|log2| 1usize << log2);
        while sides != [1, 1] {
            let below = &levels[levels.len() - 1];
            let half = sides.map(|side| side.div_ceil(2));
            let child = |x: usize, y: usize| below[(y % sides[1]) * sides[0] + x % sides[0]];
            let least = |x: usize, y: usize| {
                let pair = |y: usize| child(2 * x, y).min(child(2 * x + 1, y));
                pair(2 * y).min(pair(2 * y + 1))
            };
            let places = (0..half[1]).flat_map(|y| (0..half[0]).map(move |x| (x, y)));
            let level = places.map(|(x, y)| least(x, y)).collect();
            levels.push(level);
            sides = half;
        }
        Self { log2, levels, repeat }
    }

    fn root(&self) -> u32 {
        self.levels.len() as u32 - 1
    }

    /// Whether a node is not on the map, and no repetition of one either.
    fn is_beyond(&self, level: u32, node: [i64; 2]) -> bool {
        let log2 = self.log2.map(|log2| log2.saturating_sub(level));
        !self.repeat && (0..2).any(|axis| node[axis] < 0 || node[axis] >> log2[axis] != 0)
    }

    /// A node's parent on the map itself, of which all tiles are repetitions.
    fn parent(&self, level: u32, node: [i64; 2]) -> [i64; 2] {
        [0, 1].map(|axis| (node[axis] & ((1 << self.log2[axis].saturating_sub(level)) - 1)) >> 1)
    }

    fn depth(&self, level: u32, node: [i64; 2]) -> f64 {
        if self.is_beyond(level, node) {
            return 1.0;
        }
        let log2 = self.log2.map(|log2| log2.saturating_sub(level));
        let [x, y] = [0, 1].map(|axis| node[axis] as usize & ((1 << log2[axis]) - 1));
        self.levels[level as usize][y << log2[0] | x]
    }

    fn start(&self, rules: &Rules, entry: [f64; 2], direction: [f64; 2]) -> u32 {
        let Some(finer) = rules.start else { return self.root() };
        let differ = |axis: usize| {
            let side = (1u64 << (self.log2[axis] + finer)) as f64;
            let leaf = |at: f64| (at * side).floor() as i64;
            (leaf(entry[axis]) ^ leaf(entry[axis] + direction[axis])) as u64
        };
        (u64::BITS - (differ(0) | differ(1)).leading_zeros()).min(self.root())
    }

    /// Follows a ray from texture coordinate `entry` at depth 0 to `entry + direction` at depth 1.
    pub fn walk(&self, rules: &Rules, entry: [f64; 2], direction: [f64; 2]) -> Walk {
        let sides = self.log2.map(|log2| (1u64 << log2) as f64);
        let inverse = sides.map(f64::recip);
        // The column of a depth, within a node.
        let within = |axis: usize, t: f64, node: i64, level: u32| {
            let leaf = ((entry[axis] + direction[axis] * t) * sides[axis]).floor() as i64;
            leaf.clamp(node << level, ((node + 1) << level) - 1)
        };
        let mut leaf = [0, 1].map(|axis| (entry[axis] * sides[axis]).floor() as i64);
        let mut level = self.start(rules, entry, direction);
        let (mut t, mut crossings, mut flag) = (0.0f64, 0, false);
        let keeps = !matches!(rules.up, LevelUp::Coherent { consecutive: true, .. });
        for steps in 1..=WATCHDOG {
            let node = leaf.map(|leaf| leaf >> level);
            let depth = self.depth(level, node);
            let exit = |axis: usize| {
                let d = direction[axis];
                if d == 0.0 {
                    return f64::INFINITY;
                }
                let boundary = ((node[axis] + i64::from(d > 0.0)) << level) as f64 * inverse[axis];
                (boundary - entry[axis]) / d
            };
            let exits = [exit(0), exit(1)];
            let axis = usize::from(exits[1] < exits[0]);
            if depth > t && exits[axis] < depth {
                crossings += 1;
                let forward = direction[axis] > 0.0;
                let up = match rules.up {
                    LevelUp::Never => false,
                    LevelUp::Parity => parents(node[axis], forward),
                    LevelUp::Selective(reach) => {
                        // Where the ray would meet the node's depth, in nodes from here.
                        let far = |axis: usize| {
                            let leaf = ((entry[axis] + direction[axis] * depth) * sides[axis]).floor() as i64;
                            ((leaf >> level) - node[axis]).abs()
                        };
                        far(0).max(far(1)) > reach && parents(node[axis], forward)
                    }
                    LevelUp::Coherent { parity, .. } => flag && (!parity || parents(node[axis], forward)),
                };
                t = t.max(exits[axis]);
                let other = 1 - axis;
                leaf[axis] = if forward { (node[axis] + 1) << level } else { (node[axis] << level) - 1 };
                leaf[other] = within(other, t, node[other], level);
                // At the root there is no level to go up to: such a crossing stays.
                let up = up && level < self.root();
                flag = !up;
                let entered = leaf.map(|leaf| leaf >> level);
                let sibling = self.parent(level, entered) == self.parent(level, node);
                let inside = !self.is_beyond(level, node) && !self.is_beyond(level, entered);
                if up {
                    level += 1;
                } else if rules.siblings && sibling && inside && self.depth(level, entered) <= t {
                    if level == 0 {
                        return Walk { texel: leaf, t, steps, crossings, ended: true };
                    }
                    level -= 1;
                    flag &= keeps;
                }
            } else {
                if depth > t {
                    t = depth;
                    leaf = [0, 1].map(|axis| within(axis, t, node[axis], level));
                }
                if level == 0 {
                    return Walk { texel: leaf, t, steps, crossings, ended: true };
                }
                level -= if crossings == 0 && level >= rules.down { rules.down } else { 1 };
                flag &= keeps;
            }
        }
        Walk { texel: leaf, t, steps: WATCHDOG, crossings, ended: false }
    }
}

/// Whether a crossing is one of the parent's boundaries (P3).
fn parents(node: i64, forward: bool) -> bool {
    (node + i64::from(forward)) & 1 == 0
}
