// The design as sent next to the present one: curves and outline in grey, and figures that differ.

/** The view of the design as sent that belongs to one of the present cam. */
const ghostOf = (view) => (doc.sentCam && doc.sentCam.views[Math.min(doc.sentCam.views.length - 1, Math.max(0, cams[0].views.indexOf(view)))]) ?? null;

/** The outlines of the design as sent, in the picture of the present one and moving with it. */
function withGhost(view) {
  // Nothing is behind a design that has not changed.
  const before = cams.length === 1 && (doc.past.length || isDragging) ? ghostOf(view)?.parts.filter(({ role }) => role === "cam") ?? [] : [];
  const own = view.parts.filter(({ role }) => role === "cam");
  if (before.length !== own.length) return;
  const ghosts = own.map((part, index) => ({ ...part, role: "sent", name: null, path: before[index].path }));
  view.parts.splice(view.parts.indexOf(own.at(-1)) + 1, 0, ...ghosts);
}

/** What differs from the design as sent: figures, and checks with their values. */
function differences() {
  if (cams.length > 1 || !doc.sentCam) {
    byId("compare").hidden = true;
    return;
  }
  const both = [doc.sentCam, cams[0]];
  const changed = both[0].sections.some((section) => JSON.stringify(section.values) !== JSON.stringify(cams[0].sections.find(({ key }) => key === section.key)?.values));
  byId("compare").hidden = !doc.past.length && !changed;
  if (byId("compare").hidden) return;
  const figures = sectionsBeside(both);
  for (const row of figures.querySelectorAll("tbody tr:not(.differs)")) row.remove();
  for (const box of figures.querySelectorAll(":scope > div")) if (!box.querySelector("tbody tr")) box.remove();
  for (const head of figures.querySelectorAll("thead tr")) ["sent", "present", "difference"].forEach((name, index) => (head.children[index + 1].textContent = text(name)));
  const checks = checksThatDiffer(both);
  const any = checks || figures.querySelector("tbody tr");
  byId("differences").replaceChildren(...(any ? [checks, figures].filter(Boolean) : [make("p", {}, text("same"))]));
}

/** The checks whose values differ, with the difference. */
function checksThatDiffer([before, present]) {
  const rows = present.checks.flatMap((check) => {
    const old = before.checks.find((other) => other.check === check.check);
    if (!old || (old.value === check.value && old.verdict === check.verdict)) return [];
    const both = [old, check].flatMap((one) => [[badge(one.verdict)], [withUnit(one.value, one.unit), "number"]]);
    const difference = old.value === null || check.value === null ? "" : withUnit(check.value - old.value, check.unit);
    return [{ className: "differs", cells: [[words(check.check)], ...both, [difference, "number difference"]] }];
  });
  return rows.length ? table([["Check"], [text("sent")], ["", "number"], [text("present")], ["", "number"], [text("difference"), "number"]], rows) : null;
}
