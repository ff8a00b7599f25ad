//! A performance made by chance: what the muscles of `choe-ko-16` do when a face moves at all times.
//!
//! Contractions rise and fall as raised cosines with a hold between; most are symmetric. Eyes blink.

use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64;

use super::{curves::Curves, take::N_NEUTRAL};

/// Frames a second.
pub const RATE_HZ: f64 = 60.0;

/// Frames of a performance, the neutral ones included: 20 s.
pub const N_FRAMES: usize = N_NEUTRAL + 1200;

const N_MUSCLES: usize = 16;

/// Muscles that contract together, left and right.
const PAIRS: [[usize; 2]; 5] = [[0, 1], [2, 3], [6, 7], [8, 9], [10, 11]];

/// Muscles without a mirror image: depressor anguli oris, orbicularis oris, lips pressor, jaw.
const SINGLES: [usize; 4] = [12, 13, 14, 15];

/// The eyelids.
const EYELIDS: [usize; 2] = [4, 5];

const EVENTS_PER_SECOND: f64 = 1.4;
const EVENT_SECONDS: std::ops::Range<f64> = 0.5..2.2;
const EVENT_HEIGHT: std::ops::Range<f64> = 0.25..1.0;

/// How often a pair contracts on both sides, and the least share of the height on each.
const SYMMETRIC: f64 = 0.75;
const SIDE_SHARE: std::ops::Range<f64> = 0.8..1.0;

const BLINK_SECONDS: f64 = 0.22;
const SECONDS_BETWEEN_BLINKS: std::ops::Range<f64> = 1.5..5.0;

/// The share of an event that is held at its height.
const HOLD: f64 = 0.3;

/// The contractions of one performance.
pub fn contractions(seed: u64) -> Curves {
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut curves = Curves(vec![vec![0.0; N_MUSCLES]; N_FRAMES]);
    let seconds = (N_FRAMES - N_NEUTRAL) as f64 / RATE_HZ;
    let mut events = EVENTS_PER_SECOND * seconds;
    while events > 0.0 {
        add_event(&mut curves, seconds, &mut rng);
        events -= 1.0;
    }
    add_blinks(&mut curves, seconds, &mut rng);
    curves
}

fn add_event(curves: &mut Curves, seconds: f64, rng: &mut Pcg64) {
    let start = rng.random_range(0.0..seconds);
    let length = rng.random_range(EVENT_SECONDS);
    let height = rng.random_range(EVENT_HEIGHT);
    let kind = rng.random_range(0..PAIRS.len() + SINGLES.len());
    let Some(pair) = PAIRS.get(kind) else {
        return contract(curves, SINGLES[kind - PAIRS.len()], start, length, height);
    };
    if rng.random_range(0.0..1.0) < SYMMETRIC {
        for &muscle in pair {
            contract(
                curves,
                muscle,
                start,
                length,
                height * rng.random_range(SIDE_SHARE),
            );
        }
    } else {
        contract(curves, pair[rng.random_range(0..2)], start, length, height);
    }
}

fn add_blinks(curves: &mut Curves, seconds: f64, rng: &mut Pcg64) {
    let mut start = rng.random_range(0.5..2.0);
    while start < seconds {
        for muscle in EYELIDS {
            contract(curves, muscle, start, BLINK_SECONDS, 1.0);
        }
        start += rng.random_range(SECONDS_BETWEEN_BLINKS);
    }
}

/// One contraction; where two overlap the stronger one shows.
fn contract(curves: &mut Curves, muscle: usize, start: f64, length: f64, height: f64) {
    for (k, row) in curves.0[N_NEUTRAL..].iter_mut().enumerate() {
        let phase = (k as f64 / RATE_HZ - start) / length;
        if (0.0..1.0).contains(&phase) {
            row[muscle] = row[muscle].max(height * rise_and_fall(phase));
        }
    }
}

fn rise_and_fall(phase: f64) -> f64 {
    let ramp = 0.5 * (1.0 - HOLD);
    let share = (phase.min(1.0 - phase) / ramp).min(1.0);
    0.5 - 0.5 * (std::f64::consts::PI * share).cos()
}
