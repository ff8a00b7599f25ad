//! Curves as the CSV of the Live Link Face app: a timecode, the number 61, 52 ARKit shapes and nine rotations in radians.
//!
//! The columns are those of the app's own takes, where `JawRight` stands before `JawLeft` and `MouthRight` before
//! `MouthLeft`; what reads them goes by name.

mod mapping;

pub use mapping::ShapeMapping;

use std::io::{self, Write};

use crate::{space::HeadPose, timecode::Timecode};

/// Shapes of ARKit.
pub const N_SHAPES: usize = 52;
/// Shapes, and yaw, pitch and roll of the head and of both eyes.
const N_VALUES: usize = 61;

/// The shapes in the columns' order.
pub const SHAPES: [&str; N_SHAPES] = [
    "EyeBlinkLeft",
    "EyeLookDownLeft",
    "EyeLookInLeft",
    "EyeLookOutLeft",
    "EyeLookUpLeft",
    "EyeSquintLeft",
    "EyeWideLeft",
    "EyeBlinkRight",
    "EyeLookDownRight",
    "EyeLookInRight",
    "EyeLookOutRight",
    "EyeLookUpRight",
    "EyeSquintRight",
    "EyeWideRight",
    "JawForward",
    "JawRight",
    "JawLeft",
    "JawOpen",
    "MouthClose",
    "MouthFunnel",
    "MouthPucker",
    "MouthRight",
    "MouthLeft",
    "MouthSmileLeft",
    "MouthSmileRight",
    "MouthFrownLeft",
    "MouthFrownRight",
    "MouthDimpleLeft",
    "MouthDimpleRight",
    "MouthStretchLeft",
    "MouthStretchRight",
    "MouthRollLower",
    "MouthRollUpper",
    "MouthShrugLower",
    "MouthShrugUpper",
    "MouthPressLeft",
    "MouthPressRight",
    "MouthLowerDownLeft",
    "MouthLowerDownRight",
    "MouthUpperUpLeft",
    "MouthUpperUpRight",
    "BrowDownLeft",
    "BrowDownRight",
    "BrowInnerUp",
    "BrowOuterUpLeft",
    "BrowOuterUpRight",
    "CheekPuff",
    "CheekSquintLeft",
    "CheekSquintRight",
    "NoseSneerLeft",
    "NoseSneerRight",
    "TongueOut",
];

const ROTATIONS: &str = "HeadYaw,HeadPitch,HeadRoll,LeftEyeYaw,LeftEyePitch,LeftEyeRoll,RightEyeYaw,RightEyePitch,RightEyeRoll";

/// Writes a take row by row.
#[derive(Debug)]
pub struct LiveLinkWriter<W> {
    out: W,
}

impl<W: Write> LiveLinkWriter<W> {
    /// Writes the heading.
    ///
    /// # Errors
    ///
    /// When `out` cannot be written.
    pub fn new(mut out: W) -> io::Result<Self> {
        let shapes = SHAPES.join(",");
        writeln!(out, "Timecode,BlendshapeCount,{shapes},{ROTATIONS}")?;
        Ok(Self { out })
    }

    /// Writes one row: shapes as [`ShapeMapping::shapes`] gives them, the head's turn since the neutral pose as zeros where
    /// it is not known, and eyes that look straight ahead, which markers do not see.
    ///
    /// # Errors
    ///
    /// When the output cannot be written.
    pub fn write_row(
        &mut self,
        timecode: &Timecode,
        shapes: &[f64; N_SHAPES],
        head: Option<&HeadPose>,
    ) -> io::Result<()> {
        const STRAIGHT_AHEAD: [f64; 6] = [0.0; 6];
        write_timecode(&mut self.out, timecode)?;
        write!(self.out, ",{N_VALUES}")?;
        let head = head.map_or([0.0; 3], yaw_pitch_roll);
        for value in shapes.iter().chain(&head).chain(&STRAIGHT_AHEAD) {
            // Adding 0 takes the sign from a zero.
            write!(self.out, ",{:.10}", value + 0.0)?;
        }
        self.out.write_all(b"\n")
    }

    /// Hands the sink back, flushed.
    ///
    /// # Errors
    ///
    /// When the output cannot be written.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.flush()?;
        Ok(self.out)
    }
}

/// `HH:MM:SS:FF.fff`, with colons where labels are dropped too, as the app writes it.
fn write_timecode(out: &mut impl Write, timecode: &Timecode) -> io::Result<()> {
    let label = timecode.label();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "0 to 999: cut, because rounding up would be another frame"
    )]
    let thousandths = (f64::from(timecode.sub_frame()) * 1_000.0) as u32;
    write!(
        out,
        "{:02}:{:02}:{:02}:{:02}.{thousandths:03}",
        label.hours, label.minutes, label.seconds, label.frames
    )
}

/// Radians of R = `R_y(yaw)` `R_x(pitch)` `R_z(roll)` in model space.
///
/// Positive yaw turns to the subject's left, positive pitch nods, positive roll leans to the subject's right.
fn yaw_pitch_roll(head: &HeadPose) -> [f64; 3] {
    let rotation = head.rotation.to_rotation_matrix();
    let at = |row, column| rotation[(row, column)];
    let pitch = (-at(1, 2)).clamp(-1.0, 1.0).asin();
    let yaw = f64::atan2(at(0, 2), at(2, 2));
    let roll = f64::atan2(at(1, 0), at(1, 1));
    [yaw, pitch, roll]
}

#[cfg(test)]
mod tests;
