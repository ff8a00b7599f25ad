//! common on the wire.
