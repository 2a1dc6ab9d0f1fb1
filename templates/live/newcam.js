// A new cam by a few numbers: follower and body by pictures, its motion as far as the body leaves it free, and what limits it.

/** Followers: the keys of their tables, what their travel is measured in, and a picture. */
const FOLLOWERS = {
  roller: { keys: ['radius = "12 mm"'], unit: "mm", picture: "M30 4V18M26 8H34M30 18a7 7 0 1 0 .01 0M10 40a22 14 0 0 1 40 0" },
  "swinging-roller": { keys: ['radius = "12 mm"', 'arm = "110 mm"', 'pivot_distance = "140 mm"'], unit: "deg", picture: "M8 12L34 22M5 16L8 12L11 16ZM34 16a7 7 0 1 0 .01 0M14 42a22 14 0 0 1 40 0" },
  flat: { keys: [], unit: "mm", picture: "M30 4V24M16 24H44V28H16ZM10 44a22 16 0 0 1 40 0" },
  "swinging-flat": { keys: ['pivot_distance = "200 mm"'], unit: "deg", picture: "M8 18L52 24M5 22L8 18L11 22ZM12 42a22 16 0 0 1 40 0" },
  knife: { keys: [], unit: "mm", picture: "M30 4V18M25 18H35L30 28ZM10 44a22 16 0 0 1 40 0" },
};
/** What the motion of a body is given by: a rise, a dwell and a return in a turn; others below. */
const IN_A_TURN = ["rise", "riseOver", "dwellOver", "returnOver", "rpm"];
/** Bodies: the followers that they have, their keys, whether they have no bore, the numbers of their motion where these are others, and a picture. */
const BODIES = {
  disc: { of: ["roller", "swinging-roller", "flat", "swinging-flat", "knife"], keys: ['base_radius = "auto"', 'thickness = "15 mm"'], picture: "M30 2C46 2 54 14 50 26C46 38 38 42 30 42C18 42 12 34 12 24C12 12 18 2 30 2ZM30 20a5 5 0 1 0 .01 0" },
  ring: { of: ["roller", "swinging-roller"], keys: ['base_radius = "auto"', 'thickness = "15 mm"'], open: true, picture: "M30 1a21 21 0 1 0 .01 0M30 8C40 8 46 14 44 24C42 34 38 36 30 36C20 36 16 30 16 22C16 14 22 8 30 8ZM30 28a4 4 0 1 0 .01 0" },
  groove: { of: ["roller", "swinging-roller"], keys: ['base_radius = "auto"', 'thickness = "24 mm"', 'groove_depth = "14 mm"', 'clearance = "0.04 mm"'], picture: "M30 1a21 21 0 1 0 .01 0M30 5C42 5 48 14 46 24C44 34 38 39 30 39C20 39 14 32 14 22C14 12 20 5 30 5ZM30 12C36 12 41 17 39 24C37 30 36 32 30 32C24 32 21 28 21 22C21 16 24 12 30 12Z" },
  conjugate: { of: ["roller", "swinging-roller"], keys: ['base_radius = "auto"', 'thickness = "15 mm"'], counter: true, picture: "M24 6C38 6 46 14 42 26C38 36 32 40 24 40C14 40 8 32 8 24C8 12 14 6 24 6ZM36 8C48 8 54 18 52 26C50 36 44 40 36 40" },
  rib: { of: ["roller", "swinging-roller"], keys: ['base_radius = "auto"', 'thickness = "24 mm"', 'roller_distance = "34 mm"'], open: true, picture: "M30 4C44 4 50 14 47 25C44 36 38 40 30 40C19 40 13 32 13 23C13 12 19 4 30 4ZM30 8C41 8 46 15 43 24C41 33 36 36 30 36C22 36 17 30 17 23C17 14 22 8 30 8ZM52 10a5 5 0 1 0 .01 0M36 14a4 4 0 1 0 .01 0" },
  yoke: { of: ["roller", "flat"], keys: ['base_radius = "auto"', 'thickness = "15 mm"'], numbers: ["rise", "riseOver", "rpm"], most: 180, picture: "M8 5H52V41H8ZM30 5C41 5 45 14 43 24C41 34 38 41 30 41C20 41 16 34 17 24C18 14 20 5 30 5ZM30 20a4 4 0 1 0 .01 0" },
  wedge: { of: ["roller", "knife"], keys: ['run_in = "25 mm"', 'thickness = "16 mm"'], open: true, along: "mm", numbers: ["rise", "riseOver", "dwellOver", "returnOver"], most: Infinity, picture: "M4 42V37C24 37 26 30 34 25C40 21 44 20 56 20V42ZM13 22a7 7 0 1 0 .01 0M13 4V22M9 10H17M36 10H52M47 5L52 10L47 15" },
  barrel: { of: ["roller", "swinging-roller"], keys: ['outer_radius = "auto"', 'groove_depth = "12 mm"', 'roller_height = "11 mm"', 'clearance = "0.03 mm"'], picture: "M10 8H50V38H10ZM4 20H10V26H4ZM50 20H56V26H50ZM18 8C22 20 38 24 40 38M24 8C28 20 44 22 46 34" },
  globoid: { of: ["roller"], keys: ['rests_on = "rib"', 'groove_depth = "17 mm"', 'roller_height = "16 mm"', 'clearance = "0.02 mm"'], numbers: ["stations", "riseOver", "rpm"], picture: "M4 4H26C19 16 19 30 26 42H4C10 30 10 16 4 4ZM9 15L20 20M9 25L20 30M56 4A20 20 0 0 0 56 42M36 23H26M40 12L31 7M40 34L31 39M52 23a3 3 0 1 0 .01 0" },
};
/** Keys of the limits that can be given at once. */
const NEW_LIMITS = ["pressure_angle", "min_convex_radius", "size", "wall", "contact_stress"];
const NEW_NUMBERS = [["stations", 8], ["rise", 30], ["riseOver", 120], ["dwellOver", 60], ["returnOver", 100], ["rpm", 250]];
/** What a new cam may have besides: the mass or inertia that moves, and a spring; each with its unit on a straight path and on an arm, and the bodies that have it. */
const NEW_LOADS = [["moving", "kg", "kg*m2"], ["rate", "N/mm", "N*m/rad"], ["preload", "N", "N*m"]];
const WITH_SPRING = ["disc", "wedge"];
/** Arms of followers, mm; that of a flat one reaches to the camshaft. */
const ARMS = { "swinging-roller": 110, "swinging-flat": 200 };

