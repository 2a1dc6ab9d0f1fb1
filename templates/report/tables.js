// The page: verdicts, mechanism, curves, tables, and their animation.

// ---- verdicts and tables

const word = { pass: "pass", fail: "FAIL", warn: "WARN", info: "info" };
const badge = (verdict, text = word[verdict]) => make("span", { className: `badge ${verdict}` }, text);
const limitOf = (check) => (check.limit === null ? "" : `${check.side ? `${check.side} ` : ""}${withUnit(check.limit, check.unit)}`);
const words = (name) => name.replace(/_/g, " ");

function table(head, rows, className = "full") {
  const cell = (tag, [text, kind]) => make(tag, { className: kind || "" }, text);
  const headRow = make("tr", {}, ...head.map((entry) => make("th", { scope: "col", className: entry[1] || "" }, entry[0])));
  const body = rows.map(({ className: of, cells }) =>
    make("tr", { className: of || "" }, ...cells.map((entry, index) => cell(index === 0 ? "th" : "td", entry))));
  for (const row of body) row.firstElementChild.setAttribute("scope", "row");
  // A wide table scrolls on a narrow screen, and must be reached by the keyboard there.
  return make("div", head.length > 5 ? { className: "wide", tabIndex: 0 } : { className: "wide" }, make("table", { className }, make("thead", {}, headRow), make("tbody", {}, ...body)));
}

const isBad = (check) => check.verdict === "fail" || check.verdict === "warn";
const checksWords = (n, what) => `${n} ${n === 1 ? "check" : "checks"} ${what}`;

/** The verdict of a cam in one line. */
function banner(cam, index) {
  const count = (verdict) => cam.checks.filter((check) => check.verdict === verdict).length;
  const [fails, warns] = [count("fail"), count("warn")];
  const verdict = cam.passed ? (warns ? "warn" : count("pass") ? "pass" : "info") : "fail";
  const name = letter(index) ? `${letter(index)}: ${cam.title}. ` : "";
  const counts = [[fails, "failed"], [warns, warns === 1 ? "warns" : "warn"], [count("pass"), "passed"], [count("info"), "without a verdict"]].filter(([n]) => n > 0);
  const line = counts.map(([n, what], at) => (at ? `${n} ${what}` : checksWords(n, what))).join(", ");
  const broken = cam.checks.filter((check) => check.verdict === "fail").map((check) => words(check.check)).join(", ");
  return make("span", { className: "banner" }, badge(verdict, word[verdict]), make("span", {}, `${name}${line}`),
    cam.passed ? null : make("strong", { className: "broken", role: "alert" }, `This cam breaks a limit: ${broken}.`));
}

/** A line that opens the checks; open by itself where one failed or warns, and these first. */
function verdicts() {
  const [bad, rest] = cams.length > 1
    ? [true, false].map((wanted) => checksBeside(cams, (name) => cams.some((cam) => cam.checks.some((check) => check.check === name && isBad(check))) === wanted))
    : [true, false].map((wanted) => checksOf(cams[0].checks.filter((check) => isBad(check) === wanted)));
  const boxes = bad && rest ? [bad, make("details", {}, make("summary", {}, "The other checks"), rest)] : [bad ?? rest];
  return make("details", { open: Boolean(bad) }, make("summary", {}, ...cams.map(banner)), ...boxes);
}

function checksOf(checks) {
  if (!checks.length) return null;
  const rows = checks.map((check) => ({
    className: check.verdict,
    cells: [[words(check.check)], [badge(check.verdict)], [valueOfCheck(check), "number"],
      [limitOf(check), "number"], [check.place || "", "place"], [check.note || "", "note"]],
  }));
  const box = table([["Check"], ["Verdict"], ["Value", "number"], ["Limit", "number"], ["Place"], ["Note"]], rows);
  box.querySelectorAll("tbody th").forEach((cell, index) => (cell.title = checks[index].about || ""));
  return box;
}

