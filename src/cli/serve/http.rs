//! The little of HTTP that a page on the loopback address needs: one request, one answer, then the connection ends.

use std::io::{Read, Write};
use std::net::{Shutdown, TcpStream};
use std::time::{Duration, Instant};

/// Largest head and body of a request, bytes; most lines of a head.
const LARGEST_HEAD: usize = 16 << 10;
const LARGEST_BODY: usize = camgen::engine::LARGEST_REQUEST;
const MOST_HEADERS: usize = 64;
/// The time in which a request must be there, and in which an answer must be taken.
const READING: Duration = Duration::from_secs(5);
const WRITING: Duration = Duration::from_secs(10);
/// What is read of a refused body, so that its sender sees the answer.
const DRAINED: Duration = Duration::from_millis(200);

/// A request.
#[derive(Debug)]
pub(super) struct HttpRequest {
    pub(super) method: String,
    pub(super) target: String,
    headers: Vec<(String, String)>,
    pub(super) body: Vec<u8>,
}

impl HttpRequest {
    /// The values of a header, in small letters.
    pub(super) fn values(&self, name: &str) -> impl Iterator<Item = &str> {
        self.headers.iter().filter(move |(own, _)| own == name).map(|(_, value)| value.as_str())
    }

    /// The value of a header that is there once.
    pub(super) fn only(&self, name: &str) -> Option<&str> {
        let mut values = self.values(name);
        values.next().filter(|_| values.next().is_none())
    }
}

/// An answer.
#[derive(Debug)]
pub(super) struct Answer {
    status: u16,
    kind: &'static str,
    body: Vec<u8>,
}

impl Answer {
    /// Content of a type.
    pub(super) fn new(kind: &'static str, body: Vec<u8>) -> Self {
        Self { status: 200, kind, body }
    }

    /// A refusal, with the reason.
    pub(super) fn refused(status: u16, why: &str) -> Self {
        Self { status, kind: "text/plain; charset=utf-8", body: why.as_bytes().to_vec() }
    }

    fn write(&self, stream: &mut TcpStream) -> std::io::Result<()> {
        let head = format!(
            "HTTP/1.1 {} camgen\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\nCache-Control: no-store\r\nReferrer-Policy: no-referrer\r\n\
             X-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\nCross-Origin-Resource-Policy: same-origin\r\n\r\n",
            self.status,
            self.kind,
            self.body.len()
        );
        stream.write_all(head.as_bytes())?;
        stream.write_all(&self.body)?;
        stream.flush()
    }
}

/// Reads a request, answers it, and ends the connection. `whole` is called once the request has arrived.
pub(super) fn converse(mut stream: TcpStream, whole: impl FnOnce(), answer: impl FnOnce(&HttpRequest) -> Answer) {
    let request = read(&mut stream);
    whole();
    let (answer, whole) = match request {
        Ok(request) => (answer(&request), true),
        Err(Some(refusal)) => (refusal, false),
        Err(None) => return,
    };
    let written = stream.set_write_timeout(Some(WRITING)).and_then(|()| answer.write(&mut stream));
    if written.is_ok() && !whole {
        drain(&mut stream);
    }
    _ = stream.shutdown(Shutdown::Both);
}

/// Takes what is still sent, for a short time: closed at once, the connection would lose the answer.
fn drain(stream: &mut TcpStream) {
    _ = stream.shutdown(Shutdown::Write);
    let end = Instant::now() + DRAINED;
    let mut rest = [0; 4096];
    while Instant::now() < end && matches!(receive(stream, &mut rest, end), Some(1..)) {}
}

/// The next bytes before a time; `None` where none come.
fn receive(stream: &mut TcpStream, into: &mut [u8], end: Instant) -> Option<usize> {
    let left = end.checked_duration_since(Instant::now()).filter(|left| !left.is_zero())?;
    stream.set_read_timeout(Some(left)).ok()?;
    stream.read(into).ok()
}

