//! Takes on their way out: as streams of pieces, or the stored file itself.
//!
//! Every piece is made when it is asked for, on threads of their own: a reader that stalls holds a place, and nothing else
//! up.

mod places;

use frontalis_proto::v1::{self, TakeFormat};
use futures::{Stream, StreamExt as _, stream};
use tonic::{Code, Status};

use super::{grpc::status::refuse, peer::Peer, takes::Takes};
use crate::{
    catalogue::{CatalogueError, Store, TakeRow, TakeState},
    executor::{Threads, Workers},
    take::{Export, ExportError, ExportSource, Step, StoredFile, open_stored},
};

use places::{Place, Places};

/// Threads that make exports.
const EXPORTERS: usize = 2;

/// Hands takes out. Cheap to clone.
#[derive(Clone)]
pub struct TakeExports {
    takes: Takes,
    store: Store,
    workers: Workers,
    places: Places,
}

/// A take's stored file, for a door that hands out parts of it.
pub struct OpenTakeFile {
    /// The take.
    pub row: TakeRow,
    /// Its file.
    pub stored: StoredFile,
    workers: Workers,
    _place: Place,
}

impl TakeExports {
    /// At most `each` exports at once of one caller (CONTRACTS S-10).
    pub fn new(threads: Threads, takes: Takes, store: Store, each: usize) -> Self {
        Self {
            takes,
            store,
            workers: threads.workers(EXPORTERS),
            places: Places::new(each),
        }
    }

    /// Exports a take: the first response says what comes, the last what came.
    ///
    /// # Errors
    ///
    /// `TAKE_RECOVERING`, `TAKE_FORMAT`, `EXPORTS`, `EXPORT_FORMAT`, `TAKE_UNREADABLE`, `ACTOR`, or that the storage failed.
    pub async fn export(
        &self,
        peer: &Peer,
        row: &TakeRow,
        format: TakeFormat,
    ) -> Result<impl Stream<Item = Result<v1::ExportTakeResponse, Status>> + Send + 'static, Status>
    {
        self.takes.check_readable(row).await?;
        let place = self.places.take(peer)?;
        let source = self.source(row, format).await?;
        let started = self.workers.run(move || Export::start(source, format));
        let export = started.await.map_err(|error| status(&error))?;
        let mut export = Running {
            export: Some(export),
            workers: self.workers.clone(),
            _place: place,
        };
        let first = export.next().await?;
        let rest = stream::try_unfold(export, |mut export| async {
            let next = export.next().await?;
            Ok(next.map(|it| (it, export)))
        });
        let first = stream::iter(first.map(Ok));
        Ok(first.chain(rest))
    }

    async fn source(&self, row: &TakeRow, format: TakeFormat) -> Result<ExportSource, Status> {
        let actor = if format == TakeFormat::Glb {
            let loaded = self.store.load_actor(&row.actor, row.actor_revision);
            Some(loaded.await?)
        } else {
            None
        };
        Ok(ExportSource {
            actor,
            ..self.takes.source(row)
        })
    }

    /// The stored file of a take.
    ///
    /// # Errors
    ///
    /// `TAKE_RECOVERING`, `TAKE_FORMAT`, `EXPORTS`, or that the storage failed.
    pub async fn open(&self, peer: &Peer, row: TakeRow) -> Result<OpenTakeFile, Status> {
        self.takes.check_readable(&row).await?;
        let place = self.places.take(peer)?;
        let source = self.takes.source(&row);
        let open = move || open_stored(&*source.fs, &source.file, source.n_bytes);
        let stored = self.workers.run(open).await;
        Ok(OpenTakeFile {
            row,
            stored: stored.map_err(CatalogueError::Storage)?,
            workers: self.workers.clone(),
            _place: place,
        })
    }
}

impl OpenTakeFile {
    /// Whether its bytes stay what they are.
    pub fn is_final(&self) -> bool {
        self.row.state != TakeState::Recording && !self.stored.is_growing
    }

    /// At most so many bytes from `offset` on, which lie in the file; fewer only where a call to the system reads fewer.
    ///
    /// # Errors
    ///
    /// That the storage failed.
    pub async fn read(mut self, offset: u64, n_bytes: usize) -> Result<(Self, Vec<u8>), Status> {
        let workers = self.workers.clone();
        let read = workers.run(move || {
            let mut bytes = vec![0; n_bytes];
            let n_read = self.stored.file.read_at(offset, &mut bytes)?;
            bytes.truncate(n_read);
            Ok((self, bytes))
        });
        Ok(read.await.map_err(CatalogueError::Storage)?)
    }
}

/// An export, and the place that it takes.
struct Running {
    /// `None` after a failure.
    export: Option<Export>,
    workers: Workers,
    _place: Place,
}

impl Running {
    async fn next(&mut self) -> Result<Option<v1::ExportTakeResponse>, Status> {
        while let Some(mut export) = self.export.take() {
            let stepped = self.workers.run(move || {
                let step = export.step();
                (export, step)
            });
            let (export, step) = stepped.await;
            match step.map_err(|error| status(&error))? {
                Step::Over => return Ok(None),
                Step::Piece(piece) => {
                    self.export = Some(export);
                    return Ok(Some(*piece));
                }
                Step::Working => self.export = Some(export),
            }
        }
        Ok(None)
    }
}

fn status(error: &ExportError) -> Status {
    let source = error as &dyn std::error::Error;
    match error {
        ExportError::Io(_) => {
            tracing::error!(error = source, "an export failed");
            refuse(Code::Internal, "STORAGE", error.to_string())
        }
        error if error.is_of_the_format() => {
            refuse(Code::FailedPrecondition, "EXPORT_FORMAT", error.to_string())
        }
        _ => {
            tracing::error!(error = source, "a take cannot be read");
            refuse(Code::DataLoss, "TAKE_UNREADABLE", error.to_string())
        }
    }
}
