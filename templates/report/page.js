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
  byId("lead")?.replaceChildren();
  if (allDiagrams && !allDiagrams.open) return setTimeout(show, 0);
  // All places first: their width depends on how many there are. The first one lies next to the mechanism, unless all curves are stacked there.
  const boxes = panelsOf().map((panel) => [panel, make("div", { className: "plot" })]);
  const leads = byId("lead") && (isPrinting() || !usesStack()) ? 1 : 0;
  byId("lead")?.replaceChildren(...boxes.slice(0, leads).map(([, box]) => box));
  byId("plots").replaceChildren(...boxes.slice(leads).map(([, box]) => box));
  byId("curves").hidden = boxes.length <= leads;
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
/** What else shows the place of the mechanism: the stack of curves. */
const watchers = [];

function show() {
  for (const mover of [...movers, ...readouts, ...plots, ...watchers]) mover.draw();
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

/** Moves the mechanism to a place of the view. */
function goToPlace(place) {
  const view = first();
  setCycle(between(view.turn, locate(view.at, place)) - view.turn[0]);
}

/** Goes to the place of a check, or opens the list of checks where it has none. */
function goToCheck(check) {
  const place = placeOfCheck(check, first());
  if (place === null) return openChecks();
  play(false);
  goToPlace(place);
  for (const cell of byId("answer").querySelectorAll(".margin")) cell.setAttribute("aria-pressed", String(cell.dataset.check === check.check));
}

function openChecks() {
  const box = byId("verdict").querySelector("details");
  box.open = true;
  box.scrollIntoView({ block: "nearest" });
}

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

/** The box in which the report folds its diagrams below the stack. */
let allDiagrams = null;

function redraw() {
  drawPlots();
  for (const watcher of watchers) watcher.anew();
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
  // Of two cams each has its own line.
  byId("strip").hidden = several || !cams[0].checks.length || !cams[0].views;
  if (!byId("strip").hidden) byId("answer").replaceChildren(...stripOf(cams[0], cams[0].passed, { go: goToCheck, all: openChecks }));
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
  if (usesStack()) watchers.push(stack);
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
      folded = [...document.querySelectorAll("#verdict details:not([open]), #curves details:not([open])")];
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

