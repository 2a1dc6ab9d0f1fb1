//! The STEP file read back by a reader that is no CAD kernel, so that nothing is repaired behind our back.
//!
//! It reads the text of ISO 10303-21, follows the references of one solid and demands: every name defined once, every
//! edge in exactly two loops and in opposite senses, loops that close, vertices on their curves, loops that run
//! counter-clockwise about the outward normal of their faces, and the area and volume of the report. Faults planted in
//! the text must break one of these.

use assert_cmd::Command;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;

type Vec3 = [f64; 3];

fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The entities of a file: number → keyword and the text of its arguments.
struct Part21(BTreeMap<u32, (String, Vec<String>)>);

impl Part21 {
    fn parse(text: &str) -> Result<Self, String> {
        if !text.is_ascii() || !text.starts_with("ISO-10303-21;") || !text.trim_end().ends_with("END-ISO-10303-21;") {
            return Err("not a whole file".into());
        }
        let data = text.split("DATA;\n").nth(1).and_then(|rest| rest.split("ENDSEC;").next()).ok_or("no data")?;
        let mut entities = BTreeMap::new();
        for line in data.lines() {
            let (number, body) =
                line.strip_prefix('#').and_then(|l| l.split_once(" = ")).ok_or(format!("odd line {line}"))?;
            let number: u32 = number.parse().map_err(|_| format!("odd number {line}"))?;
            let body = body.strip_suffix(");").ok_or(format!("no end: {line}"))?;
            let (keyword, arguments) = body.split_once('(').ok_or(format!("no arguments: {line}"))?;
            let entity = (keyword.to_owned(), split(arguments));
            if entities.insert(number, entity).is_some() {
                return Err(format!("#{number} twice"));
            }
        }
        let file = Self(entities);
        for (number, (_, arguments)) in &file.0 {
            for reference in arguments.iter().flat_map(|argument| references(argument)) {
                file.0.get(&reference).ok_or(format!("#{number} refers to #{reference}, which is not there"))?;
            }
        }
        Ok(file)
    }

    fn all(&self, keyword: &str) -> Vec<u32> {
        self.0.iter().filter(|(_, (k, _))| k == keyword).map(|(number, _)| *number).collect()
    }

    fn get(&self, number: u32, keyword: &str) -> Result<&[String], String> {
        match self.0.get(&number) {
            Some((found, arguments)) if found == keyword => Ok(arguments),
            other => Err(format!("#{number} is no {keyword}: {other:?}")),
        }
    }

    fn reference(&self, number: u32, keyword: &str, argument: usize) -> Result<u32, String> {
        references(&self.get(number, keyword)?[argument]).first().copied().ok_or(format!("#{number}: no reference"))
    }

    fn triple(&self, number: u32, keyword: &str) -> Result<Vec3, String> {
        let numbers = self.get(number, keyword)?[1].trim_matches(['(', ')']);
        let read: Result<Vec<f64>, String> = numbers
            .split(", ")
            .map(|n| {
                // A real of this format has a decimal point.
                if n.contains('.') {
                    n.parse().map_err(|_| format!("odd real {n}"))
                } else {
                    Err(format!("no point: {n}"))
                }
            })
            .collect();
        read?.try_into().map_err(|_| format!("#{number} has not three coordinates"))
    }

    fn vertex(&self, number: u32) -> Result<Vec3, String> {
        self.triple(self.reference(number, "VERTEX_POINT", 1)?, "CARTESIAN_POINT")
    }

    /// Origin, axis and reference direction.
    fn placement(&self, number: u32) -> Result<[Vec3; 3], String> {
        let at = |i| self.reference(number, "AXIS2_PLACEMENT_3D", i);
        Ok([
            self.triple(at(1)?, "CARTESIAN_POINT")?,
            self.triple(at(2)?, "DIRECTION")?,
            self.triple(at(3)?, "DIRECTION")?,
        ])
    }

    fn length(&self, number: u32, keyword: &str) -> Result<f64, String> {
        self.get(number, keyword)?[2].parse().map_err(|_| format!("#{number}: odd length"))
    }
}

