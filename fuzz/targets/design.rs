//! A motion program from the fuzzer's numbers, all the way: a cam that is proven and whose files hold finite numbers, or a reason.
#![no_main]

use camgen::{Machine, Spec, Writing};
use libfuzzer_sys::arbitrary::{Arbitrary, Result, Unstructured};
use libfuzzer_sys::fuzz_target;

#[derive(Debug)]
struct Design {
    segments: Vec<(u8, u16, i16)>,
    follower: u8,
    radius: u16,
    arm: u16,
    base_radius: Option<u16>,
}

const LAWS: [&str; 10] = [
    "dwell",
    "cycloidal",
    "modified-sine",
    "modified-trapezoid",
    "3-4-5",
    "4-5-6-7",
    "harmonic",
    "parabola",
    "constant-velocity",
    "polynomial",
];

impl<'a> Arbitrary<'a> for Design {
    fn arbitrary(bytes: &mut Unstructured<'a>) -> Result<Self> {
        let (segments, follower, radius, arm, base_radius) = bytes.arbitrary()?;
        Ok(Self { segments, follower, radius, arm, base_radius })
    }
}

impl Design {
    /// A machine file; whatever the segments are, another leads back to where they began, and a dwell fills the turn.
    fn text(&self) -> String {
        let swings = self.follower % 4 > 1;
        let unit = if swings { "deg" } else { "mm" };
        let mut text = format!("name = \"fuzz\"\n[motion]\nstart = \"0 {unit}\"\n");
        for (law, over, to) in self.segments.iter().take(6) {
            let law = LAWS[usize::from(*law) % LAWS.len()];
            text +=
                &format!("[[motion.segment]]\nlaw = \"{law}\"\nover = \"{} deg\"\n", f64::from(*over % 12_000) / 100.0);
            if law != "dwell" {
                text += &format!("to = \"{} {unit}\"\n", f64::from(*to) / 500.0);
            }
        }
        text += &format!("[[motion.segment]]\nlaw = \"3-4-5\"\nover = \"60 deg\"\nto = \"0 {unit}\"\n");
        text += "[[motion.segment]]\nlaw = \"dwell\"\n";
        let radius = f64::from(self.radius) / 500.0;
        text += &match self.follower % 4 {
            0 => format!("[follower.roller]\nradius = \"{radius} mm\"\n"),
            1 => "[follower.flat]\n".to_owned(),
            _ => {
                let arm = f64::from(self.arm) / 100.0;
                format!(
                    "[follower.swinging-roller]\nradius = \"{radius} mm\"\narm = \"{arm} mm\"\npivot_distance = \"{} mm\"\n",
                    1.1 * arm
                )
            }
        };
        let base = self.base_radius.map_or("auto".to_owned(), |base| format!("{} mm", f64::from(base) / 100.0));
        text + &format!("[cam]\nbase_radius = \"{base}\"\n")
    }
}

fuzz_target!(|design: Design| {
    let Ok(machine) = Machine::from_toml("fuzz.toml", &design.text(), &[]) else { return };
    let Some(spec) = Spec::of_program(machine, None) else { return };
    let Ok(cam) = spec.solve() else { return };
    let Ok(drawing) = cam.draw(5e-5) else { return };
    let Ok(proven) = drawing.prove() else { return };
    let Ok(files) = proven.files(&Writing::to("unused", "fuzz").formats(&["dxf", "csv"])) else { return };
    let dxf = files.bytes(".dxf").expect("a cut file");
    assert!(camgen::reading::read(dxf, 1e-6).is_ok_and(|reading| reading.chains.len() == 1), "{}", design.text());
    let csv = String::from_utf8_lossy(files.bytes(".csv").expect("a table"));
    let none: Vec<&str> = csv.lines().filter(|line| line.contains("NaN")).collect();
    assert!(none.is_empty(), "{}{none:?}", design.text());
});
