// The page: verdicts, mechanism, curves, tables, and their animation.

// ---- verdicts and tables

const word = { pass: "pass", fail: "FAIL", warn: "WARN", info: "info" };
const badge = (verdict, text = word[verdict]) => make("span", { className: `badge ${verdict}` }, text);
const limitOf = (check) => (check.limit === null ? "" : `${check.side ? `${check.side} ` : ""}${withUnit(check.limit, check.unit)}`);
const withUnit = (value, unit) => (value === null ? "–" : `${shown(value)}${unit ? ` ${unit}` : ""}`);
const words = (name) => name.replace(/_/g, " ");

function table(head, rows, className = "full") {
  const cell = (tag, [text, kind]) => make(tag, { className: kind || "" }, text);
  const headRow = make("tr", {}, ...head.map((entry) => make("th", { scope: "col", className: entry[1] || "" }, entry[0])));
  const body = rows.map(({ className: of, cells }) =>
    make("tr", { className: of || "" }, ...cells.map((entry, index) => cell(index === 0 ? "th" : "td", entry))));
  for (const row of body) row.firstElementChild.setAttribute("scope", "row");
  return make("div", { className: "wide" }, make("table", { className }, make("thead", {}, headRow), make("tbody", {}, ...body)));
}

const isBad = (check) => check.verdict === "fail" || check.verdict === "warn";
const checksWords = (n, what) => `${n} ${n === 1 ? "check" : "checks"} ${what}`;

/** The verdict of a cam in one line. */
function banner(cam, index) {
  const count = (verdict) => cam.checks.filter((check) => check.verdict === verdict).length;
  const [fails, warns] = [count("fail"), count("warn")];
  const verdict = cam.passed ? (warns ? "warn" : count("pass") ? "pass" : "info") : "fail";
  const name = letter(index) ? `${letter(index)}: ${cam.title}. ` : "";
  const counts = [[fails, "failed"], [warns, warns === 1 ? "warns" : "warn"], [count("pass"), "passed"], [count("info"), "without a verdict"]].filter(([n]) => n > 0);
  const line = counts.map(([n, what], at) => (at ? `${n} ${what}` : checksWords(n, what))).join(", ");
  const broken = cam.checks.filter((check) => check.verdict === "fail").map((check) => words(check.check)).join(", ");
  return make("span", { className: "banner" }, badge(verdict, word[verdict]), make("span", {}, `${name}${line}`),
    cam.passed ? null : make("strong", { className: "broken", role: "alert" }, `This cam breaks a limit: ${broken}.`));
}

/** A line that opens the checks; open by itself where one failed or warns, and these first. */
function verdicts() {
  const [bad, rest] = cams.length > 1
    ? [true, false].map((wanted) => checksBeside(cams, (name) => cams.some((cam) => cam.checks.some((check) => check.check === name && isBad(check))) === wanted))
    : [true, false].map((wanted) => checksOf(cams[0].checks.filter((check) => isBad(check) === wanted)));
  const boxes = bad && rest ? [bad, make("details", {}, make("summary", {}, "The other checks"), rest)] : [bad ?? rest];
  return make("details", { open: Boolean(bad) }, make("summary", {}, ...cams.map(banner)), ...boxes);
}

function checksOf(checks) {
  if (!checks.length) return null;
  const rows = checks.map((check) => ({
    className: check.verdict,
    cells: [[words(check.check)], [badge(check.verdict)], [withUnit(check.value, check.unit), "number"],
      [limitOf(check), "number"], [check.place || "", "place"], [check.note || "", "note"]],
  }));
  const box = table([["Check"], ["Verdict"], ["Value", "number"], ["Limit", "number"], ["Place"], ["Note"]], rows);
  box.querySelectorAll("tbody th").forEach((cell, index) => (cell.title = checks[index].about || ""));
  return box;
}

