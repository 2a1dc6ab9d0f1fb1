// The page of a study: a table of the columns, the front, a histogram of each column, and the scatter of each against each.
const study = JSON.parse(document.getElementById("data").textContent);
const style = getComputedStyle(document.documentElement);
const colour = (name) => style.getPropertyValue(name).trim();
const element = (tag, text, parent) => {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  parent?.append(made);
  return made;
};
const shown = (value) => (value === null || value === undefined ? "" : Number(value.toPrecision(4)).toString());

const rows = document.getElementById("rows");
const kept = study.kind === "pareto" ? `, ${study.columns[0]?.front.length ?? 0} of them beaten by no other` : "";
element("p", `${study.rows} designs, ${study.faults} with a fault, ${study.feasible} within every limit${kept}.`, rows);
const table = element("table", undefined, rows);
const head = element("tr", undefined, element("thead", undefined, table));
for (const name of ["figure", "least", "mean", "standard deviation", "largest"]) element("th", name, head).scope = "col";
const body = element("tbody", undefined, table);
for (const column of study.columns) {
  const row = element("tr", undefined, body);
  const head = element("th", column.label, row);
  head.scope = "row";
  head.title = column.name;
  for (const key of ["least", "mean", "deviation", "largest"]) element("td", shown(column[key]), row);
}
if (study.reasons.length > 0) {
  element("h3", "Faults", rows);
  const list = element("ul", undefined, rows);
  for (const [reason, count] of study.reasons) element("li", `${count}: ${reason}`, list);
}

// Beyond a limit: tinted and hatched behind the points.
const beyond = (chart, [x, y]) => {
  const { ctx, bbox } = chart;
  const sides = (column, scale, low, high, along) => {
    if (!column?.limit) return [];
    const [least, most] = column.limit.map((limit) => (limit === null ? null : chart.valToPos(limit, scale, true)));
    const parts = [];
    const put = (from, to) => { if (to - from > 0.5) parts.push(along ? [from, bbox.top, to - from, bbox.height] : [bbox.left, from, bbox.width, to - from]); };
    if (along && least !== null) put(low, Math.min(least, high));
    if (along && most !== null) put(Math.max(most, low), high);
    if (!along && least !== null) put(Math.max(least, low), high);
    if (!along && most !== null) put(low, Math.min(most, high));
    return parts;
  };
  const parts = [...sides(x, "x", bbox.left, bbox.left + bbox.width, true), ...sides(y, "y", bbox.top, bbox.top + bbox.height, false)];
  ctx.save();
  for (const [left, top, width, height] of parts) {
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.save();
    ctx.clip();
    ctx.globalAlpha = 0.12;
    ctx.fillStyle = colour("--fail");
    ctx.fill();
    ctx.globalAlpha = 0.35;
    ctx.strokeStyle = colour("--fail");
    ctx.lineWidth = 1;
    ctx.beginPath();
    for (let at = left - height; at < left + width; at += 9) { ctx.moveTo(at, top + height); ctx.lineTo(at + height, top); }
    ctx.stroke();
    ctx.restore();
  }
  ctx.restore();
};

const axis = (label, size) => ({ label, size, stroke: colour("--ink"), grid: { stroke: colour("--faint"), width: 1 }, ticks: { stroke: colour("--line"), width: 1 } });

// An axis without a name, for the matrix: its column and row have one.
const small = (size) => ({ size, gap: 2, space: 34, font: "10px system-ui, sans-serif", stroke: colour("--ink"), grid: { stroke: colour("--faint"), width: 1 }, ticks: { show: false } });

