//! The PREE paper's figures; in: the Cornell box with three balls, out: each figure with ours; cost: a dozen runs of the device
//! at 320×240, with the photons traced once.

use std::path::Path;

use indicatif::ProgressBar;
use lucerna_driver::{Allocation, Busy, Hazard, InputWidth, Policies, Scheduler};

use super::table::Figures;
use crate::accelerate::{self, Outcome, PhotonSource, RunError, Setup, Units};
use crate::cli::announce;
use crate::oracle::Reference;
use crate::picture;
use crate::render::photons::CHUNK;
use crate::render::report::CLOCK_MHZ;
use crate::render::{Prepared, RenderError};
use crate::trace::{PhotonChunk, chunks, trace_photons};

/// A workload whose photons were traced once and are given to one device after the other.
struct Recorded {
    prepared: Prepared,
    chunks: Vec<PhotonChunk>,
    width: u32,
    height: u32,
    emitted: u32,
}

impl Recorded {
    fn new(width: u32, height: u32, emitted: u32) -> Result<Self, RenderError> {
        let prepared = Prepared::new("cornell-balls", None, width, height)?;
        let chunks = chunks(emitted, CHUNK)
            .map(|range| {
                let mut chunk = PhotonChunk::default();
                chunk.fill(&prepared.scene, &prepared.grid, range);
                chunk
            })
            .collect();
        Ok(Self { prepared, chunks, width, height, emitted })
    }

    /// Runs a device under the paper's own rules but for `change`.
    fn run(&self, units: Units, change: impl FnOnce(&mut Policies)) -> Result<Outcome, RunError> {
        let mut policies = Policies { hazard: Hazard::Published, ..Policies::default() };
        change(&mut policies);
        let setup = Setup { units, policies, normal_test: false, ..Setup::default() };
        let workload = self.prepared.workload(self.width * self.height, self.emitted);
        accelerate::run(&setup, &workload, &mut self.chunks.iter())
    }

    /// The f64 picture, with the published program's normal test.
    fn reference(&self) -> Result<image::RgbImage, RenderError> {
        let mut reference = Reference::new(&self.prepared.points, self.prepared.grid.radius(), true);
        for chunk in &self.chunks {
            reference.feed(chunk, self.prepared.grid.entries());
        }
        let radiance = reference.radiance(self.width * self.height, self.emitted);
        Ok(picture::tone_map(&radiance, self.width, self.height)?)
    }

    fn picture(&self, outcome: &Outcome) -> Result<image::RgbImage, RenderError> {
        Ok(picture::tone_map(&outcome.radiance(), self.width, self.height)?)
    }
}

impl PhotonSource for core::slice::Iter<'_, PhotonChunk> {
    fn next_chunk(&mut self) -> Option<&PhotonChunk> {
        self.next()
    }
}

/// Runs everything and writes Fig. 4's pictures and `pree.json` into `out`.
///
/// # Errors
/// [`RenderError`].
pub fn run(full: bool, out: &Path, bar: &ProgressBar) -> Result<Figures, RenderError> {
    std::fs::create_dir_all(out).map_err(RenderError::write(out))?;
    let mut figures = Figures::default();
    bar.set_length(16 + u64::from(full));

    announce(bar, "20x15");
    let small = Recorded::new(20, 15, 1_000)?;
    let chip = small.run(Units::Four, |_| {})?;
    announce(bar, "320x240");
    let large = Recorded::new(320, 240, 768_000)?;
    let published = large.run(Units::Four, |_| {})?;
    bar.inc(2);

    operations(&mut figures, &published, full, bar)?;
    damage(&mut figures, &large, &published, out, bar)?;
    table_ii(&mut figures, &large, &published, bar)?;
    table_iii(&mut figures, &chip);
    announce(bar, "f64 loops");
    let protected = large.run(Units::Four, |policies| policies.hazard = Hazard::Interlock)?;
    let small_protected = small.run(Units::Four, |policies| policies.hazard = Hazard::Interlock)?;
    let (interlocked, stale) = (
        "f32 without the normal test against f64 with it, which the original program has (D8)",
        "as interlocked, and stale updates and pixel collisions on top, which the paper does not speak of (D7, D12)",
    );
    let reference = large.reference()?;
    quality(&mut figures, &large, &reference, &protected, ("interlocked", interlocked), (0.995461, 83.35))?;
    quality(&mut figures, &large, &reference, &published, ("no protection", stale), (0.995461, 83.35))?;
    let reference = small.reference()?;
    quality(
        &mut figures,
        &small,
        &reference,
        &small_protected,
        ("interlocked", interlocked),
        (0.980437, 48.92),
    )?;
    quality(&mut figures, &small, &reference, &chip, ("no protection", stale), (0.980437, 48.92))?;
    bar.inc(1);

    let path = out.join("pree.json");
    std::fs::write(&path, figures.to_json()).map_err(RenderError::write(&path))?;
    Ok(figures)
}

