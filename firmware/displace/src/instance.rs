//! One instance of the unit (Fig. 6), wired; in: rays and fills, out: results and line requests; cost: the units' own.
//!
//! ```text
//! switch -> view calculation -> FIFO #0 -> traverse -> FIFO #1 -> address -> read -> colour -> result
//!                                          height cache                     texture and normal cache
//! ```
//! Within a cycle the data's way is gone backwards, so that what is put on a link is seen in the next cycle at the earliest, and
//! room that is made is seen at once.

use heapless::Deque;
use lucerna_fabric::semi::SemiPipeline;
use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::job::{Job, Source};
use crate::operators::{ADDRESS, ADDRESS_DEPTH, COLOUR, COLOUR_DEPTH, VIEW_DEPTH, VIEW_LIST, VIEW_RASTER};
use crate::outside::{Cache, Fill, Outside};
use crate::read::{Fetch, Read};
use crate::record::{Outcome, Status};
use crate::shade::address::{Addresses, Hit, addresses};
use crate::sizes::{Caches, MAX_FIFO, Sizes};
use crate::slot::Heights;
use crate::slots::{Ended, Entrant, Slots};
use crate::traverse::ray::Ray;
use crate::view::View;

/// One instance.
#[derive(Clone, Debug)]
pub struct Instance<F: Format, const LINES: usize> {
    pub(crate) depth0: usize,
    pub(crate) depth1: usize,
    pub(crate) view: SemiPipeline<(u32, View<F>), VIEW_DEPTH>,
    /// Rays in the view calculation, for which FIFO #0 keeps room.
    pub(crate) coming: usize,
    pub(crate) fifo0: Deque<Entrant<F>, MAX_FIFO>,
    /// When rays left FIFO #0 that the switch, being late, does not know of.
    #[cfg(feature = "shortcut")]
    pub(crate) taken: Deque<u64, MAX_FIFO>,
    pub(crate) slots: Slots<F, LINES>,
    pub(crate) fifo1: Deque<Ended<F>, MAX_FIFO>,
    pub(crate) address: SemiPipeline<Fetch, ADDRESS_DEPTH>,
    pub(crate) read: Read<LINES>,
    pub(crate) colour: SemiPipeline<Fetch, COLOUR_DEPTH>,
}

impl<F: Format, const LINES: usize> Instance<F, LINES> {
    /// An empty instance.
    pub fn new(sizes: &Sizes, caches: Caches<LINES>) -> Self {
        Self {
            depth0: sizes.fifo0 as usize,
            depth1: sizes.fifo1 as usize,
            view: SemiPipeline::new(VIEW_LIST.pace()),
            coming: 0,
            fifo0: Deque::new(),
            #[cfg(feature = "shortcut")]
            taken: Deque::new(),
            slots: Slots::new(caches.height),
            fifo1: Deque::new(),
            address: SemiPipeline::new(ADDRESS.pace()),
            read: Read::new(caches.texture),
            colour: SemiPipeline::new(COLOUR.pace()),
        }
    }

    /// As after reset, for a job.
    pub fn reset(&mut self, job: &Job<F>) {
        self.view = SemiPipeline::new(match job.source {
            Source::List { .. } => VIEW_LIST.pace(),
            Source::Raster(_) => VIEW_RASTER.pace(),
        });
        self.coming = 0;
        self.fifo0.clear();
        #[cfg(feature = "shortcut")]
        self.taken.clear();
        self.slots.clear();
        self.fifo1.clear();
        self.address.clear();
        self.read.clear();
        self.colour.clear();
    }

    /// A line has come for one of its caches.
    pub fn fill(&mut self, fill: Fill, counters: &mut Counters) {
        match fill.cache {
            Cache::Height => self.slots.fill(fill.line, counters),
            Cache::Texture => self.read.fill(fill.line, counters),
        }
    }

    /// One clock of all but the switch.
    pub fn tick(&mut self, outside: &mut Outside<'_, F>) {
        let _ = self.shade(outside);
        self.leave_and_enter(outside);
        let _ = self.turn(outside);
        self.settle_view(outside);
    }

    /// FIFO #1 to result: address, read and colour; says whether a line was asked for.
    #[inline]
    pub(crate) fn shade(&mut self, outside: &mut Outside<'_, F>) -> bool {
        let (job, now) = (outside.job, outside.now);
        if let Some(fetch) = self.colour.take(now) {
            outside.shaded(&fetch);
        }
        if self.read.is_done() {
            if self.colour.can_issue(now)
                && let Some(fetch) = self.read.take()
            {
                outside.counters.colour_busy += u64::from(self.colour.pace().interval);
                let _ = self.colour.issue(now, fetch);
            } else {
                outside.counters.read_stalls += 1;
            }
        }
        if self.address.ready(now).is_some() {
            if self.read.is_idle()
                && let Some(fetch) = self.address.take(now)
            {
                self.read.begin(fetch);
            } else {
                outside.counters.address_stalls += 1;
            }
        }
        let line = self.read.access(job, outside.memory, outside.counters);
        if let Some(line) = line {
            outside.request(Cache::Texture, line, self.read.cache.geometry().line_bytes);
        }
        if self.address.can_issue(now)
            && self.fifo1.front().is_some_and(|ended| ended.left < now)
            && let Some(ended) = self.fifo1.pop_front()
        {
            outside.counters.address_busy += u64::from(self.address.pace().interval);
            let _ = self.address.issue(now, fetch(&ended, job));
        }
        line.is_some()
    }

