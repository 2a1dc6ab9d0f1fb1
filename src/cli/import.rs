//! `camgen import`: an old cam as a design.

use super::analyses::write_with;
use super::args::{ImportArgs, ImportAs, ImportForm, LawOrSpline};
use super::cams::source_date;
use super::input_files::files;
use super::{Failure, Outcome};
use camgen::Vector2;
use camgen::analysis::compare::measured::{self, PointsOf, PointsStated};
use camgen::analysis::import::{self, ImportOptions, ImportSource};
use camgen::catalogue::lift_table;
use camgen::pipeline::{Judged, Writing};
use camgen::reading::outline::outline_of;
use camgen::reading::{LARGEST_FILE, step};
use camgen::report::shown;
use std::path::Path;

/// The formats that are written by default.
const USUAL: [&str; 3] = ["toml", "csv", "svg"];
/// Largest table, bytes.
const LARGEST_TABLE: u64 = 16 << 20;

pub(super) fn run(args: &ImportArgs) -> Result<Outcome, Failure> {
    let file = args.file.display().to_string();
    let name = args.file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut options = options(args, name.clone())?;
    let form = match form_said(args)? {
        Some(form) => form,
        // What says how a table is read is said of a table.
        None if of_table(args).iter().any(|(_, given)| *given) => ImportForm::Table,
        None => form_of(&args.file, !args.follower.is_empty() || args.ball.radius().is_some())?,
    };
    refuse_flags(args, form)?;
    let source = match form {
        ImportForm::Table => table(args, &options)?,
        ImportForm::Outline => {
            let bytes = files().bytes_of(&args.file, LARGEST_FILE).map_err(|why| unread(&file, &why))?;
            let found =
                outline_of(&bytes, args.layer.as_deref()).map_err(|why| Failure(format!("`{file}` is {why}")))?;
            ImportSource::Outline(found.contour, found.told)
        }
        ImportForm::Points => {
            let text = files().table_text_of(&args.file, LARGEST_TABLE).map_err(|why| unread(&file, &why))?;
            let mut stated = measured::stated(&text);
            // Columns that no heading names are those that --as says.
            stated.is_polar |= args.taken_as.is_some() && !stated.has_columns;
            let read = if stated.is_polar { measured::read_radii } else { measured::read };
            let points = read(&text).map_err(|why| Failure(format!("`{file}`: {why}")))?;
            let ball = set_curve(args, &mut options, stated)?;
            ImportSource::Points(against_rotation(points, &mut options, stated), ball)
        }
    };
    let analysis = import::analysis(&source, &options).map_err(|why| Failure(format!("`{file}`: {why}")))?;
    let judged = args.to.judged(Judged::new(analysis));
    let stem = args.to.name.clone().unwrap_or_else(|| judged.stem(&name));
    let writing = Writing {
        formats: Some(args.format.clone().unwrap_or_else(|| USUAL.map(str::to_owned).to_vec())),
        template: args.to.template()?,
        force: args.to.force,
        overwrite: args.to.overwrite,
        created: source_date()?,
        ..Writing::to(&args.to.out, stem)
    };
    write_with(&judged, &args.report, &writing)
}

/// The file form given by the flags.
fn form_said(args: &ImportArgs) -> Result<Option<ImportForm>, Failure> {
    let by_as = args.taken_as.map(|taken| if taken == ImportAs::Lift { ImportForm::Table } else { ImportForm::Points });
    let by_points = args.points_of.map(|_| ImportForm::Points);
    let said: Vec<ImportForm> = [args.from, by_as, by_points].into_iter().flatten().collect();
    if said.windows(2).any(|pair| pair.first() != pair.last()) {
        return Err(Failure(
            "--from, --as and --points-of contradict each other; use --as lift for a table, and --as profile, --as pitch or --points-of for points".into(),
        ));
    }
    Ok(said.first().copied())
}