/** Those checks of two cams in one table. */
function checksBeside([a, b], isWanted) {
  const names = [...new Set([...a.checks, ...b.checks].map((check) => check.check))].filter(isWanted);
  if (!names.length) return null;
  const rank = { fail: 0, warn: 1, pass: 2, info: 3 };
  const of = (cam, name) => cam.checks.find((check) => check.check === name);
  const worst = (name) => Math.min(...[a, b].map((cam) => rank[of(cam, name)?.verdict] ?? 4));
  names.sort((x, y) => Math.min(worst(x), 2) - Math.min(worst(y), 2));
  const rows = names.map((name) => {
    const both = [a, b].map((cam) => of(cam, name));
    const cells = both.flatMap((check) => (check
      ? [[badge(check.verdict)], [valueOfCheck(check), "number"], [check.place || "", "place"]] : [["–"], ["", "number"], [""]]));
    const limits = [...new Set(both.filter((check) => check && check.limit !== null).map(limitOf))];
    const differs = both[0]?.verdict !== both[1]?.verdict;
    const found = worst(name);
    return { className: [found === 0 ? "fail" : found === 1 ? "warn" : "", differs ? "differs" : ""].join(" "), cells: [[words(name)], ...cells, [limits.join(" | "), "number"]] };
  });
  return table([["Check"], ["A"], ["", "number"], ["at"], ["B"], ["", "number"], ["at"], ["Limit", "number"]], rows);
}

const valueText = (value) => (Array.isArray(value) ? value.map(valueText).join(", ") : typeof value === "number" ? shown(value, ALL_DIGITS) : String(value));

function sectionsOf(cam) {
  // What is said in words comes first; the values behind it are there for those who want all digits.
  const valuesOf = (section) => {
    const all = table([["Value"], ["", "number"], ["Unit"]], section.values.map(([label, value, unit]) => ({ cells: [[label], [valueText(value), "number"], [unit]] })));
    return make("details", {}, make("summary", {}, "All values"), all);
  };
  const boxes = cam.sections.filter((section) => section.values.length || section.words.length).map((section) => make("div", { className: section.words.length ? "" : "control" },
    make("h3", {}, section.title), ...section.words.map((line) => make("p", {}, line)), section.values.length ? valuesOf(section) : null));
  return make("div", {}, make("div", { className: "columns" }, ...boxes), ...(viewOf(cam)?.words ? [] : cam.sections.flatMap(listsOf)));
}

/** The lists of a section, a table each. */
function listsOf(section) {
  return section.tables.map(({ name, heads, rows }) => make("div", {}, make("h3", {}, `${section.title}: ${name}`),
    table(heads.map(([label, unit]) => [unit ? `${label}, ${unit}` : label, "number"]),
      rows.map((row) => ({ cells: row.map((value) => [value === null ? "–" : valueText(value), "number"]) })))));
}

function sectionsBeside([a, b]) {
  const keys = [...new Set([...a.sections, ...b.sections].map((section) => section.key))];
  const of = (cam, key) => cam.sections.find((section) => section.key === key)?.values ?? [];
  const boxes = keys.map((key) => {
    const labels = [...new Set([...of(a, key), ...of(b, key)].map(([label]) => label))];
    const rows = labels.map((label) => {
      const [x, y] = [a, b].map((cam) => of(cam, key).find((value) => value[0] === label));
      const comparable = !x || !y || x[2] === y[2];
      const numbers = comparable && x && y && typeof x[1] === "number" && typeof y[1] === "number";
      const differs = !comparable || valueText(x?.[1] ?? null) !== valueText(y?.[1] ?? null);
      const share = numbers && x[1] !== 0 ? ` (${shown((100 * (y[1] - x[1])) / Math.abs(x[1]), 3)} %)` : "";
      const difference = differs ? (numbers ? `${shown(y[1] - x[1], 4)}${share}` : comparable ? "differs" : "not comparable") : "";
      const unit = comparable ? (x ?? y)[2] : `${x[2]} | ${y[2]}`;
      return { className: differs ? "differs" : "", cells: [[label], ...[x, y].map((value) => [value ? valueText(value[1]) : "–", "number"]), [difference, "number difference"], [unit]] };
    });
    const { title } = [...a.sections, ...b.sections].find((section) => section.key === key);
    return rows.length ? make("div", {}, make("h3", {}, title), table([["Value"], ["A", "number"], ["B", "number"], ["B − A", "number"], ["Unit"]], rows)) : null;
  });
  return make("div", { className: "columns one" }, ...boxes);
}

