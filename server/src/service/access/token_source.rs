//! The token file on disk: read at start, and again when it changes (CONTRACTS O-15).

use std::{
    io::{self, Read as _},
    path::{Path, PathBuf},
    sync::{Arc, PoisonError, RwLock},
};

use frontalis_access::{TokenFile, TokenFileChange, TokenFileError};
use tokio::sync::watch;
use tokio_util::sync::CancellationToken;

use super::Access;
use crate::{
    reload::{Occasion, Reloads},
    service::audit::{Entry, MAX_FIELD},
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

    /// Takes the file over if it is another than before; what it says otherwise.
    fn look(&self) -> Result<Option<TokenFileChange>, TokenSourceError> {
        let text = read(&self.path)?;
        let before = self.newest();
        if text == before.text {
            return Ok(None);
        }
        let file = Arc::new(parse(&self.path, &text)?);
        let change = file.change_since(&before.file);
        let read = Arc::new(Read { text, file });
        *self.current.write().unwrap_or_else(PoisonError::into_inner) = read;
        self.version.send_modify(|it| *it = it.wrapping_add(1));
        Ok(Some(change))
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
            Ok(None | Some(Ok(None))) => said = None,
            Ok(Some(Ok(Some(change)))) => {
                said = None;
                access.note_change(&change);
            }
            Ok(Some(Err(error))) => {
                let text = format!("{error}: {}", cause(&error));
                if occasion == Occasion::Asked || said.as_ref() != Some(&text) {
                    access.note_refusal(&text);
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

/// Event of the audit log.
const CHANGE: &str = "token_file_change";

impl Access {
    fn note_change(&self, change: &TokenFileChange) {
        self.0.metrics.tokens_reloaded(true);
        tracing::info!("the token file was read again");
        for object in objects(change) {
            let entry = Entry::of_server(CHANGE, &object, "taken");
            self.0.audit.note(entry);
        }
    }

    fn note_refusal(&self, error: &str) {
        self.0.metrics.tokens_reloaded(false);
        tracing::error!(error, "the new token file is refused, the old one stays");
        let entry = Entry::of_server(CHANGE, "", "refused");
        self.0.audit.note(entry);
    }
}

/// A change for the audit log, in as many texts as it takes for every id to be kept; at least one.
fn objects(change: &TokenFileChange) -> Vec<String> {
    let kinds = [
        ("added", &change.added),
        ("removed", &change.removed),
        ("revoked", &change.revoked),
        ("changed", &change.changed),
    ];
    let tokens = kinds.into_iter().flat_map(|(kind, ids)| listed(kind, ids));
    let others = [
        (change.issuers, "changed issuers"),
        (change.certificates, "changed rules for certificates"),
    ];
    let others = others.into_iter().filter(|it| it.0);
    let mut objects: Vec<String> = tokens.chain(others.map(|it| it.1.to_owned())).collect();
    if objects.is_empty() {
        objects.push("changed comments".to_owned());
    }
    objects
}

/// `kind` and ids, with spaces between them.
fn listed(kind: &str, ids: &[String]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for id in ids {
        match lines.last_mut() {
            Some(line) if line.len() + 1 + id.len() <= MAX_FIELD => {
                line.push(' ');
                line.push_str(id);
            }
            _ => lines.push(format!("{kind} {id}")),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ids(numbers: std::ops::Range<u32>) -> Vec<String> {
        numbers.map(|it| format!("t-{it:08x}")).collect()
    }

    #[test]
    fn every_id_of_a_change_is_in_a_text_that_is_kept_whole() {
        let change = TokenFileChange {
            added: ids(0..100),
            revoked: ids(100..102),
            certificates: true,
            ..TokenFileChange::default()
        };
        let objects = objects(&change);
        let (others, added) = objects
            .split_last_chunk::<2>()
            .map(|it| (it.1, it.0))
            .unwrap();
        assert_eq!(
            others,
            &[
                "revoked t-00000064 t-00000065",
                "changed rules for certificates"
            ]
        );
        assert!(added.len() > 1 && added.iter().all(|it| it.len() <= MAX_FIELD));
        let named: Vec<&str> = added
            .iter()
            .flat_map(|it| it.strip_prefix("added ").unwrap().split(' '))
            .collect();
        assert_eq!(named, change.added);
    }

    #[test]
    fn a_change_of_nothing_that_counts_is_a_text_too() {
        let objects = objects(&TokenFileChange::default());
        assert_eq!(objects, ["changed comments"]);
    }
}