/// Arguments at the top level of a list, texts kept whole.
fn split(arguments: &str) -> Vec<String> {
    let (mut found, mut current, mut depth, mut quoted) = (Vec::new(), String::new(), 0, false);
    for c in arguments.chars() {
        match c {
            '\'' => quoted = !quoted,
            '(' if !quoted => depth += 1,
            ')' if !quoted => depth -= 1,
            ',' if !quoted && depth == 0 => {
                found.push(std::mem::take(&mut current).trim().to_owned());
                continue;
            }
            _ => {}
        }
        current.push(c);
    }
    found.push(current.trim().to_owned());
    found
}

fn references(argument: &str) -> Vec<u32> {
    if argument.starts_with('\'') {
        return Vec::new();
    }
    let digits = |part: &str| part.chars().take_while(char::is_ascii_digit).collect::<String>().parse().ok();
    argument.split('#').skip(1).filter_map(digits).collect()
}

/// Points along an edge from its start to its end, the end left out.
fn along(file: &Part21, edge: u32) -> Result<Vec<Vec3>, String> {
    let arguments = file.get(edge, "EDGE_CURVE")?;
    let ends: Vec<Vec3> =
        [1, 2].iter().map(|i| file.vertex(references(&arguments[*i])[0])).collect::<Result<_, _>>()?;
    let curve = references(&arguments[3])[0];
    if file.get(curve, "LINE").is_ok() {
        let origin = file.triple(file.reference(curve, "LINE", 1)?, "CARTESIAN_POINT")?;
        let direction = file.triple(file.reference(file.reference(curve, "LINE", 2)?, "VECTOR", 1)?, "DIRECTION")?;
        for end in &ends {
            let off = cross(sub(*end, origin), direction);
            if dot(off, off).sqrt() > 1e-8 {
                return Err(format!("a vertex of #{edge} is off its line"));
            }
        }
        if dot(sub(ends[1], ends[0]), direction) <= 0.0 || arguments[4] != ".T." {
            return Err(format!("#{edge} runs against its line"));
        }
        return Ok(vec![ends[0]]);
    }
    let [centre, axis, x] = file.placement(file.reference(curve, "CIRCLE", 1)?)?;
    let radius = file.length(curve, "CIRCLE")?;
    let y = cross(axis, x);
    let angle = |p: Vec3| dot(sub(p, centre), y).atan2(dot(sub(p, centre), x));
    for end in &ends {
        let away = sub(*end, centre);
        if (dot(away, away).sqrt() - radius).abs() > 1e-8 || dot(away, axis).abs() > 1e-8 {
            return Err(format!("a vertex of #{edge} is off its circle"));
        }
    }
    let turn = std::f64::consts::TAU;
    let sweep = angle(ends[1]) - angle(ends[0]);
    let sweep = if arguments[4] == ".T." { sweep.rem_euclid(turn) } else { -(-sweep).rem_euclid(turn) };
    let on = |i: u32| {
        let (sin, cos) = (angle(ends[0]) + sweep * f64::from(i) / 400.0).sin_cos();
        std::array::from_fn(|k| centre[k] + radius * (cos * x[k] + sin * y[k]))
    };
    Ok((0..400).map(on).collect())
}

/// Half the sum of p × q over a closed polygon: its area vector.
fn area_vector(points: &[Vec3]) -> Vec3 {
    let mut sum = [0.0; 3];
    for (i, p) in points.iter().enumerate() {
        let c = cross(*p, points[(i + 1) % points.len()]);
        for k in 0..3 {
            sum[k] += 0.5 * c[k];
        }
    }
    sum
}

