// Diagrams with a cursor and a legend of their own: both show the place of the mechanism.

/** Curves and their values as uPlot takes them. */
function plottedOf(curves) {
  const lists = curves.map((curve) => [curve.places, curve.values]);
  const same = lists.every(([places]) => places.length === lists[0][0].length);
  return { curves, same, data: same ? [lists[0][0], ...lists.map(([, values]) => values)] : uPlot.join(lists) };
}

const withUnits = (name, unit) => (unit ? `${name}, ${unit}` : name);

/** Most characters beside an axis on paper. */
const LONGEST_ON_PAPER = 18;

/** The axes of a panel; their words are drawn, in the language of the page. */
function axesOf(panel, view, spoken) {
  const [placeName, placeUnit] = view.kinds[view.place];
  const [, unit] = inRates(view, panel.unit, panel.order);
  const font = "12px system-ui, sans-serif";
  const axis = { stroke: colour("ink"), grid: { stroke: colour("faint"), width: 1 }, ticks: { stroke: colour("line"), width: 1 }, font, labelFont: font, labelSize: 18 };
  const turning = view.place.endsWith("_deg") ? { incrs: [5, 10, 15, 30, 45, 60, 90, 120, 180], space: 42 } : {};
  // What the values are, without of what.
  const named = withUnits(spoken(panel.title.split(/ of |,/)[0]), unit);
  // On paper an axis is short.
  const what = isPrinting() && named.length > LONGEST_ON_PAPER ? unit : named;
  const [scaled, along] = inLengths(placeUnit);
  const inShown = scaled === 1 ? {} : { values: (_, splits) => splits.map((value) => shown(value * scaled)) };
  return [{ ...axis, ...turning, ...inShown, size: 30, label: withUnits(spoken(placeName), along) },
    { ...axis, size: 58, label: what, values: (_, splits) => splits.map((value) => (value === null ? "" : shown(value))) }];
}

/** One diagram of the same panel of all cams. Grey curves have no dot, and one line of the legend together. */
function diagramOf(panel, { curves, data, same }, [width, height], spoken = (words) => words) {
  const view = cams.map(viewOf)[0];
  const [placeName, placeIn] = view.kinds[view.place];
  const [placeScale, placeUnit] = inLengths(placeIn);
  const [, unit] = inRates(view, panel.unit, panel.order);
  const series = curves.map((one) => ({ label: one.label, stroke: colour(one.colour), dash: one.dash, width: one.width, pxAlign: 0, points: { show: false }, spanGaps: !same }));
  const options = {
    width, height, series: [{}, ...series],
    // Values that are only rounding are drawn as 0.
    scales: { x: { time: false }, y: { range: (_, low, high) => (low === null || high - low < 1e-9 && Math.abs(high) < 1e-9 ? [-1, 1] : uPlot.rangeNum(low, high, 0.1, true)) } },
    axes: axesOf(panel, view, spoken),
    cursor: { x: false, y: false, points: { show: false }, drag: { x: true, y: false } },
    legend: { show: false },
    hooks: { setCursor: [(plot) => pointed(plot)] },
  };
  const box = make("figure", { className: "plot", role: "group", "aria-label": withUnits(panel.title, unit) }, make("h3", {}, panel.title));
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
    if (curve.ghost && index > 0) return { dot };
    const [from, to] = curve.ghost ? [1, ghosts] : [index + 1, index + 1];
    const { entry, value } = legendEntry(curve.ghost ? { ...curve, label: curve.ghost } : curve, (on) => {
      for (let at = from; at <= to; at += 1) plot.setSeries(at, { show: on });
      setTimeout(show, 0);
    });
    legend.append(entry);
    return { dot, value };
  });
  const write = (element, words) => {
    if (element.textContent !== words) element.textContent = words;
  };

  /** Cursor, dots and legend at the place of the mechanism. */
  function draw() {
    const [wide, high] = [plot.bbox.width / uPlot.pxRatio, plot.bbox.height / uPlot.pxRatio];
    const at = placeOf(curves[0].view);
    const left = plot.valToPos(at, "x");
    line.style.transform = `translateX(${left}px)`;
    line.hidden = !(left >= 0 && left <= wide);
    write(place, `${steady(at * placeScale)} ${placeUnit}`);
    marks.forEach(({ dot, value }, index) => {
      const curve = curves[index];
      if (curve.ghost) return;
      const found = valueAt(curve);
      write(value, found === null ? "–" : `${curve.limit === undefined ? steady(found) : shown(found)} ${curve.unit}`);
      const own = plot.valToPos(placeOf(curve.view), "x");
      const top = found === null ? NaN : plot.valToPos(found, "y");
      dot.hidden = !plot.series[index + 1].show || !(top >= 0 && top <= high && own >= 0 && own <= wide);
      dot.style.transform = `translate(${own}px, ${top}px)`;
    });
  }

  /** Takes the values of other curves of the same shape. */
  function take(other) {
    ({ curves, data } = other);
    plot.setData(data);
  }
  return { box, plot, draw, take };
}

