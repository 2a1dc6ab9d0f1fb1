//! Files that were cut, torn and spliced at random: each is read or refused, within the limits, and what is told of it is plain.
//!
//! `CAMGEN_MUTATIONS=1000000 cargo test --release --test all mutations::` is the long run; `CAMGEN_SEED` begins elsewhere.

use camgen::document::is_plain;
use camgen::domains::press::SpecOfPress;
use camgen::geometry::contour::Edge;
use camgen::profile::outline::{Fit, SegmentKind};
use camgen::reading::{self, MOST_SEGMENTS, step};
use camgen::tool_files::dxf::Version;
use camgen::{Machine, Request, Spec, Writing};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// Reach within which ends are joined, mm, as `camgen check` has it for 5 µm.
const REACH: f64 = 5e-4;
/// Longest time for a file of some ten kilobytes: a hundred times what one takes, for a busy machine.
const LONGEST: Duration = Duration::from_secs(5);

/// Numbers from 0 up, the same in every run (SplitMix64).
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        usize::try_from((mixed ^ (mixed >> 31)) % (end.max(1) as u64)).expect("below the end")
    }

    fn one_of<'a, T>(&mut self, all: &'a [T]) -> &'a T {
        &all[self.below(all.len())]
    }
}

const EXTREME: [&str; 26] = [
    "1e300",
    "-1e300",
    "nan",
    "inf",
    "1e15",
    "-1e15",
    "1.1e15",
    "1e-300",
    "5e-324",
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "3",
    "11",
    "12",
    "360",
    "70",
    "999999999999",
    "9223372036854775807",
    "-2147483648",
    "0x10",
    "",
    "\x1b[31m",
    "\u{202e}\u{fffe}",
];
/// Words of DXF that change what stands around them.
const WORDS: [&str; 20] = [
    "SECTION",
    "ENDSEC",
    "ENTITIES",
    "BLOCKS",
    "TABLES",
    "LAYER",
    "BLOCK",
    "ENDBLK",
    "INSERT",
    "SPLINE",
    "ELLIPSE",
    "LINE",
    "ARC",
    "CIRCLE",
    "POLYLINE",
    "VERTEX",
    "SEQEND",
    "EOF",
    "CAM_PROFILE",
    "{",
];
const CODES: [&str; 24] = [
    "0", "2", "8", "10", "11", "12", "13", "20", "21", "30", "38", "39", "40", "41", "42", "43", "44", "50", "60",
    "70", "71", "102", "210", "230",
];

/// A file after one accident.
fn spoilt(dice: &mut Dice, mut data: Vec<u8>, others: &[Vec<u8>]) -> Vec<u8> {
    let lines: Vec<&[u8]> = data.split(|byte| *byte == b'\n').collect();
    let at = dice.below(lines.len());
    let with = |new: &[u8]| {
        let mut changed = lines.clone();
        changed[at] = new;
        changed.join(&b'\n')
    };
    match dice.below(9) {
        0 => {
            for _ in 0..*dice.one_of(&[1, 1, 4, 40]) {
                let place = dice.below(data.len());
                if let Some(byte) = data.get_mut(place) {
                    *byte = u8::try_from(dice.below(256)).expect("a byte");
                }
            }
            data
        }
        1 | 2 => with(dice.one_of(&EXTREME).as_bytes()),
        3 => with(dice.one_of(&WORDS).as_bytes()),
        4 => with(dice.one_of(&CODES).as_bytes()),
        5 => {
            let count = *dice.one_of(&[1, 2, 2, 6, 50]);
            let end = (at + count).min(lines.len());
            [&lines[..at], &lines[end..]].concat().join(&b'\n')
        }
        6 => {
            let count = *dice.one_of(&[1, 2, 2, 6, 200]);
            let few = lines[at..(at + count).min(lines.len())].repeat(*dice.one_of(&[1, 1, 3, 100]));
            [&lines[..at], &few, &lines[at..]].concat().join(&b'\n')
        }
        7 => {
            data.truncate(dice.below(data.len() + 1));
            data.extend_from_slice(dice.one_of::<&[u8]>(&[
                &b""[..],
                b"\n  0\nENDSEC\n  0\nEOF\n",
                b"\nEND-ISO-10303-21;",
            ]));
            data
        }
        _ => {
            let other = dice.one_of(others);
            data.truncate(dice.below(data.len() + 1));
            data.extend_from_slice(&other[dice.below(other.len())..]);
            data
        }
    }
}

