//! Frame counts and labels, with the standard's own edges.

use proptest::prelude::*;

use super::*;

fn rate(numerator: u32, denominator: u32, counting: Counting) -> TimecodeRate {
    TimecodeRate::new(numerator, denominator, counting).unwrap()
}

fn drop_60() -> TimecodeRate {
    rate(60_000, 1_001, Counting::Drop)
}

fn all_rates() -> Vec<TimecodeRate> {
    let non_drop = [
        (24_000, 1_001),
        (24, 1),
        (25, 1),
        (30_000, 1_001),
        (30, 1),
        (48, 1),
        (50, 1),
        (60_000, 1_001),
        (60, 1),
        (120, 1),
    ];
    let mut rates: Vec<_> = non_drop
        .into_iter()
        .map(|(numerator, denominator)| rate(numerator, denominator, Counting::NonDrop))
        .collect();
    rates.extend([TimecodeRate::NTSC_DROP, drop_60()]);
    rates
}

fn follows(from: &str, to: &str, rate: TimecodeRate) {
    let (from, to) = (
        Timecode::parse(from, rate).unwrap(),
        Timecode::parse(to, rate).unwrap(),
    );
    assert_eq!(from.plus_frames(1), to);
    assert_eq!(to.plus_frames(-1), from);
}

#[test]
fn the_label_after_a_minutes_last_skips_what_is_dropped() {
    let drop = TimecodeRate::NTSC_DROP;
    follows("00:00:59;29", "00:01:00;02", drop);
    follows("00:08:59;29", "00:09:00;02", drop);
    follows("00:09:59;29", "00:10:00;00", drop);
    follows("00:59:59;29", "01:00:00;00", drop);
    follows("23:59:59;29", "00:00:00;00", drop);
    follows("00:00:59;59", "00:01:00;04", drop_60());
    follows("00:09:59;59", "00:10:00;00", drop_60());
    follows("23:59:59;59", "00:00:00;00", drop_60());
}

#[test]
fn without_dropping_every_label_occurs() {
    follows(
        "00:00:59:29",
        "00:01:00:00",
        rate(30_000, 1_001, Counting::NonDrop),
    );
    follows(
        "00:00:59:23",
        "00:01:00:00",
        rate(24_000, 1_001, Counting::NonDrop),
    );
    follows("23:59:59:24", "00:00:00:00", rate(25, 1, Counting::NonDrop));
}

#[test]
fn the_standards_frame_counts_are_ours() {
    let count = |text, rate| Timecode::parse(text, rate).unwrap().frame_count();
    let drop = TimecodeRate::NTSC_DROP;
    assert_eq!(count("00:01:00;02", drop), 1_800);
    assert_eq!(count("00:10:00;00", drop), 17_982);
    assert_eq!(count("01:00:00;00", drop), 107_892);
    assert_eq!(count("23:59:59;29", drop), 2_589_407);
    assert_eq!(drop.frames_a_day(), 2_589_408);
    assert_eq!(drop_60().frames_a_day(), 5_178_816);
    assert_eq!(rate(24, 1, Counting::NonDrop).frames_a_day(), 2_073_600);
}

#[test]
fn a_day_of_dropped_labels_is_a_day() {
    for rate in [TimecodeRate::NTSC_DROP, drop_60()] {
        let seconds = rate.frames_a_day() as f64 / rate.hz();
        assert!((seconds - 86_400.0).abs() < 0.1, "{seconds}");
    }
}

#[test]
fn every_frame_of_a_day_has_a_label_of_its_own() {
    for rate in all_rates() {
        let mut before = None;
        for count in 0..rate.frames_a_day() {
            let timecode = Timecode::from_frame_count(count, rate);
            assert_eq!(Timecode::new(timecode.label(), rate), Ok(timecode));
            assert_eq!(timecode.frame_count(), count);
            let label = Some(timecode.label());
            assert!(before < label);
            before = label;
        }
    }
}