/// Fig. 1.
fn operations(
    figures: &mut Figures,
    run: &Outcome,
    full: bool,
    bar: &ProgressBar,
) -> Result<(), RenderError> {
    let millions = |count: u64| count as f64 / 1e6;
    let count = run.update.operations;
    figures.add(
        "Fig. 1(a), 320x240: operations, millions",
        Some(78.12),
        millions(count),
        2,
        format!("{count}, by the device's counter"),
    );
    if full {
        announce(bar, "1600x1200");
        let prepared = Prepared::new("cornell-balls", None, 1600, 1200)?;
        let mut hits = Vec::new();
        let count: u64 = chunks(19_200_000, CHUNK)
            .map(|range| {
                hits.clear();
                trace_photons(&prepared.scene, range, &mut hits);
                hits.iter().map(|hit| u64::from(prepared.grid.lookup(hit.position).n)).sum::<u64>()
            })
            .sum();
        bar.inc(1);
        figures.add(
            "Fig. 1(d), 1600x1200: operations, millions",
            Some(1934.61),
            millions(count),
            2,
            format!("{count}, lists counted without the device"),
        );
    }
    Ok(())
}

/// Fig. 4: what the sequential allocation does to the picture.
fn damage(
    figures: &mut Figures,
    large: &Recorded,
    leaping: &Outcome,
    out: &Path,
    bar: &ProgressBar,
) -> Result<(), RenderError> {
    announce(bar, "Fig. 4");
    let sequential = large.run(Units::Four, |policies| policies.allocation = Allocation::Sequential)?;
    let picture = large.picture(&sequential)?;
    let leaping_picture = large.picture(leaping)?;
    picture::save(&picture, &out.join("fig4-sequential.png"))?;
    picture::save(&leaping_picture, &out.join("fig4-leaping.png"))?;
    picture::save(&picture::difference(&picture, &leaping_picture, 4)?, &out.join("fig4-difference.png"))?;
    let visible = picture.pixels().zip(leaping_picture.pixels()).filter(|(a, b)| a != b).count();
    figures.add(
        "Fig. 4, sequential allocation: pixel conflicts",
        None,
        sequential.evaluate.pixel_conflicts as f64,
        0,
        format!(
            "shown as a picture there; {visible} pixels of fig4-sequential.png differ from fig4-leaping.png"
        ),
    );
    figures.add(
        "the same with ADISO's leaping allocation",
        None,
        leaping.evaluate.pixel_conflicts as f64,
        0,
        "\"alleviated\", not gone: a pixel with more hit points than the leap still collides (D12)",
    );
    bar.inc(1);
    Ok(())
}

