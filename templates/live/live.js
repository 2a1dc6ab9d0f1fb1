// Designs as they change: a text and what it is made with, its history, and everything on the page that follows.

/** Steps of a turn while a slider moves, and at rest; tolerance while it moves, m. */
const STEPS = { draft: 180, rest: 360 };
const DRAFT = 50e-6;
/** Time between two texts of figures while a slider moves, ms: nobody reads faster. */
const READING = 120;

/** Most steps back. */
const MOST_PAST = 1000;

/** A design that is open: as it was sent, as it is now, its history and its last cam. */
function opened({ name, usual_names, toml, files, command, commands, rpm, tolerance, file }, index = null) {
  const now = { toml, command, rpm: rpm ?? [] };
  return { name, usualNames: usual_names ?? false, files: files ?? {}, commands, tolerance: tolerance ?? 5e-6, file: file ?? null, index, first: now, now, onDisk: toml, past: [], future: [], sent: { values: {} }, sentCam: null, last: null, lastCam: null, chosen: 0, measured: null, ends: new Map(), handedOut: null };
}
const docs = live.designs.map(opened);
/** The design that is shown. */
let doc = docs[0];
/** Whether a slider or a node is being moved. */
let isDragging = false;

/** A step of the history: a state as it differs from the one that came of it. Of its text only what differs is kept, so that a thousand steps of a long text are small. */
function stepFrom(before, after) {
  const [a, b] = [before.toml, after.toml];
  const most = Math.min(a.length, b.length);
  let head = 0;
  while (head < most && a[head] === b[head]) head += 1;
  let tail = 0;
  while (tail < most - head && a[a.length - 1 - tail] === b[b.length - 1 - tail]) tail += 1;
  // A copy: a browser keeps the whole of a text of which a part is kept.
  return { ...before, toml: structuredClone(a.slice(head, a.length - tail)), head, tail };
}

/** The state of a step, from the one that came of it. */
function stateOf({ head, tail, ...state }, after) {
  return { ...state, toml: after.toml.slice(0, head) + state.toml + after.toml.slice(after.toml.length - tail) };
}

/** Takes another state of a design, with a step of its history. */
function changeTo(one, after) {
  one.past.push(stepFrom(one.now, after));
  if (one.past.length > MOST_PAST) one.past.shift();
  one.future.length = 0;
  one.now = after;
}

/** The text of the box that was applied, until it is written anew. */
let applied = null;

/** Requests in their order, each made when its turn comes; of drafts only the newest is kept. */
const queue = [];
let running = false;
function ask(make, done, isDraft = false) {
  for (let at = queue.length - 1; at >= 0; at -= 1) if (queue[at].isDraft) queue.splice(at, 1);
  queue.push({ make, done, isDraft, since: performance.now() });
  if (!running) pump();
}

/** Does something when the changes before it are made. */
function afterChanges(act) {
  queue.push({ act });
  if (!running) pump();
}

async function pump() {
  running = true;
  while (queue.length) {
    const { act, make: request, done, since } = queue.shift();
    try {
      if (act) await act();
      else done(await engine(request()), since);
    } catch (error) {
      complain([{ message: error.message }]);
      settle();
    }
  }
  running = false;
}

const requestOf = (more, of = doc) => ({ name: of.name, usual_names: of.usualNames, toml: of.now.toml, files: of.files, command: of.now.command, rpm: of.now.rpm, ...more });
const whole = (more) => requestOf({ page: STEPS.rest, tolerance: doc.tolerance, ...more });
const say = (name, values) => {
  const words = text(name, values);
  if (byId("state").textContent === words) return;
  byId("state").textContent = byId("state").title = words;
};

/** The keys of the last change. */
let touched = [];

/** What comes of changes that are not made yet: while a slider moves. */
function draft(changes) {
  touched = changes.flatMap(({ set }) => (set ? [set.key] : []));
  isDragging = true;
  zoneTurn += 1;
  say("draft");
  const of = doc;
  ask(() => requestOf({ changes, page: STEPS.draft, tolerance: Math.max(DRAFT, doc.tolerance) }), (answer) => of === doc && inFrame(answer), true);
}

