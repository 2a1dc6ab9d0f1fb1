//! `camgen machines`.

use super::args::{MachinesArgs, MachinesCommand};
use super::{Failure, Outcome, print};
use camgen::catalogue::catalogue;
use camgen::document::similar;
use camgen::machine;
use camgen::write::json;

pub(super) fn run(args: &MachinesArgs) -> Result<Outcome, Failure> {
    match &args.what {
        None | Some(MachinesCommand::List) => {
            let mut text = String::new();
            for embedded in &catalogue().embedded {
                text.push_str(&format!("{:<16} {:<6} {}\n", embedded.name, embedded.command, embedded.title()));
            }
            print(&text)?;
        }
        Some(MachinesCommand::Show { name }) => {
            let Some(embedded) = catalogue().embedded.iter().find(|embedded| embedded.name.eq_ignore_ascii_case(name))
            else {
                let names = catalogue().names();
                let near = similar(name, names.iter().copied());
                let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? It is "));
                return Err(Failure(format!("no embedded machine `{name}`; {near}one of {}", names.join(", "))));
            };
            print(embedded.toml)?;
        }
    }
    Ok(Outcome::Fine)
}

pub(super) fn schema() -> Result<Outcome, Failure> {
    let bytes = json::write(&machine::schema(catalogue())).map_err(Failure::new)?;
    print(&String::from_utf8_lossy(&bytes))?;
    Ok(Outcome::Fine)
}
