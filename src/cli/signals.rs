//! Signals that end a program, while it writes files.

#[cfg(unix)]
mod held {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::low_level::{emulate_default_handler, unregister};
    use signal_hook::{SigId, flag};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};

    /// Signals that wait from [`Signals::held`] to [`Signals::released`]. A second one of the same kind ends the program at once.
    pub(in crate::cli) struct Signals {
        ending: Vec<(i32, Arc<AtomicBool>)>,
        registered: Vec<SigId>,
    }

    impl Signals {
        pub(in crate::cli) fn held() -> Self {
            let mut registered = Vec::new();
            let ending = [SIGHUP, SIGINT, SIGTERM].map(|signal| {
                let raised = Arc::new(AtomicBool::new(false));
                // In this order the first signal only raises the flag. One that cannot be held ends the program as ever.
                registered.extend(flag::register_conditional_default(signal, Arc::clone(&raised)));
                registered.extend(flag::register(signal, Arc::clone(&raised)));
                (signal, raised)
            });
            // A file that outgrows its limit is an error of its write.
            registered.extend(flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false))));
            Self { ending: ending.into(), registered }
        }

        /// Whether one has come.
        pub(in crate::cli) fn raised(&self) -> bool {
            self.ending.iter().any(|(_, raised)| raised.load(Ordering::SeqCst))
        }

        /// Ends the program by the signal that came, if one did.
        pub(in crate::cli) fn end(&self) {
            for (signal, raised) in &self.ending {
                if raised.load(Ordering::SeqCst) {
                    let _ = emulate_default_handler(*signal);
                }
            }
        }

        /// Signals end the program again, also by one that has come.
        pub(in crate::cli) fn released(self) {
            for id in &self.registered {
                unregister(*id);
            }
            self.end();
        }
    }
}

#[cfg(not(unix))]
mod held {
    /// Signals are not held here.
    pub(in crate::cli) struct Signals;

    impl Signals {
        pub(in crate::cli) fn held() -> Self {
            Self
        }

        pub(in crate::cli) fn raised(&self) -> bool {
            false
        }

        pub(in crate::cli) fn end(&self) {}

        pub(in crate::cli) fn released(self) {}
    }
}

pub(super) use held::Signals;