/** Those checks of two cams in one table. */
function checksBeside([a, b], isWanted) {
  const names = [...new Set([...a.checks, ...b.checks].map((check) => check.check))].filter(isWanted);
  if (!names.length) return null;
  const rank = { fail: 0, warn: 1, pass: 2, info: 3 };
  const of = (cam, name) => cam.checks.find((check) => check.check === name);
  const worst = (name) => Math.min(...[a, b].map((cam) => rank[of(cam, name)?.verdict] ?? 4));
  names.sort((x, y) => Math.min(worst(x), 2) - Math.min(worst(y), 2));
  const rows = names.map((name) => {
    const both = [a, b].map((cam) => of(cam, name));
    const cells = both.flatMap((check) => (check
      ? [[badge(check.verdict)], [withUnit(check.value, check.unit), "number"], [check.place || "", "place"]] : [["–"], ["", "number"], [""]]));
    const limits = [...new Set(both.filter((check) => check && check.limit !== null).map(limitOf))];
    const differs = both[0]?.verdict !== both[1]?.verdict;
    const found = worst(name);
    return { className: [found === 0 ? "fail" : found === 1 ? "warn" : "", differs ? "differs" : ""].join(" "), cells: [[words(name)], ...cells, [limits.join(" | "), "number"]] };
  });
  return table([["Check"], ["A"], ["", "number"], ["at"], ["B"], ["", "number"], ["at"], ["Limit", "number"]], rows);
}

const valueText = (value) => (Array.isArray(value) ? value.map(valueText).join(", ") : typeof value === "number" ? shown(value) : String(value));

function sectionsOf(cam) {
  // What is said in words comes first; the values behind it are there for those who want all digits.
  const valuesOf = (section) => {
    const all = table([["Value"], ["", "number"], ["Unit"]], section.values.map(([label, value, unit]) => ({ cells: [[label], [valueText(value), "number"], [unit]] })));
    return make("details", {}, make("summary", {}, "All values"), all);
  };
  const boxes = cam.sections.filter((section) => section.values.length || section.words.length).map((section) => make("div", { className: section.words.length ? "" : "control" },
    make("h3", {}, section.title), ...section.words.map((line) => make("p", {}, line)), section.values.length ? valuesOf(section) : null));
  return make("div", {}, make("div", { className: "columns" }, ...boxes), ...(viewOf(cam)?.words ? [] : cam.sections.flatMap(listsOf)));
}

/** The lists of a section, a table each. */
function listsOf(section) {
  return section.tables.map(({ name, heads, rows }) => make("div", {}, make("h3", {}, `${section.title}: ${name}`),
    table(heads.map(([label, unit]) => [unit ? `${label}, ${unit}` : label, "number"]),
      rows.map((row) => ({ cells: row.map((value) => [value === null ? "–" : valueText(value), "number"]) })))));
}

function sectionsBeside([a, b]) {
  const keys = [...new Set([...a.sections, ...b.sections].map((section) => section.key))];
  const of = (cam, key) => cam.sections.find((section) => section.key === key)?.values ?? [];
  const boxes = keys.map((key) => {
    const labels = [...new Set([...of(a, key), ...of(b, key)].map(([label]) => label))];
    const rows = labels.map((label) => {
      const [x, y] = [a, b].map((cam) => of(cam, key).find((value) => value[0] === label));
      const comparable = !x || !y || x[2] === y[2];
      const numbers = comparable && x && y && typeof x[1] === "number" && typeof y[1] === "number";
      const differs = !comparable || valueText(x?.[1] ?? null) !== valueText(y?.[1] ?? null);
      const share = numbers && x[1] !== 0 ? ` (${shown((100 * (y[1] - x[1])) / Math.abs(x[1]), 3)} %)` : "";
      const difference = differs ? (numbers ? `${shown(y[1] - x[1], 4)}${share}` : comparable ? "differs" : "not comparable") : "";
      const unit = comparable ? (x ?? y)[2] : `${x[2]} | ${y[2]}`;
      return { className: differs ? "differs" : "", cells: [[label], ...[x, y].map((value) => [value ? valueText(value[1]) : "–", "number"]), [difference, "number difference"], [unit]] };
    });
    const { title } = [...a.sections, ...b.sections].find((section) => section.key === key);
    return rows.length ? make("div", {}, make("h3", {}, title), table([["Value"], ["A", "number"], ["B", "number"], ["B − A", "number"], ["Unit"]], rows)) : null;
  });
  return make("div", { className: "columns one" }, ...boxes);
}

