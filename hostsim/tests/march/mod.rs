//! What displaced surfaces look like, column by column.

use core::convert::Infallible;

use hostsim::oracle::Columns;
use hostsim::scene::{Scene, Vec3};
use hostsim::trace::{Answer, Displacer, Request};

/// The exact march, with one map for every surface.
pub struct March<'a> {
    pub scene: &'a Scene,
    pub log2: [u32; 2],
    pub heights: Vec<u8>,
    /// All requests so far.
    pub asked: Vec<Request>,
}

impl<'a> March<'a> {
    /// Eight by eight.
    #[allow(dead_code, reason = "not every test has a map of its own")]
    pub fn new(scene: &'a Scene, height: fn(u8, u8) -> u8) -> Self {
        let heights = (0..64).map(|i| height(i & 7, i >> 3)).collect();
        Self { scene, log2: [3, 3], heights, asked: Vec::new() }
    }
}

impl Displacer for March<'_> {
    type Error = Infallible;

    fn answer(
        &mut self,
        surface: usize,
        requests: &[Request],
        answers: &mut Vec<Answer>,
    ) -> Result<(), Infallible> {
        let surface = &self.scene.displaced()[surface];
        let columns = Columns::new(self.log2, &self.heights, true);
        self.asked.extend_from_slice(requests);
        answers.extend(requests.iter().map(|request| {
            let [x, y, z] = surface.tbn().map(|row| row.dot(request.view));
            let d = [x, y].map(|c| c / -z * surface.height_scale());
            Answer { t: columns.march(request.entry, d).t, ..Answer::flat(Vec3::ONE) }
        }));
        Ok(())
    }
}