/** The turret of an indexer with so many stations: rollers 55 mm or more from each other, and so far from the cam that its pressure angle is below 43° at the inner ends of the rollers. */
function turretOf({ stations, riseOver, law }) {
  const arm = Math.max(50, Math.round((55 * stations) / (2 * Math.PI)));
  const velocity = keyTable.laws.find(({ name }) => name === law).peaks[0];
  const inner = arm + 8;
  const distance = inner + inner * velocity * (360 / stations / riseOver) / Math.tan((43 * Math.PI) / 180);
  return [`rollers = ${stations}`, `arm = "${arm} mm"`, `turret_distance = "${Math.ceil(Math.max(arm + 50, distance))} mm"`];
}

/** The tables of the motion: of a yoke the first half turn, of an indexer one station, of a wedge its travel out. */
function motionOfNew({ body, law, rise, riseOver, dwellOver, returnOver, rpm }, unit, top) {
  const { along = "deg", numbers = IN_A_TURN } = BODIES[body];
  const segment = (name, over, to) => `[[motion.segment]]\nlaw = "${name}"\n${over === null ? "" : `over = "${over} ${along}"\n`}${to === null ? "" : `to = "${to} ${unit}"\n`}`;
  const rest = (comment) => `${segment("dwell", null, null).trimEnd()}  # the rest of ${comment}\n`;
  const returns = numbers.includes("returnOver");
  const head = along === "mm" ? `stroke = "${riseOver + dwellOver + returnOver} mm"` : `rpm = ${rpm}`;
  const first = segment(law, riseOver, top);
  const segments = !returns ? [first, riseOver < (body === "yoke" ? 180 : 360) ? rest(body === "yoke" ? "the half turn" : "the turn") : null] : [
    first, dwellOver > 0 ? segment("dwell", dwellOver, null) : null, returnOver > 0 ? segment(law, returnOver, 0) : null,
    along === "deg" && riseOver + dwellOver + returnOver < 360 ? rest("the turn") : null,
  ];
  return [`[motion]\n${head}\nstart = "0 ${unit}"\n`, ...segments.filter(Boolean)];
}