/** Rows of the table at round places, the columns that fit a page; those of a list in as many tables as they need. */
const MOST_COLUMNS = 13;
function rowsOf(cam, index) {
  const view = viewOf(cam);
  const shownOf = view.words ? shown : steady;
  const skipped = /^(position|pitch_x|pitch_y|profile_|contact_|z_mm|rpm|psi|.*_cut_|air|lift_per|axial|principal|inertia)/;
  const names = Object.keys(view.columns).filter((name) => !view.parts.length || !skipped.test(name));
  const parts = [];
  for (let from = 0; from < (view.words ? names.length : 1); from += MOST_COLUMNS) parts.push(names.slice(from, from + MOST_COLUMNS));
  const last = view.columns[view.place].length - 1;
  const step = view.words ? 1 : Math.max(1, Math.round(last / 36));
  const tableOf = (part) => {
    const rows = [];
    for (let i = 0; i <= last; i += step) {
      rows.push({ cells: [...(view.words ? [[view.words[1][i]]] : []), ...part.map((name) => {
        const [factor] = inRates(view, view.kinds[name][1], view.kinds[name][2]);
        const value = view.columns[name][i];
        return [value === null ? "–" : shownOf(value * factor), "number"];
      })] });
    }
    const head = part.map((name) => {
      const [label, unit, order] = view.kinds[name];
      return [[label, inRates(view, unit, order)[1]].filter(Boolean).join(", "), "number"];
    });
    if (view.words) head.unshift([words(view.words[0])]);
    return table(head, rows, view.words ? "full" : "full every");
  };
  return make("div", {}, cams.length > 1 ? make("h3", {}, `${letter(index)}: ${cam.title}`) : null, ...parts.map(tableOf));
}