/// Checks a file; returns the area of its upper face.
fn check(text: &str) -> Result<f64, String> {
    let file = Part21::parse(text)?;
    let [brep] = file.all("MANIFOLD_SOLID_BREP")[..] else { return Err("not one solid".into()) };
    let shell = file.reference(brep, "MANIFOLD_SOLID_BREP", 1)?;
    if file.get(file.all("PRODUCT")[0], "PRODUCT")?[0] == "''" {
        return Err("the product has no name".into());
    }
    let mut uses: BTreeMap<u32, Vec<bool>> = BTreeMap::new();
    let mut end_areas = Vec::new();
    let listed = references(&file.get(shell, "CLOSED_SHELL")?[1]);
    if listed.len() != file.all("ADVANCED_FACE").len() {
        return Err("a face outside the shell".into());
    }
    for face in listed {
        let arguments = file.get(face, "ADVANCED_FACE")?;
        let mut whole = [0.0; 3];
        let mut some: Vec<Vec3> = Vec::new();
        for bound in references(&arguments[1]) {
            let bound_arguments = file.get(bound, "FACE_BOUND")?;
            let mut points: Vec<Vec3> = Vec::new();
            let mut ends: Vec<(u32, u32)> = Vec::new();
            for oriented in references(&file.get(references(&bound_arguments[1])[0], "EDGE_LOOP")?[1]) {
                let oriented_arguments = file.get(oriented, "ORIENTED_EDGE")?;
                let edge = references(&oriented_arguments[3])[0];
                let forward = oriented_arguments[4] == ".T.";
                let edge_arguments = file.get(edge, "EDGE_CURVE")?;
                let (a, b) = (references(&edge_arguments[1])[0], references(&edge_arguments[2])[0]);
                ends.push(if forward { (a, b) } else { (b, a) });
                uses.entry(edge).or_default().push(forward == (bound_arguments[2] == ".T."));
                let mut run = along(&file, edge)?;
                if !forward {
                    run.push(file.vertex(b)?);
                    run.remove(0);
                    run.reverse();
                }
                points.extend(run);
            }
            for i in 0..ends.len() {
                if ends[i].1 != ends[(i + 1) % ends.len()].0 {
                    return Err(format!("a loop of #{face} is broken"));
                }
            }
            let sign = if bound_arguments[2] == ".T." { 1.0 } else { -1.0 };
            let area = area_vector(&points);
            for k in 0..3 {
                whole[k] += sign * area[k];
            }
            some.extend(points);
        }
        let surface = references(&arguments[2])[0];
        let sense = if arguments[3] == ".T." { 1.0 } else { -1.0 };
        let normal = if file.get(surface, "PLANE").is_ok() {
            let [origin, normal, _] = file.placement(file.reference(surface, "PLANE", 1)?)?;
            if some.iter().any(|p| dot(sub(*p, origin), normal).abs() > 1e-8) {
                return Err(format!("#{face} leaves its plane"));
            }
            normal
        } else {
            let [origin, axis, _] = file.placement(file.reference(surface, "CYLINDRICAL_SURFACE", 1)?)?;
            let radius = file.length(surface, "CYLINDRICAL_SURFACE")?;
            let radial = |p: &Vec3| {
                let d = sub(*p, origin);
                let along_axis = dot(d, axis);
                std::array::from_fn(|k| d[k] - along_axis * axis[k])
            };
            if some.iter().map(radial).any(|r| (dot(r, r).sqrt() - radius).abs() > 1e-8) {
                return Err(format!("#{face} leaves its cylinder"));
            }
            // A patch of less than a whole turn: the sum of its radial vectors points along its middle normal.
            some.iter().map(radial).fold([0.0; 3], |sum, r| std::array::from_fn(|k| sum[k] + r[k]))
        };
        if sense * dot(whole, normal) <= 0.0 {
            return Err(format!("the loops of #{face} run against its sense"));
        }
        if file.get(surface, "PLANE").is_ok() && normal[2].abs() > 0.5 {
            end_areas.push(whole[2] * normal[2]);
        }
    }
    for (edge, mut senses) in uses {
        senses.sort_unstable();
        if senses != [false, true] {
            return Err(format!("edge #{edge} is used {senses:?}"));
        }
    }
    match end_areas[..] {
        [lower, upper] if (lower / upper - 1.0).abs() < 1e-9 => Ok(upper),
        _ => Err(format!("the end faces differ: {end_areas:?}")),
    }
}

fn step(args: &[&str]) -> (String, Value) {
    let directory = tempfile::tempdir().expect("a directory");
    let all = [&["rotary", "--json", "--format", "step", "--name", "cam", "--out", "."], args].concat();
    let output = Command::cargo_bin("camgen")
        .expect("the program")
        .current_dir(directory.path())
        .args(all)
        .output()
        .expect("it runs");
    let text = fs::read_to_string(directory.path().join("cam.step")).expect("a file");
    (text, serde_json::from_slice(&output.stdout).expect("a report"))
}

