// SPDX-License-Identifier: MIT
// The server: commands to it, and what it tells by itself.

/** Send a command; its answer, or an Error with the server's words. */
export async function command(name, values = {}) {
  let response;
  try {
    response = await fetch("do", { method: "POST", body: JSON.stringify({ do: name, ...values }) });
  } catch {
    throw new Error("the server doesn't answer");
  }
  const answer = await response.json().catch(() => ({ error: `the server answers ${response.status}` }));
  if (answer.error) throw new Error(answer.error);
  return answer;
}

/** Keep a connection; `hear` gets messages, `show` pictures (frame, Blob), `status` whether it is there, `tell`
 * what sends a message. */
export function listen({ hear, show, status, tell = () => {} }) {
  const url = new URL("live", location.href);
  url.protocol = "ws:";
  const socket = new WebSocket(url);
  socket.binaryType = "arraybuffer";
  const send = (message) => socket.readyState === WebSocket.OPEN && socket.send(JSON.stringify(message));
  socket.onopen = () => {
    tell(send);
    status(true);
  };
  socket.onmessage = async ({ data }) => {
    if (typeof data === "string") return hear(JSON.parse(data));
    const frame = new DataView(data).getUint32(0, true);
    await show(frame, new Blob([data.slice(4)], { type: "image/jpeg" }));
    send({ shown: frame });
  };
  socket.onclose = () => {
    status(false);
    setTimeout(() => listen({ hear, show, status, tell }), 1500);
  };
}

const MAX_KEPT = 48; // pictures

/** Pictures of frames, fetched one at a time; of several that are wanted meanwhile, only the last. */
export class Pictures {
  #kept = new Map();
  #coming = new Map();

  /** The picture of a frame as an ImageBitmap; an Error with the server's words. */
  get(frame) {
    const kept = this.#kept.get(frame);
    if (kept) return Promise.resolve(kept);
    if (!this.#coming.has(frame)) {
      this.#coming.set(frame, this.#fetch(frame).finally(() => this.#coming.delete(frame)));
    }
    return this.#coming.get(frame);
  }

  async #fetch(frame) {
    const response = await fetch(`frame/${frame}.jpg`);
    if (!response.ok) throw new Error((await response.json()).error);
    const image = await createImageBitmap(await response.blob());
    this.#kept.set(frame, image);
    if (this.#kept.size > MAX_KEPT) this.#kept.delete(this.#kept.keys().next().value);
    return image;
  }
}
