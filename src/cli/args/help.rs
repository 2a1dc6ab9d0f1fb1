//! The examples in the help of each command. A test runs every line that begins with `camgen`.

/// The page of camgen itself: examples, the commands by what they are for, what all of them have.
pub(super) const OVERVIEW: &str = concat!(
    "camgen ",
    env!("CARGO_PKG_VERSION"),
    " · cams a CNC shop can cut, proved on the file that is written

  camgen make lever         try it: an embedded design, four files in output/
  camgen init mine.toml     a design of your own, with comments
  camgen serve mine.toml    the same in the browser: drag, see, write

  Design a cam                            Files of a cam
  make         cam from a motion          check       is this file my cam?
  size         smallest cam that works    compare     measured cam and exact one
  laws         laws of motion compared    import      old cam to a design file
  side-by-side two cams on one page       trade       accuracy against run time
  study        many designs, best ones    explain     what a check means
  Press buffers                           Machine elements
  rotary       disc cam for one speed     shaft       bending, critical speed
  translating  plate on the bed           linkage     that moves a bed
  conoid       cam for many speeds        brake       belt brake of a paper roll
  regimes      one cam at other speeds
  scatter      machines that differ       Tools
  spring       bottoms on springs         serve  init  machines  schema
  drive        bed without a cam          completions  man  help

  every command:  -v all figures   --json all digits   --dry-run no files
  COMMAND --help  its options, with examples;  --allow-path DIR more tables
  exit code       0 fine, 1 a check failed (nothing written), 2 bad input"
);

pub(super) const ROTARY: &str = "\
Examples:
  camgen rotary --rpm 35 --format dxf,json
      the outline of the cam for 35 rpm, and the report as JSON
  camgen rotary dpi-paper --set cam.base_radius=200mm --dry-run
      exit code 1: the pressure angle is too large; the report names the radius that would pass";

pub(super) const TRANSLATING: &str = "\
Examples:
  camgen translating --rpm 35 --format dxf
      the plate for 35 rpm, equation (18) integrated as a differential equation
  camgen translating --solver paper --stations 180 --balance return --dry-run
      solved as in the paper, the forces balanced while the bed is accelerated; only the report";

pub(super) const CONOID: &str = "\
Examples:
  camgen conoid --rpm 20,25,30,35 --format dxf
      a section for each speed
  camgen conoid --rpm 20..35 --residual 20N --dry-run
      the fewest sections that leave no more than 20 N at any speed between";

pub(super) const SERVE: &str = "\
Examples:
  camgen serve lifter.toml groove --for 1
      both designs as tabs of a page at the address that is printed; it ends after a second, without --for at Ctrl+C
  camgen serve --port 8423 --for 1
      all embedded designs, at a port of your own";

pub(super) const MAKE: &str = "\
Examples:
  camgen make lifter.toml --format dxf,step
      the cam of the motion program in lifter.toml
  camgen make lifter.toml --set follower.roller.radius=8mm --dry-run --json
      the report for another roller, without files";

pub(super) const REGIMES: &str = "\
Examples:
  camgen regimes --rpm 20,25,30,35
      column, added volume and residual force at four speeds, as a table and a plot
  camgen regimes --without-cam --rpm 25,35 --dry-run
      fixed bottoms without a cam: column, residual force and bore, also for other end pressures";

pub(super) const SPRING: &str = "\
Examples:
  camgen spring dpi-paper --stiffness 68kgf/cm,82.5kgf/cm,165kgf/cm
      three springs at the design speed, as a table and a plot
  camgen spring --design --set spring_buffer.body.stress=700MPa --set spring_buffer.body.index=4 --dry-run
      the thinnest standard wire for each spring, with its coils, stress, surge and buckling";

pub(super) const SCATTER: &str = "\
Examples:
  camgen scatter
      what each parameter leaves, 20000 presses, and the settings of the screw, as tables and a plot
  camgen scatter dpi --fault mass=5% --fault polytropic_exponent=1.40 --vary speed=2% --samples 1000 --dry-run
      one machine that differs, and a wider band of the speed; only the report";

pub(super) const DRIVE: &str = "\
Examples:
  camgen drive
      the drive of the embedded press dp, as a table and a plot
  camgen drive --solver paper --step 5deg --set buffer.column=500mm --dry-run
      another column, solved as in the paper; only the report";

pub(super) const LINKAGE: &str = "\
Examples:
  camgen linkage
      the six-bar of the embedded press dpi-six-bar, as a table and a plot
  camgen linkage dpi-crank-slider --synthesize least --keep symmetric --dry-run
      the drag link with the least acceleration for that crank-slider, as a table to paste; only the report";

