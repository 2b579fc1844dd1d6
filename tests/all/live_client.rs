//! A page that `live` serves, spoken to in plain HTTP.

use serde_json::Value;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// How long anything may take before a test gives up.
const PATIENCE: Duration = Duration::from_secs(120);

/// A page that is served, until this is dropped.
pub struct Live {
    child: Child,
    pub address: String,
    pub port: u16,
    pub token: String,
}

impl Drop for Live {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Live {
    pub fn begin(dir: &Path, args: &[&str]) -> Live {
        let mut child = Command::new(env!("CARGO_BIN_EXE_slowlight"))
            .arg("live")
            .args(args)
            .current_dir(dir)
            .env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"))
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the binary runs");
        let mut address = String::new();
        let mut out = BufReader::new(child.stdout.take().expect("its output"));
        out.read_line(&mut address).expect("an address");
        let address = address.trim().to_owned();
        let rest = address.strip_prefix("http://127.0.0.1:");
        let (port, token) = rest.and_then(|r| r.split_once('/')).expect("an address");
        Live {
            port: port.parse().expect("a port"),
            token: token.trim_end_matches('/').to_owned(),
            address,
            child,
        }
    }

    /// A request, word for word but for its length; the status and what comes back.
    pub fn ask(&self, method: &str, path: &str, headers: &str, body: &str) -> (u16, Vec<u8>) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("it listens");
        let length = body.len();
        let head = format!(
            "{method} {path} HTTP/1.1\r\n{headers}Content-Length: {length}\r\nConnection: close\r\n\r\n"
        );
        stream.write_all(head.as_bytes()).expect("it reads");
        stream.write_all(body.as_bytes()).expect("it reads");
        let mut all = Vec::new();
        stream.read_to_end(&mut all).expect("it answers");
        let end = all.windows(4).position(|w| w == b"\r\n\r\n");
        let body = all.split_off(end.expect("a head") + 4);
        let head = String::from_utf8(all).expect("text");
        let status = head.split(' ').nth(1).and_then(|s| s.parse().ok());
        (status.expect("a status"), body)
    }

    pub fn own_headers(&self) -> String {
        let host = format!("127.0.0.1:{}", self.port);
        format!("Host: {host}\r\nOrigin: http://{host}\r\n")
    }

    pub fn get(&self, path: &str) -> (u16, Vec<u8>) {
        let path = format!("/{}/{path}", self.token);
        self.ask("GET", &path, &self.own_headers(), "")
    }

    pub fn post(&self, path: &str, body: &Value) -> (u16, Value) {
        let path = format!("/{}/{path}", self.token);
        let headers = self.own_headers() + "Content-Type: application/json\r\n";
        let (status, body) = self.ask("POST", &path, &headers, &body.to_string());
        (status, serde_json::from_slice(&body).unwrap_or(Value::Null))
    }

    /// An edit that is taken; the number of the wish.
    pub fn edit(&self, mut edit: Value) -> u64 {
        edit["page"] = "test".into();
        let (status, said) = self.post("edit", &edit);
        assert_eq!(status, 200, "{said}");
        said["serial"].as_u64().expect("a number")
    }

    pub fn state(&self, after: u64) -> (u64, Value) {
        let (status, body) = self.get(&format!("state?after={after}"));
        assert_eq!(status, 200);
        let mut said: Value = serde_json::from_slice(&body).expect("JSON");
        (
            said["version"].as_u64().expect("a number"),
            said["shown"].take(),
        )
    }

    /// The first state for which something holds.
    pub fn until(&self, what: &str, holds: impl Fn(&Value) -> bool) -> Value {
        let begun = Instant::now();
        let mut seen = 0;
        loop {
            let (version, shown) = self.state(seen);
            if holds(&shown) {
                return shown;
            }
            assert!(begun.elapsed() < PATIENCE, "{what}: {shown:#}");
            seen = version;
        }
    }

    pub fn drawn(&self, serial: u64) -> Value {
        self.until("a native picture", |shown| {
            shown["native"]["serial"] == serial && shown["native"]["stage"] == "done"
        })
    }

    pub fn run(&self, serial: u64) -> Value {
        self.until("a machine's picture", |shown| is_run(shown, 0, serial))
    }

    /// Threads of the process by name.
    #[cfg(target_os = "linux")]
    pub fn threads(&self) -> Vec<String> {
        let tasks = std::fs::read_dir(format!("/proc/{}/task", self.child.id()));
        let name = |entry: std::io::Result<std::fs::DirEntry>| {
            std::fs::read_to_string(entry.ok()?.path().join("comm")).ok()
        };
        let names = tasks.expect("threads").filter_map(name);
        names.map(|name| name.trim().to_owned()).collect()
    }

    #[cfg(unix)]
    pub fn interrupted(mut self) -> ExitStatus {
        let id = self.child.id().to_string();
        let kill = Command::new("kill").args(["-INT", &id]).status();
        assert!(kill.expect("kill runs").success());
        self.child.wait().expect("it ends")
    }
}

/// Whether a machine has run its program for a wish.
pub fn is_run(shown: &Value, panel: usize, serial: u64) -> bool {
    let machine = &shown["panels"][panel]["machine"];
    machine["serial"] == serial && machine["stage"] == "done"
}
