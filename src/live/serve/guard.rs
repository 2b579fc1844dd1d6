//! Who may ask: whoever knows the token, from a page of this server's own.
//!
//! The token keeps other users of the computer out, the check of `Host` names that were made
//! to lead here (DNS rebinding), and that of `Origin` other pages in the user's browser.

use crate::failure::{Failure, Outcome};

/// Bytes of the token.
const BYTES: usize = 16;

/// What requests are held against.
pub struct Guard {
    port: u16,
    token: String,
}

/// Of a request, what tells who asks.
pub struct Asker<'r> {
    /// The path, with its query.
    pub path: &'r str,
    /// The header `Host`.
    pub host: Option<&'r str>,
    /// The header `Origin`.
    pub origin: Option<&'r str>,
    /// The header `Sec-Fetch-Site`, which browsers give.
    pub site: Option<&'r str>,
}

impl Guard {
    /// Of a server at a port of this computer, with a new token.
    ///
    /// # Errors
    /// Where the system has no random numbers.
    pub fn new(port: u16) -> Outcome<Guard> {
        let mut bytes = [0; BYTES];
        getrandom::fill(&mut bytes)
            .map_err(|e| Failure::Wrong(format!("no random numbers for the address: {e}")))?;
        let token = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Guard { port, token })
    }

    /// Where the page is.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    /// The path below the token, where the asker may ask.
    pub fn admitted<'r>(&self, asker: &Asker<'r>) -> Option<&'r str> {
        // Browsers leave out the port that is the usual one.
        let port = match self.port {
            80 => String::new(),
            port => format!(":{port}"),
        };
        let hosts = ["127.0.0.1", "localhost"].map(|name| format!("{name}{port}"));
        let host = asker.host.filter(|host| hosts.iter().any(|h| h == host))?;
        let own = |origin: &str| origin.strip_prefix("http://") == Some(host);
        if !asker.origin.is_none_or(own) || asker.site == Some("cross-site") {
            return None;
        }
        let rest = asker.path.strip_prefix('/')?;
        let (token, below) = rest.split_at_checked(2 * BYTES)?;
        // As long for any wrong token, so that none is found letter by letter.
        let unlike = token.bytes().zip(self.token.bytes());
        let unlike = unlike.fold(0, |all, (a, b)| all | (a ^ b));
        below.strip_prefix('/').filter(|_| unlike == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_its_own_page_is_admitted() {
        let guard = Guard::new(4000).expect("random numbers");
        let path = format!("/{}/state", guard.token);
        let ask = |path: &str, host, origin, site| {
            let asker = Asker {
                path,
                host,
                origin,
                site,
            };
            guard.admitted(&asker).map(str::to_owned)
        };
        let host = Some("127.0.0.1:4000");
        let own = Some("http://127.0.0.1:4000");
        assert_eq!(ask(&path, host, own, None), Some("state".to_owned()));
        assert_eq!(
            ask(&path, host, None, Some("none")),
            Some("state".to_owned())
        );
        let local = Some("localhost:4000");
        assert!(ask(&path, local, Some("http://localhost:4000"), None).is_some());
        for origin in [
            "null",
            "http://127.0.0.1:4001",
            "https://127.0.0.1:4000",
            "",
        ] {
            assert_eq!(ask(&path, host, Some(origin), None), None, "{origin}");
        }
        for host in [None, Some("slowlight.example:4000"), Some("127.0.0.1")] {
            assert_eq!(ask(&path, host, None, None), None, "{host:?}");
        }
        assert_eq!(ask(&path, host, own, Some("cross-site")), None);
        let wrong = format!("/{}/state", "0".repeat(32));
        for path in ["/", "/state", "//state", &wrong, &path[..20], "/é/state"] {
            assert_eq!(ask(path, host, own, None), None, "{path}");
        }
    }
}
