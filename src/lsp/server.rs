//! The server's loop: one message after the other, and what is to be done where none waits.
//!
//! Edits are taken in as they come and looked at when no more of them wait, so a newer one
//! supersedes what an older one would have asked for. A request is answered of the newest
//! text. What panics in spite of all is one answer lost.

use super::inlay::Inlays;
use super::requests::{Answer, answer, params, refused, value};
use super::settings;
use super::state::State;
use super::wire::{self, Event};
use crate::failure::{Failure, Outcome};
use crate::interrupt;
use crossbeam_channel::{Receiver, Sender, never, select};
use lsp_server::{ErrorCode, Message, Notification, Request, RequestId, Response};
use lsp_types::notification::{self as told, Notification as Told};
use lsp_types::request::{self as asked, Request as Asked};
use lsp_types::{MessageType, PublishDiagnosticsParams, ShowMessageParams};
use serde::Deserialize;
use serde_json::{Value, json};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// How long an edit waits for others before it is looked at, and before it is looked at
/// closely, at least; and how long the first of several waits at most.
const SETTLE: Duration = Duration::from_millis(10);
const CALM: Duration = Duration::from_millis(60);
const PATIENCE: Duration = Duration::from_millis(400);

/// The server.
struct Server {
    state: State,
    inlays: Inlays,
    out: Sender<String>,
    /// What the client said that it can do.
    client: Value,
    initialized: bool,
    stopped: bool,
    /// When the oldest edit came that was not looked at.
    waiting: Option<Instant>,
    asked: i32,
}

/// Serves an editor on standard input and output until it ends.
///
/// # Errors
/// Where the editor goes away without saying so first.
pub fn serve() -> Outcome<()> {
    // Nothing here looks whether Ctrl-C was pressed, and nothing is left half-done by it.
    let _blind = interrupt::blind();
    let events = wire::read(std::io::BufReader::new(std::io::stdin()));
    let (out, writer) = wire::write(std::io::stdout());
    let mut server = Server {
        state: State::default(),
        inlays: Inlays::default(),
        out,
        client: Value::Null,
        initialized: false,
        stopped: false,
        waiting: None,
        asked: 0,
    };
    server.run(&events);
    let stopped = server.stopped;
    drop(server);
    // What was said is written before the process ends.
    let _ = writer.join();
    match stopped {
        true => Ok(()),
        false => Err(Failure::Wrong(
            "the editor ended without `shutdown`".to_owned(),
        )),
    }
}

impl Server {
    fn run(&mut self, events: &Receiver<Event>) {
        loop {
            let told = match self.initialized {
                true => self.inlays.told.clone(),
                false => never(),
            };
            let wait = self.wait();
            select! {
                recv(events) -> event => match event {
                    Ok(Event::Message(message)) => {
                        if !self.message(*message) {
                            return;
                        }
                    }
                    Ok(Event::Unreadable(why)) => {
                        let error = refused(ErrorCode::ParseError, why);
                        self.send_value(json!({"id": null, "error": error}));
                    }
                    Err(_) => return,
                },
                recv(told) -> done => match done.map(|done| self.inlays.done(done)) {
                    Ok(Ok(true)) => self.refresh_hints(),
                    Ok(Err(why)) => self.log(&format!("not measured: {}", why.trim())),
                    _ => {}
                },
                default(wait) => self.idle(),
            }
        }
    }

    /// How long nothing has to be done.
    fn wait(&self) -> Duration {
        let look = self.waiting.map(|since| {
            let least = if self.state.is_dirty() { SETTLE } else { CALM };
            least.min(PATIENCE.saturating_sub(since.elapsed()))
        });
        let all = [look, self.inlays.due()];
        let next = all.into_iter().flatten().min();
        next.unwrap_or(Duration::from_secs(3600))
    }

    fn idle(&mut self) {
        let late = (self.waiting).is_some_and(|since| since.elapsed() >= PATIENCE);
        if self.waiting.is_some() {
            self.look(late || !self.state.is_dirty());
        }
        if self.inlays.due() == Some(Duration::ZERO) {
            let begun = catch_unwind(AssertUnwindSafe(|| self.inlays.begin(&self.state)));
            if begun.is_err() {
                self.log("a mistake of slowlight's: a text could not be measured");
            }
        }
    }

