//! Ids as a person types them, and names as the wire wants them.

/// `sessions/{id}` from an id or a full name.
pub fn session_name(id: &str) -> String {
    full_name("sessions/", id)
}

/// `actors/{id}` from an id or a full name.
pub fn actor_name(id: &str) -> String {
    full_name("actors/", id)
}

/// The id in `actors/{id}` or `sessions/{id}`.
pub fn short_id(name: &str) -> &str {
    name.rsplit_once('/').map_or(name, |(_, id)| id)
}

/// `frontalis-HOST`: two machines that publish into one session by mistake are told apart.
pub fn default_publisher() -> String {
    let uname = rustix::system::uname();
    let host = uname.nodename().to_string_lossy();
    let name = format!("frontalis-{host}");
    let allowed = |it: char| {
        if it.is_ascii_alphanumeric() || "._-".contains(it) {
            it
        } else {
            '-'
        }
    };
    name.chars().map(allowed).take(64).collect()
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
}
