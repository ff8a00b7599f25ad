//! `[tls]`: the certificate that the port shows, and whom it trusts to show one (CONTRACTS S-2).

use serde::{Deserialize, Serialize};

use super::ConfigError;

/// Files of certificates, as PEM; an empty name: none.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Tls {
    /// The server's certificate, then those that lead to its root.
    pub cert: String,
    /// The private key of the first of them.
    pub key: String,
    /// Whose certificates of clients are believed.
    pub client_ca: String,
    /// Certificates of clients that are believed no more.
    pub client_crl: String,
    /// Turn away who shows no certificate; else it is one of two ways to say who one is.
    pub require_client_cert: bool,
}

impl Tls {
    /// Whether the port speaks TLS.
    pub fn is_on(&self) -> bool {
        !self.cert.is_empty()
    }

    pub(super) fn validate(&self) -> Result<(), ConfigError> {
        let needs = [
            ("tls.cert", self.is_on(), "tls.key", self.has_key()),
            ("tls.key", self.has_key(), "tls.cert", self.is_on()),
            (
                "tls.client_ca",
                self.knows_clients(),
                "tls.cert",
                self.is_on(),
            ),
            (
                "tls.client_crl",
                !self.client_crl.is_empty(),
                "tls.client_ca",
                self.knows_clients(),
            ),
            (
                "tls.require_client_cert",
                self.require_client_cert,
                "tls.client_ca",
                self.knows_clients(),
            ),
        ];
        let incomplete = needs
            .into_iter()
            .find(|(_, is_given, _, is_there)| *is_given && !is_there);
        match incomplete {
            Some((given, _, missing, _)) => Err(ConfigError::Incomplete { given, missing }),
            None => Ok(()),
        }
    }

    fn has_key(&self) -> bool {
        !self.key.is_empty()
    }

    fn knows_clients(&self) -> bool {
        !self.client_ca.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(tls: &Tls) -> String {
        tls.validate().unwrap_err().to_string()
    }

    #[test]
    fn a_key_that_is_of_no_use_alone_names_the_other() {
        let named = || "x.pem".to_owned();
        let cert = Tls {
            cert: named(),
            ..Tls::default()
        };
        assert_eq!(
            refusal(&cert),
            "tls.cert is given, tls.key is not: both are needed"
        );
        let key = Tls {
            key: named(),
            ..Tls::default()
        };
        assert!(refusal(&key).contains("tls.cert is not"));
        let ca = Tls {
            client_ca: named(),
            ..Tls::default()
        };
        assert!(refusal(&ca).contains("tls.client_ca is given, tls.cert is not"));
        let required = Tls {
            require_client_cert: true,
            key: named(),
            ..cert
        };
        assert!(refusal(&required).contains("tls.client_ca is not"));
        Tls::default().validate().unwrap();
    }
}
