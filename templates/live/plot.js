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
      return value === null || value === undefined ? (own.curvature && place ? 0 : null) : own.curvature ? factor / value : value * factor;
    });
    return { label: `${text("sent")}: ${label}`, unit, view, places, values, colour: "ghost", dash: [], width: 2.6, ghost: text("sent") };
  });
}

/** The curves of a panel, the grey ones first, with what they have to have in common to be drawn in the place of others. */
function plotted(panel) {
  const own = curvesOf(panel);
  const all = plottedOf([...(cams.length > 1 ? [] : ghostsOf(panel, own)), ...own]);
  const shape = JSON.stringify([all.same, panel.id, all.curves.map(({ label, unit, dash, colour: name }) => [label, unit, dash, name])]);
  return { ...all, shape };
}

/** One diagram of the same panel of all cams, which takes other values. */
function plotOf(panel, width, height) {
  const begun = plotted(panel);
  const made = diagramOf(panel, begun, [width, height], spoken);
  const one = { box: made.box, plot: made.plot, isSeen: true, waiting: null, draw() {
    // Of a diagram that is not seen later.
    if (one.isSeen) made.draw();
  }, update(other) {
    // Whether the curves of another cam are the same ones.
    const found = plotted(other);
    if (found.shape !== begun.shape) return false;
    made.take(found);
    return true;
  } };
  seen.observe(one.box);
  one.box.camgenPlot = one;
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
