//! Connections with TLS and without, against a real listener with certificates made here.

use std::{net::SocketAddr, time::Duration};

use rcgen::{
    BasicConstraints, CertificateParams, CertifiedIssuer, ExtendedKeyUsagePurpose, IsCa, KeyPair,
    date_time_ymd,
};
use tokio::{net::TcpListener, time::timeout};
use tokio_stream::wrappers::TcpListenerStream;
use tonic::{
    Request, Status,
    transport::{Identity, Server, ServerTlsConfig},
};
use tonic_health::pb::{HealthCheckRequest, health_client::HealthClient};

use super::*;

type Authority = CertifiedIssuer<'static, KeyPair>;

fn authority() -> Authority {
    let mut params = CertificateParams::default();
    params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
    CertifiedIssuer::self_signed(params, KeyPair::generate().unwrap()).unwrap()
}

/// Certificate and key of `name`.
fn issue(
    authority: &Authority,
    name: &str,
    change: impl FnOnce(&mut CertificateParams),
) -> (String, String) {
    let mut params = CertificateParams::new([name.to_owned()]).unwrap();
    change(&mut params);
    let key = KeyPair::generate().unwrap();
    let certificate = params.signed_by(&key, authority).unwrap();
    (certificate.pem(), key.serialize_pem())
}

/// A server whose health answers only those who show `Bearer secret-1`.
async fn serve(tls: Option<ServerTlsConfig>) -> SocketAddr {
    let (_, health) = tonic_health::server::health_reporter();
    let guarded = InterceptedService::new(health, |request: Request<()>| {
        match request.metadata().get("authorization") {
            Some(it) if it == "Bearer secret-1" => Ok(request),
            _ => Err(Status::unauthenticated("who are you")),
        }
    });
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    let mut builder = Server::builder();
    if let Some(tls) = tls {
        builder = builder.tls_config(tls).unwrap();
    }
    let serving = builder
        .add_service(guarded)
        .serve_with_incoming(TcpListenerStream::new(listener));
    tokio::spawn(serving);
    address
}

async fn serve_tls(certificate: &(String, String)) -> SocketAddr {
    let identity = Identity::from_pem(&certificate.0, &certificate.1);
    serve(Some(ServerTlsConfig::new().identity(identity))).await
}

/// Connects and asks for the health.
async fn ask(url: &str, credentials: &Credentials) -> Result<(), ClientError> {
    let asking = async {
        let channel = connect_with(url, credentials).await?;
        let request = HealthCheckRequest::default();
        HealthClient::new(channel).check(request).await?;
        Ok(())
    };
    timeout(Duration::from_secs(10), asking).await.unwrap()
}

fn trusting(authority: &Authority) -> Credentials {
    Credentials {
        token: Some(Token::parse("secret-1").unwrap()),
        ca_pem: Some(authority.pem()),
        identity: None,
    }
}

fn check_refusal(answer: Result<(), ClientError>, reason: &str, advice: &str) {
    let error = answer.unwrap_err();
    assert_eq!(error.reason.as_deref(), Some(reason), "{error:?}");
    assert!(!error.is_transient(), "{error}");
    assert!(error.advice().unwrap().contains(advice), "{error}");
}

#[tokio::test]
async fn a_trusted_server_gets_the_token_over_tls_with_every_call() {
    let authority = authority();
    let address = serve_tls(&issue(&authority, "127.0.0.1", |_| ())).await;
    let url = format!("https://{address}");
    ask(&url, &trusting(&authority)).await.unwrap();
    let without = Credentials {
        token: None,
        ..trusting(&authority)
    };
    let error = ask(&url, &without).await.unwrap_err();
    assert_eq!(error.code, Code::Unauthenticated);
    assert!(error.advice().unwrap().contains("frontalis login"));
}

#[tokio::test]
async fn the_token_goes_over_a_plain_connection_too() {
    let address = serve(None).await;
    let credentials = trusting(&authority());
    ask(&format!("http://{address}"), &credentials)
        .await
        .unwrap();
}

