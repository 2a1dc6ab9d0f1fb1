//! `--live`: the design that the moving report begins with when its engine is in it.

use super::Failure;
use super::args::{CommonArgs, FileArgs, Speed};
use super::input_files::source as source_of;
use camgen::body::{Accuracy, Request};
use camgen::engine::{self, TextChange};
use camgen::pipeline::Cam;
use camgen::profile::outline::Fit;
use camgen::tool_files::dxf::Version;
use camgen::write::html::live::LiveDesign;

/// What is made live.
pub(super) struct LiveSource<'a> {
    /// The name or path of the machine file.
    pub(super) machine: &'a str,
    /// Its overrides.
    pub(super) overrides: Vec<String>,
}

impl FileArgs {
    /// Refuses --live where the page would make another cam than the one that is written.
    pub(super) fn live_fits(&self, common: &CommonArgs, request: &Request) -> Result<(), Failure> {
        if !self.format.iter().flatten().any(|format| format == "html") {
            return Err(Failure("--live belongs to --format html".into()));
        }
        // What the page itself draws with.
        let own = Request {
            rates: [None, Accuracy::Standard.acceleration()],
            strict: [false; 2],
            ..Request::within(Fit::from(request.fit.tolerance))
        };
        let flags = "--side, --outline, --start, --lead-in, --cutter-diameter, --accuracy, --tolerance-velocity, --tolerance-acceleration";
        if request.without_tool_files() != own {
            return Err(Failure(format!("--live draws within --tolerance alone: leave out {flags}")));
        }
        if common.end.is_some() || !common.free.is_empty() || self.outline.dxf_version != Version::default() {
            return Err(Failure(
                "--live cannot be combined with --end, --free or --dxf-version; set the keys in the file".into(),
            ));
        }
        Ok(())
    }
}

/// The design of a live page, its overrides as values of its text.
pub(super) fn design(
    source: &LiveSource<'_>,
    (common, cam, named): (&CommonArgs, &Cam, Option<&str>),
    tolerance: f64,
) -> Result<LiveDesign, Failure> {
    let text = source_of(source.machine).map_err(Failure::new)?;
    let changes = source.overrides.iter().map(|typed| {
        let (key, to) = typed.split_once('=').unwrap_or((typed, ""));
        TextChange::Set { key: key.trim().to_owned(), to: to.trim().to_owned() }
    });
    let changes: Vec<TextChange> = changes.collect();
    let toml = engine::changed_text(text.text(), &changes).map_err(Failure::new)?;
    let rpm = common.rpm.iter().map(|speed| match speed {
        Speed::One(rpm) => Ok(*rpm),
        Speed::Range(..) => Err(Failure("--live needs the speeds themselves, --rpm 20,25,30, not a range".into())),
    });
    Ok(LiveDesign {
        name: named.unwrap_or(text.stem()).to_owned(),
        usual_names: named.is_none(),
        toml,
        files: text.named_texts(&source.overrides),
        command: cam.body().kind().command.to_owned(),
        commands: engine::commands(cam.body().machine()).into_iter().map(str::to_owned).collect(),
        rpm: rpm.collect::<Result<_, _>>()?,
        tolerance,
        file: None,
    })
}