/** The text of a machine file for what the form says. */
function textOfNew(asked) {
  const { follower, body, rise, stations, limits, loads = {} } = asked;
  const isTurret = body === "globoid";
  const own = BODIES[body];
  const unit = isTurret ? "deg" : FOLLOWERS[follower].unit;
  // An arm swings by the angle whose arc is the rise; a turret to its next station.
  const arm = ARMS[follower];
  const swing = isTurret ? 360 / stations : (rise / arm) * (180 / Math.PI);
  const top = arm || isTurret ? Number(swing.toFixed(isTurret ? 12 : 3)) : rise;
  // The arm of a barrel's roller has its pivot where the roller stays near the middle of the cylinder.
  const keys = FOLLOWERS[follower].keys.map((key) => (body === "barrel" ? key.replace(/pivot_distance.*/, `pivot_distance = "${arm} mm"`) : key));
  const keysOfCam = [...own.keys, ...(isTurret ? turretOf(asked) : []), ...(own.open ? [] : ['bore_radius = "10 mm"']), 'material = "steel"'];
  const tables = [
    ...motionOfNew(asked, unit, top),
    `[follower.${follower}]\n${keys.map((key) => `${key}\n`).join("")}${loads.moving ? `${ARMS[follower] ? "inertia" : "mass"} = "${loads.moving}"\n` : ""}`,
    loads.rate || loads.preload ? `[spring]\n${["rate", "preload"].filter((key) => loads[key]).map((key) => `${key} = "${loads[key]}"\n`).join("")}` : null,
    `[cam]\nbody = "${body}"\n${keysOfCam.map((key) => `${key}\n`).join("")}`,
    own.counter ? '[cam.counter]\nradius = "12 mm"\n' : null,
    `[limits]\n${limits.map(([key, value]) => `${key} = "${value}"\n`).join("")}`,
  ];
  return `# A cam begun in the live page of camgen.\n\nname = "New cam"\n\n${tables.filter(Boolean).join("\n")}`;
}

/** Radio buttons with pictures. */
function pictured(id, choices, chosenName) {
  const cards = Object.entries(choices).map(([name, { picture: path }]) => {
    const svg = makeSvg("svg", { viewBox: "0 0 60 46", "aria-hidden": "true" });
    svg.append(makeSvg("path", { d: path }));
    return make("label", { className: "picture" }, make("input", { type: "radio", name: `new-${id}`, id: `new-${id}-${name}`, value: name, checked: name === chosenName }), svg, make("span", {}, text(name)));
  });
  return make("fieldset", {}, make("legend", {}, text(id)), ...cards);
}

/** The language of the form for a new cam. */
let formsOf = "";

function newCam() {
  formsOf = language;
  const number = ([id, value]) => make("label", {}, make("span"), " ", make("input", { id: `new-${id}`, type: "text", inputMode: "decimal", value: String(value), size: 6, required: true }));
  const limit = (key) => make("label", { title: aboutOf("limits", key) }, `${text(`limit_${key}`)} `, make("input", { id: `new-limit-${key}`, type: "text", size: 9 }));
  const load = ([id]) => make("label", {}, make("span"), " ", make("input", { id: `new-${id}`, type: "text", size: 8, placeholder: "–" }));
  const laws = make("select", { id: "new-law" }, ...keyTable.laws.map(({ name }) => make("option", { value: name }, name)));
  laws.value = "modified-sine";
  const go = make("button", { type: "submit", id: "new-make" }, text("make"));
  const form_ = make("form", {}, make("h3", {}, text("newCam")), pictured("follower", FOLLOWERS, "roller"), pictured("body", BODIES, "disc"),
    make("fieldset", { className: "row" }, make("legend", {}, text("motion")), ...NEW_NUMBERS.map(number), make("label", {}, `${text("law")} `, laws)),
    make("fieldset", { className: "row" }, make("legend", {}, text("massAndSpring")), ...NEW_LOADS.map(load)),
    make("fieldset", { className: "row" }, make("legend", {}, text("limits")), ...NEW_LIMITS.map(limit), make("p", { className: "muted" }, text("limitsHelp"))),
    make("p", { className: "row" }, go, make("span", { id: "new-fault", role: "alert" })));
  form_.noValidate = true;
  form_.addEventListener("change", () => fitBodies(form_));
  form_.addEventListener("submit", (event) => {
    event.preventDefault();
    const asked = askedOf(form_);
    byId("new-fault").textContent = asked.fault ?? "";
    if (asked.fault) return;
    byId("gallery").hidden = true;
    openDesign({ name: "new-cam", toml: textOfNew(asked), command: "make", commands: ["make"] });
  });
  byId("new").replaceChildren(form_);
  fitBodies(form_);
}

