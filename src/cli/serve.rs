//! `camgen serve`: the live page on the loopback address, with the engine of this program.
//!
//! Nobody else may use it: the address is 127.0.0.1, every request has to name it in its head (so that no other name leads here), one that
//! comes from another page is refused, and all but the program itself and its page lack the token. Requests are small, their number is
//! limited, and each has a time limit. A connection whose request has not arrived yet is closed if a new one needs its slot.

mod connections;
mod http;
mod page;
mod target;

use super::args::ServeArgs;
use super::{Failure, Outcome, print};
use connections::Connections;
use http::{Answer, HttpRequest};
use page::Served;
use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

/// Period of the checks for the end.
const PERIOD: Duration = Duration::from_millis(20);
/// The header that brings the token.
const TOKEN: &str = "x-camgen-token";

pub(super) fn run(args: &ServeArgs) -> Result<Outcome, Failure> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, args.port))
        .map_err(|error| Failure(format!("cannot listen at port {}: {error}", args.port)))?;
    let port = listener.local_addr().map_err(Failure::new)?.port();
    let served = Arc::new(Served::new(args, token())?);
    print(&format!("http://127.0.0.1:{port}/?token={}\n", served.token()))?;
    listen(&listener, port, &served, args.seconds.map(Duration::from_secs))
}

/// Takes connections until the time is over.
fn listen(listener: &TcpListener, port: u16, served: &Arc<Served>, time: Option<Duration>) -> Result<Outcome, Failure> {
    let begin = Instant::now();
    let open = Arc::new(Connections::default());
    listener.set_nonblocking(time.is_some()).map_err(Failure::new)?;
    loop {
        match listener.accept() {
            Ok((stream, _)) => connect(stream, port, served, &open),
            Err(error) if error.kind() == std::io::ErrorKind::WouldBlock => {
                if time.is_some_and(|time| begin.elapsed() >= time) {
                    return Ok(Outcome::Fine);
                }
                thread::sleep(PERIOD);
            }
            // A connection that failed before it was taken.
            Err(_) => thread::sleep(PERIOD),
        }
    }
}

/// Answers a connection in a thread of its own, unless there are too many.
fn connect(stream: TcpStream, port: u16, served: &Arc<Served>, open: &Arc<Connections>) {
    let Some(number) = open.enter(&stream) else { return };
    let (served, entered) = (Arc::clone(served), Arc::clone(open));
    let converse = move || {
        _ = stream.set_nonblocking(false);
        http::converse(stream, || entered.busy(number), |request| answer(request, port, &served));
        entered.leave(number);
    };
    if thread::Builder::new().spawn(converse).is_err() {
        open.leave(number);
    }
}

/// Whether two texts are equal, in a time that does not depend on where they differ.
fn is_equal(a: &str, b: &str) -> bool {
    a.len() == b.len() && a.bytes().zip(b.bytes()).fold(0, |differ, (a, b)| differ | (a ^ b)) == 0
}

/// The answer to a request that comes from the page, or asks for it.
fn answer(request: &HttpRequest, port: u16, served: &Served) -> Answer {
    let hosts = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
    let Some(host) = request.only("host").filter(|host| hosts.iter().any(|own| own == host)) else {
        return Answer::refused(403, "another host");
    };
    // A page of another origin is refused, also one that was opened from a file.
    if request.values("origin").any(|origin| origin != format!("http://{host}")) {
        return Answer::refused(403, "another origin");
    }
    let (path, query) = request.target.split_once('?').unwrap_or((&request.target, ""));
    let token = match request.method.as_str() {
        "GET" => query.strip_prefix("token="),
        "POST" => request.only(TOKEN),
        _ => return Answer::refused(405, "GET or POST"),
    };
    if !token.is_some_and(|token| is_equal(token, served.token())) {
        return Answer::refused(403, "the token is missing or wrong");
    }
    match (request.method.as_str(), path) {
        ("GET", "/") => served.page(),
        ("POST", "/engine") => served.engine(&request.body),
        ("POST", "/files") => served.files(),
        ("POST", "/save") => served.save(&request.body),
        ("POST", "/write") => served.write(&request.body),
        _ => Answer::refused(404, "there is no such page"),
    }
}

/// A token that nobody guesses: of the keys with which the system seeds hashes, which are 128 random bits.
fn token() -> String {
    let keys = RandomState::new();
    let [first, second] = [0, 1].map(|number| {
        let mut hasher = keys.build_hasher();
        hasher.write_u64(number);
        hasher.finish()
    });
    format!("{first:016x}{second:016x}")
}