/** Figures and verdict are those of the state before, until an answer comes. */
function working() {
  say("working");
  document.body.classList.add("working");
}

/** Makes changes: full tolerance, and a step of the history. */
function commit(changes, more = {}, why = null) {
  touched = changes.flatMap(({ set }) => (set ? [set.key] : []));
  isDragging = false;
  zoneTurn += 1;
  working();
  const of = doc;
  ask(() => (of === doc ? whole({ changes, ...more }) : { task: "text" }), (answer, since) => {
    if (of !== doc) return settle();
    const after = { ...doc.now, ...more, toml: answer.toml ?? doc.now.toml };
    if (JSON.stringify(after) !== JSON.stringify(doc.now)) changeTo(doc, after);
    proved(answer, since, why);
  });
}

/** Goes back or forth in the history. */
function travel(from, to) {
  working();
  ask(() => {
    if (doc[from].length) {
      const other = stateOf(doc[from].pop(), doc.now);
      doc[to].push(stepFrom(doc.now, other));
      doc.now = other;
    }
    return whole({});
  }, proved);
}

/** Shows another design of those that are open, or the same one anew. */
function turnTo(other) {
  doc = other;
  formOf = "";
  isDragging = false;
  byId("command").replaceChildren(...doc.commands.map((command) => make("option", { value: command }, command)));
  tabs();
  working();
  ask(() => whole({}), (answer, since) => {
    if (doc === other && !doc.sentCam && answer.cam?.views) asSent(answer);
    if (doc === other) proved(answer, since);
    else settle();
  });
}

/** What is wrong, with what would be right; the cam stays as it was, in grey. */
let complaint = "[]";
function complain(faults) {
  told(faults, faults.length > 0);
}

/** What is wrong with something else than the cam, which is still the present one: with a file that was to be written. */
function refuse(faults) {
  told(faults, byId("shown").classList.contains("stale"));
}