/** Rows of the table at round places, the columns that fit a page; those of a list in as many tables as they need. */
const MOST_COLUMNS = 13;
function rowsOf(cam, index) {
  const view = viewOf(cam);
  const shownOf = view.words ? shown : steady;
  const skipped = /^(position|pitch_x|pitch_y|profile_|contact_|z_mm|rpm|psi|.*_cut_|air|lift_per|axial|principal|inertia)/;
  const names = Object.keys(view.columns).filter((name) => !view.parts.length || !skipped.test(name));
  const parts = [];
  for (let from = 0; from < (view.words ? names.length : 1); from += MOST_COLUMNS) parts.push(names.slice(from, from + MOST_COLUMNS));
  const last = view.columns[view.place].length - 1;
  const step = view.words ? 1 : Math.max(1, Math.round(last / 36));
  const tableOf = (part) => {
    const rows = [];
    for (let i = 0; i <= last; i += step) {
      rows.push({ cells: [...(view.words ? [[view.words[1][i]]] : []), ...part.map((name) => {
        const [factor] = inRates(view, view.kinds[name][1], view.kinds[name][2]);
        const value = view.columns[name][i];
        return [value === null ? "–" : shownOf(value * factor), "number"];
      })] });
    }
    const head = part.map((name) => {
      const [label, unit, order] = view.kinds[name];
      return [[label, inRates(view, unit, order)[1]].filter(Boolean).join(", "), "number"];
    });
    if (view.words) head.unshift([words(view.words[0])]);
    return table(head, rows, view.words ? "full" : "full every");
  };
  return make("div", {}, cams.length > 1 ? make("h3", {}, `${letter(index)}: ${cam.title}`) : null, ...parts.map(tableOf), profileOf(cam));
}

/** The profile for paper: place, x and y in four columns of rows; on the screen the files have it. */
const PROFILE_ROWS = 72;
const PROFILE_PARTS = 4;
function profileOf(cam) {
  const view = viewOf(cam);
  const { profile_x_mm: xs, profile_y_mm: ys } = view.columns;
  // Two cams next to each other are compared, not cut.
  if (!xs || !ys || view.words || cams.length > 1) return null;
  const last = xs.length - 1;
  const step = Math.max(1, Math.round(last / PROFILE_ROWS));
  const [name, unit] = view.kinds[view.place];
  const [scaled, along] = inLengths("mm");
  const decimals = (value) => (value === null ? "–" : (value * scaled).toFixed(scaled === 1 ? 4 : 5).replace("-", "−"));
  const rows = [];
  for (let at = 0; at <= last; at += step) if (xs[at] !== null) rows.push([shown(view.columns[view.place][at]), decimals(xs[at]), decimals(ys[at])]);
  const each = Math.ceil(rows.length / PROFILE_PARTS);
  const head = [[unit === "°" ? "θ, °" : `${name}, ${unit}`, "number"], [`x, ${along}`, "number"], [`y, ${along}`, "number"]];
  const parts = Array.from({ length: PROFILE_PARTS }, (_, part) => rows.slice(part * each, (part + 1) * each)).filter((part) => part.length);
  return make("div", { className: "profile" }, make("h3", {}, "Profile"), make("div", { className: "parts" }, ...parts.map((part) => table(head, part.map((row) => ({ cells: row.map((value) => [value, "number"]) }))))));
}

function missingOf(cam, index) {
  const list = (lines) => make("ul", {}, ...lines.map((line) => make("li", {}, line)));
  const notRun = cam.notRun.map(([check, note]) => `Check ${words(check)}: ${note}.`);
  return make("div", {}, cams.length > 1 ? make("h3", {}, `${letter(index)}: ${cam.title}`) : null, list(cam.notModelled),
    notRun.length ? make("h3", {}, "Checks that were not run") : null, notRun.length ? list(notRun) : null,
    cam.notes.length ? make("h3", {}, "Notes") : null, cam.notes.length ? list(cam.notes) : null);
}

