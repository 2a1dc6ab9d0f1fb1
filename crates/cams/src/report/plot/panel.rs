//! Panels of curves: round ticks, limits as hatched bands with their reason, names at the ends of the curves.

use super::{BandAxis, CurveStroke, Plot, PlotBand, PlotCurve, PlotLine, PlotPanel, PlotPoint, finite, range};
use crate::report::page::{PicturePage, area, hatch};
use crate::report::sheet::placing::{OccupiedPaper, field_near, filling, half_field};
use crate::report::sheet::{SheetShape, TextAnchor, font, words};
use crate::report::style::{NAME, PictureColour, TEXT, figure, ticks};
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Room above a panel for its name, and below it for the names of places, or to the next panel, mm over the lettering.
const ABOVE: f64 = 8.0;
const BELOW: f64 = 12.0;
const APART: f64 = 2.5;
/// Room at a side without texts, and between a text and its axis.
const SIDE: f64 = 4.0;
const TO_AXIS: f64 = 1.5;
/// From the end of a curve to its name, and the widest name over the width of the panels.
const LEADER: f64 = 3.0;
const WIDEST: f64 = 0.24;
/// Room for one tick up and along.
const TICK: [f64; 2] = [15.0, 8.0];
/// Headroom over the range of values: above the curves, above them where texts are, and beyond a limit.
const HEADROOM: f64 = 0.08;
const TEXT_ROOM: f64 = 0.17;
const BEYOND: f64 = 0.14;
/// A limit farther from the curves than this, over their range, would flatten them: it is named and not drawn.
const FAR: f64 = 1.6;
/// Curves whose ends are nearer than this, over the range of values, are named where they are apart; not near the sides of the panel.
const CROWDED: f64 = 0.075;
const INNER: (f64, f64) = (0.06, 0.9);
/// More names than these stand at the ends all the same: there is no room for them between the curves.
const MOST_INSIDE: usize = 4;
/// From a curve to its name within the panel.
const ON_CURVE: [f64; 8] = [0.9, 1.8, 3.0, 5.0, 8.0, 12.0, 17.0, 24.0];
/// Radii of a dot and a ring.
const DOT: f64 = 0.95;
const RING: f64 = 1.25;
/// From a point to its text: the distances that are tried, from which on a line leads to it, and the directions in degrees.
const NEAR: [f64; 6] = [1.7, 2.8, 4.5, 7.0, 10.0, 15.0];
const LED: f64 = 4.0;
const DIRECTIONS: [f64; 12] = [60.0, 120.0, 90.0, 20.0, 160.0, 0.0, 180.0, -60.0, -120.0, -90.0, -20.0, 200.0];

/// A panel with its ranges.
#[derive(Debug)]
pub(super) struct StackedPanel<'a> {
    panel: &'a PlotPanel,
    /// What its places are; `None` where the panel below says it.
    places: Option<&'a str>,
    /// Whether its places are its own.
    is_own: bool,
    along: (f64, f64),
    across: (f64, f64),
    /// Limits that are not drawn.
    far: Vec<&'a PlotBand>,
}

/// The panels that can be drawn, from above.
pub(super) fn stack(plot: &Plot) -> Vec<StackedPanel<'_>> {
    let common = range(plot.panels.iter().flat_map(places_of));
    let count = plot.panels.len();
    let shared = plot.panels.iter().enumerate().filter_map(|(index, panel)| {
        let places = (index + 1 == count).then_some(plot.places.as_str());
        Some(StackedPanel::new(panel, places, common?))
    });
    let own = plot.own.iter().filter_map(|(places, panel)| {
        Some(StackedPanel { is_own: true, ..StackedPanel::new(panel, Some(places), range(places_of(panel))?) })
    });
    shared.chain(own).collect()
}

fn places_of(panel: &PlotPanel) -> impl Iterator<Item = f64> + '_ {
    panel.curves.iter().flat_map(|curve| finite(&curve.points)).map(|[place, _]| place)
}