#[tokio::test]
async fn a_certificate_of_a_stranger_is_refused() {
    let (ours, stranger) = (authority(), authority());
    let address = serve_tls(&issue(&stranger, "127.0.0.1", |_| ())).await;
    let answer = ask(&format!("https://{address}"), &trusting(&ours)).await;
    check_refusal(answer, "TLS_UNTRUSTED", "--ca-cert");
    // Neither does the system know it.
    let with_system_roots = Credentials::default();
    let answer = ask(&format!("https://{address}"), &with_system_roots).await;
    check_refusal(answer, "TLS_UNTRUSTED", "--ca-cert");
}

#[tokio::test]
async fn a_certificate_of_another_name_is_refused() {
    let authority = authority();
    let address = serve_tls(&issue(&authority, "stage.example", |_| ())).await;
    let answer = ask(&format!("https://{address}"), &trusting(&authority)).await;
    check_refusal(answer, "TLS_NAME", "--server");
}

#[tokio::test]
async fn an_expired_certificate_is_refused() {
    let authority = authority();
    let expired = issue(&authority, "127.0.0.1", |it| {
        it.not_before = date_time_ymd(2019, 1, 1);
        it.not_after = date_time_ymd(2020, 1, 1);
    });
    let address = serve_tls(&expired).await;
    let answer = ask(&format!("https://{address}"), &trusting(&authority)).await;
    check_refusal(answer, "TLS_EXPIRED", "renewal");
}

#[tokio::test]
async fn https_to_a_port_without_tls_is_told() {
    let address = serve(None).await;
    let answer = ask(&format!("https://{address}"), &trusting(&authority())).await;
    check_refusal(answer, "TLS_NOT_SPOKEN", "http://");
}

#[tokio::test]
async fn http_to_a_port_with_tls_is_told() {
    let authority = authority();
    let address = serve_tls(&issue(&authority, "127.0.0.1", |_| ())).await;
    let url = format!("http://{address}");
    ask(&url, &trusting(&authority)).await.unwrap_err();
    assert!(speaks_tls(&url).await);
    let plain = serve(None).await;
    assert!(!speaks_tls(&format!("http://{plain}")).await);
    assert!(!speaks_tls("http://127.0.0.1:1").await);
}

#[tokio::test]
async fn a_server_that_asks_for_a_certificate_takes_one_of_its_authority_only() {
    let (authority, stranger) = (authority(), authority());
    let certificate = issue(&authority, "127.0.0.1", |_| ());
    let tls = ServerTlsConfig::new()
        .identity(Identity::from_pem(&certificate.0, &certificate.1))
        .client_ca_root(Certificate::from_pem(authority.pem()));
    let url = format!("https://{}", serve(Some(tls)).await);
    let with = |issuer: &Authority| {
        let (certificate_pem, key_pem) = issue(issuer, "rig", |it| {
            it.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth];
        });
        Credentials {
            identity: Some(ClientIdentity {
                certificate_pem,
                key_pem,
            }),
            ..trusting(&authority)
        }
    };
    ask(&url, &with(&authority)).await.unwrap();
    for refused in [trusting(&authority), with(&stranger)] {
        let answer = ask(&url, &refused).await;
        check_refusal(answer, "TLS_CLIENT_CERTIFICATE", "--client-cert");
    }
}

#[test]
fn a_text_without_certificates_is_no_authority() {
    assert!(check_certificates("").is_err());
    assert!(check_certificates("-----BEGIN CERTIFICATE-----\n!\n").is_err());
    assert!(check_certificates(&authority().pem()).is_ok());
}

#[test]
fn an_address_has_a_scheme_that_is_spoken() {
    for server in ["ftp://stage:7400", "https://", "a b"] {
        assert!(
            endpoint(server, &Credentials::default()).is_err(),
            "{server}"
        );
    }
    assert!(endpoint("stage:7400", &Credentials::default()).is_ok());
}