/// Sets the curve on which points lie, as flags or their file state it, and returns the radius of the ball whose centres they are, mm.
fn set_curve(args: &ImportArgs, options: &mut ImportOptions, stated: PointsStated) -> Result<f64, Failure> {
    let by_as = match args.taken_as {
        Some(ImportAs::Profile) => Some(PointsOf::Profile),
        Some(ImportAs::Pitch) => Some(PointsOf::Centre),
        Some(ImportAs::Lift) | None => None,
    };
    if by_as.is_some() && args.points_of.is_some() && by_as != args.points_of {
        return Err(Failure("--as and --points-of contradict each other; give one of them".into()));
    }
    let by_flag = by_as.or(args.points_of);
    let file = args.file.display();
    options.has_angles = stated.is_polar;
    let ball = stated
        .ball(args.ball.radius().map(|radius| 1e3 * radius))
        .map_err(|why| Failure(format!("`{file}`: {why}")))?;
    if matches!(stated.of, Some(PointsOf::Tool | PointsOf::Gauge)) {
        if by_flag.is_some() {
            return Err(Failure(format!(
                "`{file}` gives the path of the centre of a cutter, wheel or gauge by its head; leave --as and --points-of out"
            )));
        }
        return Ok(ball.unwrap_or(0.0));
    }
    options.points_of = by_flag.or(stated.of);
    if ball.is_some() && options.points_of == Some(PointsOf::Centre) {
        return Err(Failure(
            "--ball is for centres of a measuring ball, but the points are roller centres; remove one of the two"
                .into(),
        ));
    }
    if stated.is_polar && options.points_of.is_none() && ball.is_none() {
        return Err(Failure(format!(
            "`{file}` has radii: whether of the profile or of the roller's centre is not stated; give --as profile or --as pitch"
        )));
    }
    Ok(ball.unwrap_or(0.0))
}

/// Points whose angles are against the rotation of the cam, as they lie in a drawing.
fn against_rotation(points: Vec<Vector2<f64>>, options: &mut ImportOptions, stated: PointsStated) -> Vec<Vector2<f64>> {
    let rotation = options.settings.iter().find_map(|key| key.trim_start().strip_prefix("cam.rotation"));
    // The head of a table of a gauge does not state the rotation.
    let turns_back = stated.turns_back
        || (stated.of == Some(PointsOf::Gauge) && rotation.is_some_and(|value| value.contains("ccw")));
    if !turns_back {
        return points;
    }
    if rotation.is_none() {
        options.settings.push("cam.rotation=ccw".into());
    }
    points.into_iter().map(|point| Vector2::new(point.x, -point.y)).collect()
}

fn unread(file: &str, why: &camgen::Refusal) -> Failure {
    Failure(format!("cannot read `{file}`: {why}"))
}

/// The options as the flags say them.
fn options(args: &ImportArgs, name: String) -> Result<ImportOptions, Failure> {
    let (kind, keys) = match args.follower.split_first() {
        None => (None, &[][..]),
        Some((kind, keys)) => (Some(kind.trim().to_lowercase()), keys),
    };
    let mut settings = Vec::new();
    for key in keys {
        if !key.contains('=') {
            let kind = kind.as_deref().unwrap_or_default();
            return Err(Failure(format!(
                "--follower: `{key}` is not KEY=VALUE; write the keys of the follower behind its kind, e.g. --follower {kind},diameter=24mm"
            )));
        }
        settings.push(format!("follower.{}.{}", kind.as_deref().unwrap_or_default(), key.trim()));
    }
    settings.extend(args.set.iter().cloned());
    let laws: Vec<_> =
        args.law.iter().filter_map(|found| if let LawOrSpline::Law(law) = found { Some(*law) } else { None }).collect();
    let spline = args.law.is_empty() || laws.len() < args.law.len();
    Ok(ImportOptions {
        source: args.file.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        name,
        follower: kind,
        settings,
        only_spline: laws.is_empty() && !args.law.is_empty(),
        laws,
        spline,
        deviation: args.deviation,
        rpm: args.rpm,
        fit: args.fit,
        points_of: None,
        has_angles: false,
    })
}

/// What a file is, by its beginning and its headings.
fn form_of(path: &Path, follower: bool) -> Result<ImportForm, Failure> {
    let file = path.display().to_string();
    let bytes = files().bytes_of(path, LARGEST_FILE).map_err(|why| unread(&file, &why))?;
    let begins = |start: &str| bytes.trim_ascii_start().starts_with(start.as_bytes());
    let line = |number: usize| bytes.split(|byte| *byte == b'\n').nth(number).unwrap_or_default().trim_ascii();
    let named = |ending: &str| path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending));
    let drawing = begins("AutoCAD Binary DXF") || line(0) == b"999" || (line(0) == b"0" && line(1) == b"SECTION");
    if drawing || named("dxf") || step::is_step(&bytes) {
        return Ok(ImportForm::Outline);
    }
    if bytes.trim_ascii().is_empty() {
        return Err(Failure(format!("`{file}` is an empty file; give a lift table, points, a DXF or a STEP file")));
    }
    let others = [
        ("<", "an XML, SVG or HTML file"),
        ("%PDF", "a PDF document"),
        ("PK\u{3}\u{4}", "a packed file, as spreadsheets are"),
        ("{", "a JSON file"),
        ("[", "a file of settings"),
    ];
    if let Some((_, kind)) = others.iter().find(|(start, _)| begins(start)) {
        return Err(Failure(format!(
            "`{file}` is {kind}; give a lift table or points as text (CSV), a DXF or a STEP file"
        )));
    }
    let text = files().table_text_of(path, LARGEST_TABLE).map_err(|why| unread(&file, &why))?;
    Ok(if measured::looks_like_points(&text, follower) { ImportForm::Points } else { ImportForm::Table })
}

