// The design as it changes: a text and what it is made with, its history, and everything on the page that follows.

/** Steps of a turn while a slider moves, and at rest; tolerance while it moves, m. */
const STEPS = { draft: 180, rest: 720 };
const DRAFT = 50e-6;

/** The design as it was sent, and as it is now. */
let sent = { values: {} };
let now = { toml: live.toml, command: live.command, rpm: live.rpm };
let last = null;
let sentCam = structuredClone(cams[0]);
const past = [];
const future = [];

/** Requests in their order, each made when its turn comes; of drafts only the newest is kept. */
const queue = [];
let running = false;
function ask(make, done, isDraft = false) {
  for (let at = queue.length - 1; at >= 0; at -= 1) if (queue[at].isDraft) queue.splice(at, 1);
  queue.push({ make, done, isDraft });
  if (!running) pump();
}

async function pump() {
  running = true;
  while (queue.length) {
    const { make: request, done } = queue.shift();
    try {
      const asked = request();
      const started = performance.now();
      const answer = await engine(asked);
      done(answer, performance.now() - started);
    } catch (error) {
      complain([{ message: error.message }]);
      settle();
    }
  }
  running = false;
}

const requestOf = (more) => ({ name: live.name, toml: now.toml, command: now.command, rpm: now.rpm, ...more });
const whole = (more) => requestOf({ page: STEPS.rest, tolerance: live.tolerance, formats: ["svg"], ...more });

/** What comes of changes that are not made yet: while a slider moves. */
function draft(changes) {
  byId("state").textContent = text("draft");
  ask(() => requestOf({ changes, page: STEPS.draft, tolerance: Math.max(DRAFT, live.tolerance) }), (answer) => show_(answer, true), true);
}

/** Makes changes: full tolerance, and a step of the history. */
function commit(changes, more = {}, why = null) {
  byId("state").textContent = text("working");
  ask(() => whole({ changes, ...more }), (answer, ms) => {
    const after = { ...now, ...more, toml: answer.toml ?? now.toml };
    if (JSON.stringify(after) !== JSON.stringify(now)) {
      past.push(now);
      future.length = 0;
    }
    now = after;
    show_(answer, false, ms);
    if (why) byId("state").textContent = text(why);
  });
}

/** Goes back or forth in the history. */
function travel(from, to) {
  byId("state").textContent = text("working");
  ask(() => {
    if (from.length) {
      to.push(now);
      now = from.pop();
    }
    return whole({});
  }, (answer, ms) => show_(answer, false, ms));
}

/** What is wrong, with what would be right; the cam stays as it was, in grey. */
function complain(faults) {
  const line = ({ key, message, help, remedies, line: at }) => make("p", {}, key ? make("strong", {}, `${key}: `) : null, message, at ? ` (${text("line", { line: at })})` : null, help ? make("span", { className: "muted" }, ` ${help}`) : null, ...remedyButtons(remedies ?? []));
  byId("faults").replaceChildren(...faults.map(line), faults.length ? make("p", { className: "muted" }, text("lastGood")) : "");
  byId("faults").hidden = !faults.length;
  byId("shown").classList.toggle("stale", faults.length > 0);
  for (const { key } of faults) fields.get(key)?.box.classList.add("wrong");
  if (faults.length) byId("state").textContent = text("refused");
}

/** Buttons that make the changes with which something would pass. */
function remedyButtons(remedies) {
  const words = (changes) => changes.map(({ set }) => `${set.key} = ${set.to}`).join(", ");
  return remedies.map((changes) => {
    const button = make("button", { type: "button", className: "remedy control" }, `${text("try")}: ${words(changes)}`);
    button.addEventListener("click", () => commit(changes));
    return button;
  });
}

/** Everything on the page after an answer. */
function show_(answer, isDraft, ms) {
  document.documentElement.dataset.answers = Number(document.documentElement.dataset.answers ?? 0) + 1;
  if (!isDraft && answer.toml !== undefined) byId("toml").value = answer.toml;
  if (answer.faults?.length) {
    complain(answer.faults);
    if (!isDraft) settle();
    return;
  }
  const without = answer.noOutline ? [{ message: answer.noOutline, remedies: Object.values(answer.remedies).flat() }] : [];
  complain(without);
  last = answer;
  if (answer.cam.views) takeCam(answer.cam, isDraft);
  else Object.assign(cams[0], { checks: answer.cam.checks, passed: false });
  verdict(answer);
  if (isDraft) {
    showPlots(true);
    show();
    return;
  }
  form(answer);
  motionEditor(answer);
  tables();
  showPlots(false);
  show();
  differences();
  sheet(answer);
  downloads(answer);
  byId("title").textContent = cams[0].title;
  document.title = cams[0].title;
  if (ms !== undefined && !without.length) byId("state").textContent = text(answer.passed ? "proved" : "failed", { ms: Math.round(ms) });
  document.documentElement.dataset.proof = Math.round(ms ?? 0);
  settle();
}

