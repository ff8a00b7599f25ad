//! What is asked for: a server with sessions and actors inside and outside of the callers' scope.

use std::{
    collections::BTreeMap,
    sync::atomic::{AtomicU32, Ordering},
};

use frontalis_proto::v1::{StartTakeRequest, StopTakeRequest};
use harness::{TestAuthority, TestServer, assert_eventually, toy_files, zip};

use super::{
    callers::{self, Caller},
    grpc,
};

/// Whose the object is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Object {
    Own,
    Foreign,
    Missing,
}

pub(super) const OBJECTS: [Object; 3] = [Object::Own, Object::Foreign, Object::Missing];

impl Object {
    /// Id of a session, and of the actor that only it uses; or of one that is nowhere.
    pub(super) fn id(self) -> &'static str {
        match self {
            Self::Own => "own-1",
            Self::Foreign => "foreign-1",
            Self::Missing => "missing-1",
        }
    }

    fn begins(self) -> &'static str {
        self.id().trim_end_matches('1')
    }
}

/// A server that asks everybody who they are, and those whom it may be asked by.
pub(super) struct Stage {
    pub(super) server: TestServer,
    pub(super) callers: Vec<Caller>,
    /// An actor that is quick to import.
    pub(super) package: Vec<u8>,
    n_made: AtomicU32,
    /// Takes of the sessions that are there from the start, which are over, by session.
    takes: BTreeMap<&'static str, String>,
    _authority: TestAuthority,
}

impl Stage {
    pub(super) async fn new() -> Self {
        let authority = TestAuthority::new("authority");
        let mut server = TestServer::start_guarded(|config| {
            config.limits.auth_failures_per_minute = 60_000;
            config.limits.session_creations_per_minute = 60_000;
            config.limits.sessions = 4_096;
            (config.tls.cert, config.tls.key) = authority.server_files(&["127.0.0.1"]);
            config.tls.client_ca = authority.ca_file();
        })
        .await
        .spoken_to_over(authority.believer(None, &["h2"]));
        let callers = callers::all(&authority, server.keys());
        server.reload();
        let mut stage = Self {
            server,
            callers,
            package: zip(&toy_files()),
            n_made: AtomicU32::new(0),
            takes: BTreeMap::new(),
            _authority: authority,
        };
        let package = harness::reference_package();
        for id in [Object::Own, Object::Foreign].map(Object::id) {
            stage.server.import(id, &package).await.unwrap();
            stage.make_session(id, id).await;
            let take = stage.make_take(id).await;
            stage.stop_take(&take).await;
            stage.takes.insert(id, take);
        }
        let known = stage.callers.iter().find(|it| it.role.is_some()).unwrap();
        assert_eventually!(grpc::is_known(&stage, known).await);
        stage
    }

    /// The id that a call of this method shall name. What a method uses up is made for it alone.
    pub(super) async fn id_for(&self, method: &str, object: Object) -> String {
        // A plain page has no method behind it.
        let name = method.rsplit('/').next().unwrap_or_default();
        match (name, object) {
            ("CreateSession", Object::Own) => self.new_id("own-new-"),
            ("CreateSession", Object::Missing) => self.new_id("elsewhere-"),
            ("ImportActor", _) => "imported".to_owned(),
            (_, Object::Missing) => object.id().to_owned(),
            ("PublishMarkers" | "EndSession" | "StartTake", _) => {
                let id = self.new_id(object.begins());
                self.make_session(&id, object.id()).await;
                id
            }
            ("StopTake" | "GetTake" | "UpdateTake" | "ExportTake" | "ResolveTake", _) => {
                self.takes[object.id()].clone()
            }
            ("DeleteTake", _) => {
                let session = self.new_id(object.begins());
                self.make_session(&session, object.id()).await;
                self.make_take(&session).await
            }
            ("DeleteActor", _) => {
                let id = self.new_id(object.begins());
                self.server.import(&id, &self.package).await.unwrap();
                id
            }
            _ => object.id().to_owned(),
        }
    }

    fn new_id(&self, begins: &str) -> String {
        let n = self.n_made.fetch_add(1, Ordering::Relaxed);
        format!("{begins}made-{n}")
    }

    /// The id of a take under way.
    async fn make_take(&self, session: &str) -> String {
        let request = StartTakeRequest {
            session: format!("sessions/{session}"),
            ..StartTakeRequest::default()
        };
        let mut takes = self.server.takes().await;
        let take = takes.start_take(request).await.unwrap().into_inner().take;
        take.unwrap().name.replace("takes/", "")
    }

    async fn stop_take(&self, id: &str) {
        let name = format!("takes/{id}");
        let mut takes = self.server.takes().await;
        takes.stop_take(StopTakeRequest { name }).await.unwrap();
    }

    async fn make_session(&self, id: &str, actor: &str) {
        let actor = format!("actors/{actor}");
        self.server.create_session(id, &actor).await.unwrap();
    }
}