/// A request; the refusal of one that is too large or not HTTP, nothing where none comes in time.
fn read(stream: &mut TcpStream) -> Result<HttpRequest, Option<Answer>> {
    let end = Instant::now() + READING;
    let mut bytes = Vec::new();
    let mut more = |bytes: &mut Vec<u8>| -> Result<(), Option<Answer>> {
        let mut part = [0; 16 << 10];
        let count = receive(stream, &mut part, end).filter(|count| *count > 0).ok_or(None)?;
        bytes.extend_from_slice(part.get(..count).unwrap_or_default());
        Ok(())
    };
    let (mut request, length, head) = loop {
        let found = head(&bytes).map_err(Some)?;
        let length = found.as_ref().map_or(bytes.len(), |(_, _, length)| *length);
        if length > LARGEST_HEAD {
            return Err(Some(Answer::refused(431, "the head is too large")));
        }
        if let Some(found) = found {
            break found;
        }
        more(&mut bytes)?;
    };
    if length > LARGEST_BODY {
        return Err(Some(Answer::refused(413, "the body is too large")));
    }
    while bytes.len() < head + length {
        more(&mut bytes)?;
    }
    if bytes.len() > head + length {
        return Err(Some(Answer::refused(400, "more than one request")));
    }
    request.body = bytes.split_off(head);
    Ok(request)
}

/// The head of a request with the lengths of its body and of itself; `None` where it is not whole.
fn head(bytes: &[u8]) -> Result<Option<(HttpRequest, usize, usize)>, Answer> {
    let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
    let mut parsed = httparse::Request::new(&mut headers);
    let length = match parsed.parse(bytes) {
        Ok(httparse::Status::Complete(length)) => length,
        Ok(httparse::Status::Partial) => return Ok(None),
        Err(_) => return Err(Answer::refused(400, "not a request")),
    };
    let headers = parsed.headers.iter().map(|header| {
        let value = String::from_utf8(header.value.to_vec()).ok()?;
        Some((header.name.to_ascii_lowercase(), value))
    });
    let headers: Option<Vec<_>> = headers.collect();
    let (Some(method), Some(target), Some(headers)) = (parsed.method, parsed.path, headers) else {
        return Err(Answer::refused(400, "not a request"));
    };
    let request = HttpRequest { method: method.to_owned(), target: target.to_owned(), headers, body: Vec::new() };
    if request.values("transfer-encoding").next().is_some() {
        return Err(Answer::refused(411, "the length of the body is missing"));
    }
    let body = match (request.only("content-length"), request.values("content-length").next()) {
        (Some(digits), _) if digits.bytes().all(|digit| digit.is_ascii_digit()) => {
            digits.parse().map_err(|_| Answer::refused(413, "the body is too large"))?
        }
        (None, None) => 0,
        _ => return Err(Answer::refused(400, "the length of the body is not a number")),
    };
    Ok(Some((request, body, length)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn status(bytes: &[u8]) -> u16 {
        head(bytes).expect_err("refused").status
    }

    #[test]
    fn a_head_is_read_when_it_is_whole() {
        let text = b"POST /engine HTTP/1.1\r\nHost: a\r\nX-Camgen-Token: t\r\nContent-Length: 3\r\n\r\nabc";
        assert!(head(&text[..30]).expect("so far").is_none());
        let (request, body, length) = head(text).expect("a request").expect("whole");
        assert_eq!((request.method.as_str(), request.target.as_str(), body), ("POST", "/engine", 3));
        assert_eq!((request.only("x-camgen-token"), &text[length..]), (Some("t"), &b"abc"[..]));
    }

    #[test]
    fn doubtful_heads_are_refused() {
        assert_eq!(status(b"\x16\x03\x01\r\n\r\n"), 400);
        assert_eq!(status(b"POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n"), 411);
        assert_eq!(status(b"POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n"), 400);
        assert_eq!(status(b"POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"), 400);
        assert_eq!(status(b"POST / HTTP/1.1\r\nContent-Length: 99999999999999999999999\r\n\r\n"), 413);
    }
}
