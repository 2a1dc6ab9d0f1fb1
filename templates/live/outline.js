// The outline coloured by a quantity, with the limit on its scale, and the place of contact.

/** Quantities that can be painted on the outline: the column, its name, the check whose limit it has, and whether it is a radius, which is painted as curvature. */
const PAINTS = [
  { id: "pressure", column: /^pressure_angle_deg$/, check: "pressure_angle" },
  { id: "force", column: /^contact_force_/, check: null },
  { id: "curvature", column: /^profile_curvature_radius_mm$/, check: null, isRadius: true },
];
const PAINT_STEPS = 10;
let paintChoice = "pressure";

/** Quantities that a view has along its outline; none without the profile in the frame of the cam. */
function paintsOf(view) {
  const { profile_x_mm: xs, profile_y_mm: ys } = view.columns;
  if (cams.length > 1 || !xs || !ys || !view.parts.some(({ role }) => role === "cam")) return [];
  const names = Object.keys(view.columns);
  return PAINTS.flatMap((paint) => {
    const column = names.find((name) => paint.column.test(name));
    return column && view.columns[column].some((value) => value !== null && Math.abs(value) > 1e-6) ? [{ ...paint, name: column }] : [];
  });
}

/** The quantity that is painted now, with its values, their largest and the limit. */
function paintOf(view) {
  const all = paintsOf(view);
  const paint = all.find(({ id }) => id === paintChoice) ?? all[0];
  if (!paint) return null;
  const [factor, unit] = inLengths(paint.isRadius ? "1/mm" : view.kinds[paint.name][1]);
  const values = view.columns[paint.name].map((value) => (value === null ? (paint.isRadius ? 0 : null) : paint.isRadius ? factor / value : value * factor));
  const sizes = values.map((value) => (value === null ? null : Math.abs(value)));
  const largest = Math.max(1e-12, ...sizes.filter((size) => size !== null));
  const check = cams[0].checks.find(({ check: name }) => name === paint.check);
  const limit = check?.limit ?? null;
  // A limit far above what is reached would leave the outline in one colour.
  const top = limit !== null && limit < 4 * largest ? limit : largest;
  return { ...paint, sizes, largest, limit: top === limit ? limit : null, top, unit };
}

/** The step of the colours that a size has; one more beyond the limit. */
const stepOf = ({ top, limit }, size) => (limit !== null && size > limit * (1 + 1e-9) ? PAINT_STEPS : Math.min(PAINT_STEPS - 1, Math.floor((PAINT_STEPS * size) / top)));

/** The outline in pieces of one colour each. */
function paintedPaths(view) {
  const paint = paintOf(view);
  if (!paint) return [];
  const { profile_x_mm: xs, profile_y_mm: ys } = view.columns;
  const pieces = Array.from({ length: PAINT_STEPS + 1 }, () => "");
  let drawn = -1;
  for (let at = 0; at + 1 < xs.length; at += 1) {
    const size = paint.sizes[at];
    if ([xs[at], ys[at], xs[at + 1], ys[at + 1], size].includes(null)) {
      drawn = -1;
      continue;
    }
    const step = stepOf(paint, Math.max(size, paint.sizes[at + 1] ?? 0));
    if (step !== drawn) pieces[step] += `M${xs[at]} ${-ys[at]}`;
    pieces[step] += `L${xs[at + 1]} ${-ys[at + 1]}`;
    drawn = step;
  }
  return pieces;
}

