//! The vocabulary of `common.proto`: units, regions, states, time of day, head pose.

use frontalis_analysis::{
    face::region::FaceRegion,
    space::{HeadPose, LengthUnit},
    timecode::{Counting, Label, Timecode, TimecodeRate},
};
use frontalis_proto::v1;

use super::{
    actor::finite,
    invalid::{FieldError, FieldProblem},
};
use crate::hub::SessionState;

/// The unit that a publisher must declare: a wrong guess is off by a factor of ten.
///
/// # Errors
///
/// `UNIT` when it is not given, `ENUM` when it is not known.
pub fn length_unit(field: &'static str, number: i32) -> Result<LengthUnit, FieldError> {
    match v1::LengthUnit::try_from(number) {
        Ok(v1::LengthUnit::Millimeter) => Ok(LengthUnit::Millimeter),
        Ok(v1::LengthUnit::Centimeter) => Ok(LengthUnit::Centimeter),
        Ok(v1::LengthUnit::Meter) => Ok(LengthUnit::Meter),
        Ok(v1::LengthUnit::Unspecified) => Err(FieldError::unusable(
            field,
            "UNIT",
            "the unit must be given",
        )),
        Err(_unknown) => Err(FieldError::new(field, FieldProblem::UnknownEnum(number))),
    }
}

/// The unit's number on the wire.
pub fn length_unit_to_wire(unit: LengthUnit) -> v1::LengthUnit {
    match unit {
        LengthUnit::Millimeter => v1::LengthUnit::Millimeter,
        LengthUnit::Centimeter => v1::LengthUnit::Centimeter,
        LengthUnit::Meter => v1::LengthUnit::Meter,
    }
}

/// The region's number on the wire.
pub fn face_region(region: FaceRegion) -> v1::FaceRegion {
    match region {
        FaceRegion::Upper => v1::FaceRegion::Upper,
        FaceRegion::Lower => v1::FaceRegion::Lower,
    }
}

/// The state's number on the wire.
pub fn session_state(state: SessionState) -> v1::SessionState {
    match state {
        SessionState::Waiting => v1::SessionState::Waiting,
        SessionState::Aligning => v1::SessionState::Aligning,
        SessionState::Live => v1::SessionState::Live,
        SessionState::Stale => v1::SessionState::Stale,
        SessionState::Ended => v1::SessionState::Ended,
        SessionState::Failed => v1::SessionState::Failed,
    }
}

/// A time of day that can occur; `None` when it cannot (CONTRACTS D-34).
pub fn timecode(sent: &v1::Timecode) -> Option<Timecode> {
    let counting = if sent.drop_frame {
        Counting::Drop
    } else {
        Counting::NonDrop
    };
    let rate = TimecodeRate::new(sent.rate_numerator, sent.rate_denominator, counting).ok()?;
    let label = Label {
        hours: sent.hours,
        minutes: sent.minutes,
        seconds: sent.seconds,
        frames: sent.frames,
    };
    let timecode = Timecode::new(label, rate).ok()?;
    let timecode = timecode.with_sub_frame(sent.sub_frame).ok()?;
    Some(timecode.with_user_bits(sent.user_bits))
}

/// The time of day on the wire.
pub fn timecode_to_wire(timecode: &Timecode) -> v1::Timecode {
    let (label, rate) = (timecode.label(), timecode.rate());
    v1::Timecode {
        hours: label.hours,
        minutes: label.minutes,
        seconds: label.seconds,
        frames: label.frames,
        rate_numerator: rate.numerator(),
        rate_denominator: rate.denominator(),
        drop_frame: rate.counting() == Counting::Drop,
        sub_frame: timecode.sub_frame(),
        user_bits: timecode.user_bits(),
    }
}

/// The head's motion on the wire.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the wire has f32; values are a unit quaternion and centimeters"
)]
pub fn head_pose(pose: &HeadPose) -> v1::HeadPose {
    let rotation = pose.rotation.quaternion();
    v1::HeadPose {
        qx: rotation.i as f32,
        qy: rotation.j as f32,
        qz: rotation.k as f32,
        qw: rotation.w as f32,
        tx_cm: pose.translation_cm.x as f32,
        ty_cm: pose.translation_cm.y as f32,
        tz_cm: pose.translation_cm.z as f32,
    }
}

/// A figure as the wire's `float`: finite, whatever it was (CONTRACTS N-0).
#[expect(
    clippy::cast_possible_truncation,
    reason = "the wire has f32; the clamp keeps what is finite so"
)]
pub fn narrow(figure: f64) -> f32 {
    (finite(figure) as f32).clamp(f32::MIN, f32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_must_be_given_and_known() {
        assert_eq!(length_unit("unit", 1), Ok(LengthUnit::Millimeter));
        assert_eq!(length_unit("unit", 0).unwrap_err().reason(), "UNIT");
        assert_eq!(length_unit("unit", 77).unwrap_err().reason(), "ENUM");
    }

    #[test]
    fn a_valid_time_of_day_returns_unchanged() {
        let sent = v1::Timecode {
            hours: 23,
            minutes: 59,
            seconds: 59,
            frames: 29,
            rate_numerator: 30_000,
            rate_denominator: 1_001,
            drop_frame: true,
            sub_frame: 0.25,
            user_bits: 7,
        };
        assert_eq!(timecode_to_wire(&timecode(&sent).unwrap()), sent);
        assert!(timecode(&v1::Timecode::default()).is_none());
    }

    fn at(hours: u32, minutes: u32, seconds: u32, frames: u32) -> v1::Timecode {
        v1::Timecode {
            hours,
            minutes,
            seconds,
            frames,
            rate_numerator: 30_000,
            rate_denominator: 1_001,
            drop_frame: true,
            ..v1::Timecode::default()
        }
    }

    #[test]
    fn a25_the_last_frame_of_a_day_occurs_and_the_next_does_not() {
        assert!(timecode(&at(23, 59, 59, 29)).is_some());
        assert!(timecode(&at(25, 0, 0, 0)).is_none());
        assert!(timecode(&at(23, 59, 59, 30)).is_none());
    }

    #[test]
    fn a25_dropped_numbers_do_not_occur() {
        assert!(timecode(&at(1, 1, 0, 0)).is_none());
        assert!(timecode(&at(1, 1, 0, 1)).is_none());
        assert!(timecode(&at(1, 1, 0, 2)).is_some());
        assert!(timecode(&at(1, 10, 0, 0)).is_some());
        let at_60 = |frames| v1::Timecode {
            rate_numerator: 60_000,
            ..at(1, 1, 0, frames)
        };
        assert!(timecode(&at_60(3)).is_none());
        assert!(timecode(&at_60(4)).is_some());
    }

    #[test]
    fn a25_frames_are_dropped_at_two_rates_only_and_fractions_are_fractions() {
        let pal = v1::Timecode {
            rate_numerator: 25,
            rate_denominator: 1,
            ..at(0, 0, 0, 3)
        };
        assert!(timecode(&pal).is_none());
        let counted = |sub_frame| v1::Timecode {
            drop_frame: false,
            sub_frame,
            ..pal
        };
        assert!(timecode(&counted(0.5)).is_some());
        for sub_frame in [f32::NAN, -0.1, 1.0, f32::INFINITY] {
            assert!(timecode(&counted(sub_frame)).is_none());
        }
    }
}
