//! The audit log of a running server: what is a line of it, and that one which was tampered with is found
//! (CONTRACTS S-12).

use std::path::{Path, PathBuf};

use frontalis_access::{AuditLine, ChainReport, Role, verify_chain};
use frontalis_proto::v1::{GetServerRequest, server_service_client::ServerServiceClient};
use frontalis_server::{config::Config, service::audit::FILE_NAME};
use harness::{TestAuthority, TestServer, assert_eventually};

/// The log of a server with these settings.
fn log_of(config: &Config) -> PathBuf {
    Path::new(&config.data_dir).join(FILE_NAME)
}

fn lines(log: &Path) -> Vec<AuditLine> {
    let text = std::fs::read_to_string(log).unwrap();
    let whole = text.split_inclusive('\n').filter(|it| it.ends_with('\n'));
    whole.map(|it| serde_json::from_str(it).unwrap()).collect()
}

/// Object and result of every line of this event.
fn noted(log: &Path, event: &str) -> Vec<(String, String)> {
    let lines = lines(log).into_iter().filter(|it| it.event == event);
    lines.map(|it| (it.object, it.result)).collect()
}

fn verify(text: &str) -> ChainReport {
    verify_chain(text.as_bytes()).unwrap()
}

async fn knock(server: &TestServer) {
    let mut stranger = ServerServiceClient::new(server.bare_channel().await);
    stranger.get_server(GetServerRequest {}).await.unwrap_err();
}

#[tokio::test]
async fn the_log_is_a_chain_over_restarts_in_which_a_changed_line_is_found() {
    let server = TestServer::start_guarded(|_| {}).await;
    server.import_reference().await;
    server
        .create_session("s", "actors/reference")
        .await
        .unwrap();
    knock(&server).await;
    let server = server.restart().await;
    server.end_session("sessions/s").await;
    let token = server.operator_token().to_owned();
    let folder = server.stop().await;

    let log = folder.path().join(FILE_NAME);
    let events: Vec<String> = lines(&log).into_iter().map(|it| it.event).collect();
    let expected = [
        "actor_import",
        "session_create",
        "auth_failure",
        "session_end",
    ];
    assert_eq!(events, expected);
    let text = std::fs::read_to_string(&log).unwrap();
    let report = verify(&text);
    assert_eq!((report.n_lines, report.first_broken), (4, None));
    assert!(!text.contains(&token));

    for (idx, line) in text.lines().enumerate() {
        let number = idx as u64 + 1;
        let changed = line.replacen("\"result\":\"", "\"result\":\"x", 1);
        let changed = text.replacen(line, &changed, 1);
        assert_eq!(verify(&changed).first_broken, Some(number));
        let removed = verify(&text.replacen(&format!("{line}\n"), "", 1));
        let is_last = number == report.n_lines;
        let expected = (!is_last).then_some(number);
        assert_eq!(removed.first_broken, expected, "line {number}");
    }
}

#[tokio::test]
async fn a_token_file_that_was_read_again_is_lines_that_name_every_token_that_changed() {
    let mut log = PathBuf::new();
    let mut server = TestServer::start_guarded(|config| log = log_of(config)).await;
    let keys = server.keys();
    for _ in 0..3 {
        keys.grant(Role::Viewer, "*");
    }
    let ids: Vec<String> = keys.file().tokens()[2..]
        .iter()
        .map(|it| it.id.clone())
        .collect();
    keys.save();
    server.reload();
    let noted = || noted(&log, "token_file_change");
    assert_eventually!(noted().len() == 1);

    let file = server.keys().file();
    file.revoke(&ids[0]).unwrap();
    file.remove(&ids[1]).unwrap();
    let text = file.to_toml();
    let (before, last) = text.rsplit_once("viewer").unwrap();
    assert!(last.contains(&file.token(&ids[2]).unwrap().hash.to_text()));
    let text = format!("{before}renderer{last}");
    server.keys().write_text(&text);
    server.reload();
    assert_eventually!(noted().len() == 4);

    server.keys().write_text("[[token]]\nid = 3\n");
    server.reload();
    assert_eventually!(noted().len() == 5);
    let taken = |object: String| (object, "taken".to_owned());
    assert_eq!(
        noted(),
        [
            taken(format!("added {}", ids.join(" "))),
            taken(format!("removed {}", ids[1])),
            taken(format!("revoked {}", ids[0])),
            taken(format!("changed {}", ids[2])),
            (String::new(), "refused".to_owned()),
        ]
    );
    server.stop().await;
}

#[tokio::test]
async fn certificates_that_were_read_again_are_a_line_and_those_that_were_refused_are_one() {
    let authority = TestAuthority::new("authority");
    let revoked = authority.client("renderer-1", 7, 2100);
    let mut log = PathBuf::new();
    let server = TestServer::start_with(|config| {
        (config.tls.cert, config.tls.key) = authority.server_files(&["127.0.0.1"]);
        config.tls.client_ca = authority.ca_file();
        config.tls.client_crl = authority.revoked_file(&[]);
        log = log_of(config);
    })
    .await;
    let noted = || noted(&log, "certificate_change");
    authority.revoked_file(&[&revoked]);
    server.reload();
    assert_eventually!(noted().len() == 1);
    authority.damage("revoked.pem");
    server.reload();
    assert_eventually!(noted().len() == 2);
    let changed = "tls.client_crl".to_owned();
    let [taken, (object, result)] = noted().try_into().unwrap();
    assert_eq!(taken, (changed.clone(), "taken".to_owned()));
    assert_eq!(object, changed);
    assert!(
        result.starts_with("refused: ") && result.contains("revoked.pem"),
        "{result}"
    );
    server.stop().await;
}
