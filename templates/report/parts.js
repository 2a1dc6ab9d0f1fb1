// Parts of a mechanism and their names at the places of their samples.

/** Another value of an attribute, where it differs. */
function put(element, name, value) {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}

/** The least and the largest pressure of a part that has one. */
const pressuresOf = ({ pressure }) => (Array.isArray(pressure) ? [Math.min(...pressure), Math.max(...pressure)] : null);

const captionOf = (cam, index) => [letter(index) && `${letter(index)}: ${cam.title}.`, ...cam.pictureNotes].filter(Boolean).join(" ");

/** Half of the width of each name. */
function measureNames(moving) {
  for (const one of moving) if (one.name) one.room = one.name.getBBox().width / 2;
}

/** Of names that would overlap or touch the first is kept. */
function unravel(moving, pixel) {
  const kept = [];
  for (const { name } of moving) {
    if (!name) continue;
    const own = name.getBBox();
    const gap = 5 * pixel;
    const over = (other) => own.x < other.x + other.width + gap && other.x < own.x + own.width + gap && own.y < other.y + other.height && other.y < own.y + own.height;
    const hidden = kept.some(over);
    name.style.visibility = hidden ? "hidden" : "";
    if (!hidden) kept.push(own);
  }
}

/** Every part of a view at its place in a picture. */
function placeParts(moving, view, [left, , wide]) {
  const sample = locate(view.turn, turnOf(view));
  const of = (track) => (Array.isArray(track) ? between(track, sample) : track);
  // Names are larger on paper.
  if (isPrinting()) measureNames(moving);
  for (const { part, group, name, range, room } of moving) {
    const [x, y] = [of(part.x), -of(part.y)];
    put(group, "transform", `translate(${x} ${y}) rotate(${-of(part.turn)}) scale(${of(part.stretch)} ${of(part.height ?? 1)})`);
    if (name) {
      // A name at the edge is not cut.
      put(name, "x", String(Math.max(left + room, Math.min(left + wide - room, x + part.name[1]))));
      put(name, "y", String(y + part.name[2]));
    }
    // Pale at ambient pressure, deep at the largest.
    if (range) group.style.fillOpacity = 0.1 + 0.75 * ((of(part.pressure) - range[0]) / (range[1] - range[0] || 1));
  }
}

