/** One diagram of the same panel of all cams. Its cursor and its legend are ours: both show the place of the mechanism. */
function plotOf(panel, width, height) {
  const curves = curvesOf(panel);
  const view = cams.map(viewOf)[0];
  const lists = curves.map((curve) => [curve.places, curve.values]);
  const same = lists.every(([places]) => places.length === lists[0][0].length);
  const data = same ? [lists[0][0], ...lists.map(([, values]) => values)] : uPlot.join(lists);
  const series = curves.map((one) => ({ label: one.label, stroke: colour(one.colour), dash: one.dash, width: one.width, points: { show: false }, spanGaps: !same }));
  const turning = view.place.endsWith("_deg");
  const [placeName, placeUnit] = view.kinds[view.place];
  const [, unit] = inRates(view, panel.unit, panel.order);
  const withUnits = (name, of) => (of ? `${name}, ${of}` : name);
  const font = "12px system-ui, sans-serif";
  const axis = { stroke: colour("ink"), grid: { stroke: colour("faint"), width: 1 }, ticks: { stroke: colour("line"), width: 1 }, font, labelFont: font, labelSize: 18 };
  const options = {
    width, height, series: [{}, ...series],
    // Values that are only rounding are drawn as 0.
    scales: { x: { time: false }, y: { range: (_, low, high) => (low === null || high - low < 1e-9 && Math.abs(high) < 1e-9 ? [-1, 1] : uPlot.rangeNum(low, high, 0.1, true)) } },
    axes: [{ ...axis, ...(turning ? { incrs: [5, 10, 15, 30, 45, 60, 90, 120, 180], space: 42 } : {}), size: 30, label: withUnits(placeName, placeUnit) },
      // What the values are, without of what.
      { ...axis, size: 58, label: isPrinting() ? unit : withUnits(panel.title.split(/ of |,/)[0], unit), values: (_, splits) => splits.map((value) => (value === null ? "" : shown(value))) }],
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
  const marks = curves.map((curve, index) => {
    const dot = make("div", { className: "dot", style: `background:${colour(curve.colour)}` });
    if (curve.limit === undefined) plot.over.append(dot);
    const { entry, value } = legendEntry(curve, (on) => {
      plot.setSeries(index + 1, { show: on });
      setTimeout(show, 0);
    });
    legend.append(entry);
    return { curve, dot, value };
  });

  /** Cursor, dots and legend at the place of the mechanism. */
  function draw() {
    const at = placeOf(view);
    const left = plot.valToPos(at, "x");
    line.style.transform = `translateX(${left}px)`;
    line.hidden = left < 0 || left > plot.over.clientWidth;
    place.textContent = `${steady(at)} ${placeUnit}`;
    marks.forEach(({ curve, dot, value }, index) => {
      const found = valueAt(curve);
      value.textContent = found === null ? "–" : `${curve.limit === undefined ? steady(found) : shown(found)} ${curve.unit}`;
      const own = plot.valToPos(placeOf(curve.view), "x");
      const top = found === null ? NaN : plot.valToPos(found, "y");
      dot.hidden = !plot.series[index + 1].show || !(top >= 0 && top <= plot.over.clientHeight && own >= 0 && own <= plot.over.clientWidth);
      dot.style.transform = `translate(${own}px, ${top}px)`;
    });
  }
  return { box, plot, draw };
}

