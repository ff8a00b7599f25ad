//! The live picture of a session: one bar a muscle, and the figures above them.

use std::time::Duration;

use frontalis_analysis::format::curve_csv::quality_name;
use frontalis_client::{
    csv::quality,
    curve_client::CurveEvent,
    proto::{CurveHeader, CurveSample, FaceRegion, Quality, SessionState},
};
use ratatui::{
    Frame,
    layout::{Constraint, Layout, Rect},
    style::{Color, Modifier, Style},
    text::{Line, Span},
    widgets::Paragraph,
};
use tokio::time::Instant;

use super::tables;
use crate::{
    commands::short_id,
    measure::{Latencies, Rate},
};

/// Eighths of a cell.
const EIGHTHS: [&str; 8] = ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"];
/// From this width on, the muscles stand in two columns.
const TWO_COLUMNS_WIDTH: u16 = 100;
/// The longest muscle name that is shown in full.
const NAME_WIDTH: usize = 30;

/// Everything the picture shows.
#[derive(Debug)]
pub struct Picture {
    server: String,
    session: String,
    header: CurveHeader,
    sample: Option<CurveSample>,
    state: SessionState,
    skipped: u64,
    rate: Rate,
    latencies: Latencies,
    /// Server clock minus this clock, so that the fastest sample took no time; nanoseconds.
    clock_offset_nanos: Option<i64>,
    opened: Instant,
    notice: String,
}

impl Picture {
    pub fn new(server: &str, session: &str) -> Self {
        Self {
            server: server.to_owned(),
            session: short_id(session).to_owned(),
            header: CurveHeader::default(),
            sample: None,
            state: SessionState::Unspecified,
            skipped: 0,
            rate: Rate::default(),
            latencies: Latencies::default(),
            clock_offset_nanos: None,
            opened: Instant::now(),
            notice: String::new(),
        }
    }

    /// Takes one event in.
    pub fn take(&mut self, event: CurveEvent) {
        match event {
            CurveEvent::Header(header) => {
                self.clock_offset_nanos = None;
                self.notice.clear();
                self.observe_clock(header.server_time_nanos);
                self.header = header;
            }
            CurveEvent::Sample(sample) => {
                let delay = self.observe_clock(sample.solved_time_nanos);
                self.latencies.add(delay);
                self.rate.add(Instant::now());
                self.sample = Some(sample);
            }
            CurveEvent::Skipped(skipped) => self.skipped = skipped,
            CurveEvent::State(state) => self.state = state.session_state(),
            CurveEvent::Lost {
                first_sequence,
                last_sequence,
            } => self.notice = format!("lost samples {first_sequence} to {last_sequence}"),
            CurveEvent::NewRun { present, .. } => {
                self.notice = format!("the session started over: run {present}");
            }
            CurveEvent::Reconnecting { cause, .. } => {
                self.notice = format!("reconnecting: {}", cause.message);
            }
            CurveEvent::End(end) => {
                self.state = SessionState::Ended;
                self.notice = format!("the session ended {}", end.reason);
            }
            CurveEvent::Gap(_) => {}
        }
    }

    /// Delay of something that left the server at `server_nanos` of its clock, over the fastest so far: two machines'
    /// clocks cannot be compared more closely than that.
    fn observe_clock(&mut self, server_nanos: i64) -> Duration {
        let here = i64::try_from(self.opened.elapsed().as_nanos()).unwrap_or(i64::MAX);
        let offset = server_nanos.saturating_sub(here);
        let best = self.clock_offset_nanos.map_or(offset, |it| it.max(offset));
        self.clock_offset_nanos = Some(best);
        Duration::from_nanos(u64::try_from(best.saturating_sub(offset)).unwrap_or(0))
    }

    /// Draws the picture over the whole screen.
    pub fn draw(&mut self, frame: &mut Frame<'_>) {
        let [heading, body, footer] = Layout::vertical([
            Constraint::Length(5),
            Constraint::Min(1),
            Constraint::Length(1),
        ])
        .areas(frame.area());
        frame.render_widget(Paragraph::new(self.heading()), heading);
        self.draw_muscles(frame, body);
        let keys = Span::styled("q or Ctrl-C: quit", Style::new().fg(Color::DarkGray));
        frame.render_widget(Paragraph::new(keys), footer);
    }