/// Table II.
fn table_ii(
    figures: &mut Figures,
    large: &Recorded,
    four: &Outcome,
    bar: &ProgressBar,
) -> Result<(), RenderError> {
    announce(bar, "Table II");
    let rules: [(&str, Busy, InputWidth); 3] = [
        ("one photon a cycle, busy registered", Busy::Registered, InputWidth::One),
        ("one photon a cycle, busy combinational", Busy::Combinational, InputWidth::One),
        ("four photons a cycle, busy combinational", Busy::Combinational, InputWidth::Four),
    ];
    for (units, without) in [(Units::Four, 95.75), (Units::Eight, 90.53), (Units::Sixteen, 81.75)] {
        let count = units.count();
        let baseline = large.run(units, |policies| policies.scheduler = Scheduler::OnePhoton)?;
        bar.inc(1);
        figures.add(
            format!("Table II, {count} PREUs without AFTSO, %"),
            Some(without),
            utilisation(&baseline),
            4,
            "the paper's workload is unstated; a mean list of 33.6 instead of 32.0 would explain it",
        );
        for (name, busy, input_width) in rules {
            let default = (units, busy, input_width) == (Units::Four, Busy::Registered, InputWidth::One);
            let outcome = match default {
                true => four.clone(),
                false => large.run(units, |policies| {
                    policies.busy = busy;
                    policies.input_width = input_width;
                })?,
            };
            bar.inc(1);
            let ours = utilisation(&outcome);
            let enough = (ours * 100.0).round() / 100.0 >= 99.99;
            let short = if enough { "" } else { "; a buffer filled by one photon a cycle runs dry (D5)" };
            let reason = format!("{name}{short}");
            figures.add(format!("Table II, {count} PREUs with AFTSO, %"), Some(99.99), ours, 4, reason);
        }
    }
    Ok(())
}

/// Operations ÷ (cycles × PREUs), per cent.
fn utilisation(outcome: &Outcome) -> f64 {
    let slots = outcome.update.update_cycles * u64::from(outcome.capabilities.preus);
    100.0 * outcome.update.operations as f64 / slots as f64
}

/// Table III and §V: the chip at 20×15.
fn table_iii(figures: &mut Figures, chip: &Outcome) {
    let total = (chip.update.total_cycles + chip.evaluate.total_cycles) as f64;
    let (update, evaluate) = (chip.update.update_cycles, chip.evaluate.evaluate_cycles);
    let overhead = total as u64 - update - evaluate;
    figures.add(
        "Table III, 20x15: cycles (not printed there: 123,682 operations at 496.79 M/s and 125 MHz)",
        Some(31_120.0),
        total,
        0,
        format!("{update} update + {evaluate} evaluation + {overhead} to fill and drain; the paper's last part is 46"),
    );
    let speed = chip.update.operations as f64 * CLOCK_MHZ / total;
    figures.add("Table III, 20x15: MHpUO/s", Some(496.79), speed, 2, "from the cycles above");
    figures.add("Table III, 20x15: ms", Some(0.25), total / CLOCK_MHZ / 1e3, 2, "from the cycles above");
    figures.add(
        "20x15: update conflicts",
        None,
        chip.update.update_conflicts as f64,
        0,
        format!("the paper does not speak of them; {} updates were stale (D7)", chip.update.stale_updates),
    );
}

/// Fig. 13 and §V: SSIM and SNR.
fn quality(
    figures: &mut Figures,
    workload: &Recorded,
    reference: &image::RgbImage,
    outcome: &Outcome,
    (hazards, reason): (&str, &str),
    (ssim, snr): (f64, f64),
) -> Result<(), RenderError> {
    let comparison = picture::compare(&workload.picture(outcome)?, reference)?;
    let size = format!("{}x{}", workload.width, workload.height);
    figures.add(
        format!("{size}, {hazards}: SSIM to the software's picture"),
        Some(ssim),
        comparison.ssim,
        6,
        reason,
    );
    figures.add(
        format!("{size}, {hazards}: SNR, dB"),
        Some(snr),
        comparison.psnr_db,
        2,
        "ours is the PSNR of 8-bit samples; the paper does not define its SNR, and no definition tried gives it",
    );
    Ok(())
}
