// The diagrams of the report, which here take other values without being made anew; in grey behind the curves those of the design as sent.

/** The same panel of the design as sent, as curves at the places of the present one. */
function ghostsOf(panel, curves) {
  const before = ghostOf(viewOf(cams[0]));
  const own = before?.panels.find((other) => isSame(other, panel));
  if (!own || !curves.length) return [];
  const [factor, unit] = inRates(before, own.unit, own.order);
  const { places, view } = curves[0];
  const [from, to] = [before.columns[before.place][0], before.columns[before.place].at(-1)];
  const at = places.map((place) => (place < from || place > to ? null : locate(before.columns[before.place], place)));
  return own.series.map(({ column, label }) => {
    const all = before.columns[column];
    const values = at.map((place) => {
      const value = place === null ? null : between(all, place);
      return value === null || value === undefined ? (own.curvature && place ? 0 : null) : own.curvature ? 1 / value : value * factor;
    });
    return { label: `${text("sent")}: ${label}`, unit, view, places, values, colour: "ghost", dash: [], width: 2.6, ghost: true };
  });
}

/** The curves of a panel, the grey ones first, and their values as uPlot takes them. */
function plotted(panel) {
  const own = curvesOf(panel);
  const curves = [...(cams.length > 1 ? [] : ghostsOf(panel, own)), ...own];
  const lists = curves.map((curve) => [curve.places, curve.values]);
  const same = lists.every(([places]) => places.length === lists[0][0].length);
  const data = same ? [lists[0][0], ...lists.map(([, values]) => values)] : uPlot.join(lists);
  const shape = JSON.stringify([same, panel.id, curves.map(({ label, unit, dash, colour: name }) => [label, unit, dash, name])]);
  return { curves, data, same, shape };
}

function axesOf(panel, view) {
  const [placeName, placeUnit] = view.kinds[view.place];
  const [, unit] = inRates(view, panel.unit, panel.order);
  const withUnits = (name, of) => (of ? `${name}, ${of}` : name);
  const font = "12px system-ui, sans-serif";
  const axis = { stroke: colour("ink"), grid: { stroke: colour("faint"), width: 1 }, ticks: { stroke: colour("line"), width: 1 }, font, labelFont: font, labelSize: 18 };
  const turning = view.place.endsWith("_deg") ? { incrs: [5, 10, 15, 30, 45, 60, 90, 120, 180], space: 42 } : {};
  const what = isPrinting() ? unit : withUnits(spoken(panel.title.split(/ of |,/)[0]), unit);
  return [{ ...axis, ...turning, size: 30, label: withUnits(spoken(placeName), placeUnit) }, { ...axis, size: 58, label: what, values: (_, splits) => splits.map((value) => (value === null ? "" : shown(value))) }];
}

/** One diagram of the same panel of all cams. Its cursor and its legend are ours: both show the place of the mechanism. */
function plotOf(panel, width, height) {
  let { curves, data, same, shape } = plotted(panel);
  const view = cams.map(viewOf)[0];
  const [placeName, placeUnit] = view.kinds[view.place];
  const series = curves.map((one) => ({ label: one.label, stroke: colour(one.colour), dash: one.dash, width: one.width, points: { show: false }, spanGaps: !same }));
  const options = {
    width, height, series: [{}, ...series],
    // Values that are only rounding are drawn as 0.
    scales: { x: { time: false }, y: { range: (_, low, high) => (low === null || high - low < 1e-9 && Math.abs(high) < 1e-9 ? [-1, 1] : uPlot.rangeNum(low, high, 0.1, true)) } },
    axes: axesOf(panel, view),
    cursor: { x: false, y: false, points: { show: false }, drag: { x: true, y: false } },
    legend: { show: false },
    hooks: { setCursor: [(plot) => pointed(plot)] },
  };
  const box = make("figure", { className: "plot", role: "group", "aria-label": panel.title }, make("h3", {}, panel.title));
  const plot = new uPlot(options, data, box);
  const line = make("div", { className: "cursor" });
  plot.over.append(line);
  const legend = make("div", { className: "legend" });
  box.append(legend);
  const place = make("span", { className: "value" });
  legend.append(make("span", { className: "key" }, make("span", {}, placeName), place));
  const ghosts = curves.filter(({ ghost }) => ghost).length;
  const marks = curves.map((curve, index) => {
    const dot = make("div", { className: "dot", style: `background:${colour(curve.colour)}` });
    if (curve.limit === undefined && !curve.ghost) plot.over.append(dot);
    // The grey curves have one line together.
    if (curve.ghost && index > 0) return { dot, value: make("span") };
    const [from, to] = curve.ghost ? [1, ghosts] : [index + 1, index + 1];
    const { entry, value } = legendEntry(curve.ghost ? { ...curve, label: text("sent") } : curve, (on) => {
      for (let at = from; at <= to; at += 1) plot.setSeries(at, { show: on });
      setTimeout(show, 0);
    });
    legend.append(entry);
    return { dot, value };
  });
  const say = (element, words) => {
    if (element.textContent !== words) element.textContent = words;
  };
  const one = { box, plot, draw, update, isSeen: true, waiting: null };

  /** Cursor, dots and legend at the place of the mechanism: of a diagram that is not seen later. */
  function draw() {
    if (!one.isSeen) return;
    const [wide, high] = [plot.bbox.width / uPlot.pxRatio, plot.bbox.height / uPlot.pxRatio];
    const at = placeOf(curves[0].view);
    const left = plot.valToPos(at, "x");
    line.style.transform = `translateX(${left}px)`;
    line.hidden = !(left >= 0 && left <= wide);
    say(place, `${steady(at)} ${placeUnit}`);
    marks.forEach(({ dot, value }, index) => {
      const curve = curves[index];
      if (curve.ghost) return;
      const found = valueAt(curve);
      say(value, found === null ? "–" : `${curve.limit === undefined ? steady(found) : shown(found)} ${curve.unit}`);
      const own = plot.valToPos(placeOf(curve.view), "x");
      const top = found === null ? NaN : plot.valToPos(found, "y");
      dot.hidden = !plot.series[index + 1].show || !(top >= 0 && top <= high && own >= 0 && own <= wide);
      dot.style.transform = `translate(${own}px, ${top}px)`;
    });
  }

  /** The values of another cam; whether its curves are the same ones. */
  function update(other) {
    const found = plotted(other);
    if (found.shape !== shape) return false;
    ({ curves, data } = found);
    plot.setData(data);
    return true;
  }

  seen.observe(box);
  box.camgenPlot = one;
  return one;
}

/** Diagrams that are on the screen are drawn at once, the others when they come there. */
const seen = new IntersectionObserver((entries) => {
  for (const { target, isIntersecting } of entries) {
    const one = target.camgenPlot;
    one.isSeen = isIntersecting;
    if (!isIntersecting) continue;
    if (one.waiting && !one.update(one.waiting)) continue;
    one.waiting = null;
    one.draw();
  }
});
