//! A first job, whole: in: four hit points, five photons, out: four pixels and the counters, printed; cost: under a thousand
//! clocks of a modelled device.
//!
//! `cargo run --release -p lucerna-tests --example first_job`

use core::error::Error;
use core::pin::pin;
use core::task::{Context, Poll, Waker};

use lucerna_bus::Model;
use lucerna_device::PreeDevice;
use lucerna_driver::{Deadline, EvaluateJob, HitPoint, Layout, Lucerna, Photon, Policies, Sizes, UpdateJob};
use lucerna_softfloat::F32;

const PATIENCE: Deadline = Deadline::millis(10);

fn main() -> Result<(), Box<dyn Error>> {
    // Four hit points a unit apart on a white floor, a pixel each. R² is where the search begins: photons shrink it.
    let hit_points: [HitPoint; 4] = core::array::from_fn(|number| HitPoint {
        position: [number as f32, 0.0, 0.0],
        normal: [0.0, 0.0, 1.0],
        colour: [1.0; 3],
        radius_squared: 0.5,
        pixel: number as u32,
        ..HitPoint::default() // no flux and no photons yet
    });
    // The lists, one behind the other: hit points 0 and 1 are near one cell of the floor, 1 and 2 near the next, ...
    let index = [0, 1, 1, 2, 2, 3];
    // Entries p_addr..p_addr + n of the index table name the hit points to test; n = 0 for none.
    let photon = |x, p_addr, n| Photon {
        position: [x, 0.1, 0.0],
        flux: [1.0, 0.5, 0.25],
        p_addr,
        n,
        ..Photon::default()
    };
    let photons =
        [photon(0.2, 0, 2), photon(0.9, 0, 2), photon(1.5, 2, 2), photon(2.6, 4, 2), photon(9.0, 0, 0)];

    // The device: its format, number of units and memory. The model is named, as bus, delay and pin borrow it.
    let sizes = Sizes { hit_points: 4, index_entries: 6, pixels: 4, ring_entries: 16, normal_test: false };
    let device = PreeDevice::<F32, 4, _>::new(vec![0u32; sizes.bytes() as usize / 4]);
    let model = Model::new(device);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay())?;
    let layout = Layout::packed(lucerna.capabilities(), sizes)?;
    let update = UpdateJob::new(&layout, 0.7, Policies::default())?;

    let mut pree = lucerna.pree()?;
    pree.write_hit_points(&layout, 0, &hit_points)?;
    pree.write_index(&layout, 0, &index)?;
    let mut pixels = [[0.0; 3]; 4];

    // A pass, waited for by polling.
    let mut stream = pree.update(&update)?;
    stream.push_all(&photons, PATIENCE)?;
    stream.finish(PATIENCE)?;
    pree.zero_pixels(&layout)?;
    pree.evaluate(&EvaluateJob::new(&layout, 5.0, Policies::default())?)?.wait(PATIENCE)?;
    pree.read_pixels(&layout, 0, &mut pixels)?;
    println!("after 5 photons: {pixels:.4?}");

    // The next pass goes on from the hit points in device memory, and sleeps until the interrupt line rises.
    let (mut irq, mut delay) = (model.irq(), model.delay());
    block_on(async {
        let mut stream = pree.update(&update)?;
        stream.push_all_on(&photons, &mut irq, &mut delay, PATIENCE).await?;
        stream.flush()?.done(&mut irq, &mut delay, PATIENCE).await
    })?;
    pree.zero_pixels(&layout)?;
    pree.evaluate(&EvaluateJob::new(&layout, 10.0, Policies::default())?)?.wait(PATIENCE)?;
    pree.read_pixels(&layout, 0, &mut pixels)?;
    println!("after 10 photons: {pixels:.4?}");

    println!("{:#?}", pree.counters()?);
    println!("{} clocks of the device, the driver's accesses and pauses included", model.elapsed());
    Ok(())
}

/// The smallest executor: polls until done. A model's futures let device time pass in every poll.
fn block_on<T>(future: impl Future<Output = T>) -> T {
    let mut future = pin!(future);
    let mut context = Context::from_waker(Waker::noop());
    loop {
        if let Poll::Ready(output) = future.as_mut().poll(&mut context) {
            return output;
        }
    }
}