    fn heading(&mut self) -> Vec<Line<'static>> {
        let bold = Style::new().add_modifier(Modifier::BOLD);
        let header = &self.header;
        let title = Line::from(vec![
            Span::styled(format!("Frontalis  {}", self.session), bold),
            Span::raw(format!(
                "  actor {} revision {}  {}",
                short_id(&header.actor),
                header.actor_revision,
                self.server
            )),
        ]);
        let rate = self.rate.per_second(Instant::now());
        let frame = self.sample.as_ref().map_or(0, |it| it.frame);
        let figures = format!(
            "{}  frame {frame}  {rate:.1} samples/s  skipped {}  delay p50 {} p99 {}",
            tables::state(self.state),
            self.skipped,
            millis(self.latencies.quantile_micros(0.5)),
            millis(self.latencies.quantile_micros(0.99)),
        );
        vec![
            title,
            Line::raw(figures),
            self.quality_line(),
            Line::styled(self.notice.clone(), Style::new().fg(Color::Yellow)),
            Line::raw(""),
        ]
    }

    fn quality_line(&self) -> Line<'static> {
        let Some(sample) = &self.sample else {
            return Line::raw("no sample yet");
        };
        let mut parts = vec![format!("{:8}", quality_name(quality(sample.quality())))];
        parts.extend(sample.region_errors.iter().map(|it| {
            format!(
                "{} marker error {:.2} mm ({} seen) {}",
                tables::region(it.region()),
                it.marker_error_cm * 10.0,
                it.n_markers,
                it.held_reason
            )
        }));
        let text = parts.join("  ");
        Line::styled(text, Style::new().fg(quality_color(sample.quality())))
    }

    fn draw_muscles(&self, frame: &mut Frame<'_>, area: Rect) {
        let n_columns: u16 = if area.width >= TWO_COLUMNS_WIDTH {
            2
        } else {
            1
        };
        let columns = Layout::horizontal(vec![Constraint::Fill(1); n_columns.into()]).split(area);
        let per_column = self.header.controls.len().div_ceil(n_columns.into());
        for (column, area) in columns.iter().enumerate() {
            let first = column * per_column;
            let last = (first + per_column).min(self.header.controls.len());
            let lines: Vec<_> = (first..last)
                .map(|it| self.muscle_line(it, area.width))
                .collect();
            frame.render_widget(Paragraph::new(lines), *area);
        }
    }

    fn muscle_line(&self, index: usize, width: u16) -> Line<'static> {
        let control = &self.header.controls[index];
        let sample = self.sample.as_ref();
        let value = sample
            .and_then(|it| it.activations.get(index))
            .copied()
            .unwrap_or(0.0);
        let is_unobserved = sample.is_some_and(|it| {
            it.unobserved
                .iter()
                .any(|unobserved| usize::try_from(*unobserved) == Ok(index))
        });
        let color = match control.region() {
            _ if is_unobserved => Color::DarkGray,
            FaceRegion::Upper => Color::Cyan,
            FaceRegion::Lower | FaceRegion::Unspecified => Color::Green,
        };
        let upper = if control.upper > 0.0 {
            control.upper
        } else {
            1.0
        };
        let bar_width = usize::from(width).saturating_sub(NAME_WIDTH + 8);
        Line::from(vec![
            Span::raw(format!("{:NAME_WIDTH$.NAME_WIDTH$} ", control.name)),
            Span::raw(format!("{value:5.2} ")),
            Span::styled(bar(value / upper, bar_width), Style::new().fg(color)),
        ])
    }
}

/// A bar of `width` cells, filled to `fraction`, exact to an eighth of a cell.
fn bar(fraction: f32, width: usize) -> String {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0..=1 times a terminal's width; NaN becomes 0"
    )]
    let eighths = (f64::from(fraction.clamp(0.0, 1.0)) * (width * 8) as f64).round() as usize;
    let full = "█".repeat(eighths / 8);
    let rest = EIGHTHS[eighths % 8];
    format!("{:<width$}", full + rest)
}

fn quality_color(quality: Quality) -> Color {
    match quality {
        Quality::Solved => Color::Green,
        Quality::Partial => Color::Yellow,
        Quality::Held | Quality::Unspecified => Color::Red,
    }
}

fn millis(micros: Option<f64>) -> String {
    micros.map_or_else(|| "-".to_owned(), |it| format!("{:.2} ms", it * 1e-3))
}

#[cfg(test)]
mod tests {
    use frontalis_client::proto::Control;
    use ratatui::{Terminal, backend::TestBackend};

    use super::*;

    fn screen(picture: &mut Picture, width: u16, height: u16) -> String {
        let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
        terminal.draw(|it| picture.draw(it)).unwrap();
        terminal.backend().to_string()
    }

    fn picture() -> Picture {
        let control = |name: &str| Control {
            name: name.to_owned(),
            upper: 1.0,
            ..Control::default()
        };
        let mut picture = Picture::new("http://127.0.0.1:7400", "sessions/take-1");
        picture.take(CurveEvent::Header(CurveHeader {
            actor: "actors/anna".to_owned(),
            actor_revision: 2,
            controls: vec![control("frontalis_left"), control("jaw_rotate")],
            ..CurveHeader::default()
        }));
        picture.take(CurveEvent::Sample(CurveSample {
            frame: 42,
            activations: vec![0.25, 1.0],
            quality: Quality::Solved.into(),
            ..CurveSample::default()
        }));
        picture
    }

    #[tokio::test]
    async fn shows_muscles_by_name_with_their_values_and_the_address() {
        for width in [80, 140] {
            let text = screen(&mut picture(), width, 12);
            for expected in [
                "take-1",
                "actor anna revision 2",
                "http://127.0.0.1:7400",
                "frame 42",
                "solved",
                "frontalis_left",
                "0.25",
                "jaw_rotate",
                "1.00",
            ] {
                assert!(text.contains(expected), "{expected} in\n{text}");
            }
        }
    }

    #[tokio::test]
    async fn fits_any_terminal() {
        for (width, height) in [(1, 1), (20, 3), (39, 6), (300, 100)] {
            screen(&mut picture(), width, height);
        }
    }

    #[test]
    fn a_bar_is_exact_to_an_eighth_of_a_cell() {
        assert_eq!(bar(0.5, 4), "██  ");
        assert_eq!(bar(1.0 / 32.0, 4), "▏   ");
        assert_eq!(bar(2.0, 2), "██");
        assert_eq!(bar(f32::NAN, 2), "  ");
    }
}
