//! The server: on the loopback alone, with few threads however many pages ask.
//!
//! A page that waits for news is kept as an open request, not as a thread ([`Waiting`]).

use super::desk::Desk;
use super::guard::{Asker, Guard};
use super::routes::{self, Answer};
use crate::failure::{Failure, Outcome, plain};
use std::io::Read;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tiny_http::{Header, Method, Request, Response, Server};

/// Threads that answer.
const THREADS: usize = 2;

/// The longest text that is taken, in bytes of JSON.
const MOST: u64 = 8 * crate::files::MAX_BYTES as u64;

/// How long a page that waits for news is kept waiting.
const PATIENCE: Duration = Duration::from_secs(20);

/// How many may wait; of more the first are told that there is no news.
const WAITING: usize = 32;

/// What no page but this server's own may do with what is answered.
const HEADERS: &[(&str, &str)] = &[
    ("Cache-Control", "no-store"),
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
    ("X-Frame-Options", "DENY"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    // The editor writes its styles into the page.
    (
        "Content-Security-Policy",
        "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; \
         img-src 'self' data:; connect-src 'self'; base-uri 'none'; form-action 'none'; \
         frame-ancestors 'none'",
    ),
];

/// A server that listens.
pub struct Listening {
    server: Server,
    /// Where.
    pub port: u16,
}

/// Listens at a port of this computer; 0 is any that is free.
///
/// # Errors
/// Where the port is taken.
pub fn listen(port: u16) -> Outcome<Listening> {
    let wrong = |why: String| {
        let way = "leave --port out for one that is free";
        Failure::Wrong(format!("cannot listen at port {port}: {why}; {way}"))
    };
    let address = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    let listener = TcpListener::bind(address).map_err(|e| wrong(plain(&e)))?;
    let port = listener.local_addr().map_err(|e| wrong(plain(&e)))?.port();
    let server = Server::from_listener(listener, None).map_err(|e| wrong(e.to_string()))?;
    Ok(Listening { server, port })
}

/// Requests that wait for news, with what they have seen and when they came.
type Waiting = Mutex<Vec<(u64, Instant, Request)>>;

/// What the threads share.
struct Serving {
    server: Server,
    desk: Arc<Desk>,
    guard: Guard,
    waiting: Waiting,
    ends: AtomicBool,
}

/// Threads that serve until this is dropped.
pub struct Threads {
    serving: Arc<Serving>,
    threads: Vec<JoinHandle<()>>,
}

/// Serves a desk.
///
/// # Errors
/// Where no thread can be had.
pub fn serve(listening: Listening, desk: &Arc<Desk>, guard: Guard) -> Outcome<Threads> {
    let serving = Arc::new(Serving {
        server: listening.server,
        desk: desk.clone(),
        guard,
        waiting: Mutex::default(),
        ends: AtomicBool::new(false),
    });
    let mut threads = Vec::new();
    let works: [fn(&Serving); 2] = [Serving::answers, Serving::tells];
    for work in std::iter::repeat_n(works[0], THREADS).chain([works[1]]) {
        let shared = serving.clone();
        let thread = std::thread::Builder::new().spawn(move || work(&shared));
        threads.push(thread.map_err(|e| Failure::Wrong(format!("cannot start a thread: {e}")))?);
    }
    Ok(Threads { serving, threads })
}

impl Drop for Threads {
    fn drop(&mut self) {
        self.serving.ends.store(true, Ordering::SeqCst);
        for _ in 0..THREADS {
            self.serving.server.unblock();
        }
        for thread in self.threads.drain(..) {
            // One that panicked has said so.
            let _ = thread.join();
        }
    }
}

impl Serving {
    fn ends(&self) -> bool {
        self.ends.load(Ordering::SeqCst)
    }

    /// Answers requests.
    fn answers(&self) {
        while !self.ends() {
            if let Ok(Some(request)) = self.server.recv_timeout(Duration::from_millis(100)) {
                self.answer(request);
            }
        }
    }

    fn answer(&self, mut request: Request) {
        let url = request.url().to_owned();
        let header = |name: &'static str| {
            let mut all = request.headers().iter();
            let found = all.find(|header| header.field.equiv(name));
            found.map(|header| header.value.as_str().to_owned())
        };
        let (host, origin) = (header("Host"), header("Origin"));
        let (site, kind) = (header("Sec-Fetch-Site"), header("Content-Type"));
        let asker = Asker {
            path: &url,
            host: host.as_deref(),
            origin: origin.as_deref(),
            site: site.as_deref(),
        };
        let Some(below) = self.guard.admitted(&asker) else {
            return send(request, Answer::text(403, "this page is not yours\n"));
        };
        let (path, query) = below.split_once('?').unwrap_or((below, ""));
        let answer = match request.method() {
            Method::Get if path == "state" => {
                let after = query.strip_prefix("after=").and_then(|n| n.parse().ok());
                return self.news(after.unwrap_or(0), request);
            }
            Method::Get => routes::got(&self.desk, path),
            Method::Post if kind.as_deref() != Some("application/json") => {
                Answer::text(415, "send application/json\n")
            }
            Method::Post => match body(&mut request) {
                Ok(body) => routes::posted(&self.desk, path, &body),
                Err(answer) => answer,
            },
            _ => Answer::text(405, "GET and POST only\n"),
        };
        send(request, answer);
    }

    /// Answers with the state where that is newer, or else keeps the request.
    fn news(&self, after: u64, request: Request) {
        let (version, shown) = self.desk.shown();
        if version != after {
            return send(request, routes::state(version, &shown));
        }
        let mut waiting = self.waiting.lock().unwrap_or_else(|e| e.into_inner());
        waiting.push((after, Instant::now(), request));
        let late = (waiting.len() > WAITING).then(|| waiting.remove(0).2);
        drop(waiting);
        if let Some(late) = late {
            send(late, Answer::text(204, ""));
        }
    }

    /// Tells those that wait what is new.
    fn tells(&self) {
        let mut seen = 0;
        while !self.ends() {
            // Some may have begun to wait since, which the next look finds.
            self.desk.wait(seen, Duration::from_millis(250));
            let (version, shown) = self.desk.shown();
            seen = version;
            let due = |(after, since, _): &mut (u64, Instant, Request)| {
                *after != version || since.elapsed() > PATIENCE
            };
            let mut waiting = self.waiting.lock().unwrap_or_else(|e| e.into_inner());
            let told: Vec<_> = waiting.extract_if(.., due).collect();
            drop(waiting);
            for (after, _, request) in told {
                let answer = match after == version {
                    true => Answer::text(204, ""),
                    false => routes::state(version, &shown),
                };
                send(request, answer);
            }
        }
    }
}

/// What a request brings.
fn body(request: &mut Request) -> Result<Vec<u8>, Answer> {
    let too_long = || Answer::text(413, "this is too long for a scene\n");
    if request.body_length().is_some_and(|n| n as u64 > MOST) {
        return Err(too_long());
    }
    let mut bytes = Vec::new();
    let read = request.as_reader().take(MOST + 1).read_to_end(&mut bytes);
    match read {
        Ok(_) if bytes.len() as u64 > MOST => Err(too_long()),
        Ok(_) => Ok(bytes),
        Err(_) => Err(Answer::text(400, "the request was cut off\n")),
    }
}

/// Answers; a page that has gone away hears nothing.
fn send(request: Request, answer: Answer) {
    let mut response = Response::from_data(answer.bytes).with_status_code(answer.status);
    let kind = ("Content-Type", answer.kind);
    for (name, value) in HEADERS.iter().copied().chain([kind]) {
        if let Ok(header) = Header::from_bytes(name, value) {
            response.add_header(header);
        }
    }
    let _ = request.respond(response);
}