/// Room to the left and to the right of the panels, so that their axes lie below each other.
pub(super) fn sides(panels: &[&StackedPanel<'_>], k: f64, width: f64) -> [f64; 2] {
    let left = panels.iter().map(|panel| panel.tick_width(k)).fold(0.0, f64::max) + 2.0 * TO_AXIS * k;
    let at_ends = panels.iter().filter(|panel| !panel.is_crowded() || panel.named_count() > MOST_INSIDE);
    let names = at_ends.flat_map(|panel| &panel.panel.curves).map(|curve| font::width(&curve.name, TEXT * k));
    let widest = names.fold(0.0, f64::max);
    let right = if widest > 0.0 { (widest + (LEADER + 1.5) * k).min(WIDEST * width) } else { SIDE * k };
    [left, right]
}

impl<'a> StackedPanel<'a> {
    fn new(panel: &'a PlotPanel, places: Option<&'a str>, along: (f64, f64)) -> Self {
        let (across, far) = values_of(panel);
        Self { panel, places, is_own: false, along, across, far }
    }

    /// Whether its places are its own.
    pub(super) fn is_own(&self) -> bool {
        self.is_own
    }

    fn named_count(&self) -> usize {
        self.panel.curves.iter().filter(|curve| !curve.name.is_empty()).count()
    }

    /// Whether the named curves end so near to each other that their names stand where they are apart.
    fn is_crowded(&self) -> bool {
        let named = self.panel.curves.iter().filter(|curve| !curve.name.is_empty());
        let ends: Vec<f64> = named.filter_map(|curve| finite(&curve.points).last()).map(|[_, value]| value).collect();
        #[expect(clippy::cast_precision_loss, reason = "a few curves")]
        let needed = CROWDED * ends.len().saturating_sub(1) as f64;
        range(ends.iter().copied())
            .map_or(ends.len() > 1, |(low, high)| (high - low) < needed * (self.across.1 - self.across.0))
    }

    /// Room above and below its field, mm.
    pub(super) fn around(&self, k: f64) -> f64 {
        (ABOVE + self.below()) * k
    }

    fn below(&self) -> f64 {
        if self.places.is_some() { BELOW } else { APART }
    }

    /// Its height over that of the others.
    pub(super) fn height(&self) -> f64 {
        self.panel.height
    }

    fn tick_width(&self, k: f64) -> f64 {
        let all = ticks(self.across, TICK[1]);
        all.iter().map(|value| font::width(&figure(*value), TEXT * k)).fold(0.0, f64::max)
    }

    /// The panel in its part of the page.
    pub(super) fn draw(&self, page: &mut PicturePage, part: &Extents, [left, right]: [f64; 2]) {
        let k = page.k;
        let field = Extents {
            least: part.least + Vector2::new(left, self.below() * k),
            largest: part.largest - Vector2::new(right, ABOVE * k),
        };
        let drawing = PanelDrawing { stacked: self, field, k };
        let name = self.name();
        let (name, size) = font::fitted_in_one(&name, NAME * k, part.size().x);
        let at = Vector2::new(part.least.x, field.largest.y + 0.75 * NAME * k);
        page.add("area", "field", Some("#fafbfd"), vec![area(&field)]);
        drawing.bands(page);
        drawing.grid(page);
        page.add("strong", "what is shown", None, vec![words(at, size, TextAnchor::Start, name)]);
        drawing.curves_and_labels(page);
    }

    /// Its name, with the limits that are not drawn.
    fn name(&self) -> String {
        let limit = |band: &&PlotBand| {
            let edge = if band.from.is_finite() { band.from } else { band.to };
            format!("limit {}: not drawn, far {}", figure(edge), if band.from.is_finite() { "above" } else { "below" })
        };
        let far: Vec<String> = self.far.iter().map(limit).collect();
        if far.is_empty() { self.panel.name.clone() } else { format!("{} ({})", self.panel.name, far.join("; ")) }
    }
}

/// The range of values of a panel, with room for texts and limits, and the limits that lie too far away. It begins at 0 unless that would leave more
/// than half of it empty.
fn values_of(panel: &PlotPanel) -> ((f64, f64), Vec<&PlotBand>) {
    let values = || {
        let of_curves = panel.curves.iter().flat_map(|curve| finite(&curve.points)).map(|[_, value]| value);
        of_curves.chain(panel.points.iter().map(|point| point.at[1]).filter(|value| value.is_finite()))
    };
    let apart = |(low, high): &(f64, f64)| low * high > 0.0 && high - low < low.abs().min(high.abs());
    let own = range(values()).filter(apart);
    let (least, largest) = own.or_else(|| range(values().chain([0.0]))).unwrap_or((-1.0, 1.0));
    let size = largest - least;
    let has_texts = panel.lines.iter().any(|line| !line.text.is_empty())
        || panel.bands.iter().any(|band| band.axis == BandAxis::Places && !band.text.is_empty());
    let room = if has_texts { TEXT_ROOM } else { HEADROOM };
    let mut low = if least == 0.0 { 0.0 } else { least - HEADROOM * size };
    let mut high = if largest == 0.0 && !has_texts { 0.0 } else { largest + room * size };
    let mut far = Vec::new();
    for band in panel.bands.iter().filter(|band| band.axis == BandAxis::Values) {
        if band.from.is_finite() {
            if band.from > largest + FAR * size {
                far.push(band);
            } else {
                high = high.max(band.from + BEYOND * (band.from.max(high) - low));
            }
        }
        if band.to.is_finite() {
            if band.to < least - FAR * size {
                far.push(band);
            } else {
                low = low.min(band.to - BEYOND * (high - band.to.min(low)));
            }
        }
    }
    ((low, high), far)
}

/// A panel in its field of the page.
struct PanelDrawing<'a> {
    stacked: &'a StackedPanel<'a>,
    field: Extents,
    k: f64,
}