    /// Looks at what was edited, closely or not, and says what is to be said of it.
    fn look(&mut self, closely: bool) {
        let found = catch_unwind(AssertUnwindSafe(|| {
            let mut said = self.state.refresh();
            if closely {
                said.extend(self.state.finish());
            }
            said
        }));
        if !self.state.is_unsaid() {
            self.waiting = None;
        }
        match found {
            Ok(said) => said.into_iter().for_each(|one: PublishDiagnosticsParams| {
                self.notify::<told::PublishDiagnostics>(one);
            }),
            Err(_) => self.log("a mistake of slowlight's: a text could not be looked at"),
        }
    }

    fn touched(&mut self) {
        self.waiting.get_or_insert_with(Instant::now);
    }

    /// Takes a message in; answers whether the server goes on.
    fn message(&mut self, message: Message) -> bool {
        match message {
            Message::Request(request) => self.request(request),
            Message::Notification(one) if one.method == told::Exit::METHOD => return false,
            Message::Notification(one) => self.notification(&one),
            Message::Response(response) => self.response(response),
        }
        true
    }

    fn request(&mut self, request: Request) {
        let id = request.id.clone();
        let found = match request.method.as_str() {
            _ if self.stopped => Err(refused(
                ErrorCode::InvalidRequest,
                "the server was shut down",
            )),
            asked::Initialize::METHOD if !self.initialized => Ok(self.initialize(&request)),
            asked::Initialize::METHOD => Err(refused(
                ErrorCode::InvalidRequest,
                "`initialize` comes once",
            )),
            _ if !self.initialized => Err(refused(
                ErrorCode::ServerNotInitialized,
                "`initialize` comes first",
            )),
            asked::Shutdown::METHOD => {
                self.stopped = true;
                Ok(Value::Null)
            }
            _ => {
                let closely = request.method == asked::DocumentDiagnosticRequest::METHOD;
                if self.state.is_dirty() || closely {
                    self.look(closely);
                }
                let found = catch_unwind(AssertUnwindSafe(|| self.about_texts(&request)));
                found.unwrap_or_else(|_| {
                    Err(refused(
                        ErrorCode::InternalError,
                        "a mistake of slowlight's",
                    ))
                })
            }
        };
        self.respond(id, found);
    }

    fn about_texts(&self, request: &Request) -> Answer {
        if request.method == asked::InlayHintRequest::METHOD {
            let asked = params::<asked::InlayHintRequest>(request)?;
            let uri = &asked.text_document.uri;
            let at = self.state.at(uri, asked.range.start);
            return value(at.map(|at| self.inlays.hints(at, uri, asked.range)));
        }
        if request.method == asked::DocumentDiagnosticRequest::METHOD {
            let asked = params::<asked::DocumentDiagnosticRequest>(request)?;
            let items = self.state.shown(&asked.text_document.uri);
            return value(json!({ "kind": "full", "items": items }));
        }
        let found = answer(&self.state, request);
        found.unwrap_or_else(|| {
            let message = format!("there is no `{}` here", request.method);
            Err(refused(ErrorCode::MethodNotFound, message))
        })
    }

    fn initialize(&mut self, request: &Request) -> Value {
        self.initialized = true;
        self.client = request.params["capabilities"].clone();
        self.set(&request.params["initializationOptions"]);
        json!({
            "capabilities": settings::capabilities(),
            "serverInfo": { "name": "slowlight", "version": env!("CARGO_PKG_VERSION") },
        })
    }

    /// Takes settings in; what they say wrong is said.
    fn set(&mut self, given: &Value) {
        match settings::target(given) {
            Ok(target) => {
                let open = self.state.documents.values().map(|d| &d.uri);
                self.inlays.measure_for(target, open);
            }
            Err(why) => self.notify::<told::ShowMessage>(ShowMessageParams {
                typ: MessageType::WARNING,
                message: why,
            }),
        }
    }

    /// Asks the client for the settings, where it has them to give.
    fn ask_settings(&mut self) {
        if self.client["workspace"]["configuration"] == true {
            let params = json!({ "items": [{ "section": "slowlight" }] });
            self.ask(
                settings::ASKED,
                asked::WorkspaceConfiguration::METHOD,
                params,
            );
        }
    }

