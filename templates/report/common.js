// What every part of the page needs: the data, elements made of text only, numbers, and places between samples.

const cams = JSON.parse(document.getElementById("data").textContent).cams;
const byId = (id) => document.getElementById(id);

/** An element with properties, attributes (names with a dash or in lower case of SVG) and children; strings become text. */
function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element) element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

function makeSvg(tag, attributes = {}) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

/** Significant digits for people; those of a table of all values, for whom they are too few. */
const FOR_PEOPLE = 4;
const ALL_DIGITS = 6;

/** A power of ten as people write it. */
const powerOfTen = (power) => `·10${[...String(power)].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)])).join("")}`;

/** A number in full with a true minus; from 10 000 on thin spaces part the thousands. */
function grouped(text) {
  const [whole, decimals] = text.replace("-", "−").split(".");
  const parted = whole.replace("−", "").length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u2009") : whole;
  return decimals ? `${parted}.${decimals}` : parted;
}

/** A number for a person: four significant digits, powers of a thousand where it is very large or small. Every figure of the page is written here. */
function shown(value, digits = FOR_PEOPLE) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size < 1e-9) return "0";
  if (size < 1e-4 || size >= 1e5) {
    const power = 3 * Math.floor(Math.log10(size) / 3);
    return `${grouped(String(Number((value / 10 ** power).toPrecision(digits))))}${powerOfTen(power)}`;
  }
  // Digits in front of the point are never rounded away, and no sum of doubles ends in 0000001.
  const inFront = Math.floor(Math.log10(size)) + 1;
  return grouped(String(Number(Number(value.toPrecision(14)).toPrecision(Math.max(digits, inFront)))));
}

/** A number with a steady number of decimals, so that it does not jump while it changes. */
function steady(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size < 5e-4) return size < 1e-6 ? "0.000" : shown(value, 2);
  if (size >= 1e5) return `${grouped((value / 1e3).toFixed(1))}·10³`;
  return grouped(value.toFixed(size < 10 ? 3 : size < 100 ? 2 : size < 1000 ? 1 : 0));
}

/** A value next to its limit: with as many digits more as the two need to differ. */
function nextTo(limit, value) {
  let digits = FOR_PEOPLE;
  while (value !== limit && digits < ALL_DIGITS + 1 && shown(value, digits) === shown(limit, digits)) digits += 1;
  return shown(value, digits);
}

/** The place of a value in an increasing list: the index before it and the share of the distance to the next. */
function locate(list, value) {
  let low = 0;
  let high = list.length - 1;
  if (value <= list[0]) return [0, 0];
  if (value >= list[high]) return [high - 1, 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (list[middle] <= value) low = middle;
    else high = middle;
  }
  return [low, (value - list[low]) / (list[high] - list[low])];
}

/** A value between two samples; a missing one stays missing. */
function between(list, [index, share]) {
  const a = list[index];
  const b = list[index + 1];
  if (share === 0 || b === undefined) return a;
  if (share === 1) return b;
  return a === null || b === null ? null : a + (b - a) * share;
}

/** The columns of a view; for a cyclic motion the first row is repeated at the end. */
function closed(view) {
  const columns = {};
  for (const [name, values] of Object.entries(view.columns)) {
    columns[name] = view.returns ? values : values.concat(name === view.place ? 360 : values[0]);
  }
  return columns;
}
for (const cam of cams) for (const view of cam.views) view.columns = closed(view);

const state = {
  /** Degrees of the shaft from the start of the cycle. */
  cycle: 0,
  playing: false,
  /** Seconds of a cycle. */
  seconds: 8,
  rate: "angle",
  section: 0,
};

const viewOf = (cam) => cam.views[Math.min(state.section, cam.views.length - 1)];
const first = () => viewOf(cams[0]);

/** Length of a cycle of a view, degrees of the shaft: a turn, or out and back. */
function cycleOf(view) {
  const span = view.turn[view.turn.length - 1] - view.turn[0];
  return view.returns ? 2 * span : span;
}

/** Angle of the shaft in a view. */
function turnOf(view) {
  const span = view.turn[view.turn.length - 1] - view.turn[0];
  const at = state.cycle <= span ? state.cycle : view.returns ? 2 * span - state.cycle : span;
  return view.turn[0] + Math.max(0, at);
}

/** The place in a view: in its table's own coordinate. */
const placeOf = (view) => between(view.at, locate(view.turn, turnOf(view)));

/** A colour of the current style. */
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** The unit of lengths on the page; what comes from the program has millimetres, and its sentences name the units that they have. */
let lengthUnit = "mm";
const INCHES = { µm: 1 / 25400, mm: 1 / 25.4, m: 1000 / 25.4 };

/** Factor and name of a unit in the lengths of the page; units with forces and masses stay, as in the files. */
function inLengths(unit) {
  if (lengthUnit === "mm" || !unit || /\bk?N|\bk?g\b|J|W|Pa/.test(unit)) return [1, unit];
  let factor = 1;
  const parts = unit.split("/").map((part, index) => part.replace(/^(µm|mm|m)([²³]?)$/, (_, length, power) => {
    factor *= INCHES[length] ** ((index ? -1 : 1) * (power === "²" ? 2 : power === "³" ? 3 : 1));
    return `in${power}`;
  }));
  return [factor, parts.join("/")];
}

/** Factor and unit in which a column of an order of derivation is shown. */
function inRates(view, unit, order) {
  const [rate, name] = inMetricRates(view, unit, order);
  const [factor, shownUnit] = inLengths(name);
  return [rate * factor, shownUnit];
}

function inMetricRates(view, unit, order) {
  if (order === 0 || state.rate === "angle" || !view.shaftSpeed) return [1, unit];
  const [above] = unit.split("/");
  // Millimetres to metres where the numbers would be long.
  const metres = above === "mm" && order > 1;
  const power = ["", "s", "s²", "s³"][order];
  if (above === "rad" && state.rate === "degrees") return [(view.shaftSpeed ** order * 180) / Math.PI, `°/${power}`];
  return [view.shaftSpeed ** order * (metres ? 1e-3 : 1), `${metres ? "m" : above}/${power}`];
}

/** The letter of a cam that is shown next to another. */
const letter = (index) => (cams.length > 1 ? "AB"[index] : "");
