use super::*;

fn dpi(overrides: &[&str]) -> Result<Machine, MachineError> {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    Machine::load("dpi", &overrides).map(|(machine, _)| machine)
}

fn message(overrides: &[&str]) -> String {
    dpi(overrides).expect_err("a fault").to_string()
}

#[test]
fn every_embedded_machine_and_the_template_read() {
    for embedded in EMBEDDED {
        let (machine, stem) = Machine::load(embedded.name, &[]).unwrap_or_else(|e| panic!("{}: {e}", embedded.name));
        assert_eq!(stem, embedded.name);
        assert!(machine.translating.is_some() && machine.conoid.is_some());
    }
    let template = include_str!("../../templates/machine.toml");
    assert!(Machine::from_toml("template", template, &[]).is_ok());
}

#[test]
fn an_override_replaces_a_value() {
    let machine = dpi(&["follower.roller.radius=25mm", "cam.base_radius = auto", "cam.lever=2"]).expect("valid");
    assert_eq!(machine.roller.radius, 0.025);
    assert_eq!(machine.cam.lever, 2.0);
}

#[test]
fn faults_name_value_place_and_remedy() {
    for (set, parts) in [
        ("bed.mass=978.2", vec!["has no unit", "kg, lb", "--set:1:"]),
        ("bed.mass=978 mm", vec!["unit of length, not of mass"]),
        ("bed.mass=-3 kg", vec!["must be above 0 kg", "-3 kg"]),
        ("bed.mass=0 kg", vec!["must be above 0 kg"]),
        ("bed.mass=nan kg", vec!["not a finite number"]),
        ("bed.mass=1e300 kg", vec!["at most 10000000 kg"]),
        ("bed.mass=heavy", vec!["does not start with a number"]),
        ("buffer.end_pressure=0.9 at", vec!["end_pressure must be above ambient_pressure: 0.9 at ≤ 1 at"]),
        ("buffer.column=long", vec!["or \"matched\" or \"return\""]),
        ("transition.kind=smooth", vec!["one of \"run-up\", \"blend\", \"none\""]),
        ("cam.thicknes=3 mm", vec!["unknown key `cam.thicknes`", "did you mean `cam.thickness`?"]),
        ("cam.bore_radius", vec!["no `=`"]),
        ("design.rpm=0", vec!["must be at least 0.001"]),
        ("cam.thickness=0.1um", vec!["must be at least 1 um"]),
        ("design.rpm=35 rpm", vec!["not a bare number"]),
        ("name=", vec!["must be a text"]),
        ("cam.keyway.width=8mm", vec!["missing key `cam.keyway.depth`"]),
        ("cam.keyway.widht=8mm", vec!["did you mean `cam.keyway.width`?"]),
        ("cam.balance=40mm", vec!["must be a band", "35 mm .. 60 mm"]),
        ("cam.balance=60mm .. 40mm", vec!["from the smaller to the larger"]),
        ("cam.balance=20mm .. 40mm", vec!["must begin outside the bore of 25 mm"]),
        ("follower.roller.mass=0kg", vec!["must be above 0 kg"]),
        ("follower.roller.preload=5kg", vec!["unit of mass, not of force"]),
        ("limits.contact_stress=5", vec!["has no unit", "MPa"]),
    ] {
        let text = message(&[set]);
        for part in parts {
            assert!(text.contains(part), "{set}: no {part:?} in\n{text}");
        }
    }
}

#[test]
fn several_faults_of_a_file_come_at_once_in_its_order() {
    let toml = "name = \"x\"\n[bed]\nmass = 5\ncrank_radius = \"180 kg\"\n[follower.roller]\nradius = true\n[camm]\nlever = 1\n";
    let error = Machine::from_toml("bad.toml", toml, &[]).expect_err("faults");
    let text = error.to_string();
    for part in [
        "bad.toml:3:8",
        "bad.toml:4:16",
        "bad.toml:6:10",
        "missing key `buffer.ambient_pressure`",
        "bad.toml:8:1",
        "^^^^^\n",
        "did you mean `cam.lever`?",
    ] {
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
    let lines: Vec<usize> = error.faults.iter().filter_map(|f| f.place.as_ref()).map(|p| p.line).collect();
    assert!(lines.is_sorted(), "{lines:?}");
    let broken = Machine::from_toml("bad.toml", "name = \n[bed\n", &[]).expect_err("not TOML").to_string();
    assert!(broken.contains("not TOML") && broken.contains("bad.toml:1:"), "{broken}");
}

#[test]
fn keys_in_disguise_and_empty_tables_are_unknown() {
    let dpi = EMBEDDED[0].toml;
    for (toml, part) in [
        (format!("\"bed.mass\" = \"1 kg\"\n{dpi}"), "unknown key `\"bed.mass\"`"),
        (format!("{dpi}\n[foo]\n"), "unknown table `foo`"),
        (format!("{dpi}\n[limits.zzz]\n"), "unknown table `limits.zzz`"),
        (format!("{dpi}\n[cam.keyway]\n"), "missing key `cam.keyway.width`"),
    ] {
        let text = Machine::from_toml("press.toml", &toml, &[]).expect_err(part).to_string();
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
    let broken = Machine::from_toml("bad.toml", "name=\"a\"\n[bed\n", &[]).expect_err("not TOML");
    assert_eq!(broken.faults.len(), 1, "only what is wrong with the text: {broken}");
}

#[test]
fn files_that_cannot_be_read_are_told() {
    for (path, part) in [("no-such.toml", "cannot read"), ("src", "directory"), ("/dev/zero", "larger than")] {
        let text = Machine::load(path, &[]).expect_err(path).to_string();
        assert!(text.contains(part) && text.contains("dpi-paper"), "{text}");
    }
}
