// The desk of a page that slowlight serves: asks it for news, and sends what is wanted, the
// newest only. A page by itself has another desk with the same names (web/src/alone.js).

// This page's own name, so that it is not told its own edits.
export const me = crypto.randomUUID();

// Asks for something that stands below the page's address.
export async function get(path) {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(await answer.text());
  return answer.json();
}

// Wants something done; answers what became of it, and throws where nobody answers.
async function send(path, body) {
  const answer = await fetch(path, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
  });
  return { ok: answer.ok, status: answer.status, said: await answer.json().catch(() => ({})) };
}

// The same; that nobody answers is said by what follows the news.
export const post = (path, body = {}) => send(path, body).catch(() => ({ ok: false, status: 0, said: {} }));

let pending = null;
let sending = false;

// Wants something else of the picture; of several before the first is sent, the last stands.
export async function want(change) {
  pending = { ...pending, ...change };
  if (sending) return;
  sending = true;
  while (pending) {
    const next = pending;
    pending = null;
    try {
      await send("edit", { page: me, ...next });
    } catch {
      // It does not answer: what follows the news says so. The wish is kept.
      pending = { ...next, ...pending };
      await pause(1000);
    }
  }
  sending = false;
}

// Whether something is still to be sent.
export const isSending = () => sending;

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

// Tells each news, and `null` where nobody answers.
export async function follow(told) {
  let version = 0;
  for (;;) {
    try {
      const answer = await fetch("state?after=" + version);
      if (answer.status === 204) continue;
      if (!answer.ok) throw new Error(String(answer.status));
      const news = await answer.json();
      version = news.version;
      told(news.shown);
    } catch {
      told(null);
      await pause(1000);
    }
  }
}

// The address of a picture, whose number is another with each.
export const picture = (name, number) => name + "?" + number;

// What a page has that stands by itself: scenes, a link, files to save. None here.
export const alone = null;
