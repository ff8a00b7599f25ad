//! Any bytes as a C3D: an error by name, or a take that is written and read again.
#![no_main]

use frontalis_analysis::format::c3d::{C3dPoint, C3dTake, C3dWriter};
use libfuzzer_sys::fuzz_target;

/// Frames that are compared; all are read.
const MAX_COMPARED: usize = 64;

fn positions(frame: &[Option<C3dPoint>]) -> Vec<Option<[u32; 3]>> {
    let bits = |it: &C3dPoint| it.position.map(f32::to_bits);
    frame.iter().map(|it| it.as_ref().map(bits)).collect()
}

fuzz_target!(|bytes: &[u8]| {
    let Ok(take) = C3dTake::open(bytes) else {
        return;
    };
    let mut compared = Vec::new();
    for frame in take.frames() {
        let Ok(frame) = frame else { return };
        if compared.len() < MAX_COMPARED {
            compared.push(frame);
        }
    }
    let mut heading = take.heading().clone();
    heading.n_frames = compared.len() as u32;
    // A name may be too long, and a number too great, for what is written.
    let Ok(mut writer) = C3dWriter::new(Vec::new(), &heading) else {
        return;
    };
    for frame in &compared {
        writer.write_frame(frame).expect("a frame that was read");
    }
    let written = writer.finish().expect("as many frames as stated");
    let again = C3dTake::open(&written).expect("it was written");
    assert_eq!(again.heading(), &heading);
    for (again, frame) in again.frames().zip(&compared) {
        assert_eq!(positions(&again.expect("it was written")), positions(frame));
    }
});
