//! Where the events of a subscription go: bars, CSV, JSON lines, or plain lines when nobody looks.

use std::io::{self, BufWriter, Stdout, Write as _};

use anyhow::bail;
use frontalis_analysis::format::curve_csv::{CurveColumns, CurveCsvWriter};
use frontalis_client::{csv::CsvRow, curve_client::CurveEvent};

use crate::{
    commands::Context,
    json,
    terminal::{self, bars::Picture, plain::PlainLines, screen::Screen},
};

/// One way to show curves.
pub enum Sink {
    /// Live bars over the whole terminal.
    Bars {
        screen: Screen,
        picture: Box<Picture>,
    },
    /// One line a second.
    Plain(PlainLines),
    /// A table; its heading follows the first header.
    Csv {
        writer: Option<CurveCsvWriter<BufWriter<Stdout>>>,
        controls: Vec<String>,
        columns: CurveColumns,
    },
    /// One JSON object an event.
    Json(BufWriter<Stdout>),
}

impl Sink {
    /// `csv` says what a table would hold, if one is wanted.
    pub fn choose(
        context: &Context,
        session: &str,
        csv: Option<CurveColumns>,
    ) -> anyhow::Result<Self> {
        Ok(if let Some(columns) = csv {
            Self::Csv {
                writer: None,
                controls: Vec::new(),
                columns,
            }
        } else if context.json {
            Self::Json(BufWriter::new(io::stdout()))
        } else if terminal::is_interactive() {
            Self::Bars {
                screen: Screen::open()?,
                picture: Box::new(Picture::new(&context.server()?, session)),
            }
        } else {
            Self::Plain(PlainLines::default())
        })
    }

    /// Shows one event.
    pub fn take(&mut self, event: CurveEvent) -> anyhow::Result<()> {
        match self {
            Self::Bars { screen, picture } => {
                picture.take(event);
                screen.draw(|it| picture.draw(it))?;
            }
            Self::Plain(lines) => lines.take(&event)?,
            Self::Csv {
                writer,
                controls,
                columns,
            } => return take_csv(writer, controls, *columns, &event),
            Self::Json(out) => writeln!(out, "{}", json::event(event)?)?,
        }
        Ok(())
    }

    /// Called about thirty times a second; true when the person wants to stop.
    pub fn tick(&mut self) -> anyhow::Result<bool> {
        match self {
            Self::Bars { screen, picture } => {
                screen.draw(|it| picture.draw(it))?;
                return Ok(Screen::wants_to_quit()?);
            }
            Self::Plain(_) | Self::Csv { writer: None, .. } => {}
            Self::Csv {
                writer: Some(writer),
                ..
            } => writer.flush()?,
            Self::Json(out) => out.flush()?,
        }
        Ok(false)
    }

    /// Hands the last lines on and gives the terminal back.
    pub fn finish(&mut self) -> anyhow::Result<()> {
        self.tick()?;
        Ok(())
    }
}

fn take_csv(
    writer: &mut Option<CurveCsvWriter<BufWriter<Stdout>>>,
    controls: &mut Vec<String>,
    columns: CurveColumns,
    event: &CurveEvent,
) -> anyhow::Result<()> {
    match (event, writer) {
        (CurveEvent::Header(header), writer) => {
            let names: Vec<_> = header.controls.iter().map(|it| it.name.clone()).collect();
            if writer.is_none() {
                let out = BufWriter::new(io::stdout());
                let headings = names.iter().map(String::as_str);
                *writer = Some(CurveCsvWriter::new(out, headings, columns)?);
                *controls = names;
            } else if *controls != names {
                bail!("the session's controls changed; one table cannot hold both");
            }
        }
        (CurveEvent::Sample(sample), Some(writer)) => {
            writer.write_row(&CsvRow::from(sample).as_row())?;
        }
        _ => {}
    }
    Ok(())
}
