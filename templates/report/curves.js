// ---- curves

const PALETTE = ["one", "two", "three", "four"];
const DASHES = [[], [7, 4], [2, 3], [10, 3, 2, 3]];
let plots = [];

/** The curves of a panel of all cams, each with its places and values, its colour and its dashes. */
function curvesOf(panel) {
  const views = cams.map(viewOf);
  const several = cams.length > 1;
  const curves = [];
  views.forEach((view, index) => {
    const own = view.panels.find((other) => isSame(other, panel));
    if (!own) return;
    const [factor, unit] = inRates(view, own.unit, own.order);
    const name = several ? `${letter(index)} ` : "";
    const places = view.columns[view.place];
    own.series.forEach(({ column, label }, at) => {
      const seen = (value) => (value === null ? (own.curvature ? 0 : null) : own.curvature ? factor / value : value * factor);
      curves.push({ label: `${name}${label}`, unit, order: own.order, factor, view, places, values: view.columns[column].map(seen), colour: PALETTE[several ? index : at % 4], dash: DASHES[several ? at % 4 : at ? 1 : 0], width: 1.6 });
    });
    if (index > 0 && JSON.stringify(own.limits) === JSON.stringify(views[0].panels.find((other) => isSame(other, panel))?.limits)) return;
    const [scaled] = inLengths(own.unit);
    for (const { label, value: limit } of own.limits) {
      const value = limit * scaled;
      curves.push({ label: `${several && index ? name : ""}${label}`, unit, view, places, values: places.map(() => value), colour: "limit", dash: [3, 4], width: 1.2, limit: value });
    }
  });
  return curves;
}

/** The value of a curve where the mechanism is; a plate has a run-in before the first row of its table. */
function valueAt({ view, places, values }) {
  const place = placeOf(view);
  return place < places[0] - 1e-9 ? null : between(values, locate(places, place)) ?? null;
}

/** The line of a legend with its sample; it hides its curve and shows it again. */
function legendEntry(curve, toggle) {
  const sample = makeSvg("svg", { width: 26, height: 10, "aria-hidden": "true" });
  sample.append(makeSvg("line", { x1: 0, x2: 26, y1: 5, y2: 5, stroke: colour(curve.colour), "stroke-width": 2, "stroke-dasharray": curve.dash.join(" ") }));
  const value = make("span", { className: "value" });
  const entry = make("button", { type: "button", className: "key", "aria-pressed": "true" }, sample, make("span", {}, curve.label), value);
  entry.addEventListener("click", () => {
    const on = entry.getAttribute("aria-pressed") !== "true";
    entry.setAttribute("aria-pressed", String(on));
    toggle(on);
  });
  return { entry, value };
}

const isPrinting = () => "printing" in document.documentElement.dataset;

