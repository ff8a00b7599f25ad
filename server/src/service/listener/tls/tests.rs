//! Files that fit, files that do not, and files that change.

use std::{fs, path::Path};

use rcgen::{CertifiedKey, generate_simple_self_signed};
use tempfile::TempDir;

use super::*;

/// A folder with a certificate for these names.
pub(in crate::service::listener) struct Folder(TempDir);

impl Folder {
    pub(in crate::service::listener) fn with(names: &[&str]) -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        folder.write_cert(&certified(names));
        folder
    }

    pub(in crate::service::listener) fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().unwrap().to_owned()
    }

    pub(in crate::service::listener) fn paths(&self) -> config::Tls {
        config::Tls {
            cert: self.path("cert.pem"),
            key: self.path("key.pem"),
            ..config::Tls::default()
        }
    }

    fn write_cert(&self, certified: &CertifiedKey<rcgen::KeyPair>) {
        fs::write(self.path("cert.pem"), certified.cert.pem()).unwrap();
        fs::write(self.path("key.pem"), certified.signing_key.serialize_pem()).unwrap();
    }
}

fn certified(names: &[&str]) -> CertifiedKey<rcgen::KeyPair> {
    let names: Vec<String> = names.iter().map(|it| (*it).to_owned()).collect();
    generate_simple_self_signed(names).unwrap()
}

fn refusal(paths: &config::Tls) -> String {
    chain(&Tls::load(paths).err().unwrap())
}

#[test]
fn a_certificate_vouches_for_its_names_and_one_level_of_its_wildcards() {
    let folder = Folder::with(&["Rig.Example", "*.stage.example", "10.0.0.1"]);
    let tls = Tls::load(&folder.paths()).unwrap();
    for host in ["rig.example", "a.stage.example"] {
        assert!(tls.vouches_for(host), "{host}");
    }
    for host in [
        "stage.example",
        ".stage.example",
        "a.b.stage.example",
        "example",
        "",
    ] {
        assert!(!tls.vouches_for(host), "{host}");
    }
}

#[test]
fn what_is_wrong_with_which_file_is_said() {
    let folder = Folder::with(&["rig.example"]);
    let good = folder.paths();
    let missing = config::Tls {
        cert: folder.path("none.pem"),
        ..good.clone()
    };
    let message = refusal(&missing);
    assert!(message.contains("none.pem cannot be read"), "{message}");

    fs::write(folder.path("text.pem"), "hello").unwrap();
    let no_key = config::Tls {
        key: folder.path("text.pem"),
        ..good.clone()
    };
    let message = refusal(&no_key);
    assert!(
        message.contains("text.pem holds no private key"),
        "{message}"
    );

    let other = certified(&["rig.example"]).signing_key.serialize_pem();
    fs::write(folder.path("other.pem"), other).unwrap();
    let mismatch = config::Tls {
        key: folder.path("other.pem"),
        ..good.clone()
    };
    let message = refusal(&mismatch);
    assert!(
        message.contains("other.pem does not belong to"),
        "{message}"
    );

    let damaged = "-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n";
    fs::write(folder.path("damaged.pem"), damaged).unwrap();
    let authorities = config::Tls {
        client_ca: folder.path("damaged.pem"),
        ..good.clone()
    };
    let message = refusal(&authorities);
    assert!(
        message.contains("damaged.pem is not a certificate"),
        "{message}"
    );

    let huge = fs::File::create(Path::new(&folder.path("huge.pem"))).unwrap();
    huge.set_len(1 << 30).unwrap();
    let too_large = config::Tls {
        cert: folder.path("huge.pem"),
        ..good
    };
    let message = refusal(&too_large);
    assert!(message.contains("huge.pem is larger than"), "{message}");
}

#[test]
fn new_files_are_taken_when_they_fit_and_keep_the_old_ones_when_they_do_not() {
    let folder = Folder::with(&["old.example"]);
    let tls = Tls::load(&folder.paths()).unwrap();
    assert!(matches!(tls.look(None, Occasion::Asked), Look::Same));

    let new = certified(&["new.example"]);
    fs::write(folder.path("cert.pem"), new.cert.pem()).unwrap();
    let Look::Refused { what, error } = tls.look(None, Occasion::Routine) else {
        panic!("a certificate without its key was taken");
    };
    assert!(matches!(error, TlsError::Mismatch { .. }));
    assert_eq!(what.changed_since(tls.current().fingerprint), "tls.cert");
    assert!(tls.vouches_for("old.example"));
    // It is complained about once, and again when somebody asks.
    let refused = Some(what);
    let look = |occasion| tls.look(refused, occasion);
    assert!(matches!(look(Occasion::Routine), Look::StillRefused));
    assert!(matches!(look(Occasion::Asked), Look::Refused { .. }));

    folder.write_cert(&new);
    let Look::New { changed } = look(Occasion::Routine) else {
        panic!("a certificate with its key was not taken");
    };
    assert_eq!(changed, "tls.cert tls.key");
    assert!(tls.vouches_for("new.example") && !tls.vouches_for("old.example"));

    fs::remove_file(folder.path("key.pem")).unwrap();
    let Look::Refused { what, .. } = tls.look(None, Occasion::Routine) else {
        panic!("a missing file was not noticed");
    };
    assert!(matches!(
        tls.look(Some(what), Occasion::Routine),
        Look::StillRefused
    ));
}
