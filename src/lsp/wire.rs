//! Messages over standard input and output, each behind a head with its length.
//!
//! What cannot be read is one message lost, not the connection: a body is read by its length
//! whatever it holds.

use crossbeam_channel::{Receiver, Sender, unbounded};
use lsp_server::Message;
use std::io::{BufRead, Read, Write};
use std::thread::JoinHandle;

/// The longest body that is read, in bytes.
const MOST: usize = 64 << 20;
/// The longest line of a head.
const HEAD: u64 = 4096;

/// What comes in.
#[derive(Debug)]
pub enum Event {
    /// A message.
    Message(Box<Message>),
    /// What is none, and why.
    Unreadable(String),
}

/// Reads messages until there are no more.
pub fn read(mut input: impl BufRead + Send + 'static) -> Receiver<Event> {
    let (sender, receiver) = unbounded();
    std::thread::spawn(move || {
        while let Some(event) = next(&mut input) {
            if sender.send(event).is_err() {
                break;
            }
        }
    });
    receiver
}

/// Writes what is sent until nobody sends any more.
pub fn write(mut output: impl Write + Send + 'static) -> (Sender<String>, JoinHandle<()>) {
    let (sender, receiver) = unbounded::<String>();
    let thread = std::thread::spawn(move || {
        for body in receiver {
            let head = format!("Content-Length: {}\r\n\r\n", body.len());
            let all = [head.as_bytes(), body.as_bytes()].concat();
            // A client that has gone away wants no more.
            if output
                .write_all(&all)
                .and_then(|()| output.flush())
                .is_err()
            {
                break;
            }
        }
    });
    (sender, thread)
}

/// The next message; none at the end.
fn next(input: &mut impl BufRead) -> Option<Event> {
    let mut length = None;
    let mut lines = 0;
    loop {
        let mut line = Vec::new();
        let read = input
            .by_ref()
            .take(HEAD)
            .read_until(b'\n', &mut line)
            .ok()?;
        if read == 0 {
            return None;
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim();
        if line.is_empty() {
            if lines > 0 {
                break;
            }
            continue;
        }
        lines += 1;
        if let Some((name, value)) = line.split_once(':')
            && name.eq_ignore_ascii_case("content-length")
        {
            length = value.trim().parse::<usize>().ok();
        }
    }
    let Some(length) = length else {
        return Some(Event::Unreadable("a head without a length".to_owned()));
    };
    if length > MOST {
        let skipped = std::io::copy(
            &mut input.by_ref().take(length as u64),
            &mut std::io::sink(),
        );
        skipped.ok()?;
        return Some(Event::Unreadable(format!("a message of {length} bytes")));
    }
    let mut body = Vec::new();
    input
        .by_ref()
        .take(length as u64)
        .read_to_end(&mut body)
        .ok()?;
    if body.len() < length {
        return None;
    }
    Some(match serde_json::from_slice(&body) {
        Ok(message) => Event::Message(Box::new(message)),
        Err(why) => Event::Unreadable(why.to_string()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_read_is_skipped() {
        let good = r#"{"jsonrpc":"2.0","method":"exit"}"#;
        let framed = |body: &str| format!("Content-Length: {}\r\n\r\n{body}", body.len());
        let text = [
            "\r\n".to_owned(),
            framed("{"),
            "Content-Type: none\r\n\r\n".to_owned(),
            framed(&"[".repeat(5000)),
            format!(
                "X: {}\r\ncontent-length:{}\r\n\r\n{good}",
                "y".repeat(5000),
                good.len()
            ),
            "Content-Length: 10\r\n\r\n{".to_owned(),
        ];
        let mut input = std::io::Cursor::new(text.concat());
        let found: Vec<Event> = std::iter::from_fn(|| next(&mut input)).collect();
        let good = |e: &Event| matches!(e, Event::Message(_));
        let good: Vec<bool> = found.iter().map(good).collect();
        assert_eq!(good, [false, false, false, true], "{found:?}");
    }
}
