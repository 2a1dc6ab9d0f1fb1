// The surface of a cam whose sections differ: quadrangles painted from the back to the front.

function solidView(cam, index) {
  const canvas = make("canvas", { tabIndex: 0, role: "img", "aria-label": `Solid of ${cam.title}; the arrow keys turn it` });
  const caption = make("figcaption", {},
    "Coloured from the slowest section (blue) to the fastest (red); lines are the sections, the thick one is shown above. Drag or use the arrow keys to turn it.");
  const figure = make("figure", { style: "margin:0" }, cams.length > 1 ? make("h3", {}, letter(index)) : null, canvas, caption);
  const { rings, sections } = cam.solid;
  const count = rings[0].points.length / 2;
  const [low, high] = [rings[0].z, rings[rings.length - 1].z];
  const middle = (low + high) / 2;
  let radius = (high - low) / 2;
  for (const ring of rings) {
    for (let i = 0; i < count; i += 1) radius = Math.max(radius, Math.hypot(ring.points[2 * i], ring.points[2 * i + 1]));
  }
  let [yaw, tilt] = [-0.6, 1.05];
  let visible = true;

  /** The ring at a place along the axis. */
  function ringAt(z) {
    const [at, share] = locate(rings.map((ring) => ring.z), z);
    return rings[at].points.map((value, i) => value + (rings[at + 1].points[i] - value) * share);
  }

  function draw() {
    if (!visible) return;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (width === 0) return;
    if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
    if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const size = (0.44 * Math.min(width, height)) / radius;
    const turn = yaw;
    const [cy, sy, ct, st] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
    // The axis upwards, tilted towards the eye.
    const seen = (x, y, z) => {
      const [a, b, c] = [x * cy - y * sy, x * sy + y * cy, z - middle];
      return [width / 2 + size * a, height / 2 - size * (c * st + b * ct), b * st - c * ct];
    };
    const points = rings.map((ring) => {
      const all = [];
      for (let i = 0; i < count; i += 1) all.push(seen(ring.points[2 * i], ring.points[2 * i + 1], ring.z));
      return all;
    });
    const faces = [];
    const share = (z) => Math.min(1, Math.max(0, (z - sections[0][1]) / (sections[sections.length - 1][1] - sections[0][1] || 1)));
    for (let r = 0; r + 1 < rings.length; r += 1) {
      const t = share((rings[r].z + rings[r + 1].z) / 2);
      for (let i = 0; i < count; i += 1) {
        const j = (i + 1) % count;
        const [a, b, c, d] = [points[r][i], points[r][j], points[r + 1][j], points[r + 1][i]];
        const area = (c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]);
        if (area > 0) continue;
        // Light from the eye: oblique faces are darker.
        const edge = Math.hypot(b[0] - a[0], b[1] - a[1], size * (b[2] - a[2])) * Math.hypot(d[0] - a[0], d[1] - a[1], size * (d[2] - a[2]));
        const light = 0.45 + 0.55 * Math.min(1, Math.abs(area) / (2 * edge || 1));
        const mix = (from, to) => Math.round((from + (to - from) * t) * light);
        faces.push([(a[2] + c[2]) / 2, [a, b, c, d], `rgb(${mix(90, 225)},${mix(150, 105)},${mix(225, 90)})`]);
      }
    }
    faces.sort((a, b) => b[0] - a[0]);
    const cap = ct >= 0 ? rings.length - 1 : 0;
    const paint = (corners, fill) => {
      context.beginPath();
      corners.forEach((p, i) => (i ? context.lineTo(p[0], p[1]) : context.moveTo(p[0], p[1])));
      context.closePath();
      context.fillStyle = fill;
      context.strokeStyle = fill;
      context.lineWidth = 0.7;
      context.fill();
      context.stroke();
    };
    for (const [, corners, fill] of faces) paint(corners, fill);
    context.beginPath();
    points[cap].forEach((p, i) => (i ? context.lineTo(p[0], p[1]) : context.moveTo(p[0], p[1])));
    context.closePath();
    if (cam.solid.bore) {
      for (let i = 0; i <= 60; i += 1) {
        const angle = (-2 * Math.PI * i) / 60;
        const p = seen(cam.solid.bore * Math.cos(angle), cam.solid.bore * Math.sin(angle), rings[cap].z);
        if (i) context.lineTo(p[0], p[1]);
        else context.moveTo(p[0], p[1]);
      }
    }
    context.fillStyle = colour("metal");
    context.strokeStyle = colour("metal-edge");
    context.lineWidth = 1;
    context.fill("evenodd");
    context.stroke();
    sections.forEach(([, z], at) => {
      const ring = ringAt(z);
      const [band] = locate(rings.map((one) => one.z), z);
      context.beginPath();
      for (let i = 0; i < count; i += 1) {
        // Only where the surface faces the eye.
        const j = (i + 1) % count;
        const [a, b, c, d] = [points[band][i], points[band][j], points[band + 1][j], points[band + 1][i]];
        if ((c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]) > 0) continue;
        const [p, q] = [seen(ring[2 * i], ring[2 * i + 1], z), seen(ring[2 * j], ring[2 * j + 1], z)];
        context.moveTo(p[0], p[1]);
        context.lineTo(q[0], q[1]);
      }
      context.lineWidth = at === state.section ? 3 : 1;
      context.strokeStyle = colour("ink");
      context.stroke();
    });
  }

  let from = null;
  const turnBy = (x, y) => {
    yaw += x;
    tilt = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, tilt + y));
    draw();
  };
  canvas.addEventListener("pointerdown", (event) => {
    from = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!from) return;
    turnBy((event.clientX - from[0]) * 0.01, -(event.clientY - from[1]) * 0.01);
    from = [event.clientX, event.clientY];
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => (from = null));
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    if (!step) return;
    turnBy(...step);
    event.preventDefault();
    event.stopPropagation();
  });
  new ResizeObserver(draw).observe(canvas);
  return { figure, draw };
}
