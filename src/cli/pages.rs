//! What camgen tells of itself: `camgen` alone, completions, manual pages, a file to start from.

use super::args::{Cli, CompletionsArgs, InitArgs, ManArgs};
use super::{Failure, Outcome, print, tell};
use camgen::document::similar;
use camgen::machine;
use clap::CommandFactory;
use std::fs::File;
use std::io::{ErrorKind, Write};

/// What camgen is, in a screen.
pub(super) fn overview() -> Result<Outcome, Failure> {
    print(&Cli::command().render_help().to_string())?;
    Ok(Outcome::Fine)
}

pub(super) fn completions(args: &CompletionsArgs) -> Result<Outcome, Failure> {
    let mut bytes = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "camgen", &mut bytes);
    print(&String::from_utf8_lossy(&bytes))?;
    Ok(Outcome::Fine)
}

pub(super) fn man(args: &ManArgs) -> Result<Outcome, Failure> {
    let mut all = Cli::command();
    all.build();
    let page = match &args.command {
        None => all,
        Some(name) => {
            let known: Vec<&str> = all.get_subcommands().map(clap::Command::get_name).collect();
            let found = all.get_subcommands().find(|command| command.get_name().eq_ignore_ascii_case(name));
            let Some(found) = found else {
                let near = similar(name, known.iter().copied());
                let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? It is "));
                return Err(Failure(format!("no such command `{name}`; {near}one of {}", known.join(", "))));
            };
            // The pages of commands are named as those of git are.
            found.clone().display_name(format!("camgen-{}", found.get_name()))
        }
    };
    let mut bytes = Vec::new();
    clap_mangen::Man::new(page).render(&mut bytes).map_err(Failure::new)?;
    print(&String::from_utf8_lossy(&bytes))?;
    Ok(Outcome::Fine)
}

/// Prints a machine file to start from, or writes it where no file is.
pub(super) fn init(args: &InitArgs) -> Result<Outcome, Failure> {
    let (text, command) = match &args.follower {
        None => (machine::template(), "rotary"),
        Some(name) => (program(name)?, "make"),
    };
    let Some(path) = &args.file else {
        print(&text)?;
        return Ok(Outcome::Fine);
    };
    let written = File::create_new(path).and_then(|mut file| file.write_all(text.as_bytes()));
    written.map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => Failure(format!("`{}` is there already, and is not replaced", path.display())),
        _ => Failure(format!("cannot write `{}`: {error}", path.display())),
    })?;
    tell(&format!("wrote {0}; `camgen {command} {0}` makes its cam", path.display()));
    Ok(Outcome::Fine)
}

/// A motion program under a follower.
fn program(follower: &str) -> Result<String, Failure> {
    machine::template_of_program(follower).ok_or_else(|| {
        let known = machine::followers();
        let near = similar(follower, known.iter().copied());
        let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? It is "));
        Failure(format!("no such follower `{follower}`; {near}one of {}", known.join(", ")))
    })
}
