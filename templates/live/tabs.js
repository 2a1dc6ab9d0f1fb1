// Several designs in tabs, and two of them next to each other.

/** The design next to the one that is shown, where there is one. */
let besideOf = null;

/** The tabs, and the choice of the design next to the present one. */
function tabs() {
  const bar = byId("tabs");
  bar.hidden = docs.length < 2;
  byId("beside-label").hidden = docs.length < 2;
  if (besideOf && !docs.includes(besideOf)) besideOf = null;
  const focused = bar.contains(document.activeElement);
  bar.replaceChildren(...docs.map((one) => {
    const isShown = one === doc;
    const differs = one.now.toml !== one.onDisk ? " •" : "";
    const tab = make("button", { type: "button", role: "tab", "aria-selected": String(isShown), tabIndex: isShown ? 0 : -1, "data-tab": one.name }, `${one.name}${differs}`);
    tab.addEventListener("click", () => isShown || goTo(one));
    const close = make("button", { type: "button", className: "close", "aria-label": `${text("close")}: ${one.name}`, tabIndex: isShown ? 0 : -1 }, "×");
    close.addEventListener("click", () => closeTab(one));
    return make("span", { role: "presentation" }, tab, close);
  }));
  if (focused) bar.querySelector("[aria-selected=true]").focus();
  const others = docs.filter((one) => one !== doc);
  byId("beside").replaceChildren(make("option", { value: "" }, "–"), ...others.map((one) => make("option", { value: String(docs.indexOf(one)) }, one.name)));
  byId("beside").value = besideOf && besideOf !== doc ? String(docs.indexOf(besideOf)) : "";
  measureTop();
}

function goTo(one) {
  if (besideOf === one) beside(null);
  else if (besideOf) beside(besideOf);
  turnTo(one);
}

function closeTab(one) {
  if (docs.length < 2) return;
  if (besideOf === one) beside(null);
  docs.splice(docs.indexOf(one), 1);
  if (one === doc) goTo(docs[0]);
  else tabs();
}

/** A design in a new tab, or the one of that name that is open and as it is given. */
function openDesign(design) {
  const same = docs.find((one) => one.first.toml === design.toml && one.first.command === design.command);
  const used = new Set(docs.map(({ name }) => name));
  let name = design.name;
  for (let number = 2; used.has(name); number += 1) name = `${design.name}-${number}`;
  const one = same ?? opened({ ...design, name });
  if (!same) docs.push(one);
  goTo(one);
}

/** Shows the cam of another design next to the present one, as two cams in a report; or none. */
function beside(other) {
  besideOf = other;
  for (const list of [movers, readouts]) for (const one of list.splice(1)) (one.figure ?? one.box).remove();
  cams.splice(1);
  if (other?.lastCam) {
    cams.push(structuredClone(other.lastCam));
    for (const view of cams[1].views) view.parts = view.parts.filter(({ role }) => role !== "sent");
    movers.push({ rest() {}, ...mechanism(cams[1], 1) });
    readouts.push(readout(cams[1], 1));
    byId("mechanisms").append(movers[1].figure);
    byId("readouts").append(readouts[1].box);
  }
  byId("mechanisms").className = cams.length > 1 ? "two" : "";
  verdictOf = "";
  // A cam that was shown with the grey outline of the design as sent, or without.
  for (const view of cams[0].views) view.parts = view.parts.filter(({ role }) => role !== "sent");
  cams[0].views.forEach(withGhost);
}

function listenToTabs() {
  byId("beside").addEventListener("change", () => {
    const chosen = byId("beside").value;
    const other = chosen === "" ? null : docs[Number(chosen)];
    const show = () => {
      beside(other);
      turnTo(doc);
    };
    if (!other || other.lastCam) return show();
    // A design of a tab that was not shown yet is made first.
    ask(() => requestOf({ page: STEPS.rest, tolerance: other.tolerance }, other), (answer) => {
      if (!answer.cam?.views) return complain(answer.faults ?? [{ message: text("refused") }]);
      for (const view of answer.cam.views) view.columns = closed(view);
      other.lastCam = answer.cam;
      show();
    });
  });
  byId("tabs").addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    goTo(docs[(docs.indexOf(doc) + step + docs.length) % docs.length]);
  });
}
