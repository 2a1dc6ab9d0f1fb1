// The page: verdicts, mechanism, curves, tables, and what moves them.

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

function banner(cam, index) {
  const count = (verdict) => cam.checks.filter((check) => check.verdict === verdict).length;
  const [fails, warns] = [count("fail"), count("warn")];
  const verdict = cam.passed ? (warns ? "warn" : "pass") : "fail";
  const name = letter(index) ? `${letter(index)}: ${cam.title}. ` : "";
  const told = [[count("pass"), "passed"], [fails, "failed"], [warns, warns === 1 ? "warning" : "warnings"], [count("info"), "without a verdict"]];
  const summary = told.filter(([n]) => n > 0).map(([n, what]) => `${n} ${what}`).join(", ");
  const box = make("div", { className: "banner" }, badge(verdict, cam.passed ? (warns ? "PASS, with warnings" : "PASS") : "FAIL"),
    make("p", {}, `${name}${cam.checks.length} checks: ${summary}`));
  const broken = cam.checks.filter((check) => check.verdict === "fail").map((check) => words(check.check)).join(", ");
  const stamp = cam.passed ? null : make("p", { className: "broken", role: "alert" }, `This cam breaks a limit: ${broken}.`);
  return make("div", {}, box, stamp);
}

function checksOf(cam) {
  const rows = cam.checks.map((check) => ({
    className: check.verdict,
    cells: [[words(check.check)], [badge(check.verdict)], [withUnit(check.value, check.unit), "number"],
      [limitOf(check), "number"], [check.place || "", "place"], [check.note || "", "note"]],
  }));
  const box = table([["Check"], ["Verdict"], ["Value", "number"], ["Limit", "number"], ["Place"], ["Note"]], rows);
  box.querySelectorAll("tbody th").forEach((cell, index) => (cell.title = cam.checks[index].about || ""));
  return box;
}

/** Checks of two cams in one table. */
function checksBeside([a, b]) {
  const names = [...new Set([...a.checks, ...b.checks].map((check) => check.check))];
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

const valueText = (value) => (Array.isArray(value) ? value.map((part) => (typeof part === "number" ? shown(part, 7) : String(part))).join(", ")
  : typeof value === "number" ? shown(value, 7) : String(value));

function sectionsOf(cam) {
  const boxes = cam.sections.filter((section) => section.values.length).map((section) => make("div", {},
    make("h3", {}, section.key), ...section.words.map((line) => make("p", { className: "muted" }, line)),
    table([["Value"], ["", "number"], ["Unit"]], section.values.map(([label, value, unit]) => ({ cells: [[label], [valueText(value), "number"], [unit]] })))));
  return make("div", {}, make("div", { className: "columns" }, ...boxes), ...cam.sections.flatMap(listsOf));
}

/** The lists of a section, a table each. */
function listsOf(section) {
  return section.tables.map(({ name, heads, rows }) => make("div", {}, make("h3", {}, `${section.key}: ${name}`),
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
      const numbers = x && y && typeof x[1] === "number" && typeof y[1] === "number";
      const differs = valueText(x?.[1] ?? null) !== valueText(y?.[1] ?? null);
      const share = numbers && x[1] !== 0 ? ` (${shown((100 * (y[1] - x[1])) / Math.abs(x[1]), 3)} %)` : "";
      const difference = differs ? (numbers ? `${shown(y[1] - x[1], 4)}${share}` : "differs") : "";
      return { className: differs ? "differs" : "", cells: [[label], ...[x, y].map((value) => [value ? valueText(value[1]) : "–", "number"]), [difference, "number difference"], [(x ?? y)[2]]] };
    });
    return rows.length ? make("div", {}, make("h3", {}, key), table([["Value"], ["A", "number"], ["B", "number"], ["B − A", "number"], ["Unit"]], rows)) : null;
  });
  return make("div", { className: "columns one" }, ...boxes);
}