function missingOf(cam, index) {
  const list = (lines) => make("ul", {}, ...lines.map((line) => make("li", {}, line)));
  const notRun = cam.notRun.map(([check, note]) => `Check ${words(check)}: ${note}.`);
  return make("div", {}, cams.length > 1 ? make("h3", {}, `${letter(index)}: ${cam.title}`) : null, list(cam.notModelled),
    notRun.length ? make("h3", {}, "Checks that were not run") : null, notRun.length ? list(notRun) : null,
    cam.notes.length ? make("h3", {}, "Notes") : null, cam.notes.length ? list(cam.notes) : null);
}

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
      const seen = (value) => (value === null ? (own.curvature ? 0 : null) : own.curvature ? 1 / value : value * factor);
      curves.push({ label: `${name}${label}`, unit, view, places, values: view.columns[column].map(seen), colour: PALETTE[several ? index : at % 4], dash: DASHES[several ? at % 4 : at ? 1 : 0], width: 1.6 });
    });
    if (index > 0 && JSON.stringify(own.limits) === JSON.stringify(views[0].panels.find((other) => isSame(other, panel))?.limits)) return;
    for (const { label, value } of own.limits) {
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

/** One diagram of the same panel of all cams. Its cursor and its legend are ours: both show the place of the mechanism. */
function plotOf(panel, width, height) {
  const curves = curvesOf(panel);
  const view = cams.map(viewOf)[0];
  const lists = curves.map((curve) => [curve.places, curve.values]);
  const same = lists.every(([places]) => places.length === lists[0][0].length);
  const data = same ? [lists[0][0], ...lists.map(([, values]) => values)] : uPlot.join(lists);
  const series = curves.map((one) => ({ label: one.label, stroke: colour(one.colour), dash: one.dash, width: one.width, points: { show: false }, spanGaps: !same }));
  const turning = view.place.endsWith("_deg");
  const [placeName, placeUnit] = view.kinds[view.place];
  const [, unit] = inRates(view, panel.unit, panel.order);
  const withUnits = (name, of) => (of ? `${name}, ${of}` : name);
  const font = "12px system-ui, sans-serif";
  const axis = { stroke: colour("ink"), grid: { stroke: colour("faint"), width: 1 }, ticks: { stroke: colour("line"), width: 1 }, font, labelFont: font, labelSize: 18 };
  const options = {
    width, height, series: [{}, ...series],
    // Values that are only rounding are drawn as 0.
    scales: { x: { time: false }, y: { range: (_, low, high) => (low === null || high - low < 1e-9 && Math.abs(high) < 1e-9 ? [-1, 1] : uPlot.rangeNum(low, high, 0.1, true)) } },
    axes: [{ ...axis, ...(turning ? { incrs: [5, 10, 15, 30, 45, 60, 90, 120, 180], space: 42 } : {}), size: 30, label: withUnits(placeName, placeUnit) },
      // What the values are, without of what.
      { ...axis, size: 58, label: isPrinting() ? unit : withUnits(panel.title.split(/ of |,/)[0], unit), values: (_, splits) => splits.map((value) => (value === null ? "" : shown(value))) }],
    cursor: { x: false, y: false, points: { show: false }, drag: { x: true, y: false } },
    legend: { show: false },
    hooks: { setCursor: [(plot) => pointed(plot)] },
  };
  const box = make("figure", { className: "plot", role: "group", "aria-label": withUnits(panel.title, unit) }, make("h3", {}, panel.title));
  const plot = new uPlot(options, data, box);
  const line = make("div", { className: "cursor" });
  plot.over.append(line);
  const legend = make("div", { className: "legend" });
  box.append(legend);
  const place = make("span", { className: "value" });
  legend.append(make("span", { className: "key" }, make("span", {}, placeName), place));
  const marks = curves.map((curve, index) => {
    const dot = make("div", { className: "dot", style: `background:${colour(curve.colour)}` });
    if (curve.limit === undefined) plot.over.append(dot);
    const { entry, value } = legendEntry(curve, (on) => {
      plot.setSeries(index + 1, { show: on });
      setTimeout(show, 0);
    });
    legend.append(entry);
    return { curve, dot, value };
  });

  /** Cursor, dots and legend at the place of the mechanism. */
  function draw() {
    const at = placeOf(view);
    const left = plot.valToPos(at, "x");
    line.style.transform = `translateX(${left}px)`;
    line.hidden = left < 0 || left > plot.over.clientWidth;
    place.textContent = `${steady(at)} ${placeUnit}`;
    marks.forEach(({ curve, dot, value }, index) => {
      const found = valueAt(curve);
      value.textContent = found === null ? "–" : `${curve.limit === undefined ? steady(found) : shown(found)} ${curve.unit}`;
      const own = plot.valToPos(placeOf(curve.view), "x");
      const top = found === null ? NaN : plot.valToPos(found, "y");
      dot.hidden = !plot.series[index + 1].show || !(top >= 0 && top <= plot.over.clientHeight && own >= 0 && own <= plot.over.clientWidth);
      dot.style.transform = `translate(${own}px, ${top}px)`;
    });
  }
  return { box, plot, draw };
}

/** Whether two panels share an axis: millimetres and degrees do not. */
const isSame = (a, b) => a.id === b.id && a.unit === b.unit;

/** Every panel that a cam has, in the order of the first. */
function panelsOf() {
  const all = [];
  for (const cam of cams) for (const panel of viewOf(cam).panels) if (!all.some((other) => isSame(other, panel))) all.push(panel);
  return all;
}

function drawPlots(width, height = 210) {
  for (const { plot } of plots) plot.destroy();
  plots = [];
  // All places first: their width depends on how many there are. The first one lies next to the mechanism.
  const boxes = panelsOf().map((panel) => [panel, make("div", { className: "plot" })]);
  byId("lead").replaceChildren(...boxes.slice(0, 1).map(([, box]) => box));
  byId("plots").replaceChildren(...boxes.slice(1).map(([, box]) => box));
  byId("curves").hidden = boxes.length < 2;
  const widths = boxes.map(([, box]) => width ?? Math.max(240, box.clientWidth));
  boxes.forEach(([panel, box], index) => {
    const made = plotOf(panel, widths[index], height);
    box.replaceWith(made.box);
    plots.push(made);
  });
  // Their scales are known only after they are drawn, which uPlot does later.
  setTimeout(show, 0);
}

/** The pointer over a curve moves everything there, while nothing plays. */
function pointed(plot) {
  if (state.playing || plot.cursor.left === undefined || plot.cursor.left < 0 || !plot.cursor.event) return;
  const view = first();
  const turn = between(view.turn, locate(view.at, plot.posToVal(plot.cursor.left, "x")));
  setCycle(turn - view.turn[0]);
}

// ---- the animation

const movers = cams.map((cam, index) => mechanism(cam, index));
const readouts = cams.map((cam, index) => readout(cam, index));
const solids = cams.flatMap((cam, index) => (cam.solid ? [solidView(cam, index)] : []));

function show() {
  for (const mover of [...movers, ...readouts, ...plots]) mover.draw();
  const scrub = byId("scrub");
  scrub.value = state.cycle;
  const view = first();
  const at = `${steady(placeOf(view))} ${view.place.endsWith("_deg") ? "degrees" : "millimetres"}`;
  scrub.setAttribute("aria-valuetext", at);
}

/** The first place at which there is something to see: before it a plate runs in. */
function begin() {
  const view = first();
  const column = view.panels[0]?.series[0].column;
  const places = view.columns[view.place];
  const from = column ? places[view.columns[column].findIndex((value) => value !== null)] : undefined;
  if (from !== undefined) state.cycle = between(view.turn, locate(view.at, from)) - view.turn[0];
}

function setCycle(value) {
  const length = cycleOf(first());
  state.cycle = value < 0 || value > length ? ((value % length) + length) % length : value;
  show();
}

let before = null;
function frame(now) {
  if (!state.playing) return;
  if (before !== null) setCycle(state.cycle + (cycleOf(first()) * Math.min(now - before, 200)) / (1000 * state.seconds));
  before = now;
  requestAnimationFrame(frame);
}

function play(on) {
  state.playing = on;
  before = null;
  const button = byId("play");
  button.textContent = on ? "Pause" : "Play";
  button.setAttribute("aria-pressed", String(on));
  if (on) requestAnimationFrame(frame);
}

/** Half or twice as fast, between half a second and two minutes a cycle. */
function faster(factor) {
  state.seconds = Math.min(128, Math.max(0.5, state.seconds / factor));
  const view = first();
  const real = view.shaftSpeed ? (cycleOf(view) * Math.PI) / 180 / view.shaftSpeed : null;
  const share = real ? real / state.seconds : null;
  const of = share === null ? "" : share >= 0.995 ? `, ${shown(share, 2)} × real time` : `, 1/${shown(1 / share, 2)} of real time`;
  byId("speed").textContent = `${shown(state.seconds, 3)} s a cycle${of}`;
}

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const tag = event.target.tagName;
  const own = { SELECT: true, INPUT: true, BUTTON: event.key === " " || event.key === "Enter", SUMMARY: event.key === " " || event.key === "Enter" }[tag];
  if (own && !(tag === "INPUT" && (event.key === " " || event.key === "+" || event.key === "-"))) return;
  const step = event.shiftKey ? 10 : 1;
  const act = {
    " ": () => play(!state.playing),
    ArrowRight: () => setCycle(state.cycle + step),
    ArrowLeft: () => setCycle(state.cycle - step),
    Home: () => setCycle(0),
    End: () => setCycle(cycleOf(first())),
    "+": () => faster(2),
    "=": () => faster(2),
    "-": () => faster(0.5),
  }[event.key];
  if (!act) return;
  act();
  event.preventDefault();
});

