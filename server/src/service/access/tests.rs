//! How often a peer may fail to say who it is.

use super::*;

const PER_MINUTE: u32 = 3;

/// Asks for tokens that nobody has.
fn guarded(folder: &tempfile::TempDir) -> Access {
    let path = folder.path().join("tokens.toml");
    std::fs::write(&path, "").unwrap();
    let limits = Limits {
        auth_failures_per_minute: PER_MINUTE,
        ..Limits::default()
    };
    Access::with_tokens(&path, &limits, Audit::none(), Metrics::new("test")).unwrap()
}

/// What a caller without a token is told at this address.
fn refusal(access: &Access, address: &str) -> Code {
    let mut extensions = Extensions::new();
    let address = SocketAddr::new(address.parse().unwrap(), 40_000);
    extensions.insert(ConnectInfo(address));
    let refused = access.caller(&HeaderMap::new(), &extensions);
    refused.unwrap_err().code()
}

#[tokio::test(start_paused = true)]
async fn the_addresses_of_one_ipv6_customer_share_their_failures() {
    let folder = tempfile::tempdir().unwrap();
    let access = guarded(&folder);
    for host in 1..=PER_MINUTE {
        let address = format!("2001:db8::{host}:0:0:1");
        assert_eq!(refusal(&access, &address), Code::Unauthenticated);
    }
    assert_eq!(refusal(&access, "2001:db8::ffff"), Code::ResourceExhausted);
    assert_eq!(refusal(&access, "2001:db8:0:1::1"), Code::Unauthenticated);
}

#[tokio::test(start_paused = true)]
async fn an_ipv4_address_is_one_peer_however_it_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let access = guarded(&folder);
    for _ in 1..=PER_MINUTE {
        assert_eq!(refusal(&access, "::ffff:10.0.0.1"), Code::Unauthenticated);
    }
    assert_eq!(refusal(&access, "10.0.0.1"), Code::ResourceExhausted);
    assert_eq!(refusal(&access, "10.0.0.2"), Code::Unauthenticated);
}