impl PanelDrawing<'_> {
    fn at(&self, place: f64, value: f64) -> Vector2<f64> {
        let share = |value: f64, (low, high): (f64, f64)| (value - low) / (high - low);
        let share = Vector2::new(share(place, self.stacked.along), share(value, self.stacked.across));
        self.field.least + self.field.size().component_mul(&share)
    }

    /// The part of the field that a band takes; `None` where it lies outside.
    fn field_of(&self, band: &PlotBand) -> Option<Extents> {
        let (a, b) = match band.axis {
            BandAxis::Places => (self.at(band.from, 0.0).x, self.at(band.to, 0.0).x),
            BandAxis::Values => (self.at(self.stacked.along.0, band.from).y, self.at(self.stacked.along.0, band.to).y),
        };
        let (low, high) = match band.axis {
            BandAxis::Places => (self.field.least.x, self.field.largest.x),
            BandAxis::Values => (self.field.least.y, self.field.largest.y),
        };
        let (a, b) = (a.clamp(low, high), b.clamp(low, high));
        if b - a < 1e-6 {
            return None;
        }
        let mut field = self.field;
        match band.axis {
            BandAxis::Places => (field.least.x, field.largest.x) = (a, b),
            BandAxis::Values => (field.least.y, field.largest.y) = (a, b),
        }
        Some(field)
    }

    fn bands(&self, page: &mut PicturePage) {
        for band in &self.stacked.panel.bands {
            let Some(field) = self.field_of(band) else { continue };
            page.add("area", &band.text, Some(band.colour.tint()), vec![area(&field)]);
            if band.colour == PictureColour::Limit {
                page.add("hatch", &band.text, None, hatch(&field));
                page.add("limit-line", &band.text, None, self.edges(band));
            }
        }
    }

    /// The edges of a band within the field.
    fn edges(&self, band: &PlotBand) -> Vec<SheetShape> {
        let (along, across) = (self.stacked.along, self.stacked.across);
        let inside = |value: &f64, (low, high): (f64, f64)| *value > low && *value < high;
        let ends = [band.from, band.to].into_iter();
        match band.axis {
            BandAxis::Places => ends
                .filter(|place| inside(place, along))
                .map(|place| SheetShape::Line(self.at(place, across.0), self.at(place, across.1)))
                .collect(),
            BandAxis::Values => ends
                .filter(|value| inside(value, across))
                .map(|value| SheetShape::Line(self.at(along.0, value), self.at(along.1, value)))
                .collect(),
        }
    }

    /// Round values with their lines, and what the places are.
    fn grid(&self, page: &mut PicturePage) {
        let (k, size, field) = (self.k, TEXT * self.k, self.field);
        let (along, across) = (self.stacked.along, self.stacked.across);
        let mut lines = Vec::new();
        let mut texts = Vec::new();
        for value in ticks(across, (field.size().y / (TICK[1] * k)).clamp(2.0, 7.0)) {
            lines.push(SheetShape::Line(self.at(along.0, value), self.at(along.1, value)));
            let place = self.at(along.0, value) - Vector2::new(TO_AXIS * k, 0.35 * size);
            texts.push(words(place, size, TextAnchor::End, figure(value)));
        }
        for place in ticks(along, (field.size().x / (TICK[0] * k)).clamp(2.0, 10.0)) {
            lines.push(SheetShape::Line(self.at(place, across.0), self.at(place, across.1)));
            if self.stacked.places.is_some() {
                let below = self.at(place, across.0) - Vector2::new(0.0, 1.35 * size);
                texts.push(words(below, size, TextAnchor::Middle, figure(place)));
            }
        }
        page.add("tick", "lines of round values", None, lines);
        page.add("tick", "round values", None, texts);
        let level = if across.0 <= 0.0 && across.1 >= 0.0 { 0.0 } else { across.0 };
        page.add("edge", "axis", None, vec![SheetShape::Line(self.at(along.0, level), self.at(along.1, level))]);
        if let Some(places) = self.stacked.places {
            let (text, size) = font::fitted_in_one(places, NAME * k, field.size().x);
            let at = Vector2::new(field.largest.x, field.least.y - 2.95 * TEXT * k);
            page.add("strong", "what the places are", None, vec![words(at, size, TextAnchor::End, text)]);
        }
    }

    fn curves_and_labels(&self, page: &mut PicturePage) {
        let panel = self.stacked.panel;
        let mut taken = OccupiedPaper::none(self.field);
        for band in panel.bands.iter().filter(|band| band.colour == PictureColour::Limit) {
            self.edges(band).iter().for_each(|edge| taken.put(edge));
        }
        for line in &panel.lines {
            if let Some(shape) = self.across_at(line) {
                taken.put(&shape);
                let class = if line.dashed { "mark-dashed" } else { "mark-line" };
                page.add(class, &line.text, None, vec![shape]);
            }
        }
        for curve in &panel.curves {
            let shape = SheetShape::Path(finite(&curve.points).map(|[place, value]| self.at(place, value)).collect());
            taken.put(&shape);
            let class = match curve.stroke {
                CurveStroke::Bold => "curve-bold",
                CurveStroke::Thin => "curve",
                CurveStroke::Dashed => "curve-dashed",
            };
            let label = if curve.name.is_empty() { &panel.name } else { &curve.name };
            page.add(class, label, Some(curve.colour.line()), vec![shape]);
        }
        let points: Vec<&PlotPoint> =
            panel.points.iter().filter(|point| point.at.iter().all(|value| value.is_finite())).collect();
        for point in &points {
            let radius = if point.ring { RING } else { DOT } * self.k;
            let shape = SheetShape::Entity(Entity::Circle(self.at(point.at[0], point.at[1]), radius));
            taken.put(&shape);
            page.add(
                if point.ring { "curve-mark" } else { "dot" },
                &point.text,
                Some(point.colour.line()),
                vec![shape],
            );
        }
        for point in points {
            self.label_point(page, &mut taken, point);
        }
        for line in &panel.lines {
            self.label_line(page, &mut taken, line);
        }
        for band in &panel.bands {
            self.label_band(page, &mut taken, band);
        }
        let curves = panel.curves.iter().filter(|curve| !curve.name.is_empty());
        let inside = self.stacked.is_crowded() && self.stacked.named_count() <= MOST_INSIDE;
        let at_ends = if inside {
            curves.filter(|curve| !self.name_on_curve(page, &mut taken, curve)).collect()
        } else {
            curves.collect()
        };
        self.names(page, at_ends);
    }

    /// The name of a curve where it is farthest from the others; false where there is no room.
    fn name_on_curve(&self, page: &mut PicturePage, taken: &mut OccupiedPaper, curve: &PlotCurve) -> bool {
        let (low, high) = self.stacked.along;
        let inner = |share: f64| low + share * (high - low);
        let mut best: Option<(f64, Vector2<f64>)> = None;
        for [place, value] in finite(&curve.points) {
            if place < inner(INNER.0) || place > inner(INNER.1) {
                continue;
            }
            let others = self.stacked.panel.curves.iter().filter(|other| !std::ptr::eq(*other, curve));
            let gaps = others.filter_map(|other| value_at(&other.points, place)).map(|other| (other - value).abs());
            let gap = gaps.fold(f64::INFINITY, f64::min);
            if best.is_none_or(|(before, _)| gap > before * (1.0 + 1e-6)) {
                best = Some((gap, self.at(place, value)));
            }
        }
        let Some((_, at)) = best else { return false };
        let size = TEXT * self.k;
        let half = half_field(&curve.name, size);
        let tried =
            ON_CURVE.iter().flat_map(|near| DIRECTIONS.iter().map(move |direction| (near * self.k, *direction)));
        let mut fields = tried.map(|(distance, direction)| {
            let (sine, cosine) = libm::sincos(direction.to_radians());
            (distance, field_near(at, Vector2::new(cosine, sine), distance, half))
        });
        let can_be_led = |distance: f64, field: &Extents| {
            distance <= LED * self.k || taken.clear(at, at.sup(&field.least).inf(&field.largest))
        };
        let found = fields.find(|(distance, field)| taken.free(field) && can_be_led(*distance, field));
        let Some((distance, field)) = found else { return false };
        let text = filling(&field, size, &curve.name);
        taken.put(&text);
        if distance > LED * self.k {
            let nearest = at.sup(&field.least).inf(&field.largest);
            page.add("curve", &curve.name, Some(curve.colour.line()), vec![SheetShape::Line(at, nearest)]);
        }
        page.label(curve.colour, &curve.name, vec![text]);
        true
    }

    fn across_at(&self, line: &PlotLine) -> Option<SheetShape> {
        let (low, high) = self.stacked.along;
        let across = self.stacked.across;
        (line.at >= low && line.at <= high)
            .then(|| SheetShape::Line(self.at(line.at, across.0), self.at(line.at, across.1)))
    }

    /// The text of a point where there is room next to it.
    fn label_point(&self, page: &mut PicturePage, taken: &mut OccupiedPaper, point: &PlotPoint) {
        if point.text.is_empty() {
            return;
        }
        let (size, at) = (TEXT * self.k, self.at(point.at[0], point.at[1]));
        let half = half_field(&point.text, size);
        let tried = || {
            NEAR.iter().flat_map(|near| DIRECTIONS.iter().map(move |direction| (near * self.k, *direction))).map(
                |(distance, direction)| {
                    let (sine, cosine) = libm::sincos(direction.to_radians());
                    (distance, field_near(at, Vector2::new(cosine, sine), distance, half))
                },
            )
        };
        let can_be_led = |distance: f64, field: &Extents| {
            distance <= LED * self.k || taken.clear(at, at.sup(&field.least).inf(&field.largest))
        };
        let found = tried()
            .find(|(distance, field)| taken.free(field) && can_be_led(*distance, field))
            .or_else(|| tried().find(|(_, field)| taken.free_of_texts(field)));
        let Some((distance, field)) = found else { return };
        let text = filling(&field, size, &point.text);
        taken.put(&text);
        if distance > LED * self.k {
            let nearest = at.sup(&field.least).inf(&field.largest);
            let way = nearest - at;
            let start = at + way / way.norm().max(1e-9) * (RING * self.k);
            page.add("curve", &point.text, Some(point.colour.text()), vec![SheetShape::Line(start, nearest)]);
        }
        page.label(point.colour, &point.text, vec![text]);
    }

    /// The text of a line at its head, on the side with room, as high as possible.
    fn label_line(&self, page: &mut PicturePage, taken: &mut OccupiedPaper, line: &PlotLine) {
        if line.text.is_empty() || self.across_at(line).is_none() {
            return;
        }
        let x = self.at(line.at, self.stacked.across.0).x;
        let half = half_field(&line.text, TEXT * self.k);
        let sides = [1.0, -1.0].map(|side| x + side * (half.x + 1.6 * self.k));
        self.label_high(page, taken, &line.text, PictureColour::Ink, &sides);
    }

    /// A text with its middle at one of some places, as high as there is room.
    fn label_high(
        &self,
        page: &mut PicturePage,
        taken: &mut OccupiedPaper,
        text: &str,
        colour: PictureColour,
        middles: &[f64],
    ) {
        let size = TEXT * self.k;
        let half = half_field(text, size);
        let steps = (0..12).map(|step| self.field.largest.y - (1.1 + 0.6 * f64::from(step)) * size);
        let tried = steps.flat_map(|y| middles.iter().map(move |x| Vector2::new(*x, y)));
        let mut fields = tried.map(|middle| Extents { least: middle - half, largest: middle + half });
        if let Some(field) = fields.find(|field| taken.free(field)) {
            let shape = filling(&field, size, text);
            taken.put(&shape);
            page.label(colour, text, vec![shape]);
        }
    }

    /// The reason of a limit within its band, or what is better in its part.
    fn label_band(&self, page: &mut PicturePage, taken: &mut OccupiedPaper, band: &PlotBand) {
        let Some(field) = self.field_of(band).filter(|_| !band.text.is_empty()) else { return };
        let size = TEXT * self.k;
        let half = half_field(&band.text, size);
        match band.axis {
            BandAxis::Places => {
                let (low, high) = (field.least.x + half.x + 1.5 * self.k, field.largest.x - half.x - 1.5 * self.k);
                if high >= low {
                    let middles = [0.5 * (low + high), high, low];
                    self.label_high(page, taken, &band.text, band.colour, &middles);
                }
            }
            BandAxis::Values => {
                let y = 0.5 * (field.least.y + field.largest.y);
                let (low, high) = (field.least.x + half.x + 1.5 * self.k, field.largest.x - half.x - 1.5 * self.k);
                let tried = (0..=20).map(|step| high - (high - low) * f64::from(step) / 20.0);
                let middles = tried.map(|x| Vector2::new(x, y));
                let mut fields = middles.map(|middle| Extents { least: middle - half, largest: middle + half });
                let found = fields.find(|field| taken.free(field));
                let found = found.or_else(|| {
                    let middle = Vector2::new(high, y);
                    Some(Extents { least: middle - half, largest: middle + half })
                        .filter(|field| taken.free_of_texts(field))
                });
                if let Some(field) = found {
                    let shape = filling(&field, size, &band.text);
                    taken.put(&shape);
                    page.label(band.colour, &band.text, vec![shape]);
                }
            }
        }
    }

    /// The names of the curves to the right of their ends, pushed apart; a line leads to a name that had to move.
    fn names(&self, page: &mut PicturePage, curves: Vec<&PlotCurve>) {
        let (k, size) = (self.k, TEXT * self.k);
        let mut ends: Vec<(&PlotCurve, Vector2<f64>)> = Vec::new();
        for curve in curves {
            if let Some([place, value]) = finite(&curve.points).last() {
                ends.push((curve, self.at(place, value)));
            }
        }
        ends.sort_by(|a, b| b.1.y.total_cmp(&a.1.y));
        let mut heights =
            push_apart(&ends.iter().map(|(_, end)| end.y).collect::<Vec<_>>(), 1.1 * font::LEADING * size);
        // No name next to those of the places.
        let below = heights.last().map_or(0.0, |lowest| (self.field.least.y + 0.3 * size - lowest).max(0.0));
        for height in &mut heights {
            *height += below;
        }
        let right = self.field.largest.x;
        for ((curve, end), height) in ends.iter().zip(heights) {
            let start = Vector2::new(right + LEADER * k, height);
            let room = page.body.largest.x.max(right) - start.x;
            let (text, size) = font::fitted_in_one(
                &curve.name,
                size,
                room.max(WIDEST * self.field.size().x / (1.0 - WIDEST) - LEADER * k),
            );
            let moved = (height - end.y).abs() > 0.3 * size || right - end.x > 1.0;
            if moved {
                let from = end + Vector2::new(0.8 * k, 0.0);
                let to = start - Vector2::new(0.4 * k, 0.0);
                page.add("curve", &curve.name, Some(curve.colour.line()), vec![SheetShape::Line(from, to)]);
            }
            let x = if moved { start.x } else { right + 1.5 * k };
            let text = words(Vector2::new(x, height - 0.35 * size), size, TextAnchor::Start, text);
            page.label(curve.colour, &curve.name, vec![text]);
        }
    }
}

