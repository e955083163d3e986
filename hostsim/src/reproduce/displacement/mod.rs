//! The displacement paper's tables; in: a folder of its height maps, any of them, out: every cell with ours, as text and JSON;
//! cost: some ten runs of the device for each map and view.

mod cell;
mod conclusion;
mod counts;
mod published;
mod throughput;

use std::fmt;
use std::path::Path;

use comfy_table::{ContentArrangement, Table, presets};
use indicatif::ProgressBar;
use rayon::prelude::*;
use serde::Serialize;

use crate::cli::announce;
use crate::displace::map::HeightMap;
use crate::displace::session::RunError;
use crate::displace::setup::Setup;
use crate::displace::{DisplaceError, load};
pub use cell::{Cell, LEGEND};
pub use counts::Count;
use counts::{Done, Task};
use published::{PAPER, VIEWS};
pub use throughput::{Resources, Throughput};

/// Everything reproduced.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Reproduction {
    /// Pixels of Tables 2 to 4.
    pub size: (u32, u32),
    /// The device's number format.
    pub format: &'static str,
    /// Maps that were there.
    pub maps: Vec<String>,
    /// Files that were not.
    pub missing: Vec<String>,
    /// What the user should know of the maps.
    pub notes: Vec<String>,
    /// Table 1.
    pub table_1: Vec<Resources>,
    /// Tables 2, 3 and 4.
    pub cells: Vec<Cell>,
    /// What was counted for them.
    pub counts: Vec<Count>,
    /// Why there is no Table 5.
    pub table_5: &'static str,
    /// Tables 6 and 7.
    pub throughput: Vec<Throughput>,
    /// What limits the paper's speed.
    pub conclusion: String,
}

const TABLE_5: &str =
    "Table 5 is of a graphics processor's frame rates: nothing here is one, so it is left out";

/// Runs everything for the maps in `folder`, and writes `displacement.json` into `out`.
///
/// # Errors
/// [`DisplaceError`].
pub fn run(
    folder: &Path,
    size: (u32, u32),
    setup: &Setup,
    out: &Path,
    bar: &ProgressBar,
) -> Result<Reproduction, DisplaceError> {
    match std::fs::metadata(folder) {
        Err(source) => return Err(DisplaceError::NoFolder { folder: folder.to_owned(), source }),
        Ok(found) if !found.is_dir() => return Err(DisplaceError::NotAFolder { folder: folder.to_owned() }),
        Ok(_) => {}
    }
    let file = |map: &str| format!("{map}_height.png");
    let (there, missing): (Vec<_>, Vec<_>) =
        PAPER.iter().map(|paper| file(paper.map)).partition(|file| folder.join(file).exists());
    if there.is_empty() {
        return Err(DisplaceError::NoMaps { folder: folder.to_owned(), wanted: missing });
    }
    std::fs::create_dir_all(out).map_err(DisplaceError::write(out))?;
    let maps = there
        .iter()
        .map(|file| Ok(load(&folder.join(file).to_string_lossy())?.0))
        .collect::<Result<Vec<HeightMap>, DisplaceError>>()?;

    let tasks: Vec<Task<'_>> =
        maps.iter().flat_map(|map| (0..VIEWS.len()).map(move |view| Task { map, view })).collect();
    bar.set_length(tasks.iter().map(Task::runs).sum::<u64>() + 2 * maps.len() as u64);
    announce(bar, "Tables 2 to 4");
    // Caches larger than usual make a device larger than a thread's usual stack.
    let pool = rayon::ThreadPoolBuilder::new().stack_size(32 << 20).build();
    let all =
        || tasks.par_iter().map(|task| task.run(setup, size, bar)).collect::<Result<Vec<_>, RunError>>();
    let done: Vec<Done> = pool.map_or_else(|_| all(), |pool| pool.install(all))?;
    announce(bar, "Tables 6, 7");
    let throughput = throughput::run(&maps, setup, bar)?;

    let (mut cells, mut counts) = (Vec::new(), Vec::new());
    for done in done {
        cells.extend(done.cells);
        counts.extend(done.counts);
    }
    cells.sort_by_key(|cell| cell.table);
    let reproduction = Reproduction {
        size,
        format: setup.format.name(),
        notes: maps.iter().flat_map(HeightMap::notes).cloned().collect(),
        maps: maps.iter().map(|map| map.name().to_owned()).collect(),
        missing,
        table_1: throughput::resources(),
        cells,
        counts,
        table_5: TABLE_5,
        conclusion: conclusion::conclusion(&throughput),
        throughput,
    };
    let path = out.join("displacement.json");
    let text = serde_json::to_string_pretty(&reproduction).expect("a plain struct of numbers and strings");
    std::fs::write(&path, text + "\n").map_err(DisplaceError::write(&path))?;
    Ok(reproduction)
}

