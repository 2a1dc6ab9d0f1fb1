//! Pages about camgen: `camgen` alone, completions, manual pages, a file to start from.

use super::args::{Cli, CompletionsArgs, InitArgs, ManArgs};
use super::put::put;
use super::{Failure, Outcome, print, print_message};
use camgen::catalogue::catalogue;
use camgen::document::similar;
use camgen::machine;
use camgen::write::files::{Output, stage_new};
use clap::CommandFactory;
use std::ffi::OsStr;
use std::path::Path;

/// The overview of camgen, on one screen.
pub(super) fn overview() -> Result<Outcome, Failure> {
    // A page that fits a screen: the flag of commands is in their help.
    let mut page = Cli::command().mut_arg("allow_path", |flag| flag.hide(true));
    print(&page.render_help().to_string())?;
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
            // The pages of commands are named like those of git.
            found.clone().display_name(format!("camgen-{}", found.get_name()))
        }
    };
    let mut bytes = Vec::new();
    clap_mangen::Man::new(page).render(&mut bytes).map_err(Failure::new)?;
    print(&String::from_utf8_lossy(&bytes))?;
    Ok(Outcome::Fine)
}

/// Prints a machine file to start from, or writes it where no file exists.
pub(super) fn init(args: &InitArgs) -> Result<Outcome, Failure> {
    let (text, command) = match &args.follower {
        None => (camgen::domains::press::template(catalogue()), "rotary"),
        Some(name) => (program(name)?, "make"),
    };
    let Some(path) = &args.file else {
        print(&text)?;
        return Ok(Outcome::Fine);
    };
    let name = path.file_name().and_then(OsStr::to_str);
    let name = name.ok_or_else(|| Failure(format!("`{}` is not the name of a file", path.display())))?;
    not_a_design(name)?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let output = Output { name: name.to_owned(), bytes: text.into_bytes() };
    put(folder, |place| Ok(((), stage_new(place, &[output]).map_err(Failure::new)?)), |()| Ok(()))?;
    print_message(&format!("wrote {0}; `camgen {command} {0}` makes its cam", path.display()));
    Ok(Outcome::Fine)
}

/// Refuses the name of an embedded machine or of a follower as that of a file: whoever gives it wants that machine or follower, and not a press.
fn not_a_design(name: &str) -> Result<(), Failure> {
    let wanted = if catalogue().names().contains(&name) {
        format!("an embedded machine: `camgen machines show {name} > my-{name}.toml` saves it")
    } else if machine::followers().contains(&name) {
        format!("a follower: `camgen init --follower {name} my-{name}.toml` writes a program for it")
    } else {
        return Ok(());
    };
    Err(Failure(format!("`{name}` is {wanted}; for a file of that name give `{name}.toml`")))
}

/// A motion program under a follower.
fn program(follower: &str) -> Result<String, Failure> {
    machine::template_of_program(catalogue(), follower).ok_or_else(|| {
        let known = machine::followers();
        let near = similar(follower, known.iter().copied());
        let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? It is "));
        Failure(format!("no such follower `{follower}`; {near}one of {}", known.join(", ")))
    })
}
