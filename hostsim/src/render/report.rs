//! What a render came to; in: outcome and verdict, out: JSON and a table beside the paper's figures; cost: none.

use std::fmt;
use std::time::Duration;

use comfy_table::{ContentArrangement, Table, presets};
use serde::Serialize;

use super::displacement::Displacement;
use super::judge::Verdict;
use super::{Options, Prepared};
use crate::accelerate::Outcome;
use crate::picture::{Comparison, fnv1a64};

/// The clock of the paper's layout, in MHz.
pub const CLOCK_MHZ: f64 = 125.0;

/// Engine cycles.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Cycles {
    /// From the first load of the buffer to the last dispatch.
    pub update: u64,
    /// In which addresses were generated for evaluation.
    pub evaluate: u64,
    /// All, with fill and drain of both.
    pub total: u64,
}

/// Host seconds.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct HostSeconds {
    /// Eye rays, index table and photons (all cores).
    pub trace: f64,
    /// The device, through driver, bus and registers (one core).
    pub device: f64,
    /// The f64 reference loop (one core).
    pub reference: f64,
    /// The scalar loop in the device's format (one core).
    pub scalar: f64,
}

/// The report; its fields are the counters' names where they are counters.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[expect(missing_docs, reason = "the names are the registers', documented there, or say it themselves")]
pub struct Report {
    pub scene: String,
    pub width: u32,
    pub height: u32,
    pub photons_emitted: u32,
    pub units: u32,
    pub format: &'static str,
    pub arith: &'static str,
    pub timing: &'static str,
    pub hazards: &'static str,
    pub normal_test: bool,
    pub hit_points: u64,
    pub index_entries: u64,
    pub surface_hits: u64,
    pub empty_cells: u64,
    pub operations: u64,
    pub updates: u64,
    pub cycles: Cycles,
    pub utilisation: f64,
    pub utilisation_without_aftso: f64,
    pub partial_dispatches: u64,
    pub stall_cycles: u64,
    pub starved_cycles: u64,
    pub update_conflicts: u64,
    pub stale_updates: u64,
    pub pixel_conflicts: u64,
    pub forwards: u64,
    pub mhpuo_per_s_at_125mhz: f64,
    pub bits_equal_scalar: bool,
    pub ssim: f64,
    /// `null` in JSON when the pictures are equal.
    pub psnr_db: f64,
    pub differing_samples: u64,
    pub image_fnv1a64: String,
    pub host_seconds: HostSeconds,
    pub host_operations_per_second: f64,
    /// The device's operations a second ÷ the f64 reference loop's, in this run.
    pub host_speed_over_reference: f64,
    /// Only of scenes with displaced surfaces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub displacement: Option<Displacement>,
}

impl Report {
    /// Puts it together.
    pub fn new(
        options: &Options,
        prepared: &Prepared,
        outcome: &Outcome,
        verdict: &Verdict,
        comparison: &Comparison,
        trace: Duration,
        displacement: Option<Displacement>,
    ) -> Self {
        let setup = &options.setup;
        let units = outcome.capabilities.preus;
        let (update, evaluate) = (&outcome.update, &outcome.evaluate);
        let cycles = Cycles {
            update: update.update_cycles,
            evaluate: evaluate.evaluate_cycles,
            total: update.total_cycles + evaluate.total_cycles,
        };
        let operations = update.operations as f64;
        let host_seconds = HostSeconds {
            trace: trace.as_secs_f64(),
            device: outcome.host_time.as_secs_f64(),
            reference: verdict.reference_time.as_secs_f64(),
            scalar: verdict.scalar_time.as_secs_f64(),
        };
        Self {
            scene: prepared.scene.name().to_owned(),
            width: options.width,
            height: options.height,
            photons_emitted: options.photons,
            units,
            format: outcome.capabilities.format.name(),
            arith: setup.arith.name(),
            timing: setup.timing_name(),
            hazards: setup.policies.hazard.name(),
            normal_test: setup.normal_test,
            hit_points: prepared.points.len() as u64,
            index_entries: prepared.grid.entries().len() as u64,
            surface_hits: update.photons,
            empty_cells: update.empty_cells,
            operations: update.operations,
            updates: update.updates,
            cycles,
            utilisation: ratio(operations, cycles.update as f64 * f64::from(units)),
            utilisation_without_aftso: verdict.utilisation_without_aftso,
            partial_dispatches: update.partial_dispatches,
            stall_cycles: update.stall_cycles + evaluate.stall_cycles,
            starved_cycles: update.starved_cycles,
            update_conflicts: update.update_conflicts,
            stale_updates: update.stale_updates,
            pixel_conflicts: evaluate.pixel_conflicts,
            forwards: update.forwards + evaluate.forwards,
            mhpuo_per_s_at_125mhz: ratio(operations * CLOCK_MHZ, cycles.total as f64),
            bits_equal_scalar: verdict.bits_equal_scalar,
            ssim: comparison.ssim,
            psnr_db: comparison.psnr_db,
            differing_samples: comparison.differing_samples,
            image_fnv1a64: format!("{:016x}", fnv1a64(outcome.pixel_bits.iter().flatten().copied())),
            host_operations_per_second: ratio(operations, host_seconds.device),
            host_speed_over_reference: ratio(host_seconds.reference, host_seconds.device),
            host_seconds,
            displacement,
        }
    }

