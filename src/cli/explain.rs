//! `camgen explain`: what a check means.

use super::args::ExplainArgs;
use super::{Failure, Outcome, print};
use camgen::verify::{CHECKS, Check};

pub(super) fn run(args: &ExplainArgs) -> Result<Outcome, Failure> {
    let chosen: Vec<&Check> =
        CHECKS.iter().filter(|check| args.check.as_ref().is_none_or(|name| name == check.name)).collect();
    if chosen.is_empty() {
        let known: Vec<&str> = CHECKS.iter().map(|check| check.name).collect();
        return Err(Failure(format!("no such check; one of {}", known.join(", "))));
    }
    let lines: Vec<String> = chosen.iter().map(|check| format!("{}\n    {}\n", check.name, check.about)).collect();
    print(&lines.concat())?;
    Ok(Outcome::Fine)
}
