// SPDX-License-Identifier: MIT
// The server: commands to it, and what it tells by itself.

/** Send a command; its answer, or an Error with the server's words. */
export async function command(name, values = {}) {
  const response = await ask("do", { method: "POST", body: JSON.stringify({ do: name, ...values }) });
  const answer = await response.json().catch(() => ({ error: `the server answered with status ${response.status}` }));
  if (answer.error) throw new Error(answer.error);
  return answer;
}

function ask(path, options = {}) {
  return fetch(path, options).catch(() => {
    throw new Error("the server doesn't answer");
  });
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

const MAX_BYTES = 256 << 20; // of pictures
const FEWEST = 3; // pictures, however large

/** Pictures of frames, fetched one at a time, and kept while there is room for them. */
export class Pictures {
  #kept = new Map(); // by frame, those wanted last at the end
  #coming = new Map();

  /** inUse(image): whether an image that is kept no longer is still shown. */
  constructor(inUse) {
    this.inUse = inUse;
  }

  /** The picture of a frame as an ImageBitmap; an Error with the server's words. */
  get(frame) {
    const kept = this.#kept.get(frame);
    if (kept) {
      this.#keep(frame, kept);
      return Promise.resolve(kept);
    }
    if (!this.#coming.has(frame)) {
      this.#coming.set(frame, this.#fetch(frame).finally(() => this.#coming.delete(frame)));
    }
    return this.#coming.get(frame);
  }

  async #fetch(frame) {
    const response = await ask(`frame/${frame}.jpg`);
    if (!response.ok) throw new Error((await response.json()).error);
    const image = await createImageBitmap(await response.blob());
    this.#keep(frame, image);
    return image;
  }

  #keep(frame, image) {
    this.#kept.delete(frame);
    this.#kept.set(frame, image);
    const most = Math.max(FEWEST, MAX_BYTES / (4 * image.width * image.height));
    while (this.#kept.size > most) {
      const [oldest, gone] = this.#kept.entries().next().value;
      this.#kept.delete(oldest);
      if (!this.inUse(gone)) gone.close();
    }
  }
}