// Points of several groups against one axis: uPlot joins the groups at their places.
const scatter = (box, [x, y], width, height, labels) => {
  const groups = [
    { stroke: colour("--soft"), size: 3, at: (i) => (study.kept[i] ? [null, null] : [x.shown[i], y.shown[i]]), count: x.shown.length, label: "beyond a limit" },
    { stroke: colour("--one"), size: 3, at: (i) => (study.kept[i] ? [x.shown[i], y.shown[i]] : [null, null]), count: x.shown.length, label: "within" },
    { stroke: colour("--two"), size: 6, at: (i) => [x.front[i], y.front[i]], count: x.front.length, label: "front" },
  ];
  const points = [];
  groups.forEach((group, number) => {
    for (let i = 0; i < group.count; i += 1) {
      const [a, b] = group.at(i);
      if (a !== null && b !== null && a !== undefined && b !== undefined) points.push([a, number, b]);
    }
  });
  points.sort((a, b) => a[0] - b[0]);
  const data = [points.map((point) => point[0]), ...groups.map((_, number) => points.map((point) => (point[1] === number ? point[2] : null)))];
  const series = groups.map((group) => ({ label: group.label, stroke: group.stroke, width: 0, paths: () => null, points: { show: true, size: group.size, fill: group.stroke, stroke: group.stroke, width: 0 } }));
  return new uPlot({
    width, height, legend: { show: false }, cursor: { show: false }, hooks: { drawClear: [(chart) => beyond(chart, [x, y])] },
    scales: { x: { time: false, range: (_, low, high) => uPlot.rangeNum(low, high, 0.05, false) }, y: { range: (_, low, high) => (low === null ? [0, 1] : uPlot.rangeNum(low, high, 0.05, false)) } },
    axes: labels ? [axis(x.label, 44), axis(y.label, 60)] : [small(38), small(44)], series: [{}, ...series],
  }, data, box);
};

const histogram = (box, column, width, height, labels) => {
  const step = (column.largest - column.least) / column.bars.length;
  const places = column.bars.map((_, i) => column.least + (i + 0.5) * step);
  const one = step > 0 ? places : places.map((_, i) => column.least + i - column.bars.length / 2);
  return new uPlot({
    width, height, legend: { show: false }, cursor: { show: false }, hooks: { drawClear: [(chart) => beyond(chart, [column, null])] },
    scales: { x: { time: false }, y: { range: (_, low, high) => [0, high * 1.05] } },
    axes: labels ? [axis(column.label, 44), axis("designs", 60)] : [small(38), small(44)],
    series: [{}, { fill: colour("--one"), stroke: colour("--one"), paths: uPlot.paths.bars({ size: [1, Infinity], gap: 0 }), points: { show: false } }],
  }, [one, column.bars], box);
};

// The chart of a column has an accessible name.
const chart = (parent, label) => {
  const box = element("div", undefined, parent);
  box.setAttribute("role", "img");
  box.setAttribute("aria-label", label);
  return box;
};

const objectives = study.objectives.map((name) => study.columns.find((column) => column.name === name)).filter((column) => column);
if (objectives.length > 1) {
  document.getElementById("front").hidden = false;
  const fronts = document.getElementById("fronts");
  for (let i = 0; i + 1 < objectives.length; i += 1) {
    const pair = [objectives[i], objectives[i + 1]];
    scatter(chart(fronts, `${pair[1].label} against ${pair[0].label}`), pair, 520, 340, true);
  }
}
for (const column of study.columns) histogram(chart(document.getElementById("histograms"), `designs by ${column.label}`), column, 400, 240, true);
for (const told of study.ends) element("p", told, document.getElementById("front"));
const limits = study.columns.filter((column) => column.limit?.some((limit) => limit !== null));
for (const column of limits) {
  const [least, most] = column.limit;
  const words = [least === null ? "" : `at least ${shown(least)}`, most === null ? "" : `at most ${shown(most)}`].filter((word) => word).join(", ");
  element("p", `Hatched: beyond the limit of ${column.label}, ${words}.`, rows);
}
const matrix = document.getElementById("matrix");
matrix.style.gridTemplateColumns = `repeat(${study.columns.length}, 200px)`;
for (const y of study.columns) {
  for (const x of study.columns) {
    const box = chart(matrix, x === y ? `designs by ${x.label}` : `${y.label} against ${x.label}`);
    element("p", x === y ? x.label : `${y.label} against ${x.label}`, box).className = "name";
    if (x === y) histogram(box, x, 196, 150, false);
    else scatter(box, [x, y], 196, 150, false);
  }
}
document.getElementById("digest").textContent = `Study ${study.digest.slice(0, 12)}.`;
