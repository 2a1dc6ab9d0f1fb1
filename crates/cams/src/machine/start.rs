//! Commented files to start from.

use super::{Catalogue, ROOT};
use camgen_kernel::document::{self, KeySection, TemplateOptions, cams};
use camgen_kernel::follower::FOLLOWERS;
use camgen_kernel::motion::program;

/// A program to start from: `{to}` is where it goes, `{start}` where it begins.
const PROGRAM: &str = "
# The program: segments one after the other over a turn of the cam.
[[motion.segment]]
law = \"modified-sine\"
over = \"90 deg\"
to = \"{to}\"

[[motion.segment]]
law = \"dwell\"
over = \"60 deg\"

[[motion.segment]]
law = \"cycloidal\"
over = \"120 deg\"
to = \"{start}\"

[[motion.segment]]
law = \"dwell\"                         # without over: the rest of the turn

# Every key of a segment, with examples:
";

/// A follower whose pressure angle does not depend on the cam.
const FLAT: &str = "follower.flat";

/// Keys of a motion program that may be absent, but that a solid needs.
const GIVEN: [&str; 3] = ["motion.rpm", "cam.thickness", "cam.bore_radius"];

/// A commented machine file with every key, to start from: of a kind of cam, with these tables as far as files may do without them.
#[must_use]
pub fn template(catalogue: &Catalogue, cam: &str, tables: &[&str]) -> String {
    let start = TemplateOptions { tables, keys: &[], cam, only: false };
    let keys = &catalogue.keys;
    document::template("A machine file of camgen. A quantity is \"number unit\".", keys, &keys.sections, &start)
}

/// The JSON schema of machine files.
#[must_use]
pub fn schema(catalogue: &Catalogue) -> serde_json::Value {
    let mut schema = document::schema("machine file of camgen", &catalogue.keys.sections);
    // A cam has one follower, of any kind.
    for bound in ["minProperties", "maxProperties"] {
        schema["properties"]["follower"][bound] = 1.into();
    }
    if let Some(names) = schema["required"].as_array_mut() {
        names.push("follower".into());
    }
    schema
}

/// The followers as [`template_of_program`] calls them.
#[must_use]
pub fn followers() -> Vec<&'static str> {
    FOLLOWERS.iter().map(|kind| name_of(kind.section)).collect()
}

fn name_of(section: &KeySection) -> &'static str {
    section.path.strip_prefix("follower.").unwrap_or(section.path)
}

/// A commented file of a motion program with every key that has an effect on it, under a follower of this name; `None` of another name.
#[must_use]
pub fn template_of_program(catalogue: &Catalogue, follower: &str) -> Option<String> {
    let kind = FOLLOWERS.iter().find(|kind| name_of(kind.section).eq_ignore_ascii_case(follower))?;
    let swings = kind.swings();
    let (start, to) = if swings { ("0 deg", "20 deg") } else { ("0 mm", "20 mm") };
    let written = |title: &str, sections: &[&KeySection], tables: &[&str]| {
        document::template(
            title,
            &catalogue.keys,
            sections,
            &TemplateOptions { tables, keys: &GIVEN, cam: cams::MAKE, only: true },
        )
    };
    let head = written(
        "A motion program of camgen, for camgen make. A quantity is \"number unit\".",
        &[&ROOT, &program::keys::SECTION],
        &[program::keys::SECTION.path],
    );
    let head = head
        .replace("start = \"0 mm\"", &format!("start = \"{start}\""))
        .replace("name = \"my press\"", "name = \"my cam\"  ")
        // Of a motion by points only.
        .replace("\ndegree = ", "\n# degree = ");
    let program = PROGRAM.replace("{start}", start).replace("{to}", to);
    let segment = written("", &[&program::keys::SEGMENT], &[]);
    // The tables after those of the followers.
    let sections = catalogue.keys.sections.iter().rev().copied();
    let after = sections.take_while(|section| FOLLOWERS.iter().all(|kind| kind.section.path != section.path));
    let of_another = |section: &KeySection| {
        let others = FOLLOWERS.iter().filter(|other| other.section.path != kind.section.path);
        others.into_iter().any(|other| section.path.starts_with(&format!("{}.", other.section.path)))
    };
    let mut body: Vec<&KeySection> = after
        .filter(|section| section.cams.is_empty() || section.cams.contains(&cams::MAKE))
        .filter(|section| !of_another(section))
        .chain([kind.section])
        .collect();
    body.reverse();
    let mut body = written("", &body, &[kind.section.path]);
    if swings || kind.section.path == FLAT {
        // The limit that the key shows is that of a roller on a straight path.
        body = body.replace("\npressure_angle = ", "\n# pressure_angle = ");
    }
    Some([head, program, without_head(&segment), without_head(&body)].concat())
}

/// Without the comment at the head, which is empty.
fn without_head(text: &str) -> String {
    text.strip_prefix("#\n").unwrap_or(text).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::catalogue;
    use crate::machine::Machine;

    #[test]
    fn a_program_to_start_from_reads_under_every_follower() {
        for name in followers() {
            let text = template_of_program(catalogue(), name).expect("a template");
            let machine =
                Machine::from_toml("start.toml", &text, &[]).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
            assert!(machine.motion().is_some(), "{name}");
            for other in followers().into_iter().filter(|other| *other != name) {
                assert!(!text.contains(&format!("[follower.{other}.")), "{name}: {other}");
            }
            assert!(!text.contains("[bed]") && !text.contains("crank_radius"), "{name}: {text}");
        }
        assert_eq!(template_of_program(catalogue(), "roler"), None);
    }
}
