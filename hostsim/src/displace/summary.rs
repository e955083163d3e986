//! A report as lines to read; in: the report, out: text; cost: none.

use std::fmt;

use comfy_table::{Table, presets};

use super::report::Report;
use super::usage::{CacheReport, Occupancy};
use super::workload::Source;

fn percent(share: f64) -> String {
    format!("{:.2} %", share * 100.0)
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{} {}x{}, depth {} of a texture, repeated {} times; {} view, {}x{}; {}, {} unit{}, {}",
            self.map,
            self.map_width,
            self.map_height,
            self.scale,
            self.repeat,
            self.view,
            self.width,
            self.height,
            self.algorithm,
            self.units,
            if self.units == 1 { "" } else { "s" },
            self.format,
        )?;
        let mut table = Table::new();
        table.load_preset(presets::NOTHING);
        let mut row = |name: &str, value: String| _ = table.add_row([name, &value]);
        row("pixels, of them on the surface", format!("{}, {}", self.pixels, self.rays));
        if self.missed + self.grazing > 0 {
            row(
                "rays that hit, missed (beside map or surface), do not come down",
                format!("{}, {}, {}", self.hits, self.missed, self.grazing),
            );
        }
        row(
            "steps a pixel (f64 traversal)",
            format!("{:.2} ({:.2})", self.steps_per_pixel, self.oracle_steps_per_pixel),
        );
        row("steps that cross into a neighbour node", percent(self.crossing_probability));
        row(
            "most steps of a ray; rays stopped by the watchdog",
            format!("{}; {}", self.max_steps, self.watchdog_hits),
        );
        row(
            "another texel than the exact march of the same ray",
            format!(
                "{} rays, {} ({} through corners)",
                self.texel_mismatch_exact_rays,
                percent(self.texel_mismatch_exact),
                self.texel_mismatch_exact_corners
            ),
        );
        row(
            "another texel than the exact march in f64",
            format!("{} rays, {}", self.texel_mismatch_f64_rays, percent(self.texel_mismatch_f64)),
        );
        let cache = |cache: &CacheReport| {
            format!("{} of {}; {} bytes filled", percent(cache.hit_rate), cache.accesses, cache.bytes)
        };
        row("height cache: hits at the first try", cache(&self.cache));
        row("texture cache: hits", cache(&self.texture_cache));
        row("cycles, a pixel", format!("{}, {:.2}", self.cycles, self.cycles_per_pixel));
        let Occupancy { view, traverse, address, read, colour, port } = self.occupancy;
        row(
            "occupied: view, traverse, address, read, colour; port",
            format!(
                "{}, {}, {}, {}, {}; {}",
                percent(view),
                percent(traverse),
                percent(address),
                percent(read),
                percent(colour),
                percent(port)
            ),
        );
        // These figures are of pixels on the surface only.
        let beside = if self.source == Source::Raster.name() && self.pixels > self.rays {
            "; pixels beside the surface take the view unit's time too"
        } else {
            ""
        };
        row(
            "Mpixels/s at 84 MHz, at 500 MHz",
            format!(
                "{:.2}, {:.2}: limited by {}, {} busy, {} waiting for memory{}",
                self.mpixels_per_s_at_84mhz,
                self.mpixels_per_s_at_500mhz,
                self.limited_by.unit,
                percent(self.limited_by.busy),
                percent(self.limited_by.waiting),
                beside
            ),
        );
        row(
            "device steps a second on this host",
            format!(
                "{:.1} M, {:.2} times the f64 traversal of the same rays",
                self.steps_per_second / 1e6,
                self.steps_per_second_over_oracle
            ),
        );
        write!(f, "{}", table.trim_fmt())
    }
}