function told(faults, isStale) {
  const said = JSON.stringify([faults, language, isStale]);
  if (said === complaint) return;
  complaint = said;
  // The key stands before a message that does not begin with it.
  const named = (key, message) => key && !message.startsWith(`\`${key}\``);
  const line = ({ key, message, help, line: at }) => make("p", { title: [message, help].filter(Boolean).join("\n") }, named(key, message) ? make("strong", {}, `${key}: `) : null, make("strong", {}, message), at ? ` (${text("line", { line: at })})` : null, help ? make("span", { className: "muted" }, ` ${help}`) : null);
  const back = make("button", { type: "button", className: "back control" }, text("undo"));
  back.addEventListener("click", () => travel("past", "future"));
  const ways = make("span", { className: "ways" }, ...remedyButtons(faults.flatMap(({ remedies }) => remedies ?? []).slice(0, 2)), isStale && doc.past.length ? back : null);
  byId("faults").replaceChildren(make("span", { className: "sign", "aria-hidden": "true" }, "✕"), make("div", { className: "said" }, ...faults.map(line), isStale && cams[0].views ? make("p", { className: "muted" }, text("lastGood")) : ""), ways);
  byId("faults").hidden = !faults.length;
  byId("strip").classList.toggle("refused", faults.length > 0);
  byId("shown").classList.toggle("stale", isStale);
  for (const { box } of fields.values()) box.classList.remove("wrong");
  // What names no key came of the last change.
  for (const key of faults.flatMap((fault) => (fault.key ? [fault.key] : isStale ? touched : []))) fields.get(key)?.box.classList.add("wrong");
  if (faults.length && isStale) stripRefused();
  else stripAnew(doc.last);
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

// ---- the answer first

/** The margin whose place is shown. */
let chosenMargin = null;
let stripSaid = "";

/** The verdict and the tightest margins of the cam that is shown; of two discs also of the other one. */
function stripAnew(answer) {
  if (!answer) return;
  const others = (answer.others ?? []).filter(({ passed }) => !passed).map((one) => ({ ...one, checks: checksInUnits(one.checks) }));
  const checks = [...cams[0].checks, ...others.flatMap(({ name, checks: all }) => all.map((check) => ({ ...check, disc: name })))];
  const said = JSON.stringify([checks.map(({ check, value, limit, verdict: of, place }) => [check, value, limit, of, place]), answer.passed, answer.remedies, language, chosenMargin]);
  if (said === stripSaid) return;
  stripSaid = said;
  const focused = byId("answer").contains(document.activeElement) ? document.activeElement.dataset.check : null;
  const remedies = (check) => remedyButtons((check.disc ? others.find(({ name }) => name === check.disc).remedies : answer.remedies ?? {})?.[check.check] ?? []);
  byId("answer").replaceChildren(...stripOf({ checks }, answer.passed ?? cams[0].passed, { go: markCheck, all: () => openMore("verdict"), remedies }));
  // One stop for the keyboard: the arrow keys go from margin to margin.
  const stops = [...byId("answer").querySelectorAll(".margin, .more")];
  stops.forEach((stop, index) => {
    stop.tabIndex = index ? -1 : 0;
    if (stop.dataset.check) stop.setAttribute("aria-pressed", String(stop.dataset.check === chosenMargin));
  });
  if (focused) byId("answer").querySelector(`[data-check="${focused}"]`)?.focus();
}

/** No cam exists: the last one is shown, and nothing about it is said. */
function stripRefused() {
  stripSaid = "";
  byId("answer").replaceChildren(make("div", { className: "summary" }, make("b", { className: "stamp fail" }, `✕ ${text("verdictRefused")}`), make("span", { className: "counts" }, make("strong", {}, ""), make("small", {}, text("lastProved")))));
}

/** Goes to the place of a check, which stays marked. */
function markCheck(check) {
  if (placeOfCheck(check, first()) !== null) chosenMargin = check.check;
  goToCheck(check);
  stripAnew(doc.last);
}

/** Shows a section below the bench, with what is folded in it. */
function openMore(id) {
  const area = byId(id);
  for (const box of area.querySelectorAll(":scope > details")) box.open = true;
  area.scrollIntoView({ block: "start" });
}

/** The newest answer to a draft that is not shown yet: it is shown with the next frame. */
let newest = null;
function inFrame(answer) {
  document.documentElement.dataset.answers = Number(document.documentElement.dataset.answers ?? 0) + 1;
  if (!newest) requestAnimationFrame(() => {
    const shownNow = newest;
    newest = null;
    if (shownNow && isDragging) drafted(shownNow);
  });
  newest = answer;
}

/** A draft: the outline in each frame, figures as fast as they can be read. */
let read = 0;
function drafted(answer) {
  if (answer.faults?.length) return refused(answer.faults);
  takeUnits(answer);
  complain(answer.noOutline ? [{ message: answer.noOutline, remedies: Object.values(answer.remedies).flat() }] : []);
  if (!answer.cam.views) return;
  takeCam(answer.cam);
  const reads = performance.now() - read > READING;
  if (reads) read = performance.now();
  movers[0].draw(true);
  plotsAnew(true);
  if (diagram && !diagram.isSeen) diagram.waiting = answer;
  else motionCurves(answer);
  stack.anew();
  if (!reads) return;
  stripAnew(answer);
  verdict(answer);
  for (const one of readouts) one.draw();
}

function refused(faults) {
  document.body.classList.remove("working");
  complain(faults);
  say("refused");
}

/** Everything on the page after an answer at rest: the proof first, and the rest of the page piece by piece. */
function proved(answer, since, why = null) {
  newest = null;
  document.documentElement.dataset.answers = Number(document.documentElement.dataset.answers ?? 0) + 1;
  const written = () => {
    if (answer.toml === undefined) return;
    byId("toml").value = answer.toml;
    applied = null;
  };
  if (answer.faults?.length) {
    refused(answer.faults);
    later([written, ...(doc.last ? [] : [textAlone]), () => downloads({ passed: false }), settle]);
    return;
  }
  const without = answer.noOutline ? [{ message: answer.noOutline, remedies: Object.values(answer.remedies).flat() }] : [];
  complain(without);
  doc.last = answer;
  takeUnits(answer);
  if (answer.cam.views) takeCam(answer.cam);
  else Object.assign(cams[0], { checks: answer.cam.checks, metric: { checks: answer.cam.checks, sections: (cams[0].metric ?? cams[0]).sections }, passed: false });
  for (const cam of new Set([...cams, doc.sentCam].filter(Boolean))) figuresInUnits(cam);
  chosenMargin = null;
  stripAnew(answer);
  verdict(answer);
  document.body.classList.remove("working");
  byId("title").textContent = cams[0].title;
  movers[0].draw(true);
  const ms = Math.round(performance.now() - since);
  if (without.length) say("refused");
  else if (why) say(why);
  else say(answer.passed ? "proved" : "failed", { ms });
  // When it can be seen: after the next frame.
  requestAnimationFrame(() => setTimeout(() => (document.documentElement.dataset.proof = Math.round(performance.now() - since)), 0));
  later([written, () => form(answer), movers[0].rest, stack.anew, paintChoices, () => plotsAnew(false), show, () => motionEditor(answer), solidAnew, tables, differences, () => sheetAnew(), () => downloads(answer), titles, settle, zonesAnew]);
}

/** Of a design that never was a cam only its text can be changed: the fields are those of another one. */
function textAlone() {
  fields = new Map();
  formOf = "";
  byId("fields").replaceChildren();
  byId("motion").hidden = byId("to-motion").hidden = byId("compare").hidden = byId("sheet").hidden = true;
  byId("chosen").replaceChildren();
  diagram = null;
  byId("file").open = true;
  byId("title").textContent = doc.name;
  for (const button of byId("formats").children) button.disabled = true;
  tabs();
}

/** Pieces of work one after the other, with the browser between them; those of an older answer end where a newer one comes. */
let works = [];
let turn = 0;
function later(pieces) {
  turn += 1;
  works = pieces;
  const own = turn;
  requestAnimationFrame(() => channel.port2.postMessage(own));
}
/** A message comes sooner than a timer. */
const channel = new MessageChannel();
channel.port1.onmessage = ({ data }) => {
  if (data !== turn) return;
  works.shift()();
  if (works.length) channel.port2.postMessage(data);
};

function titles() {
  doc.lastCam = cams[0].views ? structuredClone(cams[0]) : null;
  byId("title").textContent = cams[0].title;
  document.title = cams[0].title;
  tabs();
}

/** Buttons and texts that follow the history. */
function settle() {
  byId("command-label").hidden = doc.commands.length < 2;
  byId("rpm-label").hidden = Boolean(doc.last?.given?.includes("motion.rpm")) || Boolean(doc.last?.given?.includes("motion.stroke"));
  byId("undo").disabled = !doc.past.length;
  byId("redo").disabled = !doc.future.length;
  byId("command").value = doc.last?.command ?? doc.now.command;
  const speeds = [...new Set((cams[0].views ?? []).map(({ rpm }) => rpm).filter((rpm) => rpm !== null))];
  const ofFile = doc.last?.values?.["motion.rpm"];
  byId("rpm").value = (doc.now.rpm.length ? doc.now.rpm : ofFile ? [ofFile] : speeds.length ? speeds : [cams[0].speeds.match(/[\d.]+/)?.[0] ?? ""]).join(", ");
  document.documentElement.dataset.settled = Number(document.documentElement.dataset.settled ?? 0) + 1;
}

/** Another cam in the place of the one that is shown. */
function takeCam(cam) {
  const shownCam = cams[0];
  for (const view of cam.views) view.columns = closed(view);
  figuresInUnits(cam);
  for (const name of Object.keys(shownCam)) delete shownCam[name];
  Object.assign(shownCam, cam);
  state.section = Math.min(state.section, cam.views.length - 1);
  cam.views.forEach(withGhost);
  const length = String(cycleOf(first()));
  if (byId("scrub").max !== length) byId("scrub").max = length;
  state.cycle = Math.min(state.cycle, cycleOf(first()));
}

/** Sections and the solid of the cam that is shown. */
function solidAnew() {
  const { views, solid } = cams[0];
  const names = views.map((view) => view.name ?? "");
  byId("section").replaceChildren(...names.map((name, index) => make("option", { value: String(index) }, name)));
  byId("section").value = String(state.section);
  byId("section-choice").hidden = views.length < 2;
  for (const one of solids.splice(0)) one.figure.remove();
  if (solid && cams.length === 1) {
    solids.push(solidView(cams[0], 0));
    byId("solid").append(solids[0].figure);
  }
  byId("solid").hidden = !solids.length;
}

/** The checks, each with what would let it pass; where only figures differ, only these are written. */
let verdictOf = "";
function verdict(answer) {
  const judged = JSON.stringify([cams.map(({ title, passed, checks }) => [cams.length > 1 ? title : "", passed, checks.map(({ check, verdict: of, place }) => [check, of, Boolean(place)])]), answer.passed, answer.remedies, answer.others, language]);
  if (judged === verdictOf && cams.length === 1) {
    const rows = byId("verdict").querySelectorAll("tbody tr:not(.other tr)");
    const checks = [true, false].flatMap((wanted) => cams[0].checks.filter((check) => isBad(check) === wanted));
    checks.forEach((check, index) => {
      const [, , value, limit, place, note] = rows[index].children;
      const write = (cell, words) => {
        // Behind the text of a note are its buttons.
        if (cell.firstChild && cell.firstChild.data !== words) cell.firstChild.data = words;
      };
      write(value, valueOfCheck(check));
      write(limit, limitOf(check));
      write(place, check.place || "");
      write(note, check.note || "");
    });
    return;
  }
  verdictOf = judged;
  const wasOpen = byId("verdict").querySelector("details")?.open;
  byId("verdict").replaceChildren(verdicts());
  if (wasOpen) byId("verdict").querySelector("details").open = true;
  withRemedies(byId("verdict"), answer.remedies);
  otherVerdicts(answer.others ?? []);
}

/** Buttons in the notes of checks that know what would let them pass. */
function withRemedies(area, remedies = {}) {
  for (const row of area.querySelectorAll("tbody tr")) {
    const name = row.firstElementChild.textContent.replace(/ /g, "_");
    row.querySelector(".note")?.append(...remedyButtons(remedies[name] ?? []).flatMap((button) => [make("br"), button]));
  }
}

/** The checks that are shown are those of the first of two discs on one shaft; below them those that the other one fails, with its name. */
function otherVerdicts(others) {
  for (const { name, passed, checks: metric, remedies } of others) {
    if (passed) continue;
    const checks = checksInUnits(metric);
    const broken = text("otherFails", { name, checks: checks.map(({ check }) => words(check)).join(", ") });
    const banner = byId("verdict").querySelector(".banner");
    banner.firstElementChild.replaceWith(badge("fail"));
    banner.append(make("strong", { className: "broken", role: "alert" }, broken));
    const box = make("div", { className: "other", "data-disc": name }, make("h3", {}, text("otherChecks", { name })), checksOf(checks));
    withRemedies(box, remedies);
    const all = byId("verdict").querySelector("details");
    all.firstElementChild.after(box);
    all.open = true;
  }
}

/** The diagrams with other values: those on the screen now, while a slider moves one in each frame, the others when they are seen. */
let nextPlot = 0;
function plotsAnew(isDraft) {
  const panels = panelsOf();
  const fits = plots.length === panels.length && plots.every((one) => one.update);
  if (!fits) return drawPlots();
  const onScreen = plots.filter(({ isSeen }) => isSeen);
  nextPlot = (nextPlot + 1) % Math.max(1, onScreen.length);
  for (const [index, one] of plots.entries()) {
    if (!one.isSeen) one.waiting = panels[index];
    else if (isDraft && one !== onScreen[nextPlot]) continue;
    else if (one.update(panels[index])) one.draw();
    else return drawPlots();
  }
}

/** The sheet is made when it is looked at. */
let picture = null;
let sheetOf = null;
function sheetAnew() {
  byId("sheet").hidden = !doc.last?.passed;
  const wanted = JSON.stringify([doc.name, doc.now]);
  if (byId("sheet").hidden || !byId("sheet-box").open || sheetOf === wanted) return;
  ask(() => requestOf({ tolerance: doc.tolerance, formats: ["svg"] }), (answer) => {
    const file = (answer.files ?? []).find(({ name }) => name.endsWith(".svg"));
    if (picture) URL.revokeObjectURL(picture);
    picture = file ? URL.createObjectURL(new Blob([file.bytes], { type: "image/svg+xml" })) : null;
    sheetOf = wanted;
    if (picture) byId("sheet-picture").src = picture;
    else byId("sheet-picture").removeAttribute("src");
  });
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

/** Files with their pictures; the program that serves the page also makes PDF. */
const FILES = {
  ...(live.token ? { pdf: "M8 6H40V42H8ZM13 11H27V24H13ZM13 29H35M13 33H35M30 11H35M30 16H35" } : {}),
  svg: "M8 6H40V42H8ZM13 12a7 7 0 1 0 14 0a7 7 0 1 0-14 0M13 30H35M13 35H35M30 12H35",
  dxf: "M24 5C34 5 40 12 39 22C38 34 32 42 22 42C13 42 8 35 8 26C8 15 14 5 24 5ZM24 22a4 4 0 1 0 .01 0",
  step: "M20 8C28 8 34 14 33 22C32 33 28 40 20 40C12 40 8 34 8 26C8 16 12 8 20 8ZM27 4C36 4 41 10 40 19C39 28 35 35 28 37M20 8L27 4M20 24a3 3 0 1 0 .01 0",
  csv: "M8 8H40V40H8ZM8 16H40M8 24H40M8 32H40M19 8V40M29 8V40",
  json: "M17 6C11 6 14 22 8 24C14 26 11 42 17 42M31 6C37 6 34 22 40 24C34 26 37 42 31 42M22 24h.01M27 24h.01",
};
const FORMATS = Object.keys(FILES);
/** The files of a format. */
function takeFiles(format, take) {
  ask(() => requestOf({ tolerance: doc.tolerance, formats: [format] }), (made) => {
    if (made.faults) return refuse(made.faults);
    doc.handedOut = doc.now.toml;
    take(made.files.filter(({ name }) => name.endsWith(`.${format}`)));
  });
}

/** Names of files, each of which is taken by a click. */
function fileNames(named) {
  byId("files-list").replaceChildren(...named.map(([name, take]) => {
    const one = make("button", { type: "button", "data-file": name }, name);
    one.addEventListener("click", take);
    return one;
  }));
}
function downloads({ passed }) {
  if (byId("formats").dataset.language !== language) {
    byId("formats").dataset.language = language;
    byId("formats").replaceChildren(...FORMATS.map((format) => {
      const picture = makeSvg("svg", { viewBox: "4 2 40 44", "aria-hidden": "true" });
      picture.append(makeSvg("path", { d: FILES[format] }));
      const button = make("button", { type: "button", "data-format": format }, picture, make("span", {}, make("b", {}, text(`file_${format}`)), make("small", {}, format.toUpperCase())));
      button.addEventListener("click", () => takeFiles(format, (files) => {
        if (files.length === 1) save(files[0].name, files[0].bytes);
        // Of several a browser lets a page hand out one at a click.
        else fileNames(files.map((file) => [file.name, () => save(file.name, file.bytes)]));
      }));
      return button;
    }));
  }
  for (const button of byId("formats").children) button.disabled = !passed;
  byId("files-list").replaceChildren();
  byId("files-note").textContent = text(passed ? "provenNote" : "onlyProven");
}

/** Takes an answer as that of the design as sent. */
function asSent(answer) {
  doc.sent = answer;
  doc.sentCam = structuredClone(answer.cam);
  for (const view of doc.sentCam.views) view.columns = closed(view);
}

document.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || ["INPUT", "TEXTAREA"].includes(event.target.tagName) && event.target.type !== "range") return;
  const key = event.key.toLowerCase();
  if (key === "z" && !event.shiftKey) travel("past", "future");
  else if (key === "y" || key === "z") travel("future", "past");
  else return;
  event.preventDefault();
});

