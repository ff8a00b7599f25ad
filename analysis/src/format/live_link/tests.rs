//! Rows as the app writes them.

use nalgebra::{UnitQuaternion, Vector3};

use super::*;
use crate::{
    format::shared_data,
    timecode::{Counting, Label, TimecodeRate},
};

fn timecode(frames: u32, sub_frame: f32) -> Timecode {
    let rate = TimecodeRate::new(60, 1, Counting::NonDrop).unwrap();
    let label = Label {
        hours: 19,
        minutes: 16,
        seconds: 29,
        frames,
    };
    let timecode = Timecode::new(label, rate).unwrap();
    timecode.with_sub_frame(sub_frame).unwrap()
}

fn turned(yaw: f64, pitch: f64, roll: f64) -> HeadPose {
    let about = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    let rotation = about(Vector3::y_axis(), yaw)
        * about(Vector3::x_axis(), pitch)
        * about(Vector3::z_axis(), roll);
    HeadPose {
        rotation,
        ..HeadPose::identity()
    }
}

#[test]
fn a_take_is_a_heading_and_rows_of_63_columns() {
    let mut writer = LiveLinkWriter::new(Vec::new()).unwrap();
    let mut shapes = [-0.0; N_SHAPES];
    shapes[17] = 0.25;
    let head = turned(0.1, -0.2, 0.3);
    writer
        .write_row(&timecode(35, 0.273), &shapes, None)
        .unwrap();
    writer
        .write_row(&timecode(59, 0.999_99), &shapes, Some(&head))
        .unwrap();
    let text = String::from_utf8(writer.finish().unwrap()).unwrap();
    let lines: Vec<Vec<&str>> = text.lines().map(|it| it.split(',').collect()).collect();
    assert!(lines.iter().all(|it| it.len() == 63) && lines.len() == 3);
    let column = |name| lines[0].iter().position(|it| *it == name).unwrap();
    assert_eq!(&lines[1][..3], ["19:16:29:35.273", "61", "0.0000000000"]);
    assert_eq!(lines[2][0], "19:16:29:59.999");
    assert_eq!(lines[1][column("JawOpen")], "0.2500000000");
    assert_eq!(lines[1][column("HeadYaw")], "0.0000000000");
    for (name, expected) in [
        ("HeadYaw", "0.1000000000"),
        ("HeadPitch", "-0.2000000000"),
        ("HeadRoll", "0.3000000000"),
    ] {
        assert_eq!(lines[2][column(name)], expected);
    }
    assert!(column("JawRight") < column("JawLeft"));
    assert!(text.ends_with('\n') && !text.contains('\r'));
}

#[test]
fn the_head_turns_and_nods_as_its_angles_say() {
    let forward = Vector3::z();
    assert!((turned(0.2, 0.0, 0.0).rotation * forward).x > 0.0);
    assert!((turned(0.0, 0.2, 0.0).rotation * forward).y < 0.0);
    assert!((turned(0.0, 0.0, 0.2).rotation * Vector3::y()).x < 0.0);
}

#[test]
fn the_heading_is_that_of_the_apps_own_takes() {
    let test = "the_heading_is_that_of_the_apps_own_takes";
    let writer = LiveLinkWriter::new(Vec::new()).unwrap();
    let heading = writer.finish().unwrap();
    for path in [
        "curves/MySlate_164_iPhone_cal_900f.csv",
        "curves/MySlate_167_iPhone_cal_900f.csv",
    ] {
        let Some(take) = shared_data::read(path, test) else {
            continue;
        };
        let first = take.split_inclusive(|&it| it == b'\n').next().unwrap();
        assert_eq!(
            String::from_utf8_lossy(first).trim_end(),
            String::from_utf8_lossy(&heading).trim_end()
        );
    }
}
