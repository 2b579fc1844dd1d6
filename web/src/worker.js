// A worker of a page by itself: compiler and machines, which answer one wish at a time.

import { initSync, Worker, about } from "./slowlight.js";

let worker = null;

const told = {
  shown: (json) => postMessage({ shown: JSON.parse(json) }),
  bytes: (name, bytes) => postMessage({ name, bytes }),
  file: (name, bytes) => postMessage({ file: name, bytes }),
};

onmessage = ({ data }) => {
  if (data.module) {
    initSync({ module: data.module });
    worker = new Worker();
    return;
  }
  try {
    if (data.task === "about") postMessage({ done: JSON.parse(about()) });
    else if (data.task === "draw") postMessage({ done: worker.draw(data.wish, told) });
    else postMessage({ done: worker.work(data.task, data.wish, told) ?? null });
  } catch (error) {
    postMessage({ broken: String(error) });
  }
};
