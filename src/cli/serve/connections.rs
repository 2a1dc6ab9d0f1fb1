//! The open connections. Their number is limited; the oldest without a request is closed to admit a new one.

use std::collections::BTreeMap;
use std::net::{Shutdown, TcpStream};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Most connections at a time.
const MOST: usize = 32;

/// The open connections.
#[derive(Debug, Default)]
pub(super) struct Connections(Mutex<OpenConnections>);

#[derive(Debug, Default)]
struct OpenConnections {
    /// Streams by number, in the order of arrival; `None` once the request has arrived.
    waiting: BTreeMap<u64, Option<TcpStream>>,
    /// Connections so far.
    count: u64,
}

impl Connections {
    fn open(&self) -> MutexGuard<'_, OpenConnections> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Admits a connection and returns its number; `None` if all open ones are being answered.
    pub(super) fn enter(&self, stream: &TcpStream) -> Option<u64> {
        let mut open = self.open();
        if open.waiting.len() >= MOST {
            let (&oldest, _) = open.waiting.iter().find(|(_, stream)| stream.is_some())?;
            if let Some(Some(stream)) = open.waiting.remove(&oldest) {
                _ = stream.shutdown(Shutdown::Both);
            }
        }
        let own = stream.try_clone().ok()?;
        open.count += 1;
        let number = open.count;
        open.waiting.insert(number, Some(own));
        Some(number)
    }

    /// Marks a connection whose request has arrived: it is no longer closed to admit another.
    pub(super) fn busy(&self, number: u64) {
        if let Some(waiting) = self.open().waiting.get_mut(&number) {
            *waiting = None;
        }
    }

    /// Removes a connection that has ended.
    pub(super) fn leave(&self, number: u64) {
        self.open().waiting.remove(&number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::{Ipv4Addr, TcpListener};

    #[test]
    fn the_oldest_silent_connection_makes_room() {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("a port");
        let stream = TcpStream::connect(listener.local_addr().expect("an address")).expect("connected");
        let open = Connections::default();
        let numbers: Vec<u64> = (0..MOST).filter_map(|_| open.enter(&stream)).collect();
        assert_eq!(numbers.len(), MOST);
        open.busy(numbers[0]);
        assert!(open.enter(&stream).is_some());
        let left: Vec<u64> = open.open().waiting.keys().copied().collect();
        assert!(left.contains(&numbers[0]) && !left.contains(&numbers[1]), "{left:?}");
        numbers.iter().skip(2).chain([&33]).for_each(|number| open.busy(*number));
        assert!(open.enter(&stream).is_none(), "all are being answered");
        open.leave(numbers[0]);
        assert!(open.enter(&stream).is_some());
    }
}
