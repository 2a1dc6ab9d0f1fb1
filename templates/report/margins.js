// The answer first: the verdict, and how much of each limit the cam uses.

/** The words of the strip by their names, with values in the places of {names}: of the report, or of the live page in its language. */
let phrase;
/** The name of a check in the language of the page. */
let checkName = (check) => words(check.check);

/** The share of a limit that a value uses, 1 at the limit; null where a ratio means nothing. */
const usedOf = ({ margin }) => margin ?? null;

/**
 * The checks of a cam: those that fail, the margins from the tightest, and those of what was written, whose tolerances camgen fills on purpose: one
 * is nearly always close to its limit, and would hide what a designer can change.
 */
function marginsOf(checks) {
  const judged = checks.filter(({ verdict }) => verdict !== "info");
  const failed = judged.filter(({ verdict }) => verdict === "fail");
  const rest = judged.filter((check) => check.verdict !== "fail" && usedOf(check) !== null);
  const tightest = (list) => list.sort((a, b) => usedOf(b) - usedOf(a));
  return {
    judged, failed,
    margins: tightest(rest.filter(({ asCut }) => !asCut)),
    filled: tightest(rest.filter(({ asCut }) => asCut)),
  };
}

/** A share in percent; what passes never reads 100. */
function percent(check) {
  const used = 100 * usedOf(check);
  if (check.verdict === "fail") return phrase("used", { used: used < 1000 ? shown(Math.max(used, 100.1), used < 110 ? 4 : 3) : "> 999" });
  // A warning may lie beyond its limit.
  if (check.verdict === "warn" && used > 100) return phrase("used", { used: used < 1000 ? shown(used, 3) : "> 999" });
  return phrase("used", { used: used > 99 ? Math.min(used, 99.9).toFixed(1) : Math.round(used) });
}

/** A value with its unit; a sign of degrees follows without a space. */
const withUnit = (value, unit, digits = FOR_PEOPLE) => (value === null ? "–" : `${shown(value, digits)}${unit ? (unit === "°" ? unit : ` ${unit}`) : ""}`);

/** The value of a check, with digits enough to differ from its limit. */
function valueOfCheck({ value, limit, unit }) {
  if (value === null) return "–";
  return `${limit === null ? shown(value) : nextTo(limit, value)}${unit ? (unit === "°" ? unit : ` ${unit}`) : ""}`;
}

/** A value against its limit in words: 44.2° of at most 45°. */
function againstLimit(check) {
  const side = { "at most": "atMost", "at least": "atLeast" }[check.side] ?? "otherSide";
  return phrase("ofLimit", { value: check.limit !== null && check.unit ? valueOfCheck(check).replace(check.unit === "°" ? "" : ` ${check.unit}`, "") : valueOfCheck(check), side: phrase(side), limit: withUnit(check.limit, check.unit) });
}

/** The bar of a margin: the limit is at 90 % of its width, so that over-use has room. */
function barOf(check) {
  const used = usedOf(check);
  const fill = make("i");
  fill.style.width = `${used === null ? 100 : Math.min(100, 90 * used)}%`;
  return make("span", { className: "bar", "aria-hidden": "true" }, fill, make("u"));
}

/** Where the worst value of a check is: in the coordinate of the view. */
const placeOfCheck = (check, view) => (view.place === "cam_deg" ? check.camDeg : view.place === "x_mm" ? check.xMm : null) ?? null;

/** Whether the place of a check is one along a plate, and a length in mm with the unit of the page. */
const isAlongPlate = ({ xMm }) => xMm !== null && xMm !== undefined;
function inLength(millimetres) {
  const [factor, unit] = inLengths("mm");
  return withUnit(millimetres * factor, unit);
}

/** One margin; a click goes to its place. */
function marginCell(check, go) {
  const fails = check.verdict === "fail";
  const used = usedOf(check);
  const place = check.place ? phrase("atPlace", { place: check.camDeg !== null ? `${check.camDeg.toFixed(1)}°` : isAlongPlate(check) ? `x = ${inLength(check.xMm)}` : check.place }) : "";
  const head = make("span", { className: "first" }, make("strong", {}, checkName(check)), make("span", {}, fails ? phrase("verdictFail") : percent(check)));
  const foot = make("span", { className: "second" }, make("span", {}, againstLimit(check)), make("span", {}, place));
  const cell = make("button", { type: "button", className: fails ? "margin fails" : "margin", "data-check": check.check, title: check.about ?? "" }, head, used === null ? null : barOf(check), foot);
  cell.addEventListener("click", () => go(check, cell));
  return cell;
}

/** The verdict word of a cam: colour and text together. */
function stamp(passed, judged, warns) {
  const [name, sign, word_] = !passed ? ["fail", "✕", "verdictFail"] : warns ? ["warn", "!", "verdictWarn"] : judged ? ["pass", "✓", "verdictPass"] : ["info", "", "verdictInfo"];
  return make("b", { className: `stamp ${name}` }, `${sign} ${phrase(word_)}`.trim());
}

/** The strip of one cam: verdict, three tightest margins or what fails, and what is filled on purpose. */
function stripOf(cam, passed, { go, all, remedies = () => [] }) {
  const { judged, failed, margins, filled } = marginsOf(cam.checks);
  const good = judged.filter(({ verdict }) => verdict === "pass" || verdict === "warn").length;
  const warns = judged.some(({ verdict }) => verdict === "warn");
  const counts = make("span", { className: "counts" }, make("strong", {}, judged.length ? phrase("checksPassed", { passed: good, all: judged.length }) : phrase("noLimits")), make("small", {}, phrase("provenFile")));
  const shownMargins = [...failed, ...margins].slice(0, 3);
  const cells = shownMargins.map((check, index) => {
    const cell = marginCell(check, go);
    if (index > 0 || check.verdict !== "fail") return cell;
    const buttons = remedies(check);
    return make("div", { className: "failing" }, cell, ...buttons.slice(0, 2));
  });
  const line = (check) => `${checkName(check)} ${againstLimit(check)}`;
  const room = judged.length - shownMargins.length - filled.length;
  const more = make("button", { type: "button", className: "more" }, !failed.length && room > 0 ? phrase("moreChecks", { count: room }) : phrase("allChecks"));
  more.addEventListener("click", all);
  return [make("div", { className: "summary" }, stamp(passed, judged.length, warns), counts), make("div", { className: "margins", role: "group", "aria-label": phrase("margins") }, ...cells),
    make("div", { className: "ascut" }, make("strong", {}, phrase("asCut")), make("span", { title: filled.map(line).join("; ") }, filled.slice(0, 2).map((check) => `${checkName(check)} ${percent(check)}`).join(", ") || "–"), more)];
}