    /// As `report.json` has it.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("a plain struct of numbers and strings");
        text.push('\n');
        text
    }

    /// The table of the paper's figures beside these, for the workloads that the paper gives figures of.
    pub fn paper_table(&self) -> Option<Table> {
        let percent = |share: f64| format!("{:.4} %", share * 100.0);
        let without = match self.units {
            4 => "95.75 %",
            8 => "90.53 %",
            _ => "81.75 %",
        };
        if self.scene != "cornell-balls" {
            return None;
        }
        let workload = (self.width, self.height, self.photons_emitted);
        let (operations, speed_there, ssim_there, snr_there) = match workload {
            (20, 15, 1_000) => ("-", if self.units == 4 { "496.79" } else { "-" }, "0.980437", "48.92"),
            (320, 240, 768_000) => ("78.12 M", "-", "0.995461", "83.35"),
            (1600, 1200, 19_200_000) => ("1934.61 M", "-", "-", "-"),
            _ => return None,
        };
        let held = match self.stall_cycles {
            0 => String::new(),
            stalls => format!("{stalls} cycles held by hazards; --hazards published has none, as the paper"),
        };
        let speed = format!("{:.2}", self.mhpuo_per_s_at_125mhz);
        let (with, without_here) = (percent(self.utilisation), percent(self.utilisation_without_aftso));
        let (ssim, psnr) = (format!("{:.6}", self.ssim), format!("{:.2}", self.psnr_db));
        let rows: [[&str; 4]; 6] = [
            ["hit-point update operations", operations, &self.operations.to_string(), ""],
            ["utilisation with AFTSO (Table II)", "99.99 %", &with, &held],
            ["utilisation without it", without, &without_here, "the paper's workload is unstated"],
            [
                "MHpUO/s at 125 MHz",
                speed_there,
                &speed,
                "the paper's is of 20x15 with 1,000 photons and 4 PREUs",
            ],
            [
                "SSIM to the software's picture",
                ssim_there,
                &ssim,
                "the paper's engine has no normal test (D8)",
            ],
            ["SNR, dB", snr_there, &psnr, "ours: PSNR of 8-bit samples; theirs is not defined"],
        ];
        let mut table = Table::new();
        table.load_preset(presets::UTF8_FULL_CONDENSED).set_header(["", "paper", "here", "why"]);
        table.set_content_arrangement(ContentArrangement::Dynamic);
        for row in rows {
            table.add_row(row);
        }
        Some(table)
    }
}

pub(super) fn ratio(numerator: f64, denominator: f64) -> f64 {
    if denominator > 0.0 { numerator / denominator } else { 0.0 }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{} {}x{}, {} photons; {} PREUs, {}, {} hazards, normal test {}",
            self.scene,
            self.width,
            self.height,
            self.photons_emitted,
            self.units,
            self.format,
            self.hazards,
            if self.normal_test { "on" } else { "off" },
        )?;
        let mut table = Table::new();
        table.load_preset(presets::NOTHING);
        let mut row = |name: &str, value: String| _ = table.add_row([name, &value]);
        row("hit points, index entries", format!("{}, {}", self.hit_points, self.index_entries));
        row("surface hits (in empty cells)", format!("{} ({})", self.surface_hits, self.empty_cells));
        row("operations, updates", format!("{}, {}", self.operations, self.updates));
        let Cycles { update, evaluate, total } = self.cycles;
        row("cycles: update, evaluate, total", format!("{update}, {evaluate}, {total}"));
        row(
            "stalled cycles, partial dispatches",
            format!("{}, {}", self.stall_cycles, self.partial_dispatches),
        );
        row(
            "conflicts: update, pixel; stale",
            format!("{}, {}; {}", self.update_conflicts, self.pixel_conflicts, self.stale_updates),
        );
        row("bits equal to the scalar loop", if self.bits_equal_scalar { "yes" } else { "no" }.to_owned());
        row("samples that differ from f64", self.differing_samples.to_string());
        row("pixels' FNV-1a-64", self.image_fnv1a64.clone());
        row(
            "host seconds: trace, device, f64 reference",
            format!(
                "{:.2}, {:.2}, {:.2}",
                self.host_seconds.trace, self.host_seconds.device, self.host_seconds.reference
            ),
        );
        row(
            "device operations a second on this host",
            format!(
                "{:.1} M, {:.2} times the f64 reference loop",
                self.host_operations_per_second / 1e6,
                self.host_speed_over_reference
            ),
        );
        if let Some(d) = &self.displacement {
            for (name, part) in [("displaced: eye rays", &d.eye_rays), ("displaced: photons", &d.photons)] {
                row(
                    name,
                    format!(
                        "{}, {:.1} steps and {:.1} cycles each",
                        part.rays, part.steps_per_ray, part.cycles_per_ray
                    ),
                );
            }
        }
        write!(f, "{}", table.trim_fmt())?;
        match self.paper_table() {
            Some(paper) => write!(f, "\n\n{paper}"),
            None => Ok(()),
        }
    }
}
