// Laws of motion as pictures, each with its largest velocity, acceleration and jerk for the chosen segment.

/** Lift, velocity and acceleration of a law, each scaled to the height of the picture. */
function lawPicture({ shapes }) {
  const svg = makeSvg("svg", { viewBox: "-1 -1 62 42", "aria-hidden": "true" });
  svg.append(makeSvg("path", { class: "grid", d: "M0 20H60" }));
  shapes.forEach((values, order) => {
    const most = Math.max(...values.map(Math.abs)) || 1;
    const yOf = order < 2 ? (value) => 40 - (40 * value) / most : (value) => 20 - (20 * value) / most;
    const path = values.map((value, at) => `${at ? "L" : "M"}${((60 * at) / (values.length - 1)).toFixed(1)} ${yOf(value).toFixed(1)}`).join("");
    svg.append(makeSvg("path", { class: ["lift", "velocity", "acceleration"][order], d: path }));
  });
  return svg;
}

/** The largest rates of a law over a segment from rest to rest, as texts: in mm or degrees per second, metres where they are long. */
function lawPeaks({ peaks }, segment, units, rpm) {
  const travel = Math.abs(segment.position[1] - segment.position[0]);
  const width = segment.at[1] - segment.at[0];
  const isLength = units[1] === "mm";
  // A plate has no speed of its own: its rates are those along its travel.
  const inTime = units[0] === "deg" && rpm > 0;
  const rate = inTime ? (6 * rpm) / width : 1 / width;
  return peaks.map((peak, order) => {
    if (peak === null) return "∞";
    const value = peak * travel * rate ** (order + 1);
    const power = ["", "²", "³"][order];
    const [size, unit] = !inTime ? [value, `${units[1]}/${units[0]}${power}`] : isLength && order > 0 ? [value / 1000, `m/s${power}`] : [value, `${isLength ? "mm" : "°"}/s${power}`];
    const [factor, name] = inLengths(unit);
    return `${shown(size * factor, 3)} ${name}`;
  });
}

/** The laws that the chosen segment may have. */
function lawPictures(answer) {
  const { segments, units } = answer.motion;
  const segment = segments[doc.chosen];
  const rests = segment.position[0] === segment.position[1];
  byId("law-box").hidden = rests;
  if (rests) return;
  const { rpm } = first();
  const speed = rpm ?? (first().shaftSpeed * 30) / Math.PI;
  const chosenLaw = keyTable.laws.find(({ name }) => name === segment.law);
  byId("law-now").textContent = `${text("law")}: ${segment.law}${chosenLaw ? `: ${text("peaks", peakNames(chosenLaw, segment, units, speed))}` : ""}`;
  byId("laws").replaceChildren(...keyTable.laws.map((law) => {
    const isChosen = law.name === segment.law;
    const coefficients = text("coefficients", Object.fromEntries(["v", "a", "j"].map((name, order) => [name, law.peaks[order] === null ? "∞" : shown(law.peaks[order], 3)])));
    const card = make("button", { type: "button", role: "radio", "aria-checked": String(isChosen), tabIndex: isChosen || (!chosenLaw && law === keyTable.laws[0]) ? 0 : -1, "data-law": law.name }, lawPicture(law), make("strong", {}, law.name), make("span", { className: "muted" }, coefficients), make("span", {}, text("peaks", peakNames(law, segment, units, speed))));
    card.addEventListener("click", () => {
      lawFocus = law.name;
      commit([{ set: { key: `motion.segment[${doc.chosen}].law`, to: law.name } }]);
    });
    return card;
  }));
  if (lawFocus) byId("laws").querySelector(`[data-law="${lawFocus}"]`)?.focus();
  lawFocus = null;
}
const peakNames = (...of) => Object.fromEntries(lawPeaks(...of).map((value, order) => ["vaj"[order], value]));
/** The law that has the focus again after the pictures are made anew. */
let lawFocus = null;

/** Arrow keys go from law to law and choose, as in any group of radio buttons. */
function listenToLaws() {
  byId("laws").addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    const all = [...byId("laws").children];
    const at = all.indexOf(event.target);
    if (!step || at < 0) return;
    event.preventDefault();
    event.stopPropagation();
    const next = all[(at + step + all.length) % all.length];
    next.click();
  });
}
