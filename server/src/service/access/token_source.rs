//! The token file on disk: read at start, and again when it changes (CONTRACTS O-15).

use std::{
    io::{self, Read as _},
    path::{Path, PathBuf},
    sync::{Arc, PoisonError, RwLock},
};

use frontalis_access::{TokenFile, TokenFileError};
use tokio::sync::watch;
use tokio_util::sync::CancellationToken;

use super::Access;
use crate::{
    reload::{Occasion, Reloads},
    service::audit::Entry,
};

/// More is not read; what is read is refused as too large.
const MAX_FILE_BYTES: u64 = 1024 * 1024 + 1;

/// A token file and what it said last.
pub(super) struct TokenSource {
    path: PathBuf,
    current: RwLock<Arc<Read>>,
    version: watch::Sender<u64>,
}

/// What one look at the file gave.
struct Read {
    text: String,
    file: Arc<TokenFile>,
}

/// Why a token file is not used.
#[derive(Debug, thiserror::Error)]
pub enum TokenSourceError {
    /// It cannot be read.
    #[error("the token file {} cannot be read", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        #[source]
        cause: io::Error,
    },
    /// It is refused.
    #[error("the token file {} is refused", path.display())]
    Refused {
        /// The file.
        path: PathBuf,
        /// Where and why.
        #[source]
        cause: TokenFileError,
    },
}

impl TokenSource {
    pub(super) fn read(path: &Path) -> Result<Self, TokenSourceError> {
        let text = read(path)?;
        let file = Arc::new(parse(path, &text)?);
        if file.is_empty() {
            tracing::warn!("the token file is empty: nobody can come in");
        }
        Ok(Self {
            path: path.to_owned(),
            current: RwLock::new(Arc::new(Read { text, file })),
            version: watch::Sender::new(0),
        })
    }

    pub(super) fn current(&self) -> Arc<TokenFile> {
        Arc::clone(&self.newest().file)
    }

    pub(super) fn changes(&self) -> watch::Receiver<u64> {
        self.version.subscribe()
    }

    /// Takes the file over if it is another than before; whether it was.
    fn look(&self) -> Result<bool, TokenSourceError> {
        let text = read(&self.path)?;
        if text == self.newest().text {
            return Ok(false);
        }
        let file = Arc::new(parse(&self.path, &text)?);
        let read = Arc::new(Read { text, file });
        *self.current.write().unwrap_or_else(PoisonError::into_inner) = read;
        self.version.send_modify(|it| *it = it.wrapping_add(1));
        Ok(true)
    }

    fn newest(&self) -> Arc<Read> {
        Arc::clone(&self.current.read().unwrap_or_else(PoisonError::into_inner))
    }
}

fn read(path: &Path) -> Result<String, TokenSourceError> {
    let mut text = String::new();
    let read = std::fs::File::open(path)
        .and_then(|file| file.take(MAX_FILE_BYTES).read_to_string(&mut text));
    match read {
        Ok(_) => Ok(text),
        Err(cause) => Err(TokenSourceError::Read {
            path: path.to_owned(),
            cause,
        }),
    }
}

fn parse(path: &Path, text: &str) -> Result<TokenFile, TokenSourceError> {
    TokenFile::parse(text).map_err(|cause| TokenSourceError::Refused {
        path: path.to_owned(),
        cause,
    })
}

/// Follows the token file until the server closes. A file that is refused changes nothing; it is said once, and again
/// when somebody asks.
pub async fn follow(access: Access, mut reloads: Reloads, end: CancellationToken) {
    if access.0.tokens.is_none() {
        return;
    }
    let mut said = None;
    loop {
        let occasion = tokio::select! {
            () = end.cancelled() => return,
            occasion = reloads.next() => occasion,
        };
        let looking = access.clone();
        let look = move || looking.0.tokens.as_ref().map(TokenSource::look);
        match tokio::task::spawn_blocking(look).await {
            Ok(None | Some(Ok(false))) => said = None,
            Ok(Some(Ok(true))) => {
                said = None;
                access.note_reload(Ok(()));
            }
            Ok(Some(Err(error))) => {
                let text = format!("{error}: {}", cause(&error));
                if occasion == Occasion::Asked || said.as_ref() != Some(&text) {
                    access.note_reload(Err(&text));
                    said = Some(text);
                }
            }
            Err(error) => tracing::error!(%error, "the token file could not be looked at"),
        }
    }
}

fn cause(error: &TokenSourceError) -> String {
    std::error::Error::source(error).map_or_else(String::new, ToString::to_string)
}

impl Access {
    fn note_reload(&self, outcome: Result<(), &str>) {
        self.0.metrics.tokens_reloaded(outcome.is_ok());
        let result = match outcome {
            Ok(()) => {
                tracing::info!("the token file was read again");
                "taken"
            }
            Err(error) => {
                tracing::error!(error, "the new token file is refused, the old one stays");
                "refused"
            }
        };
        self.0
            .audit
            .note(Entry::of_server("token_file_change", result));
    }
}