/** What a key of a table means. */
const aboutOf = (path, name) => keyTable.sections.find((section) => section.path === path)?.keys.find((key) => key.name === name)?.about ?? "";

/** Only bodies that the follower has can be chosen, and only the numbers of the body's motion are asked for. */
function fitBodies(form_) {
  const follower = new FormData(form_).get("new-follower");
  for (const [name, { of }] of Object.entries(BODIES)) {
    const input = byId(`new-body-${name}`);
    input.disabled = !of.includes(follower);
    if (input.disabled && input.checked) byId("new-body-disc").checked = true;
  }
  const { along = "deg", numbers = IN_A_TURN } = BODIES[new FormData(form_).get("new-body")];
  for (const [id] of NEW_NUMBERS) {
    const label = byId(`new-${id}`).parentElement;
    label.hidden = !numbers.includes(id);
    label.firstElementChild.textContent = text(id === "riseOver" && numbers.includes("stations") ? "stepOver" : id, { along: text(along) });
  }
  const body = new FormData(form_).get("new-body");
  for (const [id, straight, arm] of NEW_LOADS) {
    const label = byId(`new-${id}`).parentElement;
    label.hidden = body === "globoid" || (id !== "moving" && !WITH_SPRING.includes(body));
    label.firstElementChild.textContent = `${text(id !== "moving" ? `key_spring.${id}` : ARMS[follower] ? "inertia" : "mass")}, ${(ARMS[follower] ? arm : straight).replace(/\*/g, "·").replace("m2", "m²")}`;
  }
  usualLimits(form_);
}

/** Shows in each empty limit the one that holds without it. */
async function usualLimits(form_) {
  const asked = askedOf(form_);
  if (asked.fault) return;
  const { usual = {} } = await engine({ task: "text", toml: textOfNew({ ...asked, limits: [] }) }).catch(() => ({}));
  for (const key of NEW_LIMITS) byId(`new-limit-${key}`).placeholder = usual[`limits.${key}`] ?? "–";
}

/** What the form says, or what is wrong with it. */
function askedOf(form_) {
  const data = new FormData(form_);
  const asked = { follower: data.get("new-follower"), body: data.get("new-body"), law: byId("new-law").value };
  const { along, numbers = IN_A_TURN, most = 360 } = BODIES[asked.body];
  // A plate need not return within its travel out.
  const mayBeNone = ["dwellOver", ...(along ? ["returnOver"] : [])];
  for (const id of numbers) {
    asked[id] = Number(byId(`new-${id}`).value.trim().replace(",", ".") || NaN);
    if (!(asked[id] > 0 || (mayBeNone.includes(id) && asked[id] === 0))) return { fault: text("notNumber", { name: byId(`new-${id}`).previousElementSibling.textContent }) };
  }
  if (numbers.includes("stations") && !(Number.isInteger(asked.stations) && asked.stations >= 4 && asked.stations <= 60)) return { fault: text("notStations") };
  const sum = asked.riseOver + (asked.dwellOver ?? 0) + (asked.returnOver ?? 0);
  if (sum > most) return { fault: text(numbers === IN_A_TURN ? "overTurn" : "overPart", { sum: shown(sum), most }) };
  asked.loads = Object.fromEntries(NEW_LOADS.map(([id, straight, arm]) => {
    const value = byId(`new-${id}`).value.trim().replace(/"/g, "").replace(",", ".");
    return [id, byId(`new-${id}`).parentElement.hidden || !value ? "" : Number.isFinite(Number(value)) ? `${value} ${ARMS[asked.follower] ? arm : straight}` : value];
  }));
  asked.limits = NEW_LIMITS.map((key) => [key, byId(`new-limit-${key}`).value.trim().replace(/"/g, "")]).filter(([, value]) => value);
  return asked;
}
