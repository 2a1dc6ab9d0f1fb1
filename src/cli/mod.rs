//! Commands, their exit codes and what they print: data and reports on stdout, messages on stderr.

mod analyses;
mod args;
mod cams;
mod check;
mod explain;
mod machines;
mod pages;
mod progress;
mod put;
mod side_by_side;
mod signals;
mod text;
mod trade;
mod watch;

use args::{Cli, Command, Later};
use camgen::document::plain;
use clap::Parser;
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

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
struct Failure(String);

impl Failure {
    fn new(why: impl std::fmt::Display) -> Self {
        Self(why.to_string())
    }
}

pub(crate) fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        None => pages::overview(),
        Some(command) => match command.watched() {
            Some(files) => watch::run(&files, || run(&command)),
            None => run(&command),
        },
    };
    match outcome {
        Ok(Outcome::Fine) => ExitCode::SUCCESS,
        Ok(Outcome::CheckFailed) => ExitCode::from(1),
        Err(failure) => {
            tell(&format!("error: {failure}"));
            ExitCode::from(2)
        }
    }
}

fn run(command: &Command) -> Result<Outcome, Failure> {
    match command {
        Command::Rotary(Later(args)) => cams::rotary(args),
        Command::Translating(Later(args)) => cams::translating(args),
        Command::Conoid(Later(args)) => cams::conoid(args),
        Command::Make(Later(args)) => cams::make(args),
        Command::Regimes(Later(args)) => analyses::regimes(args),
        Command::Spring(Later(args)) => analyses::spring(args),
        Command::Drive(Later(args)) => analyses::drive(args),
        Command::Linkage(Later(args)) => analyses::linkage(args),
        Command::Shaft(Later(args)) => analyses::shaft(args),
        Command::Brake(Later(args)) => analyses::brake(args),
        Command::Size(Later(args)) => analyses::size(args),
        Command::Laws(Later(args)) => analyses::laws(args),
        Command::SideBySide(Later(args)) => side_by_side::run(args),
        Command::Check(Later(args)) => check::run(args),
        Command::Trade(Later(args)) => trade::run(args),
        Command::Machines(args) => machines::run(args),
        Command::Init(args) => pages::init(args),
        Command::Explain(args) => explain::run(args),
        Command::Schema => machines::schema(),
        Command::Completions(args) => pages::completions(args),
        Command::Man(args) => pages::man(args),
    }
}

/// Prints data on stdout, without what a terminal would obey. A reader that closes the pipe early is not an error.
fn print(text: &str) -> Result<(), Failure> {
    print_painted(&plain(text))
}

/// Prints a text that is plain but for colours of our own.
fn print_painted(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Prints a message on stderr; when even that fails there is nothing left to do.
fn tell(message: &str) {
    let _ = writeln!(io::stderr().lock(), "{}", plain(message));
}