// ---- the page put together

function tables() {
  const several = cams.length > 1;
  const fill = (id, ...boxes) => {
    const area = byId(id);
    while (area.children.length > 1) area.lastElementChild.remove();
    area.append(...boxes);
  };
  fill("results", several ? sectionsBeside(cams) : sectionsOf(cams[0]));
  fill("rows", ...cams.map(rowsOf));
  byId("missing").hidden = cams.every((cam) => !cam.notModelled.length && !cam.notRun.length && !cam.notes.length);
  fill("missing", ...cams.map(missingOf));
}

function redraw() {
  drawPlots();
  for (const solid of solids) solid.draw();
  byId("rows").replaceChildren(byId("rows").firstElementChild, ...cams.map(rowsOf));
}

function chooseTheme(dark) {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  byId("theme").textContent = dark ? "Light" : "Dark";
  redraw();
}

function start() {
  const several = cams.length > 1;
  // An analysis may have nothing to judge.
  byId("verdict").hidden = cams.every((cam) => !cam.checks.length);
  byId("verdict").append(verdicts());
  byId("mechanisms").className = several ? "two" : "";
  byId("mechanisms").append(...movers.map((mover) => mover.figure));
  // An analysis without motion has curves and no mechanism.
  if (cams.every((cam) => cam.views.every((view) => !view.parts.length))) {
    byId("mechanisms").hidden = true;
    byId("moving").classList.add("still");
    byId("moving-title").textContent = "Along the curves";
    byId("section-choice").firstChild.textContent = "Curve ";
  }
  // A list of rows that belong to no common place is a table and has no curves.
  if (cams.every((cam) => cam.views.every((view) => view.words))) byId("moving").hidden = true;
  byId("readouts").append(...readouts.map((one) => one.box));
  const inputs = cams.map((cam) => cam.inputs).filter(Boolean);
  if (inputs.length) {
    byId("inputs").textContent = `Hash of the inputs: ${inputs.map((one) => one.hash).join(" | ")}.`;
    byId("inputs").hidden = false;
  }
  const scrub = byId("scrub");
  scrub.max = cycleOf(first());
  scrub.addEventListener("input", () => setCycle(Number(scrub.value)));
  byId("play").addEventListener("click", () => play(!state.playing));
  byId("slower").addEventListener("click", () => faster(0.5));
  byId("faster").addEventListener("click", () => faster(2));
  const sections = Math.max(...cams.map((cam) => cam.views.length));
  if (sections > 1) {
    const views = cams.find((cam) => cam.views.length === sections).views;
    byId("section").append(...views.map((view, index) => make("option", { value: String(index) }, view.name)));
    // For an analysis the first curve: the last is often that of the design, where the residual is 0.
    byId("section").value = String((state.section = views[0].parts.length ? sections - 1 : 0));
    byId("section-choice").hidden = false;
    byId("section").addEventListener("change", (event) => {
      state.section = Number(event.target.value);
      faster(1);
      redraw();
    });
  }
  if (cams.every((cam) => cam.views.every((view) => view.shaftSpeed))) {
    byId("unit-choice").hidden = false;
    const swings = cams.some((cam) => cam.views.some((view) => Object.values(view.kinds).some(([, unit]) => unit.startsWith("rad/"))));
    if (swings) byId("unit").append(make("option", { value: "degrees" }, "per second, in degrees"));
    byId("unit").addEventListener("change", (event) => {
      state.rate = event.target.value;
      redraw();
    });
  }
  const media = window.matchMedia("(prefers-color-scheme: dark)");
  byId("theme").textContent = media.matches ? "Light" : "Dark";
  byId("theme").addEventListener("click", () => chooseTheme(byId("theme").textContent === "Dark"));
  media.addEventListener("change", () => {
    if (!document.documentElement.dataset.theme) redraw();
  });
  if (solids.length) {
    byId("solid").hidden = false;
    byId("solid").append(...solids.map((solid) => solid.figure));
  }
  faster(1);
  begin();
  // What is above the mechanism takes its room.
  document.documentElement.style.setProperty("--above", `${Math.round(byId("mechanisms").getBoundingClientRect().top + window.scrollY)}px`);
  show();
  // The curves come after the first picture.
  requestAnimationFrame(() => setTimeout(() => {
    tables();
    redraw();
    let width = window.innerWidth;
    let folded = [];
    window.addEventListener("resize", () => {
      if (window.innerWidth !== width && !isPrinting()) {
        width = window.innerWidth;
        redraw();
      }
    });
    window.addEventListener("beforeprint", () => {
      play(false);
      document.documentElement.dataset.printing = "";
      folded = [...document.querySelectorAll("#verdict details:not([open])")];
      for (const box of folded) box.open = true;
      drawPlots(330, 130);
      show();
      for (const solid of solids) solid.draw();
    });
    window.addEventListener("afterprint", () => {
      delete document.documentElement.dataset.printing;
      for (const box of folded) box.open = false;
      redraw();
    });
    setTimeout(() => (document.documentElement.dataset.ready = ""), 0);
  }, 0));
}

