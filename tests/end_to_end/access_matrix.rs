//! Every method and every HTTP operation, for every role, on its own object, a foreign one and a missing one
//! (CONTRACTS S-4, S-5, goal G13).
//!
//! What is asked comes from the descriptors and from `/openapi.json`; what is expected is S-4, written down again in
//! [`rules`]. A method or an operation without a rule fails the test.

mod grpc;
mod http;
mod rules;

use std::collections::BTreeMap;

use frontalis_access::{Role, Token};
use harness::TestServer;

use rules::{Expected, Rule};

/// Who asks.
const CALLERS: [Option<Role>; 5] = [
    Some(Role::Operator),
    Some(Role::Publisher),
    Some(Role::Renderer),
    Some(Role::Viewer),
    None,
];

/// Whose the object is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Object {
    Own,
    Foreign,
    Missing,
}

const OBJECTS: [Object; 3] = [Object::Own, Object::Foreign, Object::Missing];

impl Object {
    /// Id of a session, and of the actor that only it uses. The scope of every token is `own-*`.
    fn id(self) -> &'static str {
        match self {
            Self::Own => "own-1",
            Self::Foreign => "foreign-1",
            Self::Missing => "missing-1",
        }
    }

    /// Id of a session that shall be made: of one that is there, or of one that stays outside of every other question.
    fn new_id(self) -> &'static str {
        match self {
            Self::Own => "own-1",
            Self::Foreign => "foreign-1",
            Self::Missing => "elsewhere",
        }
    }
}

/// What came of one call: `OK`, or the code and the reason.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Outcome {
    /// gRPC's name of the code, or the number of HTTP.
    code: String,
    reason: String,
    /// Everything that a client could compare.
    whole: Vec<u8>,
    /// Names in a list.
    names: Vec<String>,
}

/// A server with two sessions, an actor each, and a token of every role whose scope holds the first alone.
struct Stage {
    server: TestServer,
    tokens: BTreeMap<Role, Token>,
}

impl Stage {
    async fn new() -> Self {
        let mut tokens = BTreeMap::new();
        let mut server = TestServer::start_guarded(|config| {
            config.limits.auth_failures_per_minute = 60_000;
            config.limits.session_creations_per_minute = 60_000;
        })
        .await;
        let package = harness::reference_package();
        for object in [Object::Own, Object::Foreign] {
            let id = object.id();
            server.import(id, &package).await.unwrap();
            let actor = format!("actors/{id}");
            server.create_session(id, &actor).await.unwrap();
        }
        for role in Role::ALL {
            let scope = if role == Role::Operator { "*" } else { "own-*" };
            tokens.insert(role, server.keys().grant(role, scope));
        }
        server.keys().save();
        server.reload();
        let stage = Self { server, tokens };
        let operator = &stage.tokens[&Role::Viewer];
        harness::assert_eventually!(grpc::is_known(&stage.server, operator).await);
        stage
    }

    fn token(&self, caller: Option<Role>) -> Option<&Token> {
        self.tokens.get(&caller?)
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn every_method_and_every_operation_answers_every_role_as_specified() {
    let stage = Stage::new().await;
    let mut cells = Cells::default();
    for method in grpc::methods() {
        let rule = rules::of(&method);
        for variant in grpc::variants(&method) {
            let what = format!("{method}{}", variant.suffix());
            let rule = variant.rule(rule);
            for caller in CALLERS {
                for object in OBJECTS {
                    let token = stage.token(caller);
                    let outcome = grpc::call(&stage.server, token, &method, variant, object).await;
                    cells.check(&what, rule, caller, object, outcome);
                }
            }
        }
    }
    stage.server.stop().await;
    // A new one: the sessions of the first have been ended by now.
    let stage = Stage::new().await;
    for operation in http::operations(&stage.server).await {
        let rule = operation.rule();
        for caller in CALLERS {
            for object in OBJECTS {
                let token = stage.token(caller);
                let outcome = operation.call(&stage.server, token, object).await;
                cells.check(&operation.name(), rule, caller, object, outcome);
            }
        }
    }
    cells.report();
    stage.server.stop().await;
}

/// What was asked so far.
#[derive(Default)]
struct Cells {
    n_asked: usize,
    wrong: Vec<String>,
    /// What the same caller was answered for the foreign object.
    foreign: BTreeMap<(String, Option<Role>), Outcome>,
}

impl Cells {
    fn check(
        &mut self,
        what: &str,
        rule: Rule,
        caller: Option<Role>,
        object: Object,
        outcome: Outcome,
    ) {
        self.n_asked += 1;
        let expected = rule.expected(caller, object);
        if !expected.is(&outcome) {
            let found = (&outcome.code, &outcome.reason, &outcome.names);
            self.wrong.push(format!(
                "{what} as {caller:?} on {object:?}: {found:?}, expected {expected:?}"
            ));
        }
        let key = (what.to_owned(), caller);
        match object {
            Object::Foreign => {
                self.foreign.insert(key, outcome);
            }
            Object::Missing if expected == Expected::NotFound => {
                let foreign = self.foreign.get(&key);
                let is_foreign_hidden =
                    rule.expected(caller, Object::Foreign) == Expected::NotFound;
                if is_foreign_hidden && foreign != Some(&outcome) {
                    self.wrong.push(format!(
                        "{what} as {caller:?}: a foreign object is told from a missing one: {:?} and {:?}",
                        foreign.map(|it| String::from_utf8_lossy(&it.whole).into_owned()),
                        String::from_utf8_lossy(&outcome.whole)
                    ));
                }
            }
            Object::Own | Object::Missing => {}
        }
    }

    fn report(self) {
        let n_right = self.n_asked - self.wrong.len();
        println!(
            "G13: {n_right} of {} cells as specified (methods and operations x roles x objects)",
            self.n_asked
        );
        assert!(self.wrong.is_empty(), "{}", self.wrong.join("\n"));
    }
}
