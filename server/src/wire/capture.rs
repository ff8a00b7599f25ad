//! capture on the wire.
