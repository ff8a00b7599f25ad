//! How many connections may be open, in all and of one peer ([`network_of`]).

use std::{
    collections::BTreeMap,
    net::IpAddr,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use crate::{
    config::Limits,
    service::peer::network_of,
    telemetry::{ConnectionLimit, Metrics},
};

/// Counts open connections; cheap to clone.
#[derive(Clone)]
pub(super) struct Admission {
    limit: u64,
    limit_per_peer: u64,
    open: Arc<Mutex<Open>>,
    metrics: Metrics,
}

#[derive(Default)]
struct Open {
    all: u64,
    by_peer: BTreeMap<IpAddr, u64>,
}

/// One open connection; dropped, it is counted no more.
pub(super) struct Permit {
    admission: Admission,
    peer: IpAddr,
}

impl Admission {
    pub(super) fn new(limits: &Limits, metrics: Metrics) -> Self {
        Self {
            limit: limits.connections,
            limit_per_peer: limits.connections_per_peer,
            open: Arc::default(),
            metrics,
        }
    }

    /// Counts a connection of `peer`, or refuses it.
    pub(super) fn admit(&self, peer: IpAddr) -> Option<Permit> {
        let peer = network_of(peer);
        let mut open = self.open();
        if open.all >= self.limit {
            self.metrics
                .connection_refused(ConnectionLimit::Connections);
            return None;
        }
        let of_peer = open.by_peer.entry(peer).or_default();
        if *of_peer >= self.limit_per_peer {
            self.metrics
                .connection_refused(ConnectionLimit::ConnectionsPerPeer);
            return None;
        }
        *of_peer += 1;
        open.all += 1;
        self.metrics.connection_opened();
        Some(Permit {
            admission: self.clone(),
            peer,
        })
    }

    fn open(&self) -> MutexGuard<'_, Open> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Permit {
    fn drop(&mut self) {
        let mut open = self.admission.open();
        open.all -= 1;
        if let Some(of_peer) = open.by_peer.get_mut(&self.peer) {
            *of_peer -= 1;
            if *of_peer == 0 {
                open.by_peer.remove(&self.peer);
            }
        }
        self.admission.metrics.connection_closed();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn admission(limit: u64, limit_per_peer: u64) -> Admission {
        let limits = Limits {
            connections: limit,
            connections_per_peer: limit_per_peer,
            ..Limits::default()
        };
        Admission::new(&limits, Metrics::new("test"))
    }

    #[test]
    fn a_closed_connection_makes_room_for_another() {
        let admission = admission(2, 2);
        let peer = IpAddr::from([127, 0, 0, 1]);
        let first = admission.admit(peer).unwrap();
        let _second = admission.admit(peer).unwrap();
        assert!(admission.admit(peer).is_none());
        drop(first);
        assert!(admission.admit(peer).is_some());
    }

    #[test]
    fn one_peer_cannot_take_every_place() {
        let admission = admission(8, 1);
        let (one, other) = (IpAddr::from([10, 0, 0, 1]), IpAddr::from([10, 0, 0, 2]));
        let held = admission.admit(one).unwrap();
        assert!(admission.admit(one).is_none());
        assert!(admission.admit(other).is_some());
        drop(held);
        assert!(admission.open().by_peer.is_empty());
    }

    #[test]
    fn the_addresses_of_one_ipv6_customer_are_one_peer() {
        let admission = admission(8, 1);
        let address = |it: &str| it.parse::<IpAddr>().unwrap();
        let held = admission.admit(address("2001:db8::1")).unwrap();
        assert!(admission.admit(address("2001:db8::2:0:0:1")).is_none());
        assert!(admission.admit(address("2001:db8:0:1::1")).is_some());
        drop(held);
        assert!(admission.open().by_peer.is_empty());
    }
}