pub(super) const SHAFT: &str = "\
Examples:
  camgen shaft --sweep 1e8N/m..1e9N/m
      the embedded printing cylinder over the stiffness of its bearings, as tables and a plot
  camgen shaft dpi-shaft --rpm 35 --dry-run
      how much the shaft reduces the lift of the cam of a press; only the report";

pub(super) const BRAKE: &str = "\
Examples:
  camgen brake --cam
      the embedded paper roll with the disc that holds its tension: table, plot, and the disc as DXF, SVG, STEP and CSV
  camgen brake roll-level
      a frame that holds the tension by itself";

pub(super) const LAWS: &str = "\
Examples:
  camgen laws --lift 30mm --over 120deg --rpm 300
      every law for a rise of 30 mm in 120 degrees at 300 rpm
  camgen laws valve --laws modified-sine,cycloidal,3-4-5 --sort torque --csv
      the cam of the embedded valve with each of three laws, the smallest torque first, as CSV";

pub(super) const SIZE: &str = "\
Examples:
  camgen size feeder --free offset
      base radius and offset of the smallest cam of the embedded feeder, and how they depend on each other
  camgen size lever --free pivot-distance --dry-run
      base radius and pivot distance of an arm; only the report";

pub(super) const IMPORT: &str = "\
Examples:
  camgen import lift.csv --follower roller,diameter=24mm
      a lift table as a design file, with the law of each rise and return
  camgen import part.dxf --follower roller,diameter=60mm --deviation 20um --dry-run
      the lift of a roller on the outline of an old cam; only the report

Measured points: camgen import points.csv --follower roller,diameter=24mm --ball 1.5mm --fit centre";

pub(super) const COMPARE: &str = "\
Examples:
  camgen compare centres.csv lifter.toml --ball 3mm
      centres of a ball of radius 3 mm, turned to fit; exit code 1 where a point leaves cam.profile_tolerance
  camgen compare measured.csv lifter.toml --fit centre --format csv,svg,html
      also the centre is fitted: the report has the eccentricity";

pub(super) const SIDE_BY_SIDE: &str = "\
Examples:
  camgen side-by-side dpi dpi-paper
      the cams of both embedded presses in output/dpi-dpi-paper-side-by-side.html
  camgen side-by-side dpi lifter.toml --name both
      a press and a motion program";

pub(super) const CHECK: &str = "\
Examples:
  camgen check part.dxf
      finds its design in the record next to it, or by the hash in it, and checks whether part.dxf is that cam; `check part.dxf dpi --rpm 35`
      names a machine
  camgen check part.dxf --design lifter.toml
      exit code 1: it is not the cam of the motion program in lifter.toml

The file may also be the path of a cutter (-cutter.dxf), a table of points (-points.csv) or for a servo drive (-servo.csv, -xyva.st, -twincat.st), or a program for a milling machine (.ngc, .nc, .mpf, .h).";

pub(super) const TRADE: &str = "\
Examples:
  camgen trade
      every setting for the rotary cam of the embedded press, as a table and a chart
  camgen trade rotary --residual 5N --acceleration 5% --dry-run
      the cheapest setting that keeps both, without files";

pub(super) const STUDY: &str = "\
Examples:
  camgen study feeder-roller
      rollers and pressure angles of an embedded feeder, every combination, as output/feeder-roller.csv
  camgen study lever-pareto --page
      random designs, those that no other beats, and a page with charts

`camgen study feeder-scatter --show > mine.toml` is a file to start from; docs/study.md describes its keys.";

pub(super) const MACHINES: &str = "\
Examples:
  camgen machines
      lists their names
  camgen machines show dpi
      prints one of them; add > press.toml for a file of your own";

pub(super) const INIT: &str = "\
Examples:
  camgen init mine.toml
      writes the file; `camgen rotary mine.toml` makes its cam
  camgen init --follower swinging-roller
      prints a motion program for `camgen make`";

pub(super) const EXPLAIN: &str = "\
Examples:
  camgen explain
      every check in one line
  camgen explain pressure_angle
      one check in full";

pub(super) const SCHEMA: &str = "\
Examples:
  camgen schema
      prints it; add > machine.schema.json for a file
  camgen schema --help
      editors with Taplo complete and check a machine file whose first line is: #:schema ./machine.schema.json";

pub(super) const COMPLETIONS: &str = "\
Examples:
  camgen completions bash
      prints them; add > ~/.local/share/bash-completion/completions/camgen
  camgen completions zsh
      prints them; redirect them to a file _camgen in a directory of $fpath";

pub(super) const MAN: &str = "\
Examples:
  camgen man
      the page of camgen; add > camgen.1 for a file
  camgen man rotary
      the page of a command; add > camgen-rotary.1 for a file";
