//! Any bytes as a TRC: an error by line, or a take that is written and read again.
#![no_main]

use frontalis_analysis::format::trc::{self, TrcTake};
use libfuzzer_sys::fuzz_target;

fn bits(take: &TrcTake) -> Vec<(u64, u64, Vec<[u32; 3]>)> {
    let frames = take.frames.iter().map(|it| {
        // Any NaN is a coordinate that was not seen.
        let seen = |it: &f32| if it.is_nan() { f32::NAN } else { *it };
        let positions = it.positions.iter().map(|it| it.each_ref().map(|it| seen(it).to_bits()));
        (it.number, it.time_s.to_bits(), positions.collect())
    });
    frames.collect()
}

fuzz_target!(|bytes: &[u8]| {
    let Ok(take) = trc::parse(bytes) else {
        return;
    };
    let written = trc::write(&take, "fuzz");
    // Control characters in names become `_`, so that two names may become one.
    let Ok(again) = trc::parse(written.as_bytes()) else {
        assert!(take.marker_names.iter().any(|it| it.contains(char::is_control)));
        return;
    };
    assert_eq!(bits(&again), bits(&take));
});
