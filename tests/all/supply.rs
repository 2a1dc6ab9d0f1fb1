//! What camgen is built from and what its package holds: licences, sources, doubled crates, every file that the build needs.

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::process::Command;

fn cargo(arguments: &[&str]) -> String {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let ran = Command::new(cargo).args(arguments).current_dir(env!("CARGO_MANIFEST_DIR")).output().expect("cargo runs");
    assert!(ran.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&ran.stderr));
    String::from_utf8(ran.stdout).expect("text")
}

fn packages() -> Vec<Value> {
    let target = ["--filter-platform", "x86_64-unknown-linux-gnu"];
    let told = cargo(&[&["metadata", "--locked", "--format-version", "1"][..], &target].concat());
    let told: Value = serde_json::from_str(&told).expect("JSON");
    told["packages"].as_array().expect("packages").clone()
}

fn word(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

/// The packages of a lock file: name, version and what each needs.
fn locked(path: &str) -> BTreeMap<String, (String, BTreeSet<String>)> {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a lock file");
    let package = |text: &str| {
        let quoted =
            |key: &str| text.lines().find_map(|line| line.strip_prefix(&format!("{key} = \""))?.strip_suffix('"'));
        let needs = text.lines().filter_map(|line| line.strip_prefix(" \"")?.split(['"', ' ']).next());
        (
            quoted("name").expect("a name").to_owned(),
            (quoted("version").expect("a version").to_owned(), needs.map(str::to_owned).collect()),
        )
    };
    text.split("[[package]]\n").skip(1).map(package).collect()
}

/// What is fuzzed is built from the same crates as what is released: its lock file follows camgen's.
#[test]
fn the_fuzzed_program_has_the_same_crates() {
    let (own, fuzzed) = (locked("Cargo.lock"), locked("fuzz/Cargo.lock"));
    // The features without which the targets would miss code of the library; the program, its pages and its PDF files are not fuzzed.
    let features = ["second-reader", "press", "linkage", "shaft", "brake"];
    let manifest = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/Cargo.toml")).expect("a file");
    let wanted = format!("default-features = false, features = {features:?}");
    assert!(manifest.contains(&wanted), "{manifest}");
    let all = packages();
    for name in OWN {
        let package = all.iter().find(|package| package["name"] == name).expect("a package of the workspace");
        let direct = needed_with(package, &features);
        let (_, needed) = fuzzed.get(name).unwrap_or_else(|| panic!("no {name} in fuzz/Cargo.lock"));
        assert_eq!(*needed, direct, "{name}: run cargo metadata --manifest-path fuzz/Cargo.toml");
        for name in direct {
            let version =
                |of: &BTreeMap<String, (String, BTreeSet<String>)>| of.get(&name).map(|package| package.0.clone());
            assert_eq!(version(&own), version(&fuzzed), "{name}");
        }
    }
}

/// The packages of the workspace.
const OWN: [&str; 4] = ["camgen", "camgen-kernel", "camgen-cams", "camgen-printing"];

/// What a package needs with some features.
fn needed_with(package: &Value, features: &[&str]) -> BTreeSet<String> {
    let mut open: Vec<String> = features.iter().map(|feature| (*feature).to_owned()).collect();
    let mut asked = BTreeSet::new();
    while let Some(feature) = open.pop() {
        for need in package["features"][&*feature].as_array().into_iter().flatten().map(word) {
            match need.strip_prefix("dep:") {
                Some(name) => drop(asked.insert(name.to_owned())),
                None => open.push(need.to_owned()),
            }
        }
    }
    let direct = package["dependencies"].as_array().expect("a list").iter();
    let direct =
        direct.filter(|of| of["kind"].is_null() && (of["optional"] != true || asked.contains(word(&of["name"]))));
    direct.map(|of| word(&of["name"]).to_owned()).collect()
}

/// The words in quotes of a list of `deny.toml`.
fn list(key: &str) -> BTreeSet<String> {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("deny.toml")).expect("a file");
    let (_, rest) = text.split_once(&format!("\n{key} = [")).unwrap_or_else(|| panic!("no {key}"));
    let (inside, _) = rest.split_once("\n]").expect("an end");
    inside.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// Whether a licence expression can be kept with those allowed: `OR` needs one of its parts, `AND` all.
fn allowed(expression: &str, licences: &BTreeSet<String>) -> bool {
    let plain = expression.replace(['(', ')'], "").replace('/', " OR ");
    plain.split(" AND ").all(|part| part.split(" OR ").any(|licence| licences.contains(licence.trim())))
}

#[test]
fn licences_and_sources_are_those_of_deny_toml() {
    let licences = list("allow");
    for package in packages() {
        let (name, source) = (word(&package["name"]), word(&package["source"]));
        assert!(
            OWN.contains(&name) || source == "registry+https://github.com/rust-lang/crates.io-index",
            "{name}: {source}"
        );
        assert!(allowed(word(&package["license"]), &licences), "{name}: {}", package["license"]);
    }
    assert!(
        !allowed("GPL-3.0", &licences)
            && !allowed("MIT AND GPL-3.0", &licences)
            && allowed("GPL-3.0 OR MIT", &licences)
    );
}

#[test]
fn no_other_crate_is_there_twice() {
    // What is built: the lock file also has crates of features that are off.
    let told =
        cargo(&["tree", "--locked", "--target", "x86_64-unknown-linux-gnu", "--prefix", "none", "--format", "{p}"]);
    let mut versions: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for line in told.lines() {
        let mut words = line.split(' ');
        if let (Some(name), Some(version)) = (words.next(), words.next()) {
            versions.entry(name).or_default().insert(version);
        }
    }
    let twice: BTreeSet<String> =
        versions.iter().filter(|(_, all)| all.len() > 1).map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(twice, list("skip"));
}

/// Every direct dependency stands in docs/dependencies.md with the reason for it.
#[test]
fn each_direct_crate_has_a_reason() {
    let all = packages();
    let own = all.iter().filter(|package| OWN.contains(&word(&package["name"])));
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/dependencies.md")).expect("a file");
    for dependency in own.flat_map(|package| package["dependencies"].as_array().expect("dependencies")) {
        let name = word(&dependency["name"]);
        assert!(
            OWN.contains(&name) || text.contains(&format!("| {name} |")),
            "{name} has no row in docs/dependencies.md"
        );
    }
}

/// Files that the sources include.
fn included(directory: &Path, found: &mut BTreeSet<PathBuf>) {
    for entry in fs::read_dir(directory).expect("a directory") {
        let path = entry.expect("an entry").path();
        // What tests alone include may be in another package.
        if path.file_stem().is_some_and(|stem| stem == "tests") {
            continue;
        }
        if path.is_dir() {
            included(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") {
            let text = fs::read_to_string(&path).expect("a file");
            for macro_name in ["include_str!(\"", "include_bytes!(\""] {
                for rest in text.split(macro_name).skip(1) {
                    let (name, _) = rest.split_once('"').expect("an end");
                    let folder = path.parent().expect("a folder");
                    let file = without_steps_up(&folder.join(name));
                    assert!(file.is_file(), "{} {name}", path.display());
                    found.insert(file);
                }
            }
        }
    }
}

/// A path without `..`. The folders of profiles and templates in a crate are links, which a package follows.
fn without_steps_up(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut to, part| {
        if part == Component::ParentDir {
            to.pop();
        } else {
            to.push(part);
        }
        to
    })
}

#[test]
fn each_package_holds_what_its_build_needs() {
    for (package, folder, least) in [
        ("camgen-kernel", "crates/kernel", 0),
        ("camgen-cams", "crates/cams", 40),
        ("camgen-printing", "crates/printing", 8),
        ("camgen", ".", 2),
    ] {
        let told = cargo(&["package", "--list", "--allow-dirty", "--locked", "--offline", "--package", package]);
        let packed: BTreeSet<&str> = told.lines().collect();
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder).canonicalize().expect("a path");
        let mut needed = BTreeSet::new();
        included(&root.join("src"), &mut needed);
        assert!(needed.len() >= least, "{package}: {needed:?}");
        for path in needed {
            let name = path.strip_prefix(&root).expect("in the package");
            assert!(packed.contains(name.to_str().expect("text")), "{} is not in {package}", name.display());
        }
    }
}

#[test]
fn the_package_of_the_program_holds_the_book() {
    let told = cargo(&["package", "--list", "--allow-dirty", "--locked", "--offline"]);
    let packed: BTreeSet<&str> = told.lines().collect();
    for name in
        ["README.md", "LICENSE-MIT", "LICENSE-APACHE", "SECURITY.md", "docs/trust.md", "Cargo.lock", "tests/run"]
    {
        assert!(packed.contains(name), "{name} is not in the package");
    }
    for name in &packed {
        assert!(!["target/", "output/", ".ci/"].iter().any(|outside| name.starts_with(outside)), "{name}");
    }
}
