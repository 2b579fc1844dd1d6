//! The server: on the loopback alone, one thread for however many pages ask.

use super::desk::Desk;
use super::guard::{Asker, Guard};
use super::routes::{self, Answer};
use crate::failure::{Failure, Outcome, plain};
use http_body_util::{BodyExt, Full, Limited};
use hyper::body::{Bytes, Incoming};
use hyper::header::{self, HeaderName, HeaderValue};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::{HeaderMap, Method, Request, Response, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use std::convert::Infallible;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;
use tokio::sync::oneshot;

/// The longest text that is taken, in bytes of JSON.
const MOST: usize = 8 * crate::files::MAX_BYTES;

/// How long a page that waits for news is kept waiting.
const PATIENCE: Duration = Duration::from_secs(20);

/// How long a connection on which nothing is asked stays open.
const IDLE: Duration = Duration::from_secs(30);

/// How long to wait where the system takes no more connections.
const CROWDED: Duration = Duration::from_millis(100);

/// What no page but this server's own may do with what is answered.
const HEADERS: &[(&str, &str)] = &[
    ("cache-control", "no-store"),
    ("x-content-type-options", "nosniff"),
    ("referrer-policy", "no-referrer"),
    ("x-frame-options", "DENY"),
    ("cross-origin-resource-policy", "same-origin"),
    ("cross-origin-opener-policy", "same-origin"),
    // The editor writes its styles into the page.
    (
        "content-security-policy",
        "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; \
         img-src 'self' data:; connect-src 'self'; base-uri 'none'; form-action 'none'; \
         frame-ancestors 'none'",
    ),
];

/// A server that listens.
pub struct Listening {
    listener: TcpListener,
    /// Where.
    pub port: u16,
}

/// Listens at a port of this computer; 0 is any that is free.
///
/// # Errors
/// Where the port is taken.
pub fn listen(port: u16) -> Outcome<Listening> {
    let wrong = |e: std::io::Error| {
        let (why, way) = (plain(&e), "leave --port out for one that is free");
        Failure::Wrong(format!("cannot listen at port {port}: {why}; {way}"))
    };
    let address = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    let listener = TcpListener::bind(address).map_err(wrong)?;
    // As the runtime wants it.
    listener.set_nonblocking(true).map_err(wrong)?;
    let port = listener.local_addr().map_err(wrong)?.port();
    Ok(Listening { listener, port })
}

/// A thread that serves until this is dropped.
pub struct Serving {
    ends: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Drop for Serving {
    fn drop(&mut self) {
        drop(self.ends.take());
        if let Some(thread) = self.thread.take() {
            // Where it panicked, it has said so.
            let _ = thread.join();
        }
    }
}

/// Serves a desk.
///
/// # Errors
/// Where the system gives no thread.
pub fn serve(listening: Listening, desk: &Arc<Desk>, guard: Guard) -> Outcome<Serving> {
    let wrong = |e: std::io::Error| Failure::Wrong(format!("cannot serve: {}", plain(&e)));
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_io()
        .enable_time()
        .build()
        .map_err(wrong)?;
    let (desk, guard) = (desk.clone(), Arc::new(guard));
    let (ends, ended) = oneshot::channel();
    let work = move || {
        runtime.block_on(async {
            if let Ok(listener) = tokio::net::TcpListener::from_std(listening.listener) {
                tokio::spawn(accepts(listener, desk, guard));
                // The sender says nothing: it is dropped.
                let _ = ended.await;
            }
        });
    };
    let thread = std::thread::Builder::new().name("page".to_owned());
    Ok(Serving {
        ends: Some(ends),
        thread: Some(thread.spawn(work).map_err(wrong)?),
    })
}

/// Takes connections, and answers what is asked on each.
async fn accepts(listener: tokio::net::TcpListener, desk: Arc<Desk>, guard: Arc<Guard>) {
    loop {
        let Ok((stream, _)) = listener.accept().await else {
            tokio::time::sleep(CROWDED).await;
            continue;
        };
        let (desk, guard) = (desk.clone(), guard.clone());
        let service = service_fn(move |request| {
            let (desk, guard) = (desk.clone(), guard.clone());
            async move { Ok::<_, Infallible>(response(answer(&desk, &guard, request).await)) }
        });
        let mut builder = http1::Builder::new();
        builder.timer(TokioTimer::new()).header_read_timeout(IDLE);
        let connection = builder.serve_connection(TokioIo::new(stream), service);
        // One that breaks off has nobody to be told.
        tokio::spawn(async move { drop(connection.await) });
    }
}

/// A header's value, where it is text.
fn value(headers: &HeaderMap, name: impl header::AsHeaderName) -> Option<&str> {
    headers.get(name)?.to_str().ok()
}

async fn answer(desk: &Desk, guard: &Guard, request: Request<Incoming>) -> Answer {
    let (head, body) = request.into_parts();
    let target = head.uri.path_and_query().map_or("", |path| path.as_str());
    let asker = Asker {
        path: target,
        host: value(&head.headers, header::HOST),
        origin: value(&head.headers, header::ORIGIN),
        site: value(&head.headers, "sec-fetch-site"),
    };
    let Some(below) = guard.admitted(&asker) else {
        return Answer::text(403, "this page is not yours\n");
    };
    let (path, query) = below.split_once('?').unwrap_or((below, ""));
    match head.method {
        Method::GET if path == "state" => {
            let after = query.strip_prefix("after=").and_then(|n| n.parse().ok());
            news(desk, after.unwrap_or(0)).await
        }
        Method::GET => routes::got(desk, path),
        Method::POST if value(&head.headers, header::CONTENT_TYPE) != Some("application/json") => {
            Answer::text(415, "send application/json\n")
        }
        Method::POST => match Limited::new(body, MOST).collect().await {
            Ok(body) => routes::posted(desk, path, &body.to_bytes()),
            Err(_) => Answer::text(413, "this is cut off, or too long for a scene\n"),
        },
        _ => Answer::text(405, "GET and POST only\n"),
    }
}

/// The state, once it is another than that of a number; nothing where that takes long.
async fn news(desk: &Desk, after: u64) -> Answer {
    let mut told = desk.news();
    let other = told.wait_for(|version| *version != after);
    // What is found locks the number, which must not be held when the desk is asked.
    let found = tokio::time::timeout(PATIENCE, other).await;
    let is_new = matches!(&found, Ok(Ok(_)));
    drop(found);
    match is_new {
        true => {
            let (version, shown) = desk.shown();
            routes::state(version, &shown)
        }
        false => Answer::text(204, ""),
    }
}

fn response(answer: Answer) -> Response<Full<Bytes>> {
    let mut response = Response::new(Full::new(Bytes::from(answer.bytes.into_owned())));
    *response.status_mut() =
        StatusCode::from_u16(answer.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(answer.kind));
    for (name, value) in HEADERS {
        headers.insert(
            HeaderName::from_static(name),
            HeaderValue::from_static(value),
        );
    }
    response
}
