//! Tokens for a server that asks for them: the harness's own, and those of the roles that a test plays.

use std::path::PathBuf;

use frontalis_access::{NewToken, Role, Scope, Token, TokenFile, UnixTime};
use tonic::{GrpcMethod, Request, Status, metadata::AsciiMetadataValue, service::Interceptor};

/// The harness's own keys, and the file in which the server finds all.
#[derive(Clone, Debug)]
pub struct Keys {
    path: PathBuf,
    file: TokenFile,
    operator: Token,
    publisher: Token,
}

/// The time now, as token files have it.
pub fn now() -> UnixTime {
    frontalis_server::clock::wall_now().into()
}

impl Keys {
    /// Writes a token file with an operator, and a publisher of every session.
    pub(crate) fn write(path: PathBuf) -> Self {
        let mut file = TokenFile::default();
        let mut make = |role| {
            let new = NewToken::new("harness", role, Scope::all());
            file.create(new, now()).unwrap()
        };
        let (operator, publisher) = (make(Role::Operator), make(Role::Publisher));
        let keys = Self {
            path,
            file,
            operator,
            publisher,
        };
        keys.save();
        keys
    }

    /// An operator's token.
    pub fn operator(&self) -> &Token {
        &self.operator
    }

    /// The file as it is; changes count when they are saved.
    pub fn file(&mut self) -> &mut TokenFile {
        &mut self.file
    }

    /// Writes the file anew.
    pub fn save(&self) {
        self.write_text(&self.file.to_toml());
    }

    /// Writes anything in place of the file.
    pub fn write_text(&self, text: &str) {
        let beside = self.path.with_extension("new");
        std::fs::write(&beside, text).unwrap();
        std::fs::rename(&beside, &self.path).unwrap();
    }

    /// Makes a token of a role, in the file.
    pub fn grant(&mut self, role: Role, scope: &str) -> Token {
        let new = NewToken::new(role.name(), role, scope.parse().unwrap());
        self.file.create(new, now()).unwrap()
    }

    pub(crate) fn bearer(&self) -> Bearer {
        Bearer {
            operator: Some(value(&self.operator)),
            publisher: Some(value(&self.publisher)),
        }
    }
}

fn value(token: &Token) -> AsciiMetadataValue {
    format!("Bearer {}", token.reveal()).parse().unwrap()
}

/// Adds the token of the role that may do what is called; none where the server asks for none.
#[derive(Clone, Debug, Default)]
pub struct Bearer {
    operator: Option<AsciiMetadataValue>,
    publisher: Option<AsciiMetadataValue>,
}

impl Bearer {
    /// This token for every call.
    pub fn of(token: &Token) -> Self {
        Self {
            operator: Some(value(token)),
            publisher: Some(value(token)),
        }
    }
}

impl Interceptor for Bearer {
    fn call(&mut self, mut request: Request<()>) -> Result<Request<()>, Status> {
        let method = request.extensions().get::<GrpcMethod<'_>>();
        let publishes = method.is_some_and(|it| it.service() == "frontalis.v1.CaptureService");
        let token = if publishes {
            &self.publisher
        } else {
            &self.operator
        };
        if let Some(token) = token {
            request
                .metadata_mut()
                .insert("authorization", token.clone());
        }
        Ok(request)
    }
}
