//! Commands, their exit codes and what they print: data and reports on stdout, messages on stderr.

pub(crate) mod analyses;
pub(crate) mod args;
pub(crate) mod brake;
mod cams;
mod check;
mod design;
mod explain;
mod import;
mod input_files;
mod live;
mod machines;
mod pages;
mod progress;
mod put;
mod serve;
mod side_by_side;
mod signals;
mod study;
mod text;
mod trade;
mod watch;

use args::{Cli, Command, DeferredArgs};
use camgen::document::plain;
use clap::Parser;
use std::ffi::OsString;
use std::io::{self, ErrorKind, Write};

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    /// Everything is fine.
    Fine,
    /// A check failed.
    CheckFailed,
}

/// A message for the user: bad input, or something that cannot be done.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub(crate) struct Failure(String);

impl Failure {
    fn new(why: impl std::fmt::Display) -> Self {
        Self(why.to_string())
    }
}

/// Runs a command line, the name of the program first, and returns its exit code.
pub(crate) fn main(typed: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> u8 {
    let Cli { allow_path, command } = match Cli::try_parse_from(typed) {
        Ok(cli) => cli,
        Err(shown) => {
            // As clap ends a program; that a page of help cannot be printed is ignored.
            let _ = shown.print();
            return u8::try_from(shown.exit_code()).unwrap_or(BAD_INPUT);
        }
    };
    let outcome = input_files::allow(&allow_path).and_then(|()| match command {
        None => pages::overview(),
        Some(command) => match command.watched() {
            Some(files) => watch::run(&files, || run(&command)),
            None => run(&command),
        },
    });
    match outcome {
        Ok(Outcome::Fine) => 0,
        Ok(Outcome::CheckFailed) => 1,
        Err(failure) => {
            print_message(&format!("error: {failure}"));
            BAD_INPUT
        }
    }
}

/// The exit code of bad input, and of what cannot be done.
const BAD_INPUT: u8 = 2;

fn run(command: &Command) -> Result<Outcome, Failure> {
    match command {
        Command::Rotary(DeferredArgs(args)) => cams::rotary(args),
        Command::Translating(DeferredArgs(args)) => cams::translating(args),
        Command::Conoid(DeferredArgs(args)) => cams::conoid(args),
        Command::Make(DeferredArgs(args)) => cams::make(args),
        Command::Regimes(DeferredArgs(args)) => analyses::regimes(args),
        Command::Spring(DeferredArgs(args)) => analyses::spring(args),
        Command::Scatter(DeferredArgs(args)) => analyses::scatter(args),
        Command::Drive(DeferredArgs(args)) => analyses::drive(args),
        Command::Linkage(DeferredArgs(args)) => analyses::linkage(args),
        Command::Shaft(DeferredArgs(args)) => analyses::shaft(args),
        Command::Brake(DeferredArgs(args)) => brake::run(args),
        Command::Size(DeferredArgs(args)) => analyses::size(args),
        Command::Import(DeferredArgs(args)) => import::run(args),
        Command::Compare(DeferredArgs(args)) => analyses::compare(args),
        Command::Laws(DeferredArgs(args)) => analyses::laws(args),
        Command::SideBySide(DeferredArgs(args)) => side_by_side::run(args),
        Command::Check(DeferredArgs(args)) => check::run(args),
        Command::Trade(DeferredArgs(args)) => trade::run(args),
        Command::Study(DeferredArgs(args)) => study::run(args),
        Command::Serve(DeferredArgs(args)) => serve::run(args),
        Command::Machines(args) => machines::run(args),
        Command::Init(args) => pages::init(args),
        Command::Explain(args) => explain::run(args),
        Command::Schema => machines::schema(),
        Command::Completions(args) => pages::completions(args),
        Command::Man(args) => pages::man(args),
    }
}

/// Prints data on stdout, without control sequences. A reader that closes the pipe early is not an error.
fn print(text: &str) -> Result<(), Failure> {
    print_painted(&plain(text))
}

/// Prints a text that is plain except for the colours of camgen.
fn print_painted(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Message about the files after a failed check.
fn refusal(dry_run: bool) -> &'static str {
    if dry_run {
        "refused: a check failed; without --dry-run no file would be written (--force would write them; `camgen explain CHECK` explains a check)"
    } else {
        "refused: a check failed, nothing was written (--force writes anyway; `camgen explain CHECK` explains a check)"
    }
}

/// Prints a message on stderr; a failure of that is ignored.
fn print_message(message: &str) {
    let _ = writeln!(io::stderr().lock(), "{}", plain(message));
}
