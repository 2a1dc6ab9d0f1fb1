//! `camgen explain`: what a check means, how it is made, its usual limits, and what to change.

use super::args::ExplainArgs;
use super::text::{Page, wrapped};
use super::{Failure, Outcome, print};
use camgen::document::similar;
use camgen::verify::{CHECKS, Check};

pub(super) fn run(args: &ExplainArgs) -> Result<Outcome, Failure> {
    let page = Page::here();
    let Some(name) = &args.check else {
        let lines: Vec<String> = CHECKS.iter().map(|check| short(check, page)).collect();
        print(&format!("{}\n`camgen explain CHECK` tells one in full.\n", lines.concat()))?;
        return Ok(Outcome::Fine);
    };
    let plain = |text: &str| text.to_lowercase().replace('-', "_");
    let Some(check) = CHECKS.iter().find(|check| check.name == plain(name)) else {
        let near = similar(name, CHECKS.iter().map(|check| check.name));
        let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? It is "));
        let known: Vec<&str> = CHECKS.iter().map(|check| check.name).collect();
        return Err(Failure(format!("no such check `{name}`; {near}one of {}", known.join(", "))));
    };
    print(&full(check, page))?;
    Ok(Outcome::Fine)
}

/// The first sentence of what it means, behind its name.
fn short(check: &Check, page: Page) -> String {
    let first = check.about.split_inclusive(". ").next().unwrap_or_default().trim_end();
    wrapped(&format!("{:<18} {first}", check.name), 19, page) + "\n"
}

fn full(check: &Check, page: Page) -> String {
    let told = &check.explained;
    let lines = [
        wrapped(&format!("    {}", check.about), 4, page),
        wrapped(&format!("    how     {}", told.formula), 12, page),
        wrapped(&format!("    limit   {}: {}", told.bound.words(), told.usual), 12, page),
        wrapped(&format!("    change  {}", told.change), 12, page),
    ];
    format!("{}\n{}\n", check.name, lines.join("\n"))
}
