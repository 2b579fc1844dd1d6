//! An editor's end of the language server.

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// How long the server may be silent.
const PATIENCE: Duration = Duration::from_secs(120);

/// A server, and an editor's end of it.
pub struct Client {
    child: Child,
    input: Option<ChildStdin>,
    messages: Receiver<Value>,
    asked: i64,
    /// Diagnostics as they were last published, by address.
    pub shown: BTreeMap<String, Value>,
    /// The versions that these are of.
    pub versions: BTreeMap<String, i64>,
    /// All other notifications and requests of the server.
    pub told: Vec<Value>,
}

impl Client {
    /// A server that nothing was said to.
    pub fn spawn(cache: &Path) -> Client {
        let mut child = Command::new(env!("CARGO_BIN_EXE_slowlight"))
            .arg("lsp")
            .env("XDG_CACHE_HOME", cache)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the binary runs");
        let (sender, messages) = channel();
        let mut output = BufReader::new(child.stdout.take().expect("an output"));
        std::thread::spawn(move || {
            loop {
                let mut length = 0;
                loop {
                    let mut line = String::new();
                    if output.read_line(&mut line).unwrap_or(0) == 0 {
                        return;
                    }
                    match line.trim().strip_prefix("Content-Length:") {
                        Some(value) => length = value.trim().parse().expect("a length"),
                        None => break,
                    }
                }
                let mut body = vec![0; length];
                output.read_exact(&mut body).expect("a whole message");
                let message: Value = serde_json::from_slice(&body).expect("messages are JSON");
                assert_eq!(message["jsonrpc"], "2.0");
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        Client {
            input: child.stdin.take(),
            child,
            messages,
            asked: 0,
            shown: BTreeMap::new(),
            versions: BTreeMap::new(),
            told: Vec::new(),
        }
    }

    /// A server that has been told what the editor can do, and is set.
    pub fn start(cache: &Path, settings: Value) -> Client {
        let mut client = Client::spawn(cache);
        let abilities = json!({"workspace": {"inlayHint": {"refreshSupport": true}}});
        let said = client.ask(
            "initialize",
            json!({"capabilities": abilities, "initializationOptions": settings}),
        );
        assert_eq!(said["serverInfo"]["name"], "slowlight");
        client.tell("initialized", json!({}));
        client
    }

    /// Sends bytes as they are.
    pub fn raw(&mut self, text: &str) {
        let input = self.input.as_mut().expect("an input");
        input.write_all(text.as_bytes()).expect("the server reads");
    }

    fn send(&mut self, message: &Value) {
        let body = message.to_string();
        self.raw(&format!("Content-Length: {}\r\n\r\n{body}", body.len()));
    }

    /// Notifies.
    pub fn tell(&mut self, method: &str, params: Value) {
        self.send(&json!({"jsonrpc": "2.0", "method": method, "params": params}));
    }

    /// The next message of the server, which is kept if it is no response.
    pub fn next(&mut self) -> Value {
        let message = self
            .messages
            .recv_timeout(PATIENCE)
            .expect("the server lives");
        if message["method"] == "textDocument/publishDiagnostics" {
            let uri = message["params"]["uri"]
                .as_str()
                .expect("an address")
                .to_owned();
            let version = message["params"]["version"].as_i64().unwrap_or(0);
            self.versions.insert(uri.clone(), version);
            self.shown
                .insert(uri, message["params"]["diagnostics"].clone());
        } else if message["method"].is_string() {
            self.told.push(message.clone());
        }
        message
    }

    /// Asks; the whole response.
    pub fn response(&mut self, method: &str, params: Value) -> Value {
        self.asked += 1;
        let id = self.asked;
        self.send(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}));
        loop {
            let message = self.next();
            if message["id"] == id && message["method"].is_null() {
                return message;
            }
        }
    }

    /// Asks for what must be given.
    pub fn ask(&mut self, method: &str, params: Value) -> Value {
        let found = self.response(method, params);
        assert!(found["error"].is_null(), "{method}: {found}");
        found["result"].clone()
    }

    /// Why something is refused.
    pub fn refused(&mut self, method: &str, params: Value) -> String {
        let found = self.response(method, params);
        let why = found["error"]["message"].as_str().map(str::to_owned);
        why.unwrap_or_else(|| panic!("{method}: {found}"))
    }

    /// Opens a text.
    pub fn open(&mut self, uri: &str, text: &str) {
        let of = json!({"uri": uri, "languageId": "slowlight", "version": 1, "text": text});
        self.tell("textDocument/didOpen", json!({"textDocument": of}));
    }

    /// Changes it as a whole.
    pub fn change(&mut self, uri: &str, version: i64, text: &str) {
        let of = json!({"uri": uri, "version": version});
        let params = json!({"textDocument": of, "contentChanges": [{"text": text}]});
        self.tell("textDocument/didChange", params);
    }

    /// What is shown of a text, once all that was sent is looked at.
    pub fn diagnostics(&mut self, uri: &str) -> Vec<Value> {
        let of = json!({"textDocument": {"uri": uri}});
        let given = self.ask("textDocument/diagnostic", of);
        let shown = self.shown.get(uri).and_then(Value::as_array);
        let shown = shown.cloned().unwrap_or_default();
        assert_eq!(given["items"], json!(shown));
        shown
    }

    /// Ends the server as an editor does; its exit status.
    pub fn stop(mut self) -> Option<i32> {
        assert_eq!(self.ask("shutdown", Value::Null), Value::Null);
        self.refused("textDocument/hover", Value::Null);
        self.tell("exit", Value::Null);
        drop(self.input.take());
        self.child.wait().expect("it ends").code()
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        // A test that fails leaves none behind.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A place in a text: that of the first byte of the `nth` occurrence of a part, from 0, and
/// so many units on.
pub fn place(text: &str, part: &str, nth: usize, on: u32) -> Value {
    let (at, _) = text
        .match_indices(part)
        .nth(nth)
        .unwrap_or_else(|| panic!("{part}"));
    let before = &text[..at];
    let line = before.matches('\n').count();
    let start = before.rfind('\n').map_or(0, |k| k + 1);
    let units = u32::try_from(before[start..].encode_utf16().count()).expect("a short line");
    json!({"line": line, "character": units + on})
}

/// The place behind the first occurrence of a part.
pub fn behind(text: &str, part: &str) -> Value {
    let at = text.find(part).unwrap_or_else(|| panic!("{part}")) + part.len();
    let marked = format!("{}\0", &text[..at]);
    place(&marked, "\0", 0, 0)
}

/// The address of a file.
pub fn uri(path: &Path) -> String {
    let path = path.canonicalize().expect("a path");
    format!("file://{}", path.display())
}
