//! `camgen explain`: what a check means, how it is calculated, its usual limits, and what to change.

use super::args::ExplainArgs;
use super::text::{Page, wrapped};
use super::{Failure, Outcome, print};
use camgen::catalogue::checks;
use camgen::check::Check;
use camgen::document::similar;

pub(super) fn run(args: &ExplainArgs) -> Result<Outcome, Failure> {
    let page = Page::here();
    let Some(name) = &args.check else {
        print(&list(args.verbose, page))?;
        return Ok(Outcome::Fine);
    };
    let plain = name.to_lowercase().replace('-', "_");
    let Some(check) = checks().find(|check| check.name == plain) else {
        let near = similar(name, checks().map(|check| check.name));
        let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? It is "));
        let known: Vec<&str> = checks().map(|check| check.name).collect();
        return Err(Failure(format!("no such check `{name}`; {near}one of {}", known.join(", "))));
    };
    print(&full(check, page))?;
    Ok(Outcome::Fine)
}

/// Width of the list of names where the page does not say how wide it is.
const WIDTH: usize = 80;

/// The names of all checks, or each with its meaning.
fn list(verbose: bool, page: Page) -> String {
    const MORE: &str = "camgen explain CHECK explains one in full";
    if verbose {
        let lines: Vec<String> = checks().map(|check| short(check, page)).collect();
        return format!("{}\n{MORE}\n", lines.concat());
    }
    let names: Vec<&str> = checks().map(|check| check.name).collect();
    let page = Page { width: page.width.or(Some(WIDTH)), ..page };
    let all = wrapped(&format!("  {}", names.join(", ")), 2, page);
    format!("{} checks\n{all}\n{MORE}; -v gives each a line\n", names.len())
}

/// The name of a check and the first sentence of its meaning.
fn short(check: &Check, page: Page) -> String {
    let first = check.about.split_inclusive(". ").next().unwrap_or_default().trim_end();
    wrapped(&format!("{:<18} {first}", check.name), 19, page) + "\n"
}

fn full(check: &Check, page: Page) -> String {
    let explained = &check.explained;
    let lines = [
        wrapped(&format!("    {}", check.about), 4, page),
        wrapped(&format!("    how     {}", explained.formula), 12, page),
        wrapped(&format!("    limit   {}: {}", explained.bound.words(), explained.usual), 12, page),
        wrapped(&format!("    change  {}", explained.change), 12, page),
    ];
    format!("{}\n{}\n", check.name, lines.join("\n"))
}
