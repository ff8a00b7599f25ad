//! How many exports of takes may be on their way: of one caller, and of all (CONTRACTS S-10, O-2).

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use tonic::Status;

use crate::{
    config::TAKE_EXPORTS,
    service::{
        grpc::refusal::limit,
        peer::{Peer, network_of},
    },
};

/// Places of exports; clones share them.
#[derive(Clone, Debug)]
pub(super) struct Places {
    each: usize,
    held: Arc<Mutex<BTreeMap<String, usize>>>,
}

/// One place; free when it is dropped.
#[derive(Debug)]
pub(super) struct Place {
    places: Places,
    holder: String,
}

impl Places {
    pub(super) fn new(each: usize) -> Self {
        Self {
            each,
            held: Arc::default(),
        }
    }

    /// A place for one more export.
    ///
    /// # Errors
    ///
    /// `EXPORTS` when the caller, or all callers together, have as many as they may.
    pub(super) fn take(&self, peer: &Peer) -> Result<Place, Status> {
        let holder = holder(peer);
        let mut held = self.held();
        if held.values().sum::<usize>() >= TAKE_EXPORTS {
            return Err(limit("EXPORTS", "exports of takes at once", TAKE_EXPORTS));
        }
        let of_holder = held.entry(holder.clone()).or_default();
        if *of_holder >= self.each {
            return Err(limit("EXPORTS", "limits.exports", self.each));
        }
        *of_holder += 1;
        Ok(Place {
            places: self.clone(),
            holder,
        })
    }

    fn held(&self) -> MutexGuard<'_, BTreeMap<String, usize>> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A principal, or where nobody is asked who they are, an address.
fn holder(peer: &Peer) -> String {
    match (peer.caller.principal(), peer.address) {
        (None, Some(address)) => network_of(address.ip()).to_string(),
        _ => peer.caller.key().to_owned(),
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let mut held = self.places.held();
        if let Some(of_holder) = held.get_mut(&self.holder) {
            *of_holder -= 1;
            if *of_holder == 0 {
                held.remove(&self.holder);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn from(address: &str) -> Peer {
        Peer {
            address: Some(address.parse().unwrap()),
            ..Peer::default()
        }
    }

    #[test]
    fn each_has_so_many_and_all_have_so_many() {
        let places = Places::new(2);
        let one = from("10.0.0.1:7");
        let held = (places.take(&one).unwrap(), places.take(&one).unwrap());
        assert!(places.take(&one).is_err());
        assert!(places.take(&from("10.0.0.2:7")).is_ok());
        drop(held);
        assert!(places.take(&one).is_ok());
        let all: Vec<_> = (0..TAKE_EXPORTS)
            .map(|it| places.take(&from(&format!("10.0.1.{it}:7"))).unwrap())
            .collect();
        assert!(places.take(&one).is_err());
        drop(all);
        assert!(places.held().is_empty());
    }
}
