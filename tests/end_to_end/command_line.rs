//! The command line: tokens made, a login kept, refusals explained, an audit log verified, sessions set up, curves with their
//! standard errors.

use std::path::Path;

use frontalis_analysis::{
    format::trc::{self, TrcFrame, TrcTake},
    space::LengthUnit,
};
use frontalis_proto::v1::MarkerFrame;
use frontalis_server::service::audit::FILE_NAME;
use harness::{Protection, TestPerformance, TestServer};
use serde_json::Value;

use crate::person::{Person, text_of};

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_login_is_kept_for_its_server_and_forgotten_on_request() {
    let (anna, protection) = (Person::new(), Protection::new());
    let file = protection.token_file().display().to_string();
    let create = format!("token create --token-file {file} --role operator --name Anna");
    let token = anna.does(&create).await;
    assert_eq!(token.lines().count(), 1, "the token and nothing else");

    let server = TestServer::start_with(|it| protection.apply(it)).await;
    let url = format!("https://{}", server.address());
    let ca_cert = protection.ca_cert().display().to_string();
    let login = format!("login --server {url} --ca-cert {ca_cert}");
    let said = anna.does_with(&login, &token).await;
    assert!(
        said.contains("operator") && !said.contains(token.trim()),
        "{said}"
    );
    assert_eq!(mode(&anna.login_file()), 0o600);

    // Without a flag: the server, its authority and the token are those of the login.
    let who: Value = serde_json::from_str(&anna.does("server --json").await).unwrap();
    assert_eq!(who["caller"]["role"], "ROLE_OPERATOR");
    assert_eq!((&who["tls"], &who["tokens"]), (&true.into(), &true.into()));
    let sessions: Value = serde_json::from_str(&anna.does("session list --json").await).unwrap();
    assert_eq!(sessions.get("sessions"), None);

    anna.does("logout").await;
    let complained = anna
        .fails(&format!("session list --server {url} --ca-cert {ca_cert}"))
        .await;
    assert!(complained.contains("frontalis login"), "{complained}");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_refused_connection_says_what_to_do() {
    let (anna, protection, stranger) = (Person::new(), Protection::new(), Protection::new());
    let token = protection.token(frontalis_access::Role::Viewer, "*");
    let server = TestServer::start_with(|it| protection.apply(it)).await;
    let address = server.address();
    let ca_cert = protection.ca_cert().display().to_string();
    let token = token.display();
    for (line, advice) in [
        // Another authority, another name, no TLS where there is some.
        (
            format!(
                "session list --server https://{address} --ca-cert {} --token-file {token}",
                stranger.ca_cert().display()
            ),
            "--ca-cert",
        ),
        (
            format!(
                "session list --server https://localhost:{} --ca-cert {ca_cert}",
                address.port()
            ),
            "--server has to use a name",
        ),
        (
            format!("session list --server http://{address}"),
            "--server https://",
        ),
        // A role that may not.
        (
            format!(
                "session create --actor anna --server https://{address} --ca-cert {ca_cert} --token-file {token}"
            ),
            "your token does not allow this",
        ),
    ] {
        let complained = anna.fails(&line).await;
        assert!(complained.contains(advice), "{line}\n{complained}");
    }
    // A login that is refused is not kept.
    let output = anna
        .types(
            &format!("login --server https://{address} --ca-cert {ca_cert}"),
            "frontalis_wrong",
        )
        .await;
    assert!(!output.status.success() && !anna.login_file().exists());
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_server_without_tls_is_told_from_one_with_it() {
    let (anna, server) = (Person::new(), TestServer::start().await);
    let complained = anna
        .fails(&format!("server --server https://{}", server.address()))
        .await;
    assert!(
        complained.contains("http:// instead of https://"),
        "{complained}"
    );
    anna.does(&format!("server --server {}", server.url()))
        .await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_audit_log_is_verified_and_the_first_line_that_was_tampered_with_is_named() {
    let (anna, server) = (Person::new(), TestServer::with_session("take-1").await);
    server.end_session("sessions/take-1").await;
    let folder = server.stop().await;
    let log = folder.path().join(FILE_NAME);
    let verify = format!("audit verify {}", log.display());
    let said = anna.does(&verify).await;
    assert!(said.contains("3 lines; the chain holds"), "{said}");

    let text = std::fs::read_to_string(&log).unwrap();
    std::fs::write(&log, text.replace("session_create", "session_created")).unwrap();
    let output = anna.types(&verify, "").await;
    let said = text_of(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("3 lines; line 2 is not"), "{said}");
    let output = anna.types(&format!("{verify} --json"), "").await;
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{report}");
    assert_eq!(
        (&report["lines"], &report["firstBrokenLine"]),
        (&"3".into(), &"2".into())
    );

    let complained = anna.fails("audit verify nowhere/audit.log").await;
    assert!(complained.contains("nowhere/audit.log"), "{complained}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_objective_of_a_session_is_chosen_shown_and_changed() {
    let (anna, server) = (Person::new(), TestServer::start().await);
    server.import_reference().await;
    let url = server.url();
    let shown = anna
        .does(&format!(
            "session create --server {url} --actor reference --id take-1 --plain --bounds jaw_rotation=0..0.8"
        ))
        .await;
    assert!(
        shown.contains("plain") && shown.contains("jaw_rotation 0..0.8"),
        "{shown}"
    );
    let settings = async || server.session("sessions/take-1").await.settings.unwrap();
    assert_eq!(settings().await.plain, Some(true));

    let update = format!("session update --server {url} take-1");
    let shown = anna
        .does(&format!(
            "{update} --plain=false --smoothing 0.2 --exclusive lips_pressor,jaw_rotation"
        ))
        .await;
    assert!(
        shown.contains("robust, smoothing 0.2, sparsity 0.5"),
        "{shown}"
    );
    assert!(shown.contains("lips_pressor or jaw_rotation"), "{shown}");
    anna.does(&format!("{update} --bounds none --sparsity 0"))
        .await;
    let changed = settings().await;
    assert_eq!(
        (changed.bounds.len(), changed.exclusive_pairs.len()),
        (0, 1)
    );
    assert_eq!(
        (changed.smoothing, changed.sparsity),
        (Some(0.2), Some(0.0))
    );

    let complained = anna.fails(&format!("{update} --bounds jaw=0..0.5")).await;
    assert!(
        complained.contains("names no muscle of choe-ko-16"),
        "{complained}"
    );
    let complained = anna.fails(&format!("{update} --plain --robust")).await;
    assert!(complained.contains("SOLVER_OPTIONS"), "{complained}");
    let complained = anna
        .fails(&format!(
            "session recenter --server {url} take-1 --quietest"
        ))
        .await;
    assert!(
        complained.contains("what to do: publish more frames"),
        "{complained}"
    );
    anna.does(&format!("session recenter --server {url} take-1"))
        .await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_file_and_a_session_give_the_same_standard_errors() {
    let (anna, server) = (Person::new(), TestServer::start().await);
    server.import_reference().await;
    let url = server.url();
    let take = anna.home().join("take.trc").display().to_string();
    std::fs::write(&take, a_take()).unwrap();
    let package = anna.home().join("reference.zip").display().to_string();
    std::fs::write(&package, harness::reference_package()).unwrap();
    let settings = "--smoothing 0.3 --bounds jaw_rotation=0..0.4";
    anna.does(&format!(
        "session create --server {url} --actor reference --id take-1 {settings}"
    ))
    .await;
    anna.does(&format!(
        "publish --server {url} {take} --session take-1 --fast"
    ))
    .await;
    let watch = format!("watch --server {url} take-1 --every-frame --from-start --frames 60");
    let watched = anna.does(&format!("{watch} --csv --standard-errors")).await;
    let solve = format!("solve {take} --actor {package} {settings}");
    let solved = anna.does(&format!("{solve} --csv --standard-errors")).await;
    assert!(solved == watched, "{solved}\n{watched}");
    let heading: Vec<_> = solved.lines().next().unwrap().split(',').collect();
    assert_eq!(heading.len(), 3 + 2 * 16);
    assert_eq!(heading[3 + 16], "frontalis_left_standard_error");
    assert!(
        solved
            .lines()
            .all(|it| it.split(',').count() == heading.len())
    );

    // Without them the table is as it was, and the messages hold none.
    let plainly = anna.does(&format!("{solve} --csv")).await;
    assert!(plainly.lines().all(|it| it.split(',').count() == 3 + 16));
    let errors = |said: &str| {
        let samples = said.lines().skip(1);
        let message = |line: &str| -> Value { serde_json::from_str(line).unwrap() };
        samples
            .map(|line| message(line)["samples"][0]["standardErrors"].clone())
            .filter(|it| it.as_array().is_some_and(|it| it.len() == 16))
            .count()
    };
    let with = anna
        .does(&format!("{solve} --json --standard-errors"))
        .await;
    let without = anna.does(&format!("{solve} --json")).await;
    assert_eq!((errors(&with), errors(&without)), (60, 0));
    let bars = anna.fails(&format!("{solve} --standard-errors")).await;
    assert!(bars.contains("--csv or --json"), "{bars}");

    let shown = anna
        .does(&format!("session show --server {url} take-1"))
        .await;
    assert!(shown.contains("verdict on its shape"), "{shown}");
    let said = anna.does(&solve).await;
    assert!(said.starts_with("60 frames, 60 samples"), "{said}");
    let unknown = anna
        .fails(&format!(
            "solve {take} --actor {package} --exclusive jaw_rotation,kiss"
        ))
        .await;
    assert!(
        unknown.contains("kiss, which is not a muscle of choe-ko-16"),
        "{unknown}"
    );
    server.stop().await;
}

/// Half a second of the reference face, as a file.
fn a_take() -> String {
    let performance = TestPerformance::reference();
    let frame = |it: &MarkerFrame| TrcFrame {
        number: it.number,
        time_s: it.number as f64 / performance.rate_hz,
        positions: it
            .positions
            .chunks_exact(3)
            .map(|it| [it[0], it[1], it[2]])
            .collect(),
    };
    let take = TrcTake {
        rate_hz: performance.rate_hz,
        unit: LengthUnit::Millimeter,
        marker_names: performance.marker_names().to_vec(),
        frames: performance.frames(1..=60).iter().map(frame).collect(),
        start_timecode: None,
    };
    trc::write(&take, "take")
}

fn mode(path: &Path) -> u32 {
    use std::os::unix::fs::PermissionsExt as _;
    std::fs::metadata(path).unwrap().permissions().mode() & 0o777
}
