// Extremes of curves between the rows of a table: of the smooth curve through the rows, and with the digits of the report.

/** Largest relative change of the second difference from row to row of a curve that is smooth there. */
const SMOOTH = 0.3;
/** Largest relative difference of the two sides of a peak at which the law changes, and of a peak and the figure of the report for it. */
const SAME_PEAK = 1e-3;
const SAME_FIGURE = 3e-4;

/** Where the parabola through three rows has its vertex: its distance from the middle row in rows, and its value. */
function vertexOf(before, middle, after) {
  const curved = before - 2 * middle + after;
  const slope = (after - before) / 2;
  if (curved === 0) return null;
  const at = -slope / curved;
  return Math.abs(at) <= 1 ? { at, value: middle + (slope * at) / 2 } : null;
}

/** The extreme, within a row beyond the last of four rows, of the cubic through them. */
function beyondRows([a, b, c, d]) {
  const [one, two, three] = [d - c, d - 2 * c + b, d - 3 * c + 3 * b - a];
  const [square, linear, constant] = [three / 2, two + three, one + two / 2 + three / 3];
  const root = Math.sqrt(linear * linear - 4 * square * constant);
  const roots = Math.abs(square) < 1e-12 * Math.abs(linear) ? [-constant / linear] : [(-linear + root) / (2 * square), (-linear - root) / (2 * square)];
  const at = roots.find((place) => place >= -1e-6 && place <= 1 + 1e-6);
  return at === undefined ? null : { at, value: d + at * one + ((at * (at + 1)) / 2) * two + ((at * (at + 1) * (at + 2)) / 6) * three };
}

/** The peak of a curve next to its largest or smallest row: of the parabola through three rows, or, where the curvature steps, of both sides. */
function peakNear({ places, values, view }, best, sign) {
  const last = values.length - 1;
  const step = places[1] - places[0];
  const row = (at) => values[at < 0 && !view.returns ? at + last : at > last && !view.returns ? at - last : at] ?? NaN;
  const second = (at) => row(at - 1) - 2 * row(at) + row(at + 1);
  const [before, own, after] = [second(best - 1), second(best), second(best + 1)];
  const isSmooth = Math.abs(before - own) <= SMOOTH * Math.abs(own) && Math.abs(after - own) <= SMOOTH * Math.abs(own);
  const result = (at, value) => (Number.isFinite(value) && sign * value >= sign * values[best] ? { place: Math.min(places[last], Math.max(places[0], places[best] + at * step)), value } : null);
  if (isSmooth) {
    const vertex = vertexOf(row(best - 1), row(best), row(best + 1));
    return vertex && result(vertex.at, vertex.value);
  }
  for (const from of [best - 1, best]) {
    const [left, right] = [beyondRows([3, 2, 1, 0].map((rows) => row(from - rows))), beyondRows([4, 3, 2, 1].map((rows) => row(from + rows)))];
    if (!left || !right || Math.abs(left.value - right.value) > SAME_PEAK * Math.abs(left.value)) continue;
    return result(from - best + (left.at + 1 - right.at) / 2, (left.value + right.value) / 2);
  }
  return null;
}

/** The sizes that the report of a cam has in a unit: in its figures and checks, and of the rates of its segments, which are in the unit of the motion. */
function reportedSizes({ sections, checks }, unit, order, factor) {
  const name = [null, "velocity", "acceleration", "jerk"][order];
  const motion = sections.find(({ key }) => key === "motion")?.values ?? [];
  const angle = motion.some(([label, value]) => label === "unit" && value === "deg") ? Math.PI / 180 : 1;
  const rates = motion.filter(([label, , of]) => name && label.endsWith(`: ${name}`) && (of === "" || of.startsWith("mm/"))).map(([, value]) => value * angle * factor);
  const figures = [...sections.flatMap(({ values }) => values), ...checks.map(({ value, unit: of }) => ["", value, of])];
  return [...rates, ...figures.filter(([, value, of]) => typeof value === "number" && of === unit).map(([, value]) => value)].map(Math.abs);
}

/** An extreme with the digits of the report, where the report has a figure of the same size to what rows can tell. */
function asReported(value, { view, unit, order = 0, factor = 1 }) {
  const size = Math.abs(value);
  const sizes = reportedSizes(cams.find(({ views }) => views.includes(view)), unit, order, factor);
  const nearest = sizes.reduce((best, other) => (Math.abs(other - size) < Math.abs(best - size) ? other : best), Infinity);
  return Math.abs(nearest - size) <= SAME_FIGURE * size ? Math.sign(value) * nearest : value;
}
