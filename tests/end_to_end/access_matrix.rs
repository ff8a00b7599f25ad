//! Every method and every HTTP operation, for every role by every proof, on its own object, a foreign one and a missing
//! one (CONTRACTS S-4, S-5, goal G13).
//!
//! What is asked comes from the descriptors and from `/openapi.json`; what is expected is S-4, written down again in
//! [`rules`]. A method or an operation without a rule fails the test, and so does a call that may be made and comes to
//! another end than its rule says.

mod bytes;
mod callers;
mod grpc;
mod http;
mod messages;
mod rules;
mod stage;

use std::collections::{BTreeMap, BTreeSet};

use frontalis_access::Role;

use callers::Caller;
use messages::{Variant, variants};
use rules::{Expected, Rule};
use stage::{OBJECTS, Object, Stage};

/// What came of one call.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Outcome {
    /// `OK` or gRPC's name of the code, or the number of HTTP.
    code: String,
    /// Empty for a success.
    reason: String,
    /// Everything that a client could compare.
    whole: Vec<u8>,
    /// Names in a list.
    names: Vec<String>,
}

impl Outcome {
    fn is_success(&self) -> bool {
        let is_redirect_or_ok = matches!(self.code.as_bytes().first(), Some(b'2' | b'3'));
        self.reason.is_empty() && (self.code == "OK" || is_redirect_or_ok)
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn every_method_and_every_operation_answers_every_role_as_specified() {
    let stage = Stage::new().await;
    let mut cells = Cells::default();
    let methods = grpc::methods();
    let operations = http::operations(&stage).await;
    for caller in &stage.callers {
        let channel = caller.channel(&stage.server).await;
        for method in &methods {
            for variant in variants(method) {
                let cell = Cell::new(method, method, *variant, caller);
                for object in OBJECTS {
                    let call = grpc::Call {
                        method,
                        variant: *variant,
                        id: &stage.id_for(method, object).await,
                        package: &stage.package,
                    };
                    let outcome = call.outcome(channel.clone(), caller).await;
                    cells.check(&cell, object, outcome);
                }
            }
        }
        for operation in &operations {
            let name = operation.name();
            let cell = Cell::new(&name, operation.rule(), operation.variant(), caller);
            for object in OBJECTS {
                let id = stage.id_for(operation.rule(), object).await;
                let outcome = operation.call(&stage, caller, &id).await;
                cells.check(&cell, object, outcome);
            }
        }
    }
    cells.report(stage.callers.len());
    stage.server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_server_has_no_service_that_nobody_asked() {
    let stage = Stage::new().await;
    let asked: BTreeSet<String> = grpc::methods()
        .iter()
        .map(|it| it.split('/').next().unwrap().to_owned())
        .collect();
    let operator = stage
        .callers
        .iter()
        .find(|it| it.role == Some(Role::Operator));
    let served = grpc::services(&stage, operator.unwrap()).await;
    assert_eq!(served, asked);
    stage.server.stop().await;
}

/// What is asked of all three objects.
struct Cell<'a> {
    what: String,
    rule: Rule,
    caller: &'a Caller,
}

impl<'a> Cell<'a> {
    fn new(name: &str, rule: &str, variant: Variant, caller: &'a Caller) -> Self {
        let rule = rules::of(rule);
        match variant {
            Variant::Plain => Self {
                what: name.to_owned(),
                rule,
                caller,
            },
            Variant::Takeover => Self {
                what: format!("{name} (takeover)"),
                rule: rule.with_takeover(),
                caller,
            },
        }
    }
}

/// What was asked so far.
#[derive(Default)]
struct Cells {
    n_asked: usize,
    wrong: Vec<String>,
    /// What the same caller was answered for the foreign object.
    foreign: BTreeMap<(String, String), Outcome>,
}

impl Cells {
    fn check(&mut self, cell: &Cell, object: Object, outcome: Outcome) {
        self.n_asked += 1;
        let Cell { what, rule, caller } = cell;
        let (who, role) = (&caller.name, caller.role);
        let expected = rule.expected(role, object);
        if !expected.is(&outcome) {
            let found = (&outcome.code, &outcome.reason, &outcome.names);
            self.wrong.push(format!(
                "{what} as {who} on {object:?}: {found:?}, expected {expected:?}"
            ));
        }
        let key = (what.clone(), who.clone());
        match object {
            Object::Foreign => {
                self.foreign.insert(key, outcome);
            }
            Object::Missing if expected == Expected::NotFound => {
                let foreign = self.foreign.get(&key);
                let is_foreign_hidden = rule.expected(role, Object::Foreign) == Expected::NotFound;
                if is_foreign_hidden && foreign != Some(&outcome) {
                    self.wrong.push(format!(
                        "{what} as {who}: a foreign object is told from a missing one: {:?} and {:?}",
                        foreign.map(|it| String::from_utf8_lossy(&it.whole).into_owned()),
                        String::from_utf8_lossy(&outcome.whole)
                    ));
                }
            }
            Object::Own | Object::Missing => {}
        }
    }

    fn report(self, n_callers: usize) {
        let n_right = self.n_asked - self.wrong.len();
        println!(
            "G13: {n_right} of {} cells as specified ({} methods and operations x {n_callers} callers x {} objects)",
            self.n_asked,
            self.n_asked / n_callers / OBJECTS.len(),
            OBJECTS.len()
        );
        assert!(self.wrong.is_empty(), "{}", self.wrong.join("\n"));
    }
}
