//! The engine of camgen for a browser: bytes in, bytes out.
//!
//! The page asks for room of the size of its request ([`room`]), writes the request there, calls [`run`], and finds the answer at [`answer`]. It is a
//! crate of its own because names of exported functions are unsafe attributes, which the library forbids, and a program because a library would
//! also export what crates below it have for the tools of wasm-bindgen: three megabytes.

use std::cell::RefCell;
use std::sync::Once;

thread_local! {
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

unsafe extern "C" {
    /// What runs before a program: domains register. A module without a start of its own must call it.
    fn __wasm_call_ctors();
}

static REGISTERED: Once = Once::new();

/// Makes room for a request of a size and returns where it is.
#[unsafe(no_mangle)]
pub extern "C" fn room(size: usize) -> *const u8 {
    // SAFETY: the linker makes this function; it is called once, before anything else of the library.
    REGISTERED.call_once(|| unsafe { __wasm_call_ctors() });
    REQUEST.with_borrow_mut(|request| {
        request.clear();
        request.resize(size, 0);
        request.as_ptr()
    })
}

/// Answers the request and returns the size of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn run() -> usize {
    let answer = REQUEST.with_borrow(|request| camgen::engine::answer_bytes(request));
    let size = answer.len();
    ANSWER.set(answer);
    size
}

/// Where the answer is.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.as_ptr())
}

fn main() {}