#[test]
fn every_kind_of_cam_is_one_good_solid() {
    let keyway =
        ["--set", "cam.keyway.width=8mm", "--set", "cam.keyway.depth=3.3mm", "--set", "cam.keyway.angle=90deg"];
    // A short lever makes the forces large: the disc is as thick as they need.
    let holes = ["cam.lever=0.15", "cam.base_radius=90mm", "cam.balance=40mm .. 85mm", "cam.thickness=100mm"];
    let holes: Vec<&str> = holes.iter().flat_map(|value| ["--set", value]).collect();
    let corner = ["buffer.column=return", "transition.kind=none", "cam.rotation=ccw", "limits.continuity=0"];
    let corner: Vec<&str> = corner.iter().flat_map(|value| ["--set", value]).collect();
    for args in [&[][..], &keyway, &holes, &corner, &["dpi-paper"]] {
        let (text, report) = step(args);
        let area = check(&text).unwrap_or_else(|fault| panic!("{args:?}: {fault}"));
        let told = report["cam"]["area_mm2"].as_f64().expect("an area");
        // Arcs are seen as 400 chords here: 2e-5 of the segment's cap, far below a sense that is wrong.
        assert!((area / told - 1.0).abs() < 1e-5, "{args:?}: {area} {told}");
    }
}

#[test]
fn names_are_escaped() {
    let (text, _) = step(&["--set", "name=Станок 'ДПИ'"]);
    assert!(text.is_ascii());
    assert!(
        text.contains("#7 = PRODUCT('\\X2\\042104420430043D043E043A\\X0\\ ''\\X2\\0414041F0418\\X0\\\\X\\27"),
        "{}",
        &text[..900]
    );
    check(&text).expect("a good solid");
}

/// Each fault is planted in every place of its kind that is tried, and must be seen, or show in the area.
#[test]
fn planted_faults_are_caught() {
    let (good, report) =
        step(&["--set", "buffer.column=return", "--set", "transition.kind=none", "--set", "limits.continuity=0"]);
    let told = report["cam"]["area_mm2"].as_f64().expect("an area");
    let caught = |text: &str| check(text).map_or(true, |area| (area / told - 1.0).abs() > 1e-5);
    assert!(!caught(&good));
    let lines: Vec<&str> = good.lines().collect();
    let edited = |number: usize, line: &str| {
        let mut all = lines.clone();
        all[number] = line;
        all.join("\n") + "\n"
    };
    let mut planted = BTreeMap::<&str, u32>::new();
    for (number, line) in lines.iter().enumerate() {
        for kind in ["ORIENTED_EDGE", "ADVANCED_FACE", "FACE_BOUND", "EDGE_CURVE"] {
            // A straight edge has one sense only; a curve is flipped on circles.
            if line.contains(&format!("= {kind}(")) {
                let flipped = if line.ends_with(".T.);") {
                    line.replace(".T.);", ".F.);")
                } else {
                    line.replace(".F.);", ".T.);")
                };
                assert!(caught(&edited(number, &flipped)), "{kind} flipped: {line}");
                *planted.entry(kind).or_default() += 1;
            }
        }
        if let Some((head, coordinates)) = line.split_once("CARTESIAN_POINT('', (") {
            // The last points of the file are the vertices.
            let (x, rest) = coordinates.split_once(", ").expect("coordinates");
            let moved = x.parse::<f64>().expect("a real") + 1e-6;
            let moved = format!("{head}CARTESIAN_POINT('', ({moved:?}, {rest}");
            if number + 120 > lines.len() {
                assert!(caught(&edited(number, &moved)), "moved by a nanometre: {line}");
                *planted.entry("vertex").or_default() += 1;
            }
        }
        if line.contains("= CLOSED_SHELL(") {
            let dropped = line.replacen("(#", "(", 1);
            let dropped = dropped.split_once(", #").map(|(head, rest)| {
                let head = head.rsplit_once('(').expect("a list").0;
                format!("{head}(#{rest}")
            });
            assert!(caught(&edited(number, &dropped.expect("faces"))), "a face dropped");
            *planted.entry("face").or_default() += 1;
        }
    }
    assert_eq!(planted.len(), 6, "{planted:?}");
    assert!(planted.values().all(|n| *n > 0));
}
