//! The body of a download: piece after piece, for as long as they are taken.

use std::{io, time::Duration};

use axum::body::Body;
use bytes::Bytes;
use futures::{Stream, StreamExt as _, stream};
use http_body_util::StreamBody;
use hyper::body::Frame;
use tokio::sync::mpsc;
use tonic::Status;

/// A reader must take a piece within this time; else it is cut, and its export's place is free.
const PIECE_DEADLINE: Duration = Duration::from_secs(30);

/// Pieces of a body, and headers behind it.
pub(super) type Piece = Frame<Bytes>;

/// Hands out `pieces`. A failure cuts the body off, so that nobody takes it for whole.
pub(super) fn paced<S>(pieces: S) -> Body
where
    S: Stream<Item = Result<Piece, Status>> + Send + 'static,
{
    let (sender, taken) = mpsc::channel::<Result<Piece, io::Error>>(1);
    tokio::spawn(async move {
        let mut pieces = std::pin::pin!(pieces);
        while let Some(piece) = pieces.next().await {
            let piece = piece.map_err(|status| {
                tracing::warn!(%status, "a download is cut off");
                io::Error::other(status)
            });
            let is_last = piece.is_err();
            let sent = sender.send_timeout(piece, PIECE_DEADLINE).await;
            if sent.is_err() || is_last {
                return;
            }
        }
    });
    let pieces = stream::unfold(taken, |mut taken| async {
        let piece = taken.recv().await?;
        Some((piece, taken))
    });
    Body::new(StreamBody::new(pieces))
}