/** Buttons that are one stop for the keyboard: the arrow keys go from one to the next. */
function roving(id, selector) {
  byId(id).addEventListener("keydown", (event) => {
    const stops = [...byId(id).querySelectorAll(selector)];
    const next = stops[stops.indexOf(event.target) + ({ ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key] ?? NaN)];
    if (!next) return;
    event.preventDefault();
    event.stopPropagation();
    for (const stop of stops) stop.tabIndex = stop === next ? 0 : -1;
    next.focus();
  });
}

/** What the buttons and fields of the page do. */
function listen() {
  const on = (id, event, act) => byId(id).addEventListener(event, act);
  on("undo", "click", () => travel("past", "future"));
  on("redo", "click", () => travel("future", "past"));
  on("find", "input", search);
  on("lengths", "click", ({ target }) => target.dataset.lengths && chooseUnits(target.dataset.lengths));
  // What is typed into a field is not a key for the animation.
  on("main", "keydown", (event) => {
    if (event.target.matches("input[type=text], input[type=search], textarea, select")) event.stopPropagation();
  });
  const apply = () => {
    const toml = byId("toml").value;
    if (toml === applied) return;
    applied = toml;
    commit([], { toml });
  };
  on("apply", "click", apply);
  // A text that is left without Apply would be lost with the next change.
  on("toml", "change", apply);
  on("copy", "click", async () => {
    byId("toml").select();
    try {
      await navigator.clipboard.writeText(byId("toml").value);
    } catch {
      document.execCommand("copy");
    }
    say("copied");
  });
  on("save-toml", "click", () => {
    doc.handedOut = doc.now.toml;
    save(`${doc.name}.toml`, byId("toml").value, "application/toml");
  });
  on("to-motion", "click", () => openMore("motion"));
  on("to-text", "click", () => openMore("text"));
  on("to-more", "click", () => byId("more").scrollIntoView());
  on("zoom", "click", ({ target }) => target.dataset.zoom && movers[0].zoomBy(Number(target.dataset.zoom)));
  roving("answer", ".margin, .more");
  roving("zoom", "button");
  // A change that was neither downloaded nor written would be lost.
  window.addEventListener("beforeunload", (event) => {
    if (docs.some((one) => one.now.toml !== one.onDisk && one.now.toml !== one.handedOut)) event.preventDefault();
  });
  on("reset", "click", () => commit([], doc.first));
  on("rpm", "change", () => {
    const speeds = byId("rpm").value.split(/[,;\s]+/).map(Number).filter((rpm) => rpm > 0);
    // The speed of a motion program is a key of its file; that of a cam of a press is what the cam is cut for, --rpm on the command line.
    if (doc.last?.given.includes("motion.rpm") && speeds.length === 1) commit([{ set: { key: "motion.rpm", to: String(speeds[0]) } }], { rpm: [] });
    else commit([], { rpm: speeds });
  });
  on("command", "change", () => commit([], { command: byId("command").value }));
  on("sheet-box", "toggle", sheetAnew);
  on("look", "click", () => {
    byId("theme").click();
    themed();
  });
  on("language", "change", () => {
    language = byId("language").value;
    formOf = "";
    verdictOf = "";
    complaint = "";
    stripSaid = "";
    speak();
    if (!byId("gallery").hidden) gallery();
    if (doc.last) turnTo(doc);
  });
}

