//! Publisher, server and subscriber under partition, delay, reset, power cut and restart, in simulated time (CONTRACTS G6).
//!
//! The server and the clients are the real ones, on one thread, over a simulated network and a storage of which only what
//! was flushed survives. One checker of histories judges every run; it is itself tried with planted violations.

mod faults;
mod history;
mod planted;
mod wire;
mod world;

use std::{sync::Arc, time::Duration};

use self::{
    faults::{Fault, healed, schedule},
    history::{Heard, History, Violation},
    world::World,
};

/// Simulations of one run of the test; `make simulations` runs more.
const N_SEEDS: u64 = 40;

/// Simulated time between two looks at the network.
const TICK: Duration = Duration::from_millis(10);

/// No simulation takes longer, in simulated time.
const LONGEST: Duration = Duration::from_mins(2);

#[test]
fn every_simulated_stage_keeps_the_contract() {
    let n_seeds = std::env::var("FRONTALIS_SIMULATIONS").map_or(N_SEEDS, |it| it.parse().unwrap());
    let mut figures = Figures::default();
    for seed in 0..n_seeds {
        let history = simulate(seed, World::cut_power);
        let violations = history.violations();
        assert!(
            violations.is_empty(),
            "seed {seed}: {violations:?}, by {:?}, in the end {:?}",
            schedule(seed),
            history.acknowledged.last()
        );
        figures.count(seed, &history);
    }
    println!("{n_seeds} simulations, 0 violations: {figures:?}");
}

#[test]
fn a_storage_that_forgets_what_it_flushed_is_found_out() {
    let with_a_crash =
        (0..N_SEEDS).find(|seed| schedule(*seed).iter().any(|it| it.1 == Fault::Crash));
    let violations = simulate(with_a_crash.unwrap(), World::cut_power_and_lose).violations();
    let is_lost = |it: &Violation| matches!(it, Violation::DurableFrameLost { .. });
    assert!(violations.iter().any(is_lost), "{violations:?}");
}

/// What the simulations came to, so that one that did nothing is noticed.
#[derive(Debug, Default)]
struct Figures {
    crashes: usize,
    other_faults: usize,
    takes: usize,
    recorded_frames: usize,
    samples_heard: usize,
    samples_lost_and_said: u64,
}

impl Figures {
    fn count(&mut self, seed: u64, history: &History) {
        let faults = schedule(seed);
        let crashes = faults.iter().filter(|it| it.1 == Fault::Crash).count();
        self.crashes += crashes;
        self.other_faults += faults.len() - crashes;
        self.takes += history.takes.len();
        let recorded = history.takes.iter().map(|it| it.frames.len());
        self.recorded_frames += recorded.sum::<usize>();
        for heard in &history.heard {
            match heard {
                Heard::Sample(_) => self.samples_heard += 1,
                Heard::Lost { first, last } => self.samples_lost_and_said += last - first + 1,
                _ => {}
            }
        }
    }
}

/// One stage from its first frame to the end of its session; `cut_power` is what a crash does to the storage.
fn simulate(seed: u64, cut_power: fn(&World)) -> History {
    let world = World::new(seed);
    let mut sim = turmoil::Builder::new()
        .rng_seed(seed)
        .tick_duration(TICK)
        .simulation_duration(LONGEST)
        .min_message_latency(Duration::from_millis(1))
        .max_message_latency(Duration::from_millis(10))
        .build();
    let server = Arc::clone(&world);
    sim.host("server", move || Arc::clone(&server).serve());
    let operator = Arc::clone(&world);
    sim.host("operator", move || Arc::clone(&operator).operate());
    sim.client("publisher", Arc::clone(&world).publish());
    sim.client("subscriber", Arc::clone(&world).follow());
    let faults = schedule(seed);
    let healed = healed(&faults);
    let mut faults = faults.into_iter().peekable();
    loop {
        match sim.step() {
            Ok(true) => return world.to_history(),
            Ok(false) => {}
            Err(error) => panic!("seed {seed}: {error}: {:?}", world.to_history()),
        }
        while let Some((_, fault)) = faults.next_if(|it| it.0 <= sim.elapsed()) {
            apply(fault, &mut sim, &world, cut_power);
        }
        if sim.elapsed() > healed {
            world.healed.cancel();
        }
    }
}

fn apply(fault: Fault, sim: &mut turmoil::Sim<'_>, world: &World, cut_power: fn(&World)) {
    match fault {
        Fault::Hold(client) => sim.hold("server", client),
        Fault::Release(client) => sim.release("server", client),
        Fault::Partition(client) => sim.partition("server", client),
        Fault::Repair(client) => sim.repair("server", client),
        Fault::Delay(longest) => sim.set_max_message_latency(longest),
        Fault::Reset => world.scissors.cut(),
        Fault::Crash => {
            sim.crash("server");
            cut_power(world);
        }
        Fault::Restart => sim.bounce("server"),
    }
}