#[test]
fn labels_that_do_not_occur_are_refused() {
    let refused = |text, rate| Timecode::parse(text, rate).unwrap_err().to_string();
    let drop = TimecodeRate::NTSC_DROP;
    assert_eq!(
        refused("00:01:00;00", drop),
        "00:01:00;00 does not occur: drop-frame counting begins this minute at a later frame"
    );
    for (text, rate) in [
        ("00:01:00;01", drop),
        ("23:59:00;00", drop),
        ("00:01:00;03", drop_60()),
    ] {
        assert!(refused(text, rate).contains("does not occur"));
    }
    for occurs in ["00:00:00;00", "00:10:00;01", "00:01:01;00", "00:01:00;02"] {
        assert!(Timecode::parse(occurs, drop).is_ok(), "{occurs}");
    }
    let pal = rate(25, 1, Counting::NonDrop);
    assert_eq!(
        refused("25:00:00:00", pal),
        "hours is 25, which is not below 24"
    );
    assert_eq!(
        refused("00:60:00:00", pal),
        "minutes is 60, which is not below 60"
    );
    assert_eq!(
        refused("00:00:60:00", pal),
        "seconds is 60, which is not below 60"
    );
    assert_eq!(
        refused("00:00:00:25", pal),
        "frames is 25, which is not below 25"
    );
}

#[test]
fn text_that_is_no_timecode_is_refused() {
    let pal = rate(25, 1, Counting::NonDrop);
    for text in [
        "",
        "1",
        "00:00:00",
        "00:00:00:0",
        "0:00:00:00",
        "00:00:00:00:00",
        "00;00:00:00",
        "00:00:00:+1",
        "00:00:00:-1",
        "00:00:00:99999999999",
        " 00:00:00:00",
        "00:00:00.00",
        "00:00:00:0\u{661}",
    ] {
        let error = Timecode::parse(text, pal).unwrap_err();
        assert!(
            matches!(error, TimecodeError::Form { .. }),
            "{text}: {error}"
        );
    }
    let mark = |text, rate| matches!(Timecode::parse(text, rate), Err(TimecodeError::Mark { .. }));
    assert!(mark("00:00:00;00", pal));
    assert!(mark("00:00:00:00", TimecodeRate::NTSC_DROP));
}

#[test]
fn rates_that_cannot_be_are_refused() {
    for (numerator, denominator) in [(0, 1), (30, 0), (0, 0)] {
        let refused = TimecodeRate::new(numerator, denominator, Counting::NonDrop);
        assert!(matches!(refused, Err(TimecodeError::Rate { .. })));
    }
    for (numerator, denominator) in [(25, 1), (30, 1), (24_000, 1_001), (60, 1), (120_000, 1_001)] {
        let refused = TimecodeRate::new(numerator, denominator, Counting::Drop);
        assert!(matches!(refused, Err(TimecodeError::DropRate { .. })));
    }
}

#[test]
fn sub_frames_are_fractions_and_user_bits_are_kept() {
    let it = Timecode::from_frame_count(0, TimecodeRate::NTSC_DROP);
    for sub_frame in [f32::NAN, -0.1, 1.0, f32::INFINITY] {
        assert_eq!(it.with_sub_frame(sub_frame), Err(TimecodeError::SubFrame));
    }
    let it = it.with_sub_frame(0.25).unwrap().with_user_bits(7);
    let later = it.plus_frames(1_800);
    assert_eq!(
        (later.sub_frame().to_bits(), later.user_bits()),
        (0.25_f32.to_bits(), 7)
    );
    assert_eq!(later.to_string(), "00:01:00;02");
}

proptest! {
    #[test]
    fn what_is_printed_is_read(which in any::<prop::sample::Index>(), count in any::<u64>(), by in any::<i64>()) {
        let rates = all_rates();
        let rate = rates[which.index(rates.len())];
        let it = Timecode::from_frame_count(count, rate);
        prop_assert_eq!(Timecode::parse(&it.to_string(), rate), Ok(it));
        let there = it.plus_frames(by);
        let expected = (i128::from(it.frame_count()) + i128::from(by)).rem_euclid(i128::from(rate.frames_a_day()));
        prop_assert_eq!(i128::from(there.frame_count()), expected);
    }

    #[test]
    fn no_text_and_no_rate_makes_it_panic(text in ".{0,16}", numerator in any::<u32>(), denominator in any::<u32>(), count in any::<u64>()) {
        if let Ok(rate) = TimecodeRate::new(numerator, denominator, Counting::NonDrop) {
            let it = Timecode::from_frame_count(count, rate);
            prop_assert_eq!(Timecode::parse(&it.to_string(), rate), Ok(it));
            let _refused = Timecode::parse(&text, rate);
        }
    }
}
