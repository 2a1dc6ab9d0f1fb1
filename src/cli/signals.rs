//! Signals that end a program, while it writes files.

#[cfg(unix)]
mod platform {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::flag;
    use signal_hook::low_level::emulate_default_handler;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::sync::{Arc, OnceLock};

    /// A signal that waits while it is held, and ends the program otherwise.
    struct EndingSignal {
        signal: i32,
        /// It came while it was held.
        raised: Arc<AtomicBool>,
        /// It is not held.
        free: Arc<AtomicBool>,
    }

    /// Signals that wait from [`Signals::hold`] to [`Signals::release`], except ignored ones. A second signal of the same kind
    /// ends the program at once.
    pub(in crate::cli) struct Signals(&'static [EndingSignal]);

    /// The signals that are ignored from the start, as set by `nohup` and by `&` in a shell, one bit each; 0 where the system has no
    /// such file.
    fn ignored() -> u64 {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        line.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
    }

    /// Whether a signal is one of these.
    fn is_of(signal: i32, signals: u64) -> bool {
        u32::try_from(signal - 1).ok().and_then(|bit| signals.checked_shr(bit)).is_some_and(|rest| rest & 1 == 1)
    }

    /// A handler that is taken off leaves its signal ignored for good, so handlers are set once and stay: a flag tells them
    /// whether the signal waits.
    fn handled() -> Vec<EndingSignal> {
        let ignored = ignored();
        // A file that outgrows its limit is an error of its write. Where a handler cannot be set, the signal ends the program as usual.
        let _ = flag::register(SIGXFSZ, Arc::default());
        let all = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| !is_of(*signal, ignored));
        all.filter_map(|signal| {
            let (raised, free) = (Arc::<AtomicBool>::default(), Arc::new(AtomicBool::new(true)));
            // In this order the first signal only raises the flag, and the second one ends the program.
            flag::register_conditional_default(signal, Arc::clone(&free)).ok()?;
            flag::register_conditional_default(signal, Arc::clone(&raised)).ok()?;
            flag::register(signal, Arc::clone(&raised)).ok()?;
            Some(EndingSignal { signal, raised, free })
        })
        .collect()
    }

    impl Signals {
        pub(in crate::cli) fn hold() -> Self {
            static HANDLED: OnceLock<Vec<EndingSignal>> = OnceLock::new();
            let all = HANDLED.get_or_init(handled);
            for each in all {
                each.free.store(false, Ordering::SeqCst);
            }
            Self(all)
        }

        /// Whether one has come.
        pub(in crate::cli) fn raised(&self) -> bool {
            self.0.iter().any(|each| each.raised.load(Ordering::SeqCst))
        }

        /// Ends the program with the signal that came, if one did.
        pub(in crate::cli) fn end(&self) {
            for EndingSignal { signal, raised, .. } in self.0 {
                if raised.load(Ordering::SeqCst) {
                    let _ = emulate_default_handler(*signal);
                }
            }
        }

        /// Lets signals end the program again, including one that has already come.
        pub(in crate::cli) fn release(self) {
            for each in self.0 {
                each.free.store(true, Ordering::SeqCst);
            }
            self.end();
        }
    }
}

#[cfg(not(unix))]
mod platform {
    /// Signals are not delayed on this system.
    pub(in crate::cli) struct NoSignals;

    impl NoSignals {
        pub(in crate::cli) fn hold() -> Self {
            Self
        }

        pub(in crate::cli) fn raised(&self) -> bool {
            false
        }

        pub(in crate::cli) fn end(&self) {}

        pub(in crate::cli) fn release(self) {}
    }
}

#[cfg(not(unix))]
pub(super) use platform::NoSignals as Signals;
#[cfg(unix)]
pub(super) use platform::Signals;
