// A measured table over the lift of the motion: rows of place and lift, with the largest difference.

/** The rows of a table of two columns; lines that are no numbers are headings. A decimal comma is known by another separator. */
function rowsOfTable(words) {
  const points = [];
  for (const line of words.replace(/^\uFEFF/, "").split(/\r?\n/)) {
    const separator = line.includes(";") ? ";" : line.includes("\t") ? "\t" : line.includes(",") && !/,\d+\s+[-+\d]/.test(line) ? "," : /\s+/;
    const cells = line.trim().split(separator).map((cell) => cell.trim());
    const numbers = cells.map((cell) => (cell === "" ? NaN : Number(separator === "," ? cell : cell.replace(",", "."))));
    if (numbers.length >= 2 && Number.isFinite(numbers[0]) && Number.isFinite(numbers[1])) points.push([numbers[0], numbers[1]]);
    else if (points.length && line.trim() && !line.trim().startsWith("#")) return { fault: text("measuredLine", { line: line.slice(0, 60) }) };
  }
  return points.length < 2 ? { fault: text("measuredNone") } : { points };
}

/** The lift at a place: between two rows by the cubic with their velocities, which is exact to fractions of a micrometre. */
function liftAt(view, at) {
  const lanes = lanesOf(view);
  const lift = view.columns[lanes[0].column];
  const velocity = view.columns[lanes.find(({ name }) => name === "velocity")?.column];
  const places = view.columns[view.place];
  const cycle = view.returns ? 0 : 360;
  const place = cycle ? places[0] + ((((at - places[0]) % cycle) + cycle) % cycle) : at;
  if (place < places[0] - 1e-9 || place > places.at(-1) + 1e-9) return null;
  const [index, share] = locate(places, place);
  const [a, b] = [lift[index], lift[index + 1] ?? lift[index]];
  if (a === null || b === null) return null;
  const radians = view.place.endsWith("_deg") ? Math.PI / 180 : 1;
  const width = (places[index + 1] - places[index]) * radians;
  if (!velocity || velocity[index] === null || velocity[index + 1] === null) return a + (b - a) * share;
  const [u, v, rest] = [velocity[index] * width, velocity[index + 1] * width, 1 - share];
  return rest * rest * (1 + 2 * share) * a + share * share * (3 - 2 * share) * b + share * rest * (rest * u - share * v);
}

/** The largest difference of the measured lift from that of the design, where it is, and the root of the mean square. */
function measuredDifference() {
  const view = first();
  let [largest, place, sum, count] = [0, null, 0, 0];
  for (const [at, lift] of doc.measured.points) {
    const own = liftAt(view, at);
    if (own === null) continue;
    const difference = lift - own;
    if (place === null || Math.abs(difference) > Math.abs(largest)) [largest, place] = [difference, at];
    sum += difference * difference;
    count += 1;
  }
  return { largest, place, mean: Math.sqrt(sum / (count || 1)), count };
}

function measuredShown() {
  byId("measured-remove").hidden = !doc.measured;
  if (!doc.measured) {
    byId("measured-said").textContent = "";
    return;
  }
  const view = first();
  const [unit, along] = [view.kinds[lanesOf(view)[0].column][1], view.kinds[view.place][1]];
  const { largest, place, mean, count } = measuredDifference();
  byId("measured-said").textContent = count ? text("measuredSaid", { name: doc.measured.name, count, largest: `${shown(largest, 4)} ${unit}`, place: `${shown(place, ALL_DIGITS)} ${along}`, mean: `${shown(mean, 3)} ${unit}` }) : text("measuredOutside", { name: doc.measured.name });
}

async function takeMeasured(file) {
  const found = rowsOfTable(await file.text());
  if (found.fault) {
    doc.measured = null;
    byId("measured-said").textContent = `${file.name}: ${found.fault}`;
    byId("measured-remove").hidden = true;
  } else {
    doc.measured = { name: file.name, points: found.points };
    measuredShown();
  }
  motionCurves(doc.last);
}

function listenToMeasured() {
  byId("measured").addEventListener("change", ({ target }) => {
    if (target.files.length) takeMeasured(target.files[0]);
    target.value = "";
  });
  byId("measured-remove").addEventListener("click", () => {
    doc.measured = null;
    measuredShown();
    motionCurves(doc.last);
  });
  const area = byId("motion");
  area.addEventListener("dragover", (event) => {
    event.preventDefault();
    area.classList.add("over");
  });
  area.addEventListener("dragleave", () => area.classList.remove("over"));
  area.addEventListener("drop", (event) => {
    event.preventDefault();
    area.classList.remove("over");
    if (event.dataTransfer.files.length) takeMeasured(event.dataTransfer.files[0]);
  });
}