/** Buttons and texts that follow the history. */
function settle() {
  byId("undo").disabled = !past.length;
  byId("redo").disabled = !future.length;
  byId("command").value = last?.command ?? now.command;
  byId("rpm").value = now.rpm.length ? now.rpm.join(", ") : cams[0].speeds.replace(/[^\d., ]/g, "").trim();
  translated(byId("main"));
  document.documentElement.dataset.settled = Number(document.documentElement.dataset.settled ?? 0) + 1;
}

/** The outline of the design as sent, in the picture of the present one. */
function withGhost(view) {
  const before = sentCam.views[Math.min(sentCam.views.length - 1, state.section)];
  const part = before?.parts.find((one) => one.role === "cam");
  const own = view.parts.find((one) => one.role === "cam");
  if (!part || !own || part.path === own.path || before.turn.at(-1) !== view.turn.at(-1)) return;
  const at = (track) => (Array.isArray(track) ? view.turn.map((turn) => between(track, locate(before.turn, turn))) : track);
  const ghost = { ...part, role: "sent", name: null, x: at(part.x), y: at(part.y), turn: at(part.turn), stretch: at(part.stretch) };
  view.parts.splice(view.parts.indexOf(own) + 1, 0, ghost);
}

/** Another cam in the place of the one that is shown. */
function takeCam(cam, isDraft) {
  const shown = cams[0];
  for (const view of cam.views) view.columns = closed(view);
  for (const name of Object.keys(shown)) delete shown[name];
  Object.assign(shown, cam);
  state.section = Math.min(state.section, cam.views.length - 1);
  cam.views.forEach(withGhost);
  byId("scrub").max = cycleOf(first());
  state.cycle = Math.min(state.cycle, cycleOf(first()));
  if (isDraft) return;
  const names = cam.views.map((view) => view.name ?? "");
  byId("section").replaceChildren(...names.map((name, index) => make("option", { value: String(index) }, name)));
  byId("section").value = String(state.section);
  byId("section-choice").hidden = cam.views.length < 2;
  for (const solid of solids.splice(0)) solid.figure.remove();
  if (cam.solid) {
    solids.push(solidView(shown, 0));
    byId("solid").append(solids[0].figure);
  }
  byId("solid").hidden = !cam.solid;
}

/** The checks, each with what would let it pass. */
function verdict(answer) {
  const wasOpen = byId("verdict").querySelector("details")?.open;
  byId("verdict").replaceChildren(verdicts());
  if (wasOpen) byId("verdict").querySelector("details").open = true;
  for (const row of byId("verdict").querySelectorAll("tbody tr")) {
    const name = row.firstElementChild.textContent.replace(/ /g, "_");
    const buttons = remedyButtons(answer.remedies?.[name] ?? []);
    row.querySelector(".note")?.append(...buttons.flatMap((button) => [make("br"), button]));
  }
}

/** The diagrams: while a slider moves only those that can be seen, and ten times a second. */
let drawn = 0;
function showPlots(isDraft) {
  if (isDraft && performance.now() - drawn < 100) return;
  drawn = performance.now();
  if (!isDraft || plots.length !== panelsOf().length) {
    drawPlots();
    return;
  }
  panelsOf().forEach((panel, index) => {
    const { box, plot } = plots[index];
    const { top, bottom } = box.getBoundingClientRect();
    if (bottom < 0 || top > window.innerHeight) return;
    const made = plotOf(panel, plot.width, plot.height);
    plot.destroy();
    box.replaceWith(made.box);
    plots[index] = made;
  });
}

/** What differs from the design as sent: figures and checks. */
function differences() {
  const both = [sentCam, cams[0]];
  const table_ = sectionsBeside(both);
  for (const row of table_.querySelectorAll("tbody tr:not(.differs)")) row.remove();
  for (const box of table_.querySelectorAll(".columns > div")) if (!box.querySelector("tbody tr")) box.remove();
  const any = table_.querySelector("tbody tr");
  byId("differences").replaceChildren(any ? table_ : make("p", {}, text("same")));
  byId("compare").hidden = !past.length && !any;
}

let picture = null;
function sheet(answer) {
  const file = answer.files.find(({ name }) => name.endsWith(".svg"));
  byId("sheet").hidden = !file;
  if (picture) URL.revokeObjectURL(picture);
  picture = file ? URL.createObjectURL(new Blob([file.bytes], { type: "image/svg+xml" })) : null;
  if (picture) byId("sheet-picture").src = picture;
  else byId("sheet-picture").removeAttribute("src");
}

