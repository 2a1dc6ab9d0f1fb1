//! The comparison of laws and the smallest cam, as their reader sees them.

use camgen::analysis::laws::{self, LawsOptions};
use camgen::analysis::{Analysis, Picture, size};
use camgen::report::plot::Plot;
use camgen::{Machine, law};

fn machine(name: &str) -> Machine {
    Machine::load(name, &[]).expect("valid").0
}

fn plot(analysis: &Analysis) -> &Plot {
    let Picture::Curves(plot) = &analysis.picture else { panic!("curves") };
    plot
}

/// Laws whose acceleration jumps come after all others, and each group begins with the least peak acceleration.
#[test]
fn laws_whose_acceleration_jumps_come_last() {
    for machine in [None, Some(machine("feeder"))] {
        let all = laws::analysis(machine.as_ref(), &LawsOptions::default()).expect("laws");
        let (_, table) = &all.tables[0];
        let column = |name: &str| table.columns.iter().position(|column| *column == name).expect("a column");
        let (ca, cj) = (column("ca"), column("cj"));
        let rows: Vec<(bool, f64)> = table.rows.iter().map(|row| (row[cj].is_infinite(), row[ca])).collect();
        assert!(rows.is_sorted(), "{rows:?}");
        assert!(rows.iter().filter(|(jumps, _)| *jumps).count() > 3);
        // A column that is asked for is the only order.
        let sorted = LawsOptions { sort: Some("cv".into()), ..LawsOptions::default() };
        let by_velocity = laws::analysis(machine.as_ref(), &sorted).expect("laws");
        let cv: Vec<f64> = by_velocity.tables[0].1.rows.iter().map(|row| row[column("cv")]).collect();
        assert!(cv.is_sorted(), "{cv:?}");
    }
}

/// Only the laws that are asked for are compared and drawn, lift to jerk, each rate over its own scale.
#[test]
fn laws_can_be_chosen() {
    let chosen = ["modified-sine", "cycloidal", "parabola"];
    let laws = chosen.iter().filter_map(|name| law(name).ok()).collect();
    let options = LawsOptions { laws, ..LawsOptions::default() };
    let analysis = laws::analysis(Some(&machine("feeder")), &options).expect("laws");
    let (_, table) = &analysis.tables[0];
    assert_eq!(table.words.as_ref().expect("names").1, chosen);
    let plot = plot(&analysis);
    assert!(plot.title.starts_with("modified-sine"), "{}", plot.title);
    assert!(plot.subtitle.starts_with("Feeder: "), "{}", plot.subtitle);
    assert_eq!(plot.panels.len(), 4);
    let peak = |panel: usize, curve: usize| {
        let points = &plot.panels[panel].curves[curve].points;
        points.iter().map(|[_, value]| value.abs()).fold(0.0, f64::max)
    };
    let column = |name: &str| table.columns.iter().position(|column| *column == name).expect("a column");
    for (curve, row) in table.rows.iter().enumerate() {
        assert!((peak(0, curve) - 1.0).abs() < 1e-12);
        for (panel, name) in [(1, "cv"), (2, "ca")] {
            let (drawn, told) = (peak(panel, curve), row[column(name)]);
            assert!((drawn / told - 1.0).abs() < 1e-3 && drawn <= told * (1.0 + 1e-12), "{name}: {drawn} {told}");
        }
    }
}

/// Each heading of the table in the text has a line that says what it is.
#[test]
fn every_column_is_explained() {
    for machine in [None, Some(machine("feeder"))] {
        let analysis = laws::analysis(machine.as_ref(), &LawsOptions::default()).expect("laws");
        let words: Vec<String> = analysis.sections[0].words.iter().map(|line| line.text.to_string()).collect();
        let heads = words.iter().find(|line| line.starts_with("law ")).expect("headings");
        for head in heads.split_whitespace().skip(1) {
            let explained =
                |line: &&String| line.split_whitespace().next() == Some(head) && line.len() > head.len() + 10;
            assert_eq!(words.iter().filter(explained).count(), 1, "{head}: {words:#?}");
        }
    }
}

/// The plot of sizes has the limits and a mark at the chosen cam.
#[test]
fn the_plot_of_sizes_has_limits_and_the_chosen_cam() {
    let analysis = size::analysis(&machine("feeder"), &[], None).expect("a size");
    let plot = plot(&analysis);
    let angle = &plot.panels[0];
    let limit = angle.bands.first().expect("a limit");
    assert!((limit.from - 30.0).abs() < 1e-9 && limit.to.is_infinite(), "{limit:?}");
    for (_, panel) in
        plot.panels.iter().map(|panel| ("", panel)).chain(plot.own.iter().map(|(at, panel)| (&**at, panel)))
    {
        let [at, value] = panel.points.first().expect("a mark").at;
        // It lies on the curve, but for the steps of the table.
        let curve = panel.curves.iter().rfind(|curve| curve.points.len() > 2).expect("a curve");
        let near = curve.points.windows(2).find(|two| two[0][0] <= at && at <= two[1][0]).expect("in the table");
        let [low, high] = [near[0][1].min(near[1][1]), near[0][1].max(near[1][1])];
        assert!(value >= low - 0.6 && value <= high + 0.6, "{value} {near:?}");
    }
}

/// A pair whose counter disc determines the size: the law of its file needs the same size in the comparison as in `camgen size`.
const PAIR: &str = r#"
name = "pair"
[motion]
rpm = 150
start = "5.5 mm"
[[motion.segment]]
over = "88 deg"
law = "cycloidal"
to = "10.4 mm"
[[motion.segment]]
over = "120 deg"
law = "dwell"
[[motion.segment]]
law = "cycloidal"
to = "5.5 mm"
[follower.roller]
radius = "8.6 mm"
[cam]
body = "conjugate"
thickness = "20 mm"
[cam.counter]
radius = "12.4 mm"
preload = "200 N"
[limits]
pressure_angle = "55 deg"
"#;

#[test]
fn laws_need_the_size_that_both_discs_of_a_pair_need() {
    let smallest = |text: &str| {
        let machine = Machine::from_toml("pair.toml", text, &[]).expect("valid");
        let column = |analysis: &Analysis, table: usize, name: &str| {
            let table = &analysis.tables[table].1;
            let column = table.columns.iter().position(|column| *column == name).expect("a column");
            table.rows.iter().map(|row| row[column]).collect::<Vec<f64>>()
        };
        let options = LawsOptions { laws: vec![law("cycloidal").expect("a law")], ..LawsOptions::default() };
        let laws = laws::analysis(Some(&machine), &options).expect("laws");
        let sizes = size::analysis(&machine, &[], None).expect("a size");
        // The row of the smallest cam is the only one whose offset is 0.
        let offsets = column(&sizes, 0, "offset_mm");
        let own = offsets.iter().position(|offset| offset.abs() < 1e-9).expect("the offset of the file");
        (column(&laws, 0, "smallest_prime_radius_mm")[0], column(&sizes, 0, "prime_radius_mm")[own])
    };
    let (of_pair, found_for_pair) = smallest(PAIR);
    let (of_disc, found_for_disc) = smallest(&PAIR.replace("conjugate", "disc"));
    assert!((of_pair - found_for_pair).abs() < 1e-6 && (of_disc - found_for_disc).abs() < 1e-6);
    assert!(of_pair > of_disc + 1.0, "{of_pair} {of_disc}");
}
