//! One line a second, for logs and pipes.

use std::{io, time::Duration};

use frontalis_analysis::format::curve_csv::quality_name;
use frontalis_client::{
    csv::quality,
    curve_client::CurveEvent,
    proto::{CurveHeader, CurveSample},
};
use tokio::time::Instant;

use super::{say, tables};
use crate::measure::Rate;

/// Samples are summed up so often.
const LINE_EVERY: Duration = Duration::from_secs(1);
/// Muscles named in a line: those that contract the most.
const N_STRONGEST: usize = 3;

/// The state between two lines.
#[derive(Debug, Default)]
pub struct PlainLines {
    header: CurveHeader,
    rate: Rate,
    last_line: Option<Instant>,
    last_state: i32,
}

impl PlainLines {
    pub fn take(&mut self, event: &CurveEvent) -> io::Result<()> {
        match event {
            CurveEvent::Header(header) => self.header.clone_from(header),
            CurveEvent::Sample(sample) => {
                let now = Instant::now();
                self.rate.add(now);
                if self.last_line.is_none_or(|it| now - it >= LINE_EVERY) {
                    self.last_line = Some(now);
                    say(self.line(sample, now))?;
                }
            }
            CurveEvent::State(state) => {
                if self.last_state != state.session_state {
                    self.last_state = state.session_state;
                    say(format_args!(
                        "session {}",
                        tables::state(state.session_state())
                    ))?;
                }
            }
            CurveEvent::Lost {
                first_sequence,
                last_sequence,
            } => say(format_args!(
                "lost samples {first_sequence} to {last_sequence}"
            ))?,
            CurveEvent::NewRun { present, .. } => {
                say(format_args!("the session started over: run {present}"))?;
            }
            CurveEvent::Reconnecting { cause, .. } => {
                say(format_args!("reconnecting: {}", cause.message))?;
            }
            CurveEvent::End(end) => say(format_args!("the session ended {}", end.reason))?,
            CurveEvent::Gap(_) | CurveEvent::Skipped(_) => {}
        }
        Ok(())
    }

    fn line(&mut self, sample: &CurveSample, now: Instant) -> String {
        let mut parts = vec![
            format!("frame {}", sample.frame),
            format!("{:.1} samples/s", self.rate.per_second(now)),
            quality_name(quality(sample.quality())).to_owned(),
        ];
        parts.extend(sample.region_errors.iter().map(|it| {
            let error_mm = it.marker_error_cm * 10.0;
            format!("{} {error_mm:.2} mm", tables::region(it.region()))
        }));
        let mut strongest: Vec<_> = self
            .header
            .controls
            .iter()
            .zip(&sample.activations)
            .collect();
        strongest.sort_by(|left, right| right.1.total_cmp(left.1));
        let strongest = strongest.into_iter().take(N_STRONGEST);
        parts.extend(strongest.map(|(control, value)| format!("{} {value:.2}", control.name)));
        parts.join("  ")
    }
}
