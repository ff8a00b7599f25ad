//! `CaptureService`: frames in.