/** Hands bytes to the person as a file. */
function save(name, bytes, type = "application/octet-stream") {
  const address = URL.createObjectURL(new Blob([bytes], { type }));
  const link = make("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

const FORMATS = ["dxf", "svg", "step", "csv", "json"];
function downloads(answer) {
  byId("formats").replaceChildren(...FORMATS.map((format) => {
    const button = make("button", { type: "button", disabled: !answer.passed, "data-format": format }, format.toUpperCase());
    button.addEventListener("click", () => ask(() => requestOf({ tolerance: live.tolerance, formats: [format] }), (made) => {
      if (made.faults) complain(made.faults);
      if (made.files.length === 1) save(made.files[0].name, made.files[0].bytes);
      // Of several a browser lets a page hand out one at a click.
      else byId("files-list").replaceChildren(...made.files.map((file) => {
        const one = make("button", { type: "button", "data-file": file.name }, file.name);
        one.addEventListener("click", () => save(file.name, file.bytes));
        return one;
      }));
    }));
    return button;
  }));
  byId("files-list").replaceChildren();
  byId("files-note").textContent = text(answer.passed ? "provenNote" : "onlyProven");
}

/** Another design in the place of all: its history begins with it. */
function openDesign(design) {
  live.name = design.name;
  byId("command").replaceChildren(...design.commands.map((command) => make("option", { value: command }, command)));
  now = { toml: design.toml, command: design.command, rpm: design.rpm ?? [] };
  past.length = 0;
  future.length = 0;
  formOf = "";
  sent = { values: {} };
  sentCam = { ...cams[0], views: [], sections: [] };
  ask(() => whole({}), (answer, ms) => {
    if (answer.cam?.views) asSent(answer);
    show_(answer, false, ms);
  });
}

/** Takes an answer as that of the design as sent. */
function asSent(answer) {
  sent = answer;
  sentCam = structuredClone(answer.cam);
  for (const view of sentCam.views) view.columns = closed(view);
}

document.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || ["INPUT", "TEXTAREA"].includes(event.target.tagName) && event.target.type !== "range") return;
  const key = event.key.toLowerCase();
  if (key === "z" && !event.shiftKey) travel(past, future);
  else if (key === "y" || key === "z") travel(future, past);
  else return;
  event.preventDefault();
});

async function startLive() {
  byId("state").textContent = text("starting");
  speak();
  byId("undo").addEventListener("click", () => travel(past, future));
  byId("redo").addEventListener("click", () => travel(future, past));
  byId("find").addEventListener("input", search);
  // What is typed into a field is not a key for the animation.
  byId("main").addEventListener("keydown", (event) => {
    if (event.target.matches("input[type=text], input[type=search], textarea, select")) event.stopPropagation();
  });
  byId("apply").addEventListener("click", () => commit([], { toml: byId("toml").value }));
  byId("copy").addEventListener("click", async () => {
    byId("toml").select();
    try {
      await navigator.clipboard.writeText(byId("toml").value);
    } catch {
      document.execCommand("copy");
    }
    byId("state").textContent = text("copied");
  });
  byId("save-toml").addEventListener("click", () => save(`${live.name}.toml`, byId("toml").value, "application/toml"));
  byId("reset").addEventListener("click", () => commit([], { toml: live.toml, command: live.command, rpm: live.rpm }));
  byId("rpm").addEventListener("change", () => {
    const speeds = byId("rpm").value.split(/[,;\s]+/).map(Number).filter((rpm) => rpm > 0);
    // The speed of a motion program is a key of its file; that of a cam of a press is what the cam is cut for, --rpm on the command line.
    if (last?.given.includes("motion.rpm") && speeds.length === 1) commit([{ set: { key: "motion.rpm", to: String(speeds[0]) } }], { rpm: [] });
    else commit([], { rpm: speeds });
  });
  byId("command").append(...live.commands.map((command) => make("option", { value: command }, command)));
  byId("command").addEventListener("change", () => commit([], { command: byId("command").value }));
  byId("language").addEventListener("change", () => {
    language = byId("language").value;
    formOf = "";
    speak();
    if (last) show_(last, false);
  });
  const given = { ...now };
  keyTable = mergedKeys((await engine({ task: "keys" })).keys);
  ask(() => whole({}), (answer, ms) => {
    if (JSON.stringify(given) === JSON.stringify(now) && answer.cam?.views) asSent(answer);
    show_(answer, false, ms);
    document.documentElement.dataset.live = "";
  });
  startDesigns();
}
