//! Ids as a person types them, and names as the wire wants them.

/// What a publisher's 64 characters leave to the host, beside `frontalis-`, `-` and the ten digits of a process.
const MAX_HOST_CHARS: usize = 43;

/// `sessions/{id}` from an id or a full name.
pub fn session_name(id: &str) -> String {
    full_name("sessions/", id)
}

/// `actors/{id}` from an id or a full name.
pub fn actor_name(id: &str) -> String {
    full_name("actors/", id)
}

/// `takes/{id}` from an id or a full name.
pub fn take_name(id: &str) -> String {
    full_name("takes/", id)
}

/// The id in `actors/{id}` or `sessions/{id}`.
pub fn short_id(name: &str) -> &str {
    name.rsplit_once('/').map_or(name, |(_, id)| id)
}

/// A new session's id as it was typed, `sessions/` left out; anything else is for the server to judge.
///
/// # Errors
///
/// When nothing is left: the server would make an id of its own.
pub fn new_session_id(text: &str) -> Result<String, String> {
    new_id("sessions/", text)
}

/// A new actor's id as it was typed, `actors/` left out.
///
/// # Errors
///
/// When nothing is left.
pub fn new_actor_id(text: &str) -> Result<String, String> {
    new_id("actors/", text)
}

fn new_id(collection: &str, text: &str) -> Result<String, String> {
    match text.strip_prefix(collection).unwrap_or(text) {
        "" => Err("an id has 1 to 63 of a-z, 0-9, - and _".to_owned()),
        id => Ok(id.to_owned()),
    }
}

/// `frontalis-HOST-PID`: two publishers of one session by mistake are told apart, on one machine too.
pub fn default_publisher() -> String {
    let uname = rustix::system::uname();
    publisher_of(&uname.nodename().to_string_lossy(), std::process::id())
}

/// At most 64 characters of A-Z, a-z, 0-9, . _ -, the process last and whole.
fn publisher_of(host: &str, process: u32) -> String {
    let allowed = |it: char| {
        if it.is_ascii_alphanumeric() || "._-".contains(it) {
            it
        } else {
            '-'
        }
    };
    let host: String = host.chars().map(allowed).take(MAX_HOST_CHARS).collect();
    format!("frontalis-{host}-{process}")
}

fn full_name(collection: &str, id: &str) -> String {
    if id.starts_with(collection) {
        id.to_owned()
    } else {
        format!("{collection}{id}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_and_its_full_name_mean_the_same() {
        assert_eq!(session_name("take-1"), "sessions/take-1");
        assert_eq!(session_name("sessions/take-1"), "sessions/take-1");
        assert_eq!(short_id("actors/anna"), "anna");
        assert_eq!(short_id("anna"), "anna");
    }

    #[test]
    fn a_new_id_goes_out_as_it_was_typed() {
        assert_eq!(new_session_id("take-1").unwrap(), "take-1");
        assert_eq!(new_session_id("sessions/take-1").unwrap(), "take-1");
        // The server refuses these; half of them must not become another session.
        for id in ["../x2", "foo/bar", "sessions/foo/bar", "actors/x", "/"] {
            let sent = new_session_id(id).unwrap();
            assert!(sent.contains('/'), "{id} became {sent}");
        }
        assert_eq!(new_actor_id("actors/anna").unwrap(), "anna");
        assert!(new_session_id("").is_err() && new_session_id("sessions/").is_err());
        assert!(new_actor_id("").is_err());
    }

    #[test]
    fn two_publishers_of_one_machine_have_two_names() {
        assert_eq!(publisher_of("rig.local", 7), "frontalis-rig.local-7");
        assert_ne!(publisher_of("rig", 1), publisher_of("rig", 2));
        let long = publisher_of(&"ü x".repeat(40), u32::MAX);
        assert_eq!(long.len(), 64);
        assert!(long.ends_with("-4294967295"));
        let is_allowed = |it: char| it.is_ascii_alphanumeric() || "._-".contains(it);
        assert!(long.chars().all(is_allowed));
        assert_eq!(default_publisher(), default_publisher());
    }
}
