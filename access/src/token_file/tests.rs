//! The token file as a whole: what goes in comes out, and what must not pass does not.

use std::time::Duration;

use proptest::prelude::*;

use super::*;

const NOW: UnixTime = UnixTime::from_secs(1_800_000_000);

fn publisher() -> NewToken {
    NewToken::new("Stage A", Role::Publisher, "stage-a-*".parse().unwrap())
}

fn refusal(text: &str) -> String {
    TokenFile::parse(text).unwrap_err().to_string()
}

#[test]
fn a_token_opens_until_it_expires_or_is_revoked() {
    let mut file = TokenFile::default();
    let until = NOW.after(Duration::from_mins(1));
    let new = NewToken {
        expire_time: Some(until),
        ..publisher()
    };
    let token = file.create(new, NOW).unwrap();
    let presented = token.reveal().as_bytes();
    let principal = file.authenticate(presented, NOW).unwrap();
    assert_eq!(
        (principal.role, principal.name.as_str()),
        (Role::Publisher, "Stage A")
    );
    assert!(file.still_stands(&principal, NOW));

    let refused = file.authenticate(presented, until).unwrap_err();
    assert_eq!(refused.why, "the token expired");
    assert_eq!(refused.to_string(), "a valid token is needed");
    assert!(!file.still_stands(&principal, until));

    let id = file.tokens()[0].id.clone();
    file.revoke(&id).unwrap();
    let refused = file.authenticate(presented, NOW).unwrap_err();
    assert_eq!(
        (refused.why, refused.token_id),
        ("the token is revoked", Some(id))
    );
    assert!(!file.still_stands(&principal, NOW));
}

#[test]
fn a_changed_right_or_a_removed_entry_ends_what_rests_on_it() {
    let mut file = TokenFile::default();
    let token = file.create(publisher(), NOW).unwrap();
    let principal = file.authenticate(token.reveal().as_bytes(), NOW).unwrap();
    let text = file.to_toml();
    let same = TokenFile::parse(&text).unwrap();
    assert!(same.still_stands(&principal, NOW));
    let narrowed = TokenFile::parse(&text.replace("stage-a-*", "stage-a-1")).unwrap();
    assert!(!narrowed.still_stands(&principal, NOW));
    assert!(!TokenFile::default().still_stands(&principal, NOW));
}

#[test]
fn a_rule_for_certificates_says_in_one_way_whom_it_means() {
    let rest = "role = \"renderer\"\nsessions = [\"*\"]\n";
    let entry = |names: &str| format!("[[certificate]]\n{names}\n{rest}");
    for names in ["common_name = \"a\"", "subject = \"O=Stage, CN=a\""] {
        let file = TokenFile::parse(&entry(names)).unwrap();
        assert_eq!(TokenFile::parse(&file.to_toml()), Ok(file));
    }
    let one = "exactly one of common_name and subject";
    for names in ["", "common_name = \"a\"\nsubject = \"CN=a\""] {
        let message = refusal(&entry(names));
        assert!(message.contains(one), "{message}");
    }
    let empty = refusal(&entry("subject = \"\""));
    assert!(empty.contains("subject is empty"), "{empty}");
}

#[test]
fn a_file_that_is_wrong_says_what_and_where() {
    let mut file = TokenFile::default();
    file.create(publisher(), NOW).unwrap();
    let good = file.to_toml();
    let cases = [
        (
            "role = \"publisher\"",
            "role = \"admin\"",
            "line 4, [[token]]: a role is",
        ),
        ("sha256:", "md5:", "line 4, [[token]]: hash is not"),
        (
            "[\"stage-a-*\"]",
            "[\"Stage\"]",
            "line 4, [[token]]: sessions: entry 1",
        ),
        (
            "[\"stage-a-*\"]",
            "[]",
            "line 4, [[token]]: sessions: a scope names",
        ),
        (
            "2027-01-15T08:00:00Z",
            "2027-01-15",
            "line 4, [[token]]: create_time is no time",
        ),
        ("name = ", "nmae = ", "line 6: unknown field `nmae`"),
        ("[[token]]", "[[token]", "line 4: "),
        (
            "\"Stage A\"",
            "\"\"",
            "line 4, [[token]]: a token's name has",
        ),
    ];
    for (from, to, expected) in cases {
        assert!(good.contains(from), "{from}");
        let text = refusal(&good.replace(from, to));
        assert!(text.starts_with(expected), "{to}: {text}");
    }
    let operator = good.replace("publisher", "operator");
    assert!(refusal(&operator).contains("an operator has every session"));
    let twice = format!("{good}{}", good.replace("[[token]]", "\n[[token]]"));
    assert!(
        refusal(&twice).contains("there is a token of this id"),
        "{}",
        refusal(&twice)
    );
}