/** The paths of the colours, to be put into the group of the cam, and the bead at the place of contact. */
function outlinePaint() {
  const group = makeSvg("g", { class: "paint" });
  const paths = Array.from({ length: PAINT_STEPS + 1 }, (_, step) => makeSvg("path", step < PAINT_STEPS ? { style: `stroke: var(--ramp-${step})` } : { class: "over" }));
  group.append(...paths);
  const bead = makeSvg("circle", { class: "contact" });
  return {
    group, bead,
    /** Takes the curve of another cam, or another quantity. */
    take(view) {
      const pieces = paintedPaths(view);
      paths.forEach((path, step) => put(path, "d", pieces[step] ?? ""));
      bead.style.display = pieces.length ? "" : "none";
    },
    /** The bead where follower and cam touch, in the frame of the cam. */
    place(view, transform, pixel) {
      if (bead.style.display === "none") return;
      const places = view.columns[view.place];
      const sample = locate(places, placeOf(view));
      const [x, y] = [between(view.columns.profile_x_mm, sample), between(view.columns.profile_y_mm, sample)];
      if (x === null || y === null) return;
      put(bead, "transform", transform);
      put(bead, "cx", String(x));
      put(bead, "cy", String(-y));
      put(bead, "r", String(5.5 * pixel));
    },
  };
}

/** The choice of the quantity, and the scale below the cam. */
function paintChoices() {
  const view = first();
  const all = paintsOf(view);
  const chosen = all.find(({ id }) => id === paintChoice) ?? all[0];
  const said = JSON.stringify([all.map(({ id }) => id), chosen?.id, language]);
  if (byId("paint").dataset.said !== said) {
    byId("paint").dataset.said = said;
    byId("paint").replaceChildren(...(all.length > 1 ? all : []).map(({ id }) => {
      const button = make("button", { type: "button", "aria-pressed": String(id === chosen.id), tabIndex: id === chosen.id ? 0 : -1, "data-paint": id }, text(`paint_${id}`));
      button.addEventListener("click", () => choosePaint(id));
      return button;
    }));
  }
  scaleBar(view);
}

function choosePaint(id) {
  paintChoice = id;
  paintChoices();
  movers[0].paintAnew();
  byId("paint").querySelector("[aria-pressed=true]")?.focus();
}

/** The colours with round figures, the limit, and a mark at the value of the present place. */
function scaleBar(view) {
  const bar = byId("scale-bar");
  const paint = paintOf(view);
  bar.hidden = !paint;
  if (!paint) return;
  const cells = PAINT_STEPS + (paint.limit === null ? 0 : 1);
  const at = (size) => `${(100 * PAINT_STEPS * Math.min(size / paint.top, cells / PAINT_STEPS)) / cells}%`;
  const ramp = make("div", { className: "ramp" }, ...Array.from({ length: PAINT_STEPS }, (_, step) => make("i", { style: `background: var(--ramp-${step})` })), paint.limit === null ? null : make("i", { className: "beyond-limit" }));
  const put_ = (words_, style, className = "") => make("span", { className, style }, words_);
  const unit = paint.unit === "°" ? "°" : ` ${paint.unit}`;
  bar.replaceChildren(ramp, put_(text(`paint_${paint.id}_long`), "left: 0; top: 0"),
    paint.limit === null ? put_(`${shown(paint.largest)}${unit}`, "right: 0; top: 0") : put_(`${text("limit")} ${shown(paint.limit)}${unit}`, `right: 0; top: 0`, "at-limit"),
    put_("0", "left: 0; top: 27px"), put_(shown(paint.top / 2), `left: ${at(paint.top / 2)}; top: 27px; transform: translateX(-50%)`), put_("", "", "here"));
}

/** The mark of the scale at the present place. */
function scaleMark(view) {
  const mark = byId("scale-bar").querySelector(".here");
  const paint = mark && !byId("scale-bar").hidden ? paintOf(view) : null;
  if (!paint) return;
  const size = between(paint.sizes, locate(view.columns[view.place], placeOf(view)));
  const cells = PAINT_STEPS + (paint.limit === null ? 0 : 1);
  mark.style.left = `${(100 * PAINT_STEPS * Math.min((size ?? 0) / paint.top, cells / PAINT_STEPS)) / cells}%`;
}

byId("paint").addEventListener("keydown", (event) => {
  const stops = [...byId("paint").children];
  const next = stops[stops.indexOf(event.target) + ({ ArrowRight: 1, ArrowLeft: -1 }[event.key] ?? NaN)];
  if (!next) return;
  event.preventDefault();
  event.stopPropagation();
  next.click();
});