/// The value of a curve at a place between its points; `None` outside of them.
fn value_at(points: &[[f64; 2]], place: f64) -> Option<f64> {
    points.iter().zip(points.iter().skip(1)).find_map(|([a, from], [b, to])| {
        let (low, high) = (a.min(*b), a.max(*b));
        if !(low <= place && place <= high && (from + to).is_finite()) {
            return None;
        }
        Some(if a == b { *from } else { from + (to - from) * (place - a) / (b - a) })
    })
}

/// Decreasing heights at least this far apart, each as near to its own as the others allow; a cluster stays about its middle.
fn push_apart(wanted: &[f64], least: f64) -> Vec<f64> {
    // A cluster: the sum of the tops that its heights would need, and their number.
    let mut clusters: Vec<(f64, f64)> = Vec::new();
    let top = |(sum, count): (f64, f64)| sum / count;
    for height in wanted {
        let mut cluster = (*height, 1.0);
        while let Some(above) = clusters.last().copied()
            && top(above) - least * above.1 < top(cluster)
        {
            clusters.pop();
            cluster = (above.0 + cluster.0 + least * above.1 * cluster.1, above.1 + cluster.1);
        }
        clusters.push(cluster);
    }
    let mut heights = Vec::with_capacity(wanted.len());
    for cluster in clusters {
        let mut member = 0.0;
        while member < cluster.1 {
            heights.push(top(cluster) - least * member);
            member += 1.0;
        }
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_pushed_apart_and_stay_in_order() {
        for wanted in [vec![], vec![5.0], vec![9.0, 5.0, 1.0], vec![5.0, 5.0, 5.0], vec![8.0, 7.5, 7.0, 1.0, 0.5]] {
            let placed = push_apart(&wanted, 2.0);
            assert_eq!(placed.len(), wanted.len());
            assert!(placed.windows(2).all(|two| two[0] - two[1] >= 2.0 - 1e-12), "{wanted:?}: {placed:?}");
            let middle = |heights: &[f64]| heights.iter().sum::<f64>();
            assert!((middle(&placed) - middle(&wanted)).abs() < 1e-9, "about their middle: {placed:?}");
        }
        assert_eq!(push_apart(&[9.0, 5.0, 1.0], 2.0), [9.0, 5.0, 1.0]);
    }

    /// A limit near the curves is within the range, with room beyond it; one far away is named.
    #[test]
    fn limits_are_drawn_or_named() {
        let panel = |limit: f64| PlotPanel {
            bands: vec![PlotBand::above(limit, "too much")],
            ..PlotPanel::new("angle, degrees", vec![PlotCurve::new("", 0, vec![[0.0, 5.0], [1.0, 20.0]])])
        };
        for limit in [10.0, 30.0] {
            let panel = panel(limit);
            let ((low, high), far) = values_of(&panel);
            assert!(low == 0.0 && high > limit && high > 20.0 && far.is_empty(), "{limit}: {low} {high}");
        }
        let far = panel(1500.0);
        let stacked = StackedPanel::new(&far, None, (0.0, 1.0));
        assert!(stacked.across.1 < 30.0);
        assert_eq!(stacked.name(), "angle, degrees (limit 1500: not drawn, far above)");
    }
}
