//! Animations that the glTF crate accepts, and what it finds in them.

use gltf::animation::{Interpolation, Property, util::ReadOutputs};

use super::*;
use crate::{
    format::{actor_package, glb},
    synthesis::reference_face,
    timecode::TimecodeRate,
};

fn written(times_s: &[f32], weights: &[Vec<f32>], timecode: Option<&Timecode>) -> Vec<u8> {
    let actor = reference_face::actor();
    let mesh = actor_package::morph_mesh(&actor);
    let mut writer =
        AnimationWriter::new(Vec::new(), &mesh, Map::new(), times_s, timecode).unwrap();
    for frame in weights {
        writer.write_frame(frame).unwrap();
    }
    writer.finish().unwrap()
}

fn weights() -> Vec<Vec<f32>> {
    let frame = |frame: u16| {
        (0..16_u16)
            .map(|it| f32::from(frame * 16 + it) / 64.0)
            .collect()
    };
    (0..3).map(frame).collect()
}

const TIMES_S: [f32; 3] = [0.0, 1.0 / 120.0, 2.0 / 120.0];

#[test]
fn the_gltf_crate_finds_every_weight_at_its_time() {
    let bytes = written(&TIMES_S, &weights(), None);
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(&bytes).unwrap();
    let animation = document.animations().next().unwrap();
    let channel = animation.channels().next().unwrap();
    assert_eq!(channel.sampler().interpolation(), Interpolation::Linear);
    assert_eq!(channel.target().property(), Property::MorphTargetWeights);
    assert!(channel.target().node().mesh().is_some());
    let reader = channel.reader(|_| blob.as_deref());
    let times: Vec<f32> = reader.read_inputs().unwrap().collect();
    assert_eq!(times.map_bits(), TIMES_S.to_vec().map_bits());
    let Some(ReadOutputs::MorphTargetWeights(found)) = reader.read_outputs() else {
        panic!("no weights");
    };
    let found: Vec<f32> = found.into_f32().collect();
    assert_eq!(found.map_bits(), weights().concat().map_bits());
}

trait MapBits {
    fn map_bits(&self) -> Vec<u32>;
}

impl MapBits for Vec<f32> {
    fn map_bits(&self) -> Vec<u32> {
        self.iter().map(|it| it.to_bits()).collect()
    }
}

#[test]
fn the_mesh_is_the_actors_with_a_target_a_muscle() {
    let actor = reference_face::actor();
    let read = glb::read(&written(&TIMES_S, &weights(), None)).unwrap();
    let names = read.targets.iter().map(|it| it.name.as_deref().unwrap());
    let muscles = actor
        .muscle_set()
        .muscles()
        .iter()
        .map(|it| it.name.as_str());
    assert!(names.eq(muscles));
    let mesh = actor_package::morph_mesh(&actor);
    assert_eq!(read.positions_m, mesh.positions_m);
    assert_eq!(read.targets, mesh.targets);
}

#[test]
fn the_first_frames_timecode_survives() {
    let timecode = Timecode::parse("01:02:03;04", TimecodeRate::NTSC_DROP).unwrap();
    let bytes = written(&TIMES_S, &weights(), Some(&timecode));
    let glb = gltf::binary::Glb::from_slice(&bytes).unwrap();
    let document: Value = serde_json::from_slice(&glb.json).unwrap();
    assert_eq!(
        document["animations"][0]["extras"],
        json!({ "timecode": "01:02:03;04", "rate": "30000/1001" })
    );
}

#[test]
fn times_and_frames_that_do_not_fit_are_refused() {
    let actor = reference_face::actor();
    let mesh = actor_package::morph_mesh(&actor);
    let begin =
        |times_s: &[f32]| AnimationWriter::new(Vec::new(), &mesh, Map::new(), times_s, None);
    let refused = |times_s: &[f32]| begin(times_s).unwrap_err().to_string();
    assert!(refused(&[]).starts_with("an animation needs a frame"));
    for times_s in [
        [0.0, 0.0],
        [1.0, 0.5],
        [0.0, f32::NAN],
        [0.0, f32::INFINITY],
    ] {
        assert!(refused(&times_s).starts_with("the time of frame 1 "));
    }
    assert!(refused(&[-1.0]).starts_with("the time of frame 0 "));
    let mut writer = begin(&[0.0]).unwrap();
    for weights in [vec![0.0; 15], vec![f32::NAN; 16]] {
        let error = writer.write_frame(&weights).unwrap_err();
        assert!(matches!(
            error,
            AnimationError::Weights { expected: 16, .. }
        ));
    }
    writer.write_frame(&[0.0; 16]).unwrap();
    let error = writer.write_frame(&[0.0; 16]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "2 frames were written; 1 times were stated"
    );
    assert!(matches!(
        begin(&[0.0]).unwrap().finish(),
        Err(AnimationError::FrameCount { .. })
    ));
}
