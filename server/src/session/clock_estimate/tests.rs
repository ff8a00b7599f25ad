//! The offset of a capture clock that is off, drifts, and is reached by ways that jitter (CONTRACTS G14).

use super::*;

const MILLI: i64 = 1_000_000;

/// A fixed sequence of numbers in 0..1 (a linear congruential generator, the upper half of its state).
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 32).unwrap()) / f64::from(u32::MAX)
    }

    /// A way of up to 20 ms.
    fn way(&mut self) -> i64 {
        300_000 + whole(self.next() * 20e6)
    }
}

/// A capture clock.
#[derive(Clone, Copy)]
struct CaptureClock {
    offset_nanos: i64,
    drift_ppm: f64,
}

impl CaptureClock {
    /// Its reading at a moment of the server's.
    fn at(self, server_nanos: i64) -> i64 {
        let offset = self.offset_nanos + whole(server_nanos as f64 * self.drift_ppm * 1e-6);
        server_nanos - offset
    }
}

fn exchange(clock: CaptureClock, at: i64, chance: &mut Chance) -> ClockExchange {
    let arrived = at + chance.way();
    let answered = arrived + whole(chance.next() * 30e6);
    ClockExchange {
        server_send: at,
        client_receive: clock.at(arrived),
        client_send: clock.at(answered),
        server_receive: answered + chance.way(),
    }
}

/// Largest error of any report, nanoseconds, over two minutes of an exchange every 50 ms.
fn largest_error(clock: CaptureClock, seed: u64) -> i64 {
    let (mut estimate, mut chance) = (ClockEstimate::default(), Chance(seed));
    let mut largest = 0;
    let mut n_reports = 0;
    for at in (0..2_400).map(|k| 3_600_000 * MILLI + k * 50 * MILLI) {
        let Some(report) = estimate.add(exchange(clock, at, &mut chance)) else {
            continue;
        };
        n_reports += 1;
        // The drift is known after some twenty seconds; a report holds until the next one.
        if n_reports < 5 {
            continue;
        }
        for later in [0, 2_500, 5_000] {
            let now = report.server_time_nanos + later * MILLI;
            let error = report.on_server_clock(clock.at(now)) - now;
            largest = largest.max(error.abs());
        }
    }
    assert!(n_reports > 15);
    largest
}

#[test]
fn the_offset_is_known_to_a_millisecond_under_jitter_and_drift() {
    let mut worst = 0;
    for offset_nanos in [-500 * MILLI, 0, 500 * MILLI] {
        for drift_ppm in [-100.0, 0.0, 100.0] {
            for seed in 1..=5 {
                let clock = CaptureClock {
                    offset_nanos,
                    drift_ppm,
                };
                worst = worst.max(largest_error(clock, seed));
            }
        }
    }
    println!("G14: the offset is off by at most {worst} ns");
    assert!(worst <= MILLI, "{worst} ns");
}

#[test]
fn eight_exchanges_make_a_report_and_every_five_seconds_make_another() {
    let clock = CaptureClock {
        offset_nanos: 70 * MILLI,
        drift_ppm: 0.0,
    };
    let (mut estimate, mut chance) = (ClockEstimate::default(), Chance(1));
    let told: Vec<i64> = (0..300)
        .filter(|k| {
            let exchange = exchange(clock, k * 100 * MILLI, &mut chance);
            estimate.add(exchange).is_some()
        })
        .collect();
    assert_eq!(told.first(), Some(&7));
    assert!(
        told.windows(2)
            .all(|it| (49..=52).contains(&(it[1] - it[0])))
    );
    let report = estimate.report().unwrap();
    assert!(report.round_trip_nanos < 20_000_000);
    assert!(report.uncertainty_nanos < 10_000_000);
}

#[test]
fn what_cannot_have_been_is_passed_over() {
    let mut estimate = ClockEstimate::default();
    let possible = ClockExchange {
        server_send: 1_000,
        client_receive: 50,
        client_send: 60,
        server_receive: 2_000,
    };
    for impossible in [
        ClockExchange {
            server_receive: 900,
            ..possible
        },
        ClockExchange {
            client_send: 40,
            ..possible
        },
        ClockExchange {
            client_send: 5_000,
            ..possible
        },
        ClockExchange {
            client_receive: i64::MIN,
            client_send: i64::MAX,
            ..possible
        },
    ] {
        assert_eq!(estimate.add(impossible), None);
        assert!(estimate.exchanges.is_empty(), "{impossible:?}");
    }
    assert_eq!(estimate.add(possible), None);
    assert_eq!(estimate.exchanges.len(), 1);
}

#[test]
fn times_at_the_ends_of_their_range_do_not_overflow() {
    let mut estimate = ClockEstimate::default();
    for k in 0..20 {
        let at = k * 6_000 * MILLI;
        estimate.add(ClockExchange {
            server_send: at,
            client_receive: i64::MIN + at,
            client_send: i64::MIN + at,
            server_receive: at,
        });
    }
    let report = estimate.report().unwrap();
    assert!(report.drift_ppm.is_finite());
    let _saturates = report.on_server_clock(i64::MAX);
}
