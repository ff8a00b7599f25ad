//! What a token file says otherwise than the one before it, for the audit log (CONTRACTS S-12).

use super::{TokenFile, TokenRecord};

/// Ids of the tokens that changed, in the order of the file, and whether anything else did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TokenFileChange {
    /// Not there before.
    pub added: Vec<String>,
    /// There no more.
    pub removed: Vec<String>,
    /// Taken back, whatever else changed with them.
    pub revoked: Vec<String>,
    /// Anything else: another name, role, scope, expiry or hash, or good again.
    pub changed: Vec<String>,
    /// Whether an issuer came, went or changed.
    pub issuers: bool,
    /// Whether a rule for certificates came, went or changed.
    pub certificates: bool,
}

impl TokenFile {
    /// How this file differs from the one `before` it.
    pub fn change_since(&self, before: &Self) -> TokenFileChange {
        let mut change = TokenFileChange {
            removed: absent(before, self),
            issuers: self.issuers != before.issuers,
            certificates: self.certificates != before.certificates,
            ..TokenFileChange::default()
        };
        for record in &self.tokens {
            let ids = match before.token(&record.id) {
                None => &mut change.added,
                Some(old) if old == record => continue,
                Some(old) if is_revoked(old, record) => &mut change.revoked,
                Some(_) => &mut change.changed,
            };
            ids.push(record.id.clone());
        }
        change
    }
}

/// Ids of `file` that `other` does not have.
fn absent(file: &TokenFile, other: &TokenFile) -> Vec<String> {
    let ids = file.tokens.iter().map(|it| &it.id);
    ids.filter(|it| other.token(it).is_none())
        .cloned()
        .collect()
}

fn is_revoked(before: &TokenRecord, after: &TokenRecord) -> bool {
    after.revoked && !before.revoked
}

#[cfg(test)]
mod tests {
    use crate::{NewToken, Role, UnixTime};

    use super::*;

    const NOW: UnixTime = UnixTime::from_secs(1_800_000_000);

    fn create(file: &mut TokenFile, id: &str) {
        let new = NewToken {
            id: Some(id.to_owned()),
            ..NewToken::new(id, Role::Viewer, "*".parse().unwrap())
        };
        file.create(new, NOW).unwrap();
    }

    #[test]
    fn what_was_added_removed_revoked_and_changed_is_told_apart() {
        let mut before = TokenFile::default();
        for id in ["kept", "gone", "taken-back", "renamed", "good-again"] {
            create(&mut before, id);
        }
        before.revoke("good-again").unwrap();
        assert_eq!(before.change_since(&before), TokenFileChange::default());

        let mut after = before.clone();
        create(&mut after, "new");
        after.remove("gone").unwrap();
        after.revoke("taken-back").unwrap();
        for record in &mut after.tokens {
            match record.id.as_str() {
                "taken-back" | "renamed" => record.name.push_str(" II"),
                "good-again" => record.revoked = false,
                _ => {}
            }
        }
        let expected = TokenFileChange {
            added: vec!["new".to_owned()],
            removed: vec!["gone".to_owned()],
            revoked: vec!["taken-back".to_owned()],
            changed: vec!["renamed".to_owned(), "good-again".to_owned()],
            ..TokenFileChange::default()
        };
        assert_eq!(after.change_since(&before), expected);
    }

    #[test]
    fn another_rule_for_certificates_is_a_change_of_its_own() {
        let before = TokenFile::default();
        let rule = "[[certificate]]\ncommon_name = \"a\"\nrole = \"viewer\"\nsessions = [\"*\"]\n";
        let after = TokenFile::parse(rule).unwrap();
        let expected = TokenFileChange {
            certificates: true,
            ..TokenFileChange::default()
        };
        assert_eq!(after.change_since(&before), expected);
        assert_eq!(before.change_since(&after), expected);
    }
}