    fn refresh_hints(&mut self) {
        if self.client["workspace"]["inlayHint"]["refreshSupport"] == true {
            self.ask("hints", asked::InlayHintRefreshRequest::METHOD, Value::Null);
        }
    }

    fn ask(&mut self, about: &str, method: &str, params: Value) {
        self.asked += 1;
        let id = RequestId::from(format!("{about} {}", self.asked));
        let request = Request {
            id,
            method: method.to_owned(),
            params,
        };
        self.send(Message::Request(request));
    }

    fn response(&mut self, response: Response) {
        // `"settings 3"`, as it was asked.
        let about = response.id.to_string();
        if about.trim_matches('"').starts_with(settings::ASKED)
            && let Ok(Value::Array(given)) = response.response_result
            // Editors that were given settings only at the start have none to say.
            && let Some(first) = given.first().filter(|first| !first.is_null())
        {
            self.set(first);
        }
    }

    fn notification(&mut self, one: &Notification) {
        if !self.initialized || self.stopped {
            return;
        }
        match one.method.as_str() {
            told::Initialized::METHOD => self.ask_settings(),
            told::DidOpenTextDocument::METHOD => {
                if let Some(p) = read::<told::DidOpenTextDocument>(one) {
                    let of = p.text_document;
                    self.inlays.edited(&of.uri);
                    self.state.open(of.uri, of.text, of.version);
                    self.touched();
                }
            }
            told::DidChangeTextDocument::METHOD => {
                if let Some(p) = read::<told::DidChangeTextDocument>(one) {
                    let of = p.text_document;
                    self.inlays.edited(&of.uri);
                    self.state.change(&of.uri, of.version, p.content_changes);
                    self.touched();
                }
            }
            told::DidCloseTextDocument::METHOD => {
                if let Some(p) = read::<told::DidCloseTextDocument>(one) {
                    self.inlays.closed(&p.text_document.uri);
                    self.state.close(&p.text_document.uri);
                    self.touched();
                }
            }
            told::DidSaveTextDocument::METHOD => {
                if let Some(p) = read::<told::DidSaveTextDocument>(one) {
                    let users = self.state.users(&p.text_document.uri);
                    users.iter().for_each(|uri| self.inlays.edited(uri));
                }
            }
            told::DidChangeWatchedFiles::METHOD => {
                if let Some(p) = read::<told::DidChangeWatchedFiles>(one) {
                    for change in &p.changes {
                        let users = self.state.users(&change.uri);
                        users.iter().for_each(|uri| self.inlays.edited(uri));
                        self.state.changed_on_disk(&change.uri);
                    }
                    self.touched();
                }
            }
            told::DidChangeConfiguration::METHOD => {
                if let Some(p) = read::<told::DidChangeConfiguration>(one) {
                    match p.settings["slowlight"].is_null() && p.settings["target"].is_null() {
                        true => self.ask_settings(),
                        false => self.set(&p.settings),
                    }
                }
            }
            _ => {}
        }
    }

    fn respond(&self, id: RequestId, answer: Answer) {
        let response_result = answer;
        self.send(Message::Response(Response {
            id,
            response_result,
        }));
    }

    fn notify<N: Told>(&self, params: N::Params) {
        self.send(Message::Notification(Notification {
            method: N::METHOD.to_owned(),
            params: serde_json::to_value(params).unwrap_or_default(),
        }));
    }

    fn log(&self, message: &str) {
        self.notify::<told::LogMessage>(lsp_types::LogMessageParams {
            typ: MessageType::INFO,
            message: message.to_owned(),
        });
    }

    fn send(&self, message: Message) {
        self.send_value(serde_json::to_value(message).unwrap_or_default());
    }

    fn send_value(&self, mut message: Value) {
        if let Some(parts) = message.as_object_mut() {
            parts.insert("jsonrpc".to_owned(), "2.0".into());
        }
        // The writer is gone where the client is.
        let _ = self.out.send(message.to_string());
    }
}

/// What a notification says; nothing where it is not what the protocol says.
fn read<N: Told>(one: &Notification) -> Option<N::Params> {
    N::Params::deserialize(&one.params).ok()
}