/** The bench takes what the window has below the head and the strip. */
function measureTop() {
  const top = byId("strip").getBoundingClientRect().bottom + window.scrollY + 10;
  document.documentElement.style.setProperty("--top", `${Math.round(top)}px`);
}

/** What a cam is found to be, without the samples of its curves. */
const findingsOf = ({ passed, checks, sections, notes, notModelled }) => JSON.stringify([passed, checks, sections, notes, notModelled]);

async function startLive() {
  say("starting");
  listen();
  speak();
  // Designers think in rates per second; those of the shaft's angle are a choice.
  if (!byId("unit-choice").hidden) byId("unit").value = state.rate = "time";
  measureTop();
  window.addEventListener("resize", measureTop);
  keyTable = mergedKeys((await engine({ task: "keys" })).keys);
  startDesigns();
  byId("command").append(...doc.commands.map((command) => make("option", { value: command }, command)));
  const own = doc;
  ask(() => whole({}), (answer, since) => {
    if (own === doc && own.now === own.first && answer.cam?.views) {
      // The program wrote the page with its own results; an engine of other sources finds others.
      byId("older").hidden = live.token !== null || findingsOf(answer.cam) === findingsOf(cams[0]);
      measureTop();
      asSent(answer);
    }
    proved(answer, since);
    works.push(() => (document.documentElement.dataset.live = ""));
  });
}