/// The flags of a lift table, and whether they are given.
fn of_table(args: &ImportArgs) -> [(&'static str, bool); 10] {
    let table = &args.table;
    [
        ("--columns", !table.columns.is_empty()),
        ("--unit", table.unit.is_some()),
        ("--scale", table.scale.is_some()),
        ("--ratio", table.ratio.is_some()),
        ("--step", table.step.is_some()),
        ("--lift", table.lift.is_some()),
        ("--over", table.over.is_some()),
        ("--mirror", table.mirror),
        ("--rest", table.rest.is_some()),
        ("--repeat", table.repeat.is_some()),
    ]
}

/// Refuses flags that belong to another form.
fn refuse_flags(args: &ImportArgs, form: ImportForm) -> Result<(), Failure> {
    let what = match form {
        ImportForm::Table => "a lift table",
        ImportForm::Outline => "an outline",
        ImportForm::Points => "measured points",
    };
    let refused = |flag: &str, of: &str, from: &str| {
        Err(Failure(format!(
            "{flag} belongs to {of}, but `{}` is read as {what}; leave it out, or give --from {from}",
            args.file.display()
        )))
    };
    if let Some((flag, _)) = of_table(args).iter().find(|(_, given)| *given && form != ImportForm::Table) {
        return refused(flag, "a lift table", "table");
    }
    if args.ball.radius().is_some() && form != ImportForm::Points {
        return refused("--ball", "measured points", "points");
    }
    if args.layer.is_some() && form != ImportForm::Outline {
        return refused("--layer", "the outline of a DXF file", "outline");
    }
    Ok(())
}

/// A message on keys of [motion], with what they are here.
fn as_flags(message: &str) -> String {
    let keys = ["unit", "columns", "ratio", "over", "lift", "step", "rest", "mirror", "scale"];
    let named: Vec<String> =
        keys.iter().filter(|key| message.contains(&format!("{key} = "))).map(|key| format!("--{key}")).collect();
    let hint =
        if named.is_empty() { String::new() } else { format!("\n  here such keys are flags: {}", named.join(", ")) };
    format!("{}{hint}", message.replace("--> --set:", "--> flags:"))
}

/// The rows of a lift table.
fn table(args: &ImportArgs, options: &ImportOptions) -> Result<ImportSource, Failure> {
    let file = args.file.display().to_string();
    let of = |key: &str, value: &Option<String>| value.as_ref().map(|value| format!("motion.{key}={value}"));
    let table = &args.table;
    let mut columns: Vec<String> = table.columns.iter().map(|name| format!("{:?}", name.trim())).collect();
    // `--as lift` reads columns headed as radii as positions.
    if columns.is_empty() && args.taken_as == Some(ImportAs::Lift) && table.step.is_none() {
        columns = vec!["1".into(), "2".into()];
    }
    let mut overrides = vec![format!("motion.table={file}")];
    overrides.extend((!columns.is_empty()).then(|| format!("motion.columns=[{}]", columns.join(", "))));
    let keys = [
        ("unit", &table.unit),
        ("scale", &table.scale),
        ("ratio", &table.ratio),
        ("step", &table.step),
        ("lift", &table.lift),
        ("over", &table.over),
        ("rest", &table.rest),
        ("repeat", &table.repeat),
    ];
    overrides.extend(keys.into_iter().filter_map(|(key, value)| of(key, value)));
    overrides.extend(table.mirror.then(|| "motion.mirror=true".to_owned()));
    let read = |options: &ImportOptions| {
        let text = import::frame(options).map_err(Failure::new)?;
        let all: Vec<String> = overrides.iter().cloned().chain(options.follower_settings()).collect();
        lift_table(&text, &all, files()).map_err(Failure::new)
    };
    match read(options) {
        Ok(rows) => match rows.possible_radii().filter(|_| args.taken_as.is_none()) {
            None => Ok(ImportSource::Table(rows)),
            Some((low, high)) => Err(Failure(format!(
                "`{file}`: positions of {} to {} mm may be radii, and no heading names a lift; give --as lift, --as profile or --as pitch",
                shown(1e3 * low),
                shown(1e3 * high)
            ))),
        },
        Err(why) if options.follower.is_none() && why.0.contains("motion.start") => Err(Failure(format!(
            "{why}\n  without --follower the positions are lengths; for angles give the follower that swings, e.g. --follower \
             swinging-roller,diameter=32mm,arm=110mm,pivot_distance=140mm"
        ))),
        Err(why) => Err(Failure(as_flags(&why.0))),
    }
}