/// Cut files of every sort, and a solid, as they should be.
fn good_files() -> (Vec<Vec<u8>>, Vec<Vec<u8>>) {
    let sets = ["cam.keyway.width=8mm", "cam.keyway.depth=3.3mm"].map(str::to_owned);
    let (machine, _) = Machine::load("dpi", &sets).expect("a machine");
    let cam = Spec::rotary(machine, 35.0).solve().expect("a cam");
    let files = |laid: SegmentKind, version: Version, formats: &[&str]| {
        let request = Request::within(Fit { laid, ..Fit::from(20e-6) });
        let proven = cam.draw(request).expect("drawn").prove_as(version).expect("proven");
        let files = proven.files(&Writing::to("nowhere", "part").formats(formats)).expect("files");
        files.outputs().iter().map(|output| output.bytes.clone()).collect::<Vec<_>>()
    };
    let mut drawings = files(SegmentKind::Arcs, Version::R2000, &["dxf", "step"]);
    let solids = drawings.split_off(1);
    drawings.extend(files(SegmentKind::Splines, Version::R2000, &["dxf"]));
    drawings.extend(files(SegmentKind::Arcs, Version::R12, &["dxf"]));
    (drawings, solids)
}

fn is_told_plainly(text: &str) {
    assert!(text.chars().all(is_plain), "{text:?}");
    assert!(!text.contains("please report") && text.len() < 5000, "{text}");
}

fn read_drawing(bytes: &[u8]) -> bool {
    match reading::read(bytes, REACH) {
        Err(error) => {
            is_told_plainly(&error.to_string());
            false
        }
        Ok(found) => {
            let chains = || found.chains.iter().chain(&found.others);
            assert!(chains().map(|chain| chain.edges.len()).sum::<usize>() <= MOST_SEGMENTS);
            assert!(chains().all(|chain| !chain.edges.is_empty() && chain.edges.iter().all(Edge::is_finite)));
            chains().for_each(|chain| is_told_plainly(&chain.names()));
            found.unreadable.iter().chain(&found.information).for_each(|stray| is_told_plainly(&stray.to_string()));
            [&found.layers, &found.hidden, &found.remarks].into_iter().flatten().for_each(|text| is_told_plainly(text));
            true
        }
    }
}

fn read_solid(bytes: &[u8]) -> bool {
    match step::read(bytes) {
        Err(error) => {
            is_told_plainly(&error.to_string());
            false
        }
        Ok(file) => {
            file.bodies.iter().chain(&file.faults).for_each(|text| is_told_plainly(text));
            let _ = step::form(&file.boundary, step::FlankShape::Upright, REACH);
            true
        }
    }
}

/// Of so many files from a number on: how many were read, which failed, and the longest time.
fn run(seeds: std::ops::Range<u64>, files: &[Vec<u8>], read: impl Fn(&[u8]) -> bool) -> (usize, Vec<u64>, Duration) {
    let (mut good, mut failed, mut longest) = (0, Vec::new(), Duration::ZERO);
    for seed in seeds {
        let mut dice = Dice(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
        let mut data = dice.one_of(files).clone();
        for _ in 0..*dice.one_of(&[1, 1, 1, 2, 4, 9]) {
            data = spoilt(&mut dice, data, files);
        }
        let start = Instant::now();
        match catch_unwind(AssertUnwindSafe(|| read(&data))) {
            Ok(was_read) => good += usize::from(was_read),
            Err(_) => failed.push(seed),
        }
        longest = longest.max(start.elapsed());
    }
    (good, failed, longest)
}

fn asked(variable: &str, otherwise: u64) -> u64 {
    std::env::var(variable).map_or(otherwise, |text| text.parse().expect("a whole number"))
}

/// The same over all cores.
fn hold(count: u64, files: &[Vec<u8>], what: &str, read: impl Fn(&[u8]) -> bool + Sync) {
    let (first, threads) =
        (asked("CAMGEN_SEED", 0), std::thread::available_parallelism().map_or(1, |n| n.get() as u64));
    let all: Vec<(usize, Vec<u64>, Duration)> = std::thread::scope(|scope| {
        let part = |index: u64| first + count * index / threads..first + count * (index + 1) / threads;
        let read = &read;
        let running: Vec<_> = (0..threads).map(|i| scope.spawn(move || run(part(i), files, read))).collect();
        running.into_iter().map(|thread| thread.join().expect("ended")).collect()
    });
    let good: usize = all.iter().map(|(good, ..)| good).sum();
    let failed: Vec<u64> = all.iter().flat_map(|(_, failed, _)| failed.clone()).collect();
    let longest = all.iter().map(|(.., longest)| *longest).max().unwrap_or_default();
    println!("{count} {what}: {good} read, the others refused, {} failed, longest {longest:?}", failed.len());
    assert!(failed.is_empty(), "seeds {failed:?}");
    assert!(longest < LONGEST, "{longest:?}");
    assert!(
        good as u64 > count / 20 && (good as u64) < count,
        "{good} of {count} were read: the changes are of no use"
    );
}

#[test]
fn spoilt_files_are_read_or_refused() {
    let (drawings, solids) = good_files();
    assert!(drawings.iter().all(|data| read_drawing(data)) && solids.iter().all(|data| read_solid(data)));
    let count = asked("CAMGEN_MUTATIONS", 20_000);
    hold(count, &drawings, "spoilt DXF files", read_drawing);
    hold(count / 20 + 1, &solids, "spoilt STEP files", read_solid);
}
