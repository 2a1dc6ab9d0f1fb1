//! `camgen machines`.

use super::args::{MachinesArgs, MachinesCommand};
use super::{Failure, Outcome, print};
use camgen::machine::{self, EMBEDDED, Machine};
use camgen::write::json;

pub(super) fn run(args: &MachinesArgs) -> Result<Outcome, Failure> {
    match &args.what {
        None | Some(MachinesCommand::List) => {
            let mut text = String::new();
            for embedded in EMBEDDED {
                let (machine, _) = Machine::load(embedded.name, &[]).map_err(Failure::new)?;
                text.push_str(&format!("{:<12} {}\n", embedded.name, machine.name()));
            }
            print(&text)?;
        }
        Some(MachinesCommand::Show { name }) => {
            let Some(embedded) = EMBEDDED.iter().find(|embedded| embedded.name == name) else {
                let names: Vec<&str> = EMBEDDED.iter().map(|embedded| embedded.name).collect();
                return Err(Failure(format!("no embedded machine `{name}`; there are {}", names.join(", "))));
            };
            print(embedded.toml)?;
        }
    }
    Ok(Outcome::Fine)
}

pub(super) fn schema() -> Result<Outcome, Failure> {
    let bytes = json::write(&machine::schema()).map_err(Failure::new)?;
    print(&String::from_utf8_lossy(&bytes))?;
    Ok(Outcome::Fine)
}
