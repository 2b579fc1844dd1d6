// The workers of a page by itself: one that draws, one that runs machines. What a worker does
// is stopped by ending it; another stands up from the same compiled module.

const said = document.getElementById("saved");
said.textContent = "loading";
const module = await (async () => {
  const bytes = await fetch(new URL("slowlight.wasm", import.meta.url));
  if (!bytes.ok) throw new Error("slowlight.wasm: " + bytes.status);
  return WebAssembly.compile(await bytes.arrayBuffer());
})().catch((error) => {
  said.textContent = "this page cannot begin: " + error;
  throw error;
});
said.textContent = "";

// A worker; `told` hears its messages, and of its end where it broke.
export class Crew {
  constructor(told) {
    this.told = told;
    this.doing = null;
    this.begin();
  }

  begin() {
    const worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    worker.onmessage = ({ data }) => {
      // What an ended worker had said before its end is of no wish.
      if (this.worker !== worker) return;
      const of = this.doing;
      if (data.done !== undefined || data.broken !== undefined) this.doing = null;
      if (data.broken !== undefined) this.stop();
      this.told(data, of);
    };
    // What ends a worker outside of a task: it could not be loaded, or what it said not be read.
    const ended = (event) => {
      if (this.worker !== worker) return;
      const of = this.doing;
      event.preventDefault();
      // Only where it had begun with something is another one likely to get as far.
      if (of) this.stop();
      this.told({ broken: event.message || "a worker ended" }, of);
    };
    worker.onerror = ended;
    worker.onmessageerror = ended;
    worker.postMessage({ module });
    this.worker = worker;
  }

  // Does something; whoever asks has seen that nothing is being done. `before`: the stage that
  // its end leads back to.
  does(task, wish, before) {
    this.doing = { task, serial: wish.run?.serial ?? wish.serial, panel: wish.run?.panel, before };
    this.worker.postMessage({ task, wish: JSON.stringify(wish) });
  }

  // Ends what is being done.
  stop() {
    this.worker.terminate();
    this.doing = null;
    this.begin();
  }
}
