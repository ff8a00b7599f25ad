//! Who asks: every role by each proof that there is, and those who prove nothing.

use std::net::SocketAddr;

use frontalis_access::Role;
use harness::{Keys, TestAuthority, TestIssuer, TestServer, TestTls};
use tokio::net::TcpStream;
use tokio_rustls::client::TlsStream;
use tonic::transport::Channel;

/// The sessions of everybody but operators, who have all.
const OWN: &str = "own-*";

/// One who asks.
pub(super) struct Caller {
    pub(super) name: String,
    /// None: it proves nothing.
    pub(super) role: Option<Role>,
    token: Option<String>,
    over_http2: TestTls,
    over_http1: TestTls,
}

/// Writes down what the server must know, and returns who may come, and two who may not.
pub(super) fn all(authority: &TestAuthority, keys: &mut Keys) -> Vec<Caller> {
    let issuer = TestIssuer::new();
    let maker = Maker(authority);
    let mut callers = vec![maker.without_proof()];
    let mut rules = String::new();
    for role in Role::ALL {
        let sessions = if role == Role::Operator { "*" } else { OWN };
        let token = keys.grant(role, sessions);
        callers.push(maker.with_token("token", role, token.reveal()));
        let token = issuer.signed(&TestIssuer::claims(role, sessions));
        callers.push(maker.with_token("signed token", role, &token));
        callers.push(maker.with_certificate(role.name(), Some(role)));
        rules += &rule(role, sessions);
    }
    callers.push(maker.with_certificate("somebody", None));
    let text = keys.file().to_toml() + &issuer.entry(&Role::ALL) + &rules;
    keys.write_text(&text);
    callers
}

fn rule(role: Role, sessions: &str) -> String {
    format!(
        "\n[[certificate]]\ncommon_name = \"{role}\"\nrole = \"{role}\"\nsessions = [\"{sessions}\"]\n"
    )
}

struct Maker<'a>(&'a TestAuthority);

impl Maker<'_> {
    fn without_proof(&self) -> Caller {
        Caller {
            name: "nobody".to_owned(),
            role: None,
            token: None,
            over_http2: self.0.believer(None, &["h2"]),
            over_http1: self.0.believer(None, &["http/1.1"]),
        }
    }

    fn with_token(&self, kind: &str, role: Role, token: &str) -> Caller {
        Caller {
            name: format!("{role} by {kind}"),
            role: Some(role),
            token: Some(token.to_owned()),
            ..self.without_proof()
        }
    }

    fn with_certificate(&self, name: &str, role: Option<Role>) -> Caller {
        let shown = self.0.client(name, 1, 2100);
        Caller {
            name: format!("{name} by certificate"),
            role,
            token: None,
            over_http2: self.0.believer(Some(&shown), &["h2"]),
            over_http1: self.0.believer(Some(&shown), &["http/1.1"]),
        }
    }
}

impl Caller {
    /// What is in its `Authorization`.
    pub(super) fn authorization(&self) -> Option<String> {
        self.token.as_ref().map(|it| format!("Bearer {it}"))
    }

    /// The subprotocols that it offers: a browser puts its token there.
    pub(super) fn subprotocols(&self, subprotocol: &str) -> String {
        match &self.token {
            Some(token) => format!("{subprotocol}, frontalis.bearer.{token}"),
            None => subprotocol.to_owned(),
        }
    }

    pub(super) async fn channel(&self, server: &TestServer) -> Channel {
        server.channel_over(&self.over_http2).await
    }

    pub(super) async fn connect(&self, address: SocketAddr) -> TlsStream<TcpStream> {
        self.over_http1.connect(address).await.unwrap()
    }
}