/** Rows of the table at round places, the columns that fit a page. */
const MOST_COLUMNS = 13;
function rowsOf(cam, index) {
  const view = viewOf(cam);
  const skipped = /^(position|pitch_x|pitch_y|profile_|contact_|z_mm|rpm|psi|.*_cut_|air|lift_per|axial|principal|inertia)/;
  const names = Object.keys(view.columns).filter((name) => !view.parts.length || !skipped.test(name)).slice(0, MOST_COLUMNS);
  const last = view.columns[view.place].length - 1;
  const step = Math.max(1, Math.round(last / 36));
  const rows = [];
  for (let i = 0; i <= last; i += step) {
    rows.push({ cells: names.map((name) => {
      const [factor] = inRates(view, view.kinds[name][1], view.kinds[name][2]);
      const value = view.columns[name][i];
      return [value === null ? "–" : steady(value * factor), "number"];
    }) });
  }
  const head = names.map((name) => {
    const [label, unit, order] = view.kinds[name];
    return [`${label}, ${inRates(view, unit, order)[1] || "1"}`, "number"];
  });
  return make("div", {}, cams.length > 1 ? make("h3", {}, `${letter(index)}: ${cam.title}`) : null, table(head, rows));
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

/** One diagram of the same panel of all cams. */
function plotOf(panel, width, height) {
  const views = cams.map(viewOf);
  const lists = [];
  const series = [];
  views.forEach((view, index) => {
    const own = view.panels.find((other) => other.id === panel.id);
    if (!own) return;
    const [factor, unit] = inRates(view, own.unit, own.order);
    own.series.forEach(({ column, label }, at) => {
      const seen = (value) => (value === null ? (own.curvature ? 0 : null) : own.curvature ? 1 / value : value * factor);
      lists.push([view.columns[view.place], view.columns[column].map(seen)]);
      const beside = cams.length > 1;
      series.push({
        label: `${beside ? `${letter(index)} ` : ""}${label}`, stroke: colour(PALETTE[beside ? index : at % 4]), dash: DASHES[beside ? at % 4 : at ? 1 : 0],
        width: 1.6, points: { show: false }, value: (_, value) => (value === null || value === undefined ? "–" : `${steady(value)} ${unit}`),
      });
    });
    if (index === 0 || JSON.stringify(own.limits) !== JSON.stringify(views[0].panels.find((other) => other.id === panel.id)?.limits)) {
      for (const { label, value } of own.limits) {
        lists.push([view.columns[view.place], view.columns[view.place].map(() => value)]);
        series.push({ label: `${cams.length > 1 && index ? `${letter(index)} ` : ""}${label}`, stroke: colour("limit"), dash: [3, 4], width: 1.2, points: { show: false }, value: (_, found) => (found === null ? "–" : `${shown(found)} ${unit}`) });
      }
    }
  });
  const same = lists.every(([places]) => places.length === lists[0][0].length);
  const data = same ? [lists[0][0], ...lists.map(([, values]) => values)] : uPlot.join(lists.map(([places, values]) => [places, values]));
  if (!same) series.forEach((one) => (one.spanGaps = true));
  const view = views[0];
  const turning = view.place.endsWith("_deg");
  const axis = { stroke: colour("ink"), grid: { stroke: colour("faint"), width: 1 }, ticks: { stroke: colour("line"), width: 1 }, font: "12px system-ui, sans-serif" };
  const options = {
    width, height, series: [{ label: view.place === "cam_deg" ? "θ" : turning ? "φ" : "x", value: (_, value) => (value === null ? "–" : `${steady(value)} ${turning ? "°" : "mm"}`) }, ...series],
    // What is nothing but rounding is drawn as nothing.
    scales: { x: { time: false }, y: { range: (_, low, high) => (low === null || high - low < 1e-9 && Math.abs(high) < 1e-9 ? [-1, 1] : uPlot.rangeNum(low, high, 0.1, true)) } },
    axes: [{ ...axis, ...(turning ? { incrs: [5, 10, 15, 30, 45, 60, 90, 120, 180], space: 42 } : {}), size: 30 },
      { ...axis, size: 62, values: (_, splits) => splits.map((value) => (value === null ? "" : shown(value, 6))) }],
    cursor: { y: false, drag: { x: true, y: false }, points: { size: 7 } },
    legend: { live: true },
    hooks: { setCursor: [(plot) => pointed(plot)] },
  };
  const [, unit] = inRates(view, panel.unit, panel.order);
  const box = make("figure", { className: "plot", role: "group", "aria-label": `${panel.title}${unit ? `, ${unit}` : ""}` },
    make("h3", {}, `${panel.title} `, make("span", { className: "unit" }, unit)));
  return { box, plot: new uPlot(options, data, box), view };
}

/** Every panel that a cam has, in the order of the first. */
function panelsOf() {
  const all = [];
  for (const cam of cams) for (const panel of viewOf(cam).panels) if (!all.some((other) => other.id === panel.id)) all.push(panel);
  return all;
}

function drawPlots(width, height = 210) {
  for (const { plot } of plots) plot.destroy();
  const area = byId("plots");
  area.replaceChildren();
  plots = [];
  // All places first: their width depends on how many there are.
  const boxes = panelsOf().map((panel) => [panel, make("div", { className: "plot" })]);
  area.append(...boxes.map(([, box]) => box));
  const widths = boxes.map(([, box]) => width ?? Math.max(260, box.clientWidth));
  boxes.forEach(([panel, box], index) => {
    const made = plotOf(panel, widths[index], height);
    box.replaceWith(made.box);
    plots.push(made);
  });
  // Their scales are known once they are drawn, which uPlot does after this.
  setTimeout(() => show(), 0);
}

let pointing = false;
/** The pointer over a curve moves everything there, while nothing plays. */
function pointed(plot) {
  if (pointing || state.playing || plot.cursor.left === undefined || plot.cursor.left < 0 || !plot.cursor.event) return;
  const view = first();
  const turn = between(view.turn, locate(view.at, plot.posToVal(plot.cursor.left, "x")));
  setCycle(turn - view.turn[0], plot);
}

// ---- what moves

const movers = cams.map((cam, index) => mechanism(cam, index));
const readouts = cams.map((cam, index) => readout(cam, index));
const solids = cams.flatMap((cam, index) => (cam.solid ? [solidView(cam, index)] : []));

function show(except) {
  for (const mover of [...movers, ...readouts]) mover.draw();
  pointing = true;
  for (const { plot, view } of plots) {
    if (plot === except) continue;
    const left = plot.valToPos(placeOf(view), "x");
    plot.setCursor({ left, top: 10 }, false);
  }
  pointing = false;
  const scrub = byId("scrub");
  scrub.value = state.cycle;
  const view = first();
  const at = `${steady(placeOf(view))} ${view.place.endsWith("_deg") ? "degrees" : "millimetres"}`;
  scrub.setAttribute("aria-valuetext", at);
}

function setCycle(value, except) {
  const length = cycleOf(first());
  state.cycle = value < 0 || value > length ? ((value % length) + length) % length : value;
  show(except);
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
  const beside = cams.length > 1;
  const fill = (id, ...boxes) => {
    const area = byId(id);
    while (area.children.length > 1) area.lastElementChild.remove();
    area.append(...boxes);
  };
  fill("results", beside ? sectionsBeside(cams) : sectionsOf(cams[0]));
  fill("rows", ...cams.map(rowsOf));
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
  const beside = cams.length > 1;
  byId("verdict").append(...cams.map(banner), beside ? checksBeside(cams) : checksOf(cams[0]));
  byId("mechanisms").className = beside ? "two" : "";
  // A picture that is not wide leaves room for the values.
  const [, , wide, high] = first().box;
  byId("moving").classList.toggle("tall", !beside && wide < 1.6 * high);
  byId("mechanisms").append(...movers.map((mover) => mover.figure));
  // An analysis of what does not move has curves and no mechanism.
  if (cams.every((cam) => cam.views.every((view) => !view.parts.length))) {
    byId("mechanisms").hidden = true;
    byId("moving-title").textContent = "Along the curves";
    byId("section-choice").firstChild.textContent = "Curve ";
  }
  byId("readouts").append(...readouts.map((one) => one.box));
  const inputs = cams.map((cam) => cam.inputs).filter(Boolean);
  if (inputs.length) {
    byId("inputs").textContent = `Hash of the inputs: ${inputs.map((one) => (one.hash)).join(" | ")}`;
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
    // Of an analysis the first curve: the last is often that of the design, where nothing is left.
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
  show();
  // The curves come after the first picture.
  requestAnimationFrame(() => setTimeout(() => {
    tables();
    redraw();
    let width = window.innerWidth;
    window.addEventListener("resize", () => {
      if (window.innerWidth !== width && !document.documentElement.dataset.printing) {
        width = window.innerWidth;
        redraw();
      }
    });
    window.addEventListener("beforeprint", () => {
      play(false);
      document.documentElement.dataset.printing = "";
      drawPlots(330, 122);
      for (const solid of solids) solid.draw();
    });
    window.addEventListener("afterprint", () => {
      delete document.documentElement.dataset.printing;
      redraw();
    });
    setTimeout(() => (document.documentElement.dataset.ready = ""), 0);
  }, 0));
}

start();