#[test]
fn a_refusal_of_a_file_never_repeats_what_is_in_it() {
    let token = Token::generate().unwrap();
    let secret = token.reveal();
    for text in [
        format!("[[token]]\nhash = \"{secret}\"\n"),
        format!("{secret}\n"),
        format!("[[token]]\n{secret} = 1\n"),
    ] {
        let refused = refusal(&text);
        // The name of an unknown key is repeated: it is what the writer must find. Values are not.
        if !text.contains(" = 1") {
            assert!(!refused.contains(secret), "{refused}");
        }
    }
}

#[test]
fn an_overlong_token_is_refused_and_costs_no_more_than_a_long_one() {
    let mut file = TokenFile::default();
    file.create(publisher(), NOW).unwrap();
    let refused = file.authenticate(&vec![b'a'; 1 << 20], NOW).unwrap_err();
    assert_eq!(refused.why, "longer than any token");
}

#[test]
fn ids_are_unique_and_what_cannot_be_is_not_made() {
    let mut file = TokenFile::default();
    let named = NewToken {
        id: Some("stage-a".to_owned()),
        ..publisher()
    };
    file.create(named.clone(), NOW).unwrap();
    assert_eq!(file.create(named, NOW), Err(CreateError::Exists));
    let past = NewToken {
        expire_time: Some(NOW),
        ..publisher()
    };
    assert_eq!(
        file.create(past, NOW),
        Err(CreateError::Expired { at: NOW })
    );
    let images = NewToken {
        images: true,
        ..publisher()
    };
    assert_eq!(file.create(images, NOW), Err(CreateError::Images));
    let narrow = NewToken::new("x", Role::Operator, "a".parse().unwrap());
    assert_eq!(file.create(narrow, NOW), Err(CreateError::OperatorScope));
    for name in ["\u{1b}[31m", "a\u{202e}b"] {
        let hostile = NewToken::new(name, Role::Viewer, Scope::all());
        assert_eq!(file.create(hostile, NOW), Err(CreateError::Name));
    }
    assert_eq!(file.tokens().len(), 1);
    assert_eq!(file.revoke("nobody"), Err(NoSuchToken));
}

fn any_token() -> impl Strategy<Value = (NewToken, [u8; 32])> {
    let role = proptest::sample::select(Role::ALL.to_vec());
    let entries = proptest::collection::vec("[a-z0-9][a-z0-9_-]{0,10}\\*?", 1..4);
    let expiry = proptest::option::of(1_i64..1_000_000_000);
    let rights = (role, entries, any::<bool>());
    // Neither what steers a terminal nor what breaks a line or turns its direction.
    let name = r"[^\p{Cc}\x{61c}\x{200e}\x{200f}\x{2028}-\x{202e}\x{2066}-\x{2069}]{1,64}";
    (name, rights, expiry, any::<[u8; 32]>()).prop_map(
        |(name, (role, entries, images), expiry, random)| {
            let is_operator = role == Role::Operator;
            let scope = Scope::new(&entries).unwrap();
            let new = NewToken {
                id: None,
                name,
                role,
                scope: if is_operator { Scope::all() } else { scope },
                images: is_operator && images,
                expire_time: expiry.map(|it| UnixTime::from_secs(NOW.secs() + it)),
            };
            (new, random)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_file_reads_back_from_what_it_prints(
        tokens in proptest::collection::vec(any_token(), 0..6),
        revoked: bool,
    ) {
        let mut file = TokenFile::default();
        for (new, random) in tokens {
            file.add(new, &Token::from_bytes(&random), NOW).unwrap();
        }
        if let (true, Some(first)) = (revoked, file.tokens().first()) {
            let id = first.id.clone();
            file.revoke(&id).unwrap();
        }
        prop_assert_eq!(TokenFile::parse(&file.to_toml()), Ok(file));
    }

    #[test]
    fn no_text_makes_the_reader_panic(text in "\\PC{0,200}", token in any::<Vec<u8>>()) {
        let _outcome = TokenFile::parse(&text);
        let _refused = TokenFile::default().authenticate(&token, NOW).unwrap_err();
    }

    #[test]
    fn only_the_token_itself_opens(made: [u8; 32], other: [u8; 32], cut in 0_usize..53) {
        let mut file = TokenFile::default();
        let token = Token::from_bytes(&made);
        file.add(publisher(), &token, NOW).unwrap();
        let opens = |it: &str| file.authenticate(it.as_bytes(), NOW).is_ok();
        prop_assert!(opens(token.reveal()));
        prop_assert_eq!(opens(Token::from_bytes(&other).reveal()), other == made);
        prop_assert!(!opens(&token.reveal()[..cut]));
        prop_assert!(!opens(&token.hash().to_text()));
    }
}