    /// Stage 1 of the ring: to FIFO #1, and from FIFO #0.
    #[inline]
    pub(crate) fn leave_and_enter(&mut self, outside: &mut Outside<'_, F>) {
        if !self.slots.goes_on() {
            self.leave(outside);
            let _ = self.enter(outside);
        }
    }

    /// The ray in stage 1 leaves if it has ended: to FIFO #1 if there is room, or to its result.
    #[inline(never)]
    pub(crate) fn leave(&mut self, outside: &mut Outside<'_, F>) {
        let Some(ended) = self.slots.ended(outside.now) else { return };
        if ended.status != Status::Hit {
            self.slots.release();
            let colour = outside.job.background;
            outside.result(ended.number, &Outcome { colour, ..unshaded(&ended) });
        } else if self.fifo1.len() < self.depth1 && self.fifo1.push_back(ended).is_ok() {
            self.slots.release();
        }
    }

    /// A ray enters stage 1 if that is free; says whether one did.
    #[inline(never)]
    pub(crate) fn enter(&mut self, outside: &Outside<'_, F>) -> bool {
        if self.slots.is_free()
            && let Some(entrant) = self.fifo0.pop_front()
        {
            self.slots.load(entrant, outside.job);
            return true;
        }
        false
    }

    /// Stage 2 of the ring, and its turn; says whether a line was asked for.
    #[inline]
    pub(crate) fn turn(&mut self, outside: &mut Outside<'_, F>) -> bool {
        let Outside { job, depths, memory, counters, .. } = outside;
        let heights = Heights::of(job, depths, memory);
        let (_, line) = self.slots.turns(1, false, job, heights, counters);
        if let Some(line) = line {
            self.ask(line, outside);
        }
        line.is_some()
    }

    /// Asks for a line of heights.
    #[inline]
    pub(crate) fn ask(&self, line: u32, outside: &mut Outside<'_, F>) {
        outside.request(Cache::Height, line, self.slots.cache.geometry().line_bytes);
    }

    /// The view calculation's results to FIFO #0.
    #[inline(never)]
    pub(crate) fn settle_view(&mut self, outside: &mut Outside<'_, F>) {
        let Some((number, view)) = self.view.take(outside.now) else { return };
        self.coming -= 1;
        match view {
            // There is room: the controller saw to it.
            View::Ray { entry, direction } => {
                let _ = self.fifo0.push_back(Entrant { number, ray: Ray { entry, direction } });
            }
            View::Miss => outside.result(number, &Outcome::untraversed(Status::Miss, outside.job.background)),
            View::Grazing => {
                outside.result(number, &Outcome::untraversed(Status::Grazing, outside.job.background))
            }
        }
    }

    /// When the view calculation has its next result.
    #[inline]
    pub(crate) fn viewed(&self) -> u64 {
        self.view.next_event().unwrap_or(u64::MAX)
    }

    /// Whether FIFO #0 has room for a ray (§4.1: "the main role of the controller is to prevent overflow of FIFO #0").
    #[inline]
    pub(crate) fn has_room(&self) -> bool {
        self.coming + self.fifo0.len() < self.depth0
    }

    /// Takes a ray from the switch.
    #[inline]
    pub fn issue(&mut self, now: u64, number: u32, view: View<F>, counters: &mut Counters) {
        counters.view_busy += u64::from(self.view.pace().interval);
        self.coming += 1;
        let _ = self.view.issue(now, (number, view));
    }
}

/// What the address calculation makes of a hit.
#[inline(never)]
pub(crate) fn fetch<F: Format>(ended: &Ended<F>, job: &Job<F>) -> Fetch {
    let Ray { entry, direction } = ended.ray;
    let hit = Hit { entry, direction, t: ended.t, texel: ended.leaf };
    let Addresses { position, texture, normal } =
        addresses(&hit, job.map.shape, job.texture.shape, job.normals.shape);
    let result = Outcome { position, ..unshaded(ended) }.words();
    Fetch { number: ended.number, steps: ended.steps, result, texture, normal }
}

/// The outcome of a ray without position and colour.
fn unshaded<F: Format>(ended: &Ended<F>) -> Outcome<F> {
    Outcome {
        status: ended.status,
        texel: ended.leaf,
        t: ended.t,
        steps: ended.steps,
        level: ended.start_level,
        position: [F::ZERO; 2],
        colour: 0,
    }
}
