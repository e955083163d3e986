//! The paper's cells and the study's; in: nothing, out: numbers; cost: none.

use lucerna_driver::displace::{Algorithm, LevelsDown, Policies};

/// Views in the tables' order.
pub const VIEWS: [&str; 3] = ["front", "oblique", "grazing"];

/// Rows of Table 4, one the paper has only on a GPU, and one beyond it.
pub const ROWS: [(&str, Algorithm); 9] = [
    ("[10]", Algorithm::Oh),
    ("[12]", Algorithm::Tevs),
    ("(a)", Algorithm::A),
    ("(b)", Algorithm::B(LevelsDown::Two)),
    ("(c1)", Algorithm::C1),
    ("(c2)", Algorithm::C2),
    ("a+b+c1", Algorithm::Mix),
    ("a+b+c2", Algorithm::MixGpu),
    ("fold (P22, P23)", Algorithm::Fold),
];

/// A cell that cannot be read in the print.
const LOST: f64 = f64::NAN;

/// What the paper prints of a map.
pub struct Paper {
    /// Its name, as in its file's name.
    pub map: &'static str,
    /// Table 2, per cent: [10] and [12] of each view.
    pub crossing: [[f64; 2]; 3],
    /// Table 4: the first seven of [`ROWS`], of each view.
    pub steps: [[f64; 3]; 7],
    /// The study's Table 4, where it was measured: the first eight of [`ROWS`].
    pub study: Option<[[f64; 3]; 8]>,
    /// The study's Table 2.
    pub study_crossing: Option<[[f64; 2]; 3]>,
}

/// The maps in the tables' order.
pub const PAPER: [Paper; 7] = [
    Paper {
        map: "rocks",
        crossing: [[22.4, 19.2], [54.5, 36.9], [76.4, 47.9]],
        steps: [
            [11.6, 19.7, 37.9],
            [12.6, 19.6, 30.2],
            [9.5, 19.3, 37.9],
            [8.9, 18.3, 37.8],
            [11.6, 18.4, 29.2],
            [12.1, 19.8, 31.6],
            [8.0, 16.4, 28.3],
        ],
        study: Some([
            [11.6, 19.6, 38.2],
            [12.4, 19.3, 28.7],
            [9.5, 19.3, 38.2],
            [9.0, 18.2, 37.7],
            [11.6, 18.3, 28.0],
            [12.3, 19.9, 30.8],
            [7.9, 16.4, 27.0],
            [8.7, 18.0, 29.9],
        ]),
        study_crossing: Some([[22.3, 18.3], [54.1, 36.3], [76.5, 47.6]]),
    },
    Paper {
        map: "stones",
        crossing: [[3.8, 3.7], [17.9, 15.0], [51.5, 36.1]],
        steps: [
            [9.3, 10.9, 18.4],
            [9.5, 11.5, 19.2],
            [4.4, 8.4, 18.0],
            [5.6, 7.8, 16.4],
            [9.3, 11.0, 18.2],
            [9.3, 11.3, 19.3],
            [3.2, 6.6, LOST],
        ],
        study: None,
        study_crossing: None,
    },
    Paper {
        map: "four",
        crossing: [[8.5, 8.1], [39.7, 28.3], [58.1, 37.9]],
        steps: [
            [9.8, 14.9, 21.3],
            [10.2, 15.0, 20.0],
            [7.4, 14.3, 21.3],
            [6.9, 13.8, 21.6],
            [9.8, 14.4, 19.7],
            [10.0, 15.4, 20.6],
            [5.6, 12.6, LOST],
        ],
        study: Some([
            [9.8, 14.8, 20.9],
            [10.1, 15.4, 17.2],
            [7.4, 14.2, 20.9],
            [6.9, 13.7, 21.2],
            [9.8, 14.4, 17.1],
            [10.1, 15.5, 18.4],
            [5.6, 12.5, 15.1],
            [5.9, 13.7, 16.5],
        ]),
        study_crossing: Some([[8.6, 8.2], [39.2, 27.7], [56.9, 35.1]]),
    },
    Paper {
        map: "saint",
        crossing: [[5.9, 5.5], [27.5, 21.6], [62.1, 39.8]],
        steps: [
            [9.5, 12.4, 23.6],
            [9.8, 13.2, 20.7],
            [6.6, 11.4, 23.3],
            [6.1, 10.1, 23.2],
            [9.5, 12.3, 20.0],
            [9.6, 12.9, 21.4],
            [4.7, 9.5, 18.8],
        ],
        study: Some([
            [9.6, 12.3, 23.7],
            [9.8, 13.0, 20.7],
            [6.6, 11.3, 23.7],
            [6.2, 10.0, 23.4],
            [9.6, 12.2, 20.1],
            [9.7, 13.0, 21.8],
            [4.7, 9.5, 18.8],
            [4.9, 10.3, 20.6],
        ]),
        study_crossing: Some([[6.0, 5.5], [26.7, 20.8], [62.1, 39.5]]),
    },
    Paper {
        map: "wall",
        crossing: [[5.1, 4.9], [21.0, 16.6], [52.1, 35.9]],
        steps: [
            [9.4, 11.3, 18.7],
            [9.7, 11.8, 19.2],
            [5.2, 9.4, 18.3],
            [4.1, 8.0, 23.0],
            [9.4, 11.3, 18.5],
            [9.5, 11.7, 19.3],
            [3.9, 6.6, LOST],
        ],
        study: None,
        study_crossing: None,
    },
    Paper {
        map: "bump",
        crossing: [[7.6, 7.3], [38.2, 27.5], [72.5, 47.3]],
        steps: [
            [8.6, 12.9, 28.9],
            [8.9, 13.4, 25.3],
            [8.5, 12.9, 28.9],
            [6.2, 12.9, 36.6],
            [8.6, 12.3, 24.7],
            [8.7, 13.2, 26.1],
            [6.1, LOST, 24.1],
        ],
        study: None,
        study_crossing: None,
    },
    Paper {
        map: "dent",
        crossing: [[5.1, 4.9], [23.5, 18.3], [38.5, 26.9]],
        steps: [
            [8.4, 10.4, 12.7],
            [8.6, 10.8, 12.7],
            [8.3, 10.4, 12.7],
            [5.5, 8.0, 11.0],
            [8.4, 10.3, 12.4],
            [8.4, 10.7, 13.0],
            [5.5, 7.8, LOST],
        ],
        study: None,
        study_crossing: None,
    },
];