fn table<const N: usize>(header: [&str; N]) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::UTF8_FULL_CONDENSED).set_header(header);
    table.set_content_arrangement(ContentArrangement::Dynamic);
    if !table.is_tty() {
        table.set_width(150);
    }
    table
}

impl fmt::Display for Reproduction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (width, height) = self.size;
        writeln!(f, "{} at {width}x{height}, {}", self.maps.join(", "), self.format)?;
        for file in &self.missing {
            writeln!(f, "not there, so left out: {file}")?;
        }
        for note in &self.notes {
            writeln!(f, "note: {note}")?;
        }
        let mut operators =
            table(["Table 1", "operators there", "uses a ray or step", "interval", "latency"]);
        let list = |counts: [u32; 6]| {
            let names = ["add", "add3", "compare", "multiply", "divide", "root"];
            let some = names.iter().zip(counts).filter(|(_, count)| *count > 0);
            some.map(|(name, count)| format!("{count} {name}")).collect::<Vec<_>>().join(", ")
        };
        for unit in &self.table_1 {
            operators.add_row([
                unit.unit.to_owned(),
                list(unit.published),
                list(unit.uses),
                unit.interval.to_string(),
                unit.latency.to_string(),
            ]);
        }
        writeln!(f, "\n{operators}")?;
        for name in ["Table 2", "Table 3", "Table 4"] {
            let mut cells =
                table([name, "row", "view", "published", "study", "ours", "f64", "error", "reason"]);
            let mut any = false;
            for cell in self.cells.iter().filter(|cell| cell.table == name) {
                cells.add_row(cell.line());
                any = true;
            }
            if any {
                writeln!(f, "\n{cells}")?;
            }
        }
        writeln!(f, "{LEGEND}\n\n{}", self.table_5)?;
        let mut speeds = table([
            "Tables 6, 7",
            "repeat",
            "units",
            "hits % (paper)",
            "cycles a pixel",
            "MB a frame (paper)",
            "Mpixels/s at 84 MHz (paper)",
            "at 500 MHz (paper)",
            "limited by",
        ]);
        for row in &self.throughput {
            let at_500 = match row.published_mpixels_per_s_at_500mhz {
                Some(published) => format!("{:.1} ({published:.1})", row.mpixels_per_s_at_500mhz),
                None => format!("{:.1}", row.mpixels_per_s_at_500mhz),
            };
            speeds.add_row([
                row.map.clone(),
                row.repeat.to_string(),
                row.units.to_string(),
                format!("{:.2} ({:.0})", row.hit_rate_percent, row.published_hit_rate_percent),
                format!("{:.2}", row.cycles_per_pixel),
                format!("{:.2} ({:.2})", row.port_mb_per_frame, row.published_mb_per_frame),
                format!("{:.2} ({:.1})", row.mpixels_per_s_at_84mhz, row.published_mpixels_per_s),
                at_500,
                row.limit(),
            ]);
        }
        if !self.throughput.is_empty() {
            writeln!(f, "\n{speeds}\n\n{}", self.conclusion)?;
        }
        let same = |cells: &mut dyn Iterator<Item = &Cell>| {
            let printed: Vec<f64> = cells.filter_map(|cell| cell.error_percent).collect();
            let within = |limit: f64| printed.iter().filter(|error| error.abs() <= limit).count();
            let worst = printed.iter().fold(0.0, |worst: f64, error| worst.max(error.abs()));
            format!(
                "{} printed cells: {} the same, {} within 3 %, {} within 7 %, worst {worst:.1} %",
                printed.len(),
                within(0.0),
                within(3.0),
                within(7.0)
            )
        };
        let rows =
            |view: &'static str| self.cells.iter().filter(move |cell| cell.view == view && !cell.another);
        for view in VIEWS {
            writeln!(f, "{view}: {}", same(&mut rows(view)))?;
        }
        let sum = |of: fn(&Count) -> u64| self.counts.iter().map(of).sum::<u64>();
        write!(
            f,
            "{} rays: {} hit another texel than the exact march of the same ray, {} were stopped by the watchdog",
            sum(|count| count.rays),
            sum(|count| count.texel_mismatch_exact_rays),
            sum(|count| count.watchdog_hits)
        )
    }
}
