//! What a take holds, in the order in which it took effect, and what became of each of its frames.
//!
//! A frame is given out once the file has told whether it was solved: by its sample, its gap, or one behind it. Samples and gaps
//! trail the frames by as many as waited in the session, so that little has to be kept.

use std::collections::VecDeque;

use frontalis_proto::v1::{AnalysisState, MarkerFrame, TakeEvent, TakeHeader, take_event::Event};
use prost::Message as _;

use super::super::{
    channel::Channel,
    figures::Numbered,
    read::{TakeReader, TakeRecord},
    rewrite::TakeFileError,
};
use crate::{
    hub::{Gap, GapCause},
    wire::curve::gap_cause,
};

/// Messages that wait for what became of the first of them; then it counts as solved.
const MAX_WAITING: usize = 1 << 14;

/// Gaps that wait for the frames around them.
const MAX_GAPS: usize = 1 << 16;

/// What came in.
#[derive(Debug)]
pub(super) enum Item {
    /// A frame.
    Frame(Box<RecordedFrame>),
    /// What changes how frames are solved, or says something of them.
    Event {
        /// Unix time at which it was recorded.
        time_nanos: u64,
        event: Box<Event>,
    },
}

/// A frame as it was recorded.
#[derive(Debug)]
pub(super) struct RecordedFrame {
    pub(super) time_nanos: u64,
    pub(super) frame: MarkerFrame,
    /// The message that holds it.
    pub(super) data: Vec<u8>,
}

/// One take, from its first message to its last.
pub(super) struct Incoming {
    reader: TakeReader,
    waiting: VecDeque<Item>,
    gaps: VecDeque<Gap>,
    /// Every frame up to here was solved, or has its gap.
    answered_through: u64,
    is_over: bool,
    pub(super) header: Option<TakeHeader>,
    pub(super) state: Option<AnalysisState>,
}

impl Incoming {
    /// Reads as far as it takes to know what the first frame is solved from.
    pub(super) fn start(reader: TakeReader) -> Result<Self, TakeFileError> {
        let mut incoming = Self {
            reader,
            waiting: VecDeque::new(),
            gaps: VecDeque::new(),
            answered_through: 0,
            is_over: false,
            header: None,
            state: None,
        };
        while incoming.state.is_none() && !incoming.is_over && incoming.waiting.len() < MAX_WAITING
        {
            incoming.read()?;
        }
        Ok(incoming)
    }

    /// What came in next; `None` at the end.
    pub(super) fn next(&mut self) -> Result<Option<Item>, TakeFileError> {
        while !self.is_first_known() {
            self.read()?;
        }
        Ok(self.waiting.pop_front())
    }

    fn is_first_known(&self) -> bool {
        let is_known = match self.waiting.front() {
            None => false,
            Some(Item::Event { .. }) => true,
            Some(Item::Frame(it)) => it.frame.number <= self.answered_through,
        };
        is_known || self.is_over || self.waiting.len() >= MAX_WAITING
    }

    /// The gaps among numbers below `number`, which none of the frames has that were not yet given out.
    pub(super) fn gaps_before(&mut self, number: u64) -> Vec<Gap> {
        let mut before = Vec::new();
        while let Some(gap) = self.gaps.front_mut().filter(|it| it.first < number) {
            let last = gap.last.min(number - 1);
            before.push(Gap { last, ..*gap });
            gap.first = last.saturating_add(1);
            if gap.first > gap.last || last == u64::MAX {
                self.gaps.pop_front();
            }
        }
        before
    }

    /// Whether the session could not keep up with this frame. Asked after [`Self::gaps_before`] it, once.
    pub(super) fn is_shed(&mut self, number: u64) -> bool {
        let of_frame = self.gaps_before(number.saturating_add(1));
        of_frame.iter().any(|it| it.cause == GapCause::Shed)
    }

    fn read(&mut self) -> Result<(), TakeFileError> {
        match self.reader.next_batch()? {
            Some(batch) => batch.into_iter().for_each(|it| self.add(it)),
            None => self.is_over = true,
        }
        Ok(())
    }

    /// A message that cannot be read is passed over: its checksum was right, so a later version wrote it.
    fn add(&mut self, record: TakeRecord) {
        let TakeRecord {
            channel,
            time_nanos,
            data,
            ..
        } = record;
        match channel {
            Channel::Markers => {
                if let Ok(frame) = MarkerFrame::decode(data.as_slice()) {
                    let recorded = RecordedFrame {
                        time_nanos,
                        frame,
                        data,
                    };
                    self.waiting.push_back(Item::Frame(Box::new(recorded)));
                }
            }
            Channel::Curves => {
                if let Ok(sample) = Numbered::decode(data.as_slice()) {
                    self.answered_through = self.answered_through.max(sample.number);
                }
            }
            Channel::Events => {
                let event = TakeEvent::decode(data.as_slice()).ok();
                if let Some(event) = event.and_then(|it| it.event) {
                    self.add_event(time_nanos, event);
                }
            }
        }
    }

    fn add_event(&mut self, time_nanos: u64, event: Event) {
        match event {
            Event::Header(header) => self.header = Some(header),
            Event::AnalysisState(state) => self.state = Some(state),
            Event::Gap(gap) => {
                self.answered_through = self.answered_through.max(gap.last);
                let is_gap = gap.first <= gap.last && self.gaps.len() < MAX_GAPS;
                if let Some(cause) = gap_cause(gap.cause).filter(|_| is_gap) {
                    let (first, last) = (gap.first, gap.last);
                    self.gaps.push_back(Gap { first, last, cause });
                }
            }
            // Made anew.
            Event::State(_) | Event::Alignment(_) => {}
            event => self.waiting.push_back(Item::Event {
                time_nanos,
                event: Box::new(event),
            }),
        }
    }
}
