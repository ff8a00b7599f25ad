//! How the demo shows its curves.

use frontalis_client::curve_client::CurveEvent;

use crate::{
    commands::Context,
    terminal::{self, bars::Picture, plain::PlainLines, say, screen::Screen},
};

/// Bars for a person, lines for a log.
pub enum View {
    Bars {
        screen: Screen,
        picture: Box<Picture>,
    },
    Lines(PlainLines),
    Nothing,
}

impl View {
    pub fn choose(context: &Context, url: &str, session: &str) -> anyhow::Result<Self> {
        if context.json {
            return Ok(Self::Nothing);
        }
        if terminal::is_interactive() {
            return Ok(Self::Bars {
                screen: Screen::open()?,
                picture: Box::new(Picture::new(url, session)),
            });
        }
        say(format_args!("server at {url}, session {session}"))?;
        Ok(Self::Lines(PlainLines::default()))
    }

    /// Shows one event.
    pub fn take(&mut self, event: CurveEvent) -> anyhow::Result<()> {
        match self {
            Self::Bars { picture, .. } => picture.take(event),
            Self::Lines(lines) => lines.take(&event)?,
            Self::Nothing => {}
        }
        Ok(())
    }

    /// Called about thirty times a second; true when the person wants to stop.
    pub fn tick(&mut self) -> anyhow::Result<bool> {
        if let Self::Bars { screen, picture } = self {
            screen.draw(|it| picture.draw(it))?;
            return Ok(Screen::wants_to_quit()?);
        }
        Ok(false)
    }
}
