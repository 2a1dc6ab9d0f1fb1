// Millimetres or inches: the key output.units says it, for files, reports and this page.

/** The word of a design for its unit of lengths, "mm" or "inch"; null where it has none, and each field shows what was typed. */
const unitsWord = (answer) => answer?.values?.["output.units"]?.toLowerCase() ?? null;

/** Takes the unit of lengths of a design. */
function takeUnits(answer) {
  lengthUnit = unitsWord(answer) === "inch" ? "in" : "mm";
  for (const button of byId("lengths").children) button.setAttribute("aria-pressed", String((button.dataset.lengths === "inch") === (lengthUnit === "in")));
}

const timesAll = (value, factor) => (Array.isArray(value) ? value.map((one) => timesAll(one, factor)) : typeof value === "number" ? Number((value * factor).toPrecision(7)) : value);

/** Checks in the unit of lengths of the page. */
const checksInUnits = (checks) => checks.map((check) => {
  const [factor, unit] = inLengths(check.unit);
  return { ...check, value: timesAll(check.value, factor), limit: timesAll(check.limit, factor), unit };
});

/** The checks and figures of a cam in the unit of lengths of the page; those of the program are kept. */
function figuresInUnits(cam) {
  cam.metric ??= { checks: cam.checks, sections: cam.sections };
  cam.checks = checksInUnits(cam.metric.checks);
  cam.sections = cam.metric.sections.map((section) => ({
    ...section,
    values: section.values.map(([label, value, of]) => [label, timesAll(value, inLengths(of)[0]), inLengths(of)[1]]),
    tables: section.tables.map((table) => {
      const units = table.heads.map(([, of]) => inLengths(of));
      return { ...table, heads: table.heads.map(([label], at) => [label, units[at][1]]), rows: table.rows.map((row) => row.map((value, at) => timesAll(value, units[at][0]))) };
    }),
  }));
  return cam;
}

/** A number of mm in the unit of the page; an angle stays. */
const inNumber = (value, unit) => (unit === "mm" ? value * inLengths("mm")[0] : value);
const unitName = (unit) => (unit === "mm" ? lengthUnit : unit);
/** A position or an angle for a label: a sign of degrees, no unit of lengths. */
const inPage = (value, unit) => `${shown(inNumber(value, unit))}${unit === "deg" ? "°" : ""}`;
/** A number of mm or degrees as it is typed into the file. */
const typedLength = (value, unit) => (unit === "mm" && lengthUnit === "in" ? `${Number((value / 25.4).toFixed(6))} in` : `${cleaned(value)} ${unit}`);

/** Size of a unit of length, m; undefined for others. */
const lengthSize = (unit) => keyTable.units.length?.[unit];

/** A length with the digits of the shop: to a tenth of a thousandth of an inch, and four digits where it is small. */
const lengthDigits = (value) => (Math.abs(value) < 0.1 ? Number(value.toPrecision(4)) : Number(value.toFixed(4)));

/** A value as a field shows it: as typed, or a length in the unit that the design names. */
function typedInUnits(typed, key, answer) {
  const word_ = unitsWord(answer);
  const found = quantityOf(typed);
  if (!word_ || !found || !key.ranges?.some(({ dimension }) => dimension === "length") || !lengthSize(found.unit)) return typed;
  const wanted = word_ === "inch" ? "in" : "mm";
  if (found.unit === wanted) return typed;
  return `${/^Ø/.test(typed) ? "Ø" : ""}${lengthDigits((found.number * lengthSize(found.unit)) / lengthSize(wanted))} ${wanted}`;
}

/** What was typed into a field: a number alone has the unit that the field showed before. */
function withFormerUnit(value, former, key) {
  const [found, before] = [quantityOf(value), quantityOf(former)];
  const needsUnit = key.ranges?.length > 0 && key.ranges.every(({ dimension }) => dimension !== null);
  return found && found.unit === "" && before?.unit && needsUnit ? `${value} ${before.unit}` : value;
}

/** Sets the unit of lengths in the machine file; millimetres are the usual ones, and need no word where the design as sent has none. */
function chooseUnits(word_) {
  if ((lengthUnit === "in") === (word_ === "inch")) return;
  const outputs = (doc.last?.given ?? []).filter((path) => path.startsWith("output."));
  const isOwn = doc.sent.values?.["output.units"] === undefined;
  if (word_ === "mm" && isOwn) commit([{ remove: outputs.length > 1 ? "output.units" : "output" }]);
  else commit([{ set: { key: "output.units", to: word_ } }]);
}
