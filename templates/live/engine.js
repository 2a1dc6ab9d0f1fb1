// One call, two engines: the library in this page, or the program that serves it. A request is an object, an answer has files of bytes.

const live = JSON.parse(byId("live").textContent);

/** An answer out of its bytes: a length, so much JSON, then the files. */
function answerOf(bytes) {
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
  const answer = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  let from = 4 + length;
  for (const file of answer.files) {
    file.bytes = bytes.slice(from, from + file.size);
    from += file.size;
  }
  return answer;
}

/** What runs in the worker, behind fzstd: it holds the engine, and makes a new one where a run ends in a trap. */
function workerMain() {
  let compiled = null;
  let engine = null;
  /** The bytes in a text of five characters for four of them, behind the number of those that are too many. */
  const packed = (text) => {
    const digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%()*+,-./:;=?@[]^_|~";
    const values = new Uint8Array(128);
    [...digits].forEach((digit, value) => (values[digit.charCodeAt(0)] = value));
    const view = new DataView(new ArrayBuffer(((text.length - 1) / 5) * 4));
    for (let at = 1, to = 0; at < text.length; to += 4) {
      let value = 0;
      for (const end = at + 5; at < end; at += 1) value = value * 85 + values[text.charCodeAt(at)];
      view.setUint32(to, value);
    }
    return new Uint8Array(view.buffer, 0, view.byteLength - Number(text[0]));
  };
  const run = (request) => {
    // What crates below the engine would ask of a browser is never called.
    const missing = () => { throw new Error("not to be had here"); };
    const imports = {};
    for (const { module, name } of WebAssembly.Module.imports(compiled)) (imports[module] ??= {})[name] = missing;
    engine ??= new WebAssembly.Instance(compiled, imports).exports;
    const asked = new TextEncoder().encode(request);
    const room = engine.room(asked.length);
    new Uint8Array(engine.memory.buffer, room, asked.length).set(asked);
    const size = engine.run();
    return new Uint8Array(engine.memory.buffer, engine.answer(), size).slice();
  };
  self.onmessage = async ({ data }) => {
    if (data.start) {
      compiled = await WebAssembly.compile(fzstd.decompress(packed(data.start)));
      self.postMessage({ ready: true });
      return;
    }
    try {
      const bytes = run(data.request);
      self.postMessage({ id: data.id, bytes, memory: engine.memory.buffer.byteLength }, [bytes.buffer]);
    } catch (error) {
      engine = null;
      self.postMessage({ id: data.id, error: String(error) });
    }
  };
}

/** The memory of the engine, bytes. */
let engineMemory = 0;

/** An engine in this page; of the first one the memory is told. */
function ownEngine(isFirst = true) {
  const source = URL.createObjectURL(new Blob([byId("unpack").textContent, `;\n(() => { "use strict"; (${workerMain})(); })();`], { type: "text/javascript" }));
  const worker = new Worker(source);
  const waiting = new Map();
  let count = 0;
  let started = null;
  const ready = new Promise((resolve) => (started = resolve));
  worker.onmessage = ({ data }) => {
    if (data.ready) return started();
    const { resolve, reject } = waiting.get(data.id);
    waiting.delete(data.id);
    if (isFirst && data.memory && data.memory !== engineMemory) document.documentElement.dataset.engineMemory = engineMemory = data.memory;
    if (data.error) reject(new Error(data.error));
    else resolve(answerOf(data.bytes));
  };
  worker.postMessage({ start: byId("engine").textContent });
  return async (request) => {
    await ready;
    return new Promise((resolve, reject) => {
      count += 1;
      waiting.set(count, { resolve, reject });
      worker.postMessage({ id: count, request: JSON.stringify(request) });
    });
  };
}

/** A request to the program that serves this page. */
async function served(path, body) {
  const answer = await fetch(path, { method: "POST", headers: { "X-Camgen-Token": live.token, "Content-Type": "application/json" }, body: JSON.stringify(body) });
  if (!answer.ok) throw new Error(`${answer.status} ${await answer.text()}`);
  return new Uint8Array(await answer.arrayBuffer());
}

const engine = live.token ? async (request) => answerOf(await served("/engine", request)) : ownEngine();
