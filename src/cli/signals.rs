//! Signals that end a program, while it writes files.

#[cfg(unix)]
mod held {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::low_level::{emulate_default_handler, unregister};
    use signal_hook::{SigId, flag};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};

    /// Signals that wait from [`Signals::held`] to [`Signals::released`], but for those that are ignored. A second one of the same kind
    /// ends the program at once.
    pub(in crate::cli) struct Signals {
        ending: Vec<(i32, Arc<AtomicBool>)>,
        registered: Vec<SigId>,
    }

    /// The signals that were to be ignored from the start, as `nohup` and a shell's `&` ask, one bit each; none where the system does not
    /// tell in this way.
    fn ignored() -> u64 {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        line.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
    }

    /// Whether a signal is one of these.
    fn is_of(signal: i32, signals: u64) -> bool {
        u32::try_from(signal - 1).ok().and_then(|bit| signals.checked_shr(bit)).is_some_and(|rest| rest & 1 == 1)
    }

    impl Signals {
        pub(in crate::cli) fn held() -> Self {
            let mut registered = Vec::new();
            let ignored = ignored();
            let ending =
                [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| !is_of(*signal, ignored)).map(|signal| {
                    let raised = Arc::new(AtomicBool::new(false));
                    // In this order the first signal only raises the flag. One that cannot be held ends the program as ever.
                    registered.extend(flag::register_conditional_default(signal, Arc::clone(&raised)));
                    registered.extend(flag::register(signal, Arc::clone(&raised)));
                    (signal, raised)
                });
            let ending = ending.collect();
            // A file that outgrows its limit is an error of its write.
            registered.extend(flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false))));
            Self { ending, registered }
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
