// The parts of a slider where a limit breaks: found after each proof, while nobody waits for anything.

/** Time of rest before zones are looked for, and the time after which a search is given up, ms. */
const ZONES = { rest: 900, longest: 30000, halvings: 5 };

/** An engine of its own, so that nothing waits for a search; a program that serves the page has threads for both. */
let zoneEngine = null;

let zoneTimer = null;
/** Grows with each change: what was looked for before is not shown. */
let zoneTurn = 0;

/** Forgets all zones, and looks for those of the present design when it has been at rest. */
function zonesAnew() {
  zoneTurn += 1;
  clearTimeout(zoneTimer);
  for (const one of fields.values()) zonesShown(one, []);
  if (!doc.last?.passed) return;
  const turn_ = zoneTurn;
  zoneTimer = setTimeout(() => findZones(turn_), ZONES.rest);
}

/** Looks for the zones of the keys beside the cam, one after the other; ends where something else is asked. */
async function findZones(turn_) {
  const often = [...byId("chosen").children].map((box) => [...fields.values()].find((one) => one.box === box)).filter((one) => one?.slider);
  const begun = performance.now();
  const isOver = () => turn_ !== zoneTurn || running || queue.length > 0 || isDragging || performance.now() - begun > ZONES.longest;
  zoneEngine ??= live.token ? engine : ownEngine(false);
  for (const one of often) {
    const { ends, value } = one.slider;
    const found = [];
    for (const end of [ends.low, ends.high]) {
      const zone = await zoneTo(one, value, end, isOver);
      if (zone === null) return;
      if (zone) found.push(zone);
    }
    if (isOver()) return;
    zonesShown(one, found);
  }
  document.documentElement.dataset.zones = Number(document.documentElement.dataset.zones ?? 0) + 1;
}

/** What breaks first between a value that passes and an end: where and why; false where nothing does, null where the search was ended. */
async function zoneTo(one, value, end, isOver) {
  const tried = async (at) => {
    if (isOver()) return null;
    const answer = await zoneEngine(requestOf({ changes: [{ set: { key: one.path, to: typedOf(at, one.slider) } }], tolerance: Math.max(DRAFT, doc.tolerance), report: true })).catch(() => null);
    if (answer === null || isOver()) return null;
    return { passed: Boolean(answer.passed), why: answer.faults?.length || answer.noOutline ? text("noCam") : null, checks: (answer.report?.checks ?? []).filter(({ verdict }) => verdict === "fail") };
  };
  if (Math.abs(end - value) < 1e-9 * Math.abs(end)) return false;
  const rounded = (at) => one.slider.low + Math.round((at - one.slider.low) / one.slider.step) * one.slider.step;
  let [good, bad, reason] = [value, null, null];
  for (const share of [1, 0.5]) {
    const at = rounded(value + share * (end - value));
    const result = await tried(at);
    if (result === null) return null;
    if (result.passed) {
      good = share === 1 ? good : at;
      if (share === 1) continue;
    } else [bad, reason] = [at, result];
  }
  if (bad === null) return false;
  for (let step = 0; step < ZONES.halvings && Math.abs(bad - good) > 1.5 * one.slider.step; step += 1) {
    const at = rounded((good + bad) / 2);
    const result = await tried(at);
    if (result === null) return null;
    if (result.passed) good = at;
    else [bad, reason] = [at, result];
  }
  return { from: good, to: end, why: reason.why ?? (reason.checks.length ? checkName(reason.checks[0]) : text("limit")), isAbove: end > value };
}

/** Hatches the zones below a slider, with the reason between its ends. */
function zonesShown(one, zones) {
  if (!one.ends || !one.zones) return;
  const { low, high } = one.slider ?? {};
  const part = (value) => `${(100 * (value - low)) / (high - low)}%`;
  one.zones.replaceChildren(...zones.map(({ from, to, isAbove }) => make("i", { style: isAbove ? `left: ${part(from)}; right: 0` : `left: 0; right: calc(100% - ${part(from)})` })));
  const words_ = zones.map(({ from, why, isAbove }) => text(isAbove ? "zoneAbove" : "zoneBelow", { why, value: shown(from) })).join(" · ");
  one.note = words_;
  const note = one.ends.children[1];
  if (words_) note.textContent = words_;
  else if (one.slider) note.textContent = one.typed === "auto" ? `auto: ${shown(one.slider.value)} ${one.slider.unit}` : "";
  note.className = words_ ? "zone" : "";
  note.title = words_;
}
