//! curve on the wire.