/// Table 3, rocks: steps of each view by levels down, 1 to 4; the paper's, and the study's at half the size.
pub const TABLE_3: [([f64; 4], [f64; 4]); 3] = [
    ([11.5, 8.9, 8.4, 9.6], [11.6, 9.0, 8.4, 9.6]),
    ([19.7, 18.2, 18.2, 19.1], [19.6, 18.2, 18.2, 20.4]),
    ([37.9, 37.8, 38.0, 42.7], [37.7, 37.3, 37.4, 39.0]),
];

/// (b) with so many levels down at once.
pub fn down(levels: u32) -> Policies {
    crate::cli::displace::levels_down(levels).map_or(Policies::OH, Policies::b)
}

/// Table 6, one map a scene: height-cache hit rate in per cent, memory traffic in MB/s, frames a second, Mpixels/s.
pub struct Scene {
    /// The map.
    pub map: &'static str,
    /// Per cent.
    pub hit_rate: f64,
    /// MB/s.
    pub traffic: f64,
    /// Frames a second.
    pub frames: f64,
    /// Mpixels/s at 84 MHz.
    pub speed: f64,
}

/// Table 6 without the kitchen.
pub const TABLE_6: [Scene; 4] = [
    Scene { map: "rocks", hit_rate: 99.0, traffic: 4.7, frames: 22.0, speed: 7.5 },
    Scene { map: "stones", hit_rate: 99.0, traffic: 3.9, frames: 22.0, speed: 9.8 },
    Scene { map: "four", hit_rate: 99.0, traffic: 4.4, frames: 22.0, speed: 9.0 },
    Scene { map: "saint", hit_rate: 99.0, traffic: 4.4, frames: 21.0, speed: 7.5 },
];

/// Table 7: Mpixels/s of rocks on four units at 500 MHz.
pub const TABLE_7: f64 = 44.6;
