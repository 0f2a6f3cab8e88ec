// SPDX-License-Identifier: MIT
// What the page of a camera knows: the server's state, the tracks of the last frames, and what is chosen.

import { LOST, NONE, Targets } from "./targets.js";

const KEPT = 900; // frames

/** Tells by the events "state", "tracks" and "choice" what has changed. */
export class LiveModel extends Targets {
  frame = -1; // of the last tracks
  #frames = new Map(); // by number: seconds, and the targets' rows

  setState(state) {
    if (this.state && this.state.phase !== state.phase && state.phase === "connecting") this.#frames.clear();
    super.setState(state);
  }

  /** frames: [number, seconds, rows by target]. */
  addFrames(frames) {
    for (const [number, seconds, rows] of frames) {
      this.#frames.set(number, { seconds, rows });
      this.frame = number;
    }
    while (this.#frames.size > KEPT) this.#frames.delete(this.#frames.keys().next().value);
    this.tell("tracks");
  }

  seconds(frame) {
    return this.#frames.get(frame)?.seconds ?? NaN;
  }

  box(id, frame) {
    return this.#track(id, frame)?.box ?? null;
  }

  status(id, frame) {
    return this.#track(id, frame)?.status ?? NONE;
  }

  score(id, frame) {
    return this.#track(id, frame)?.score ?? 0;
  }

  /** The distance or the position of a target in words, "" where it isn't known. */
  place(id, frame) {
    const track = this.#track(id, frame);
    return !track?.place.length || track.status === LOST ? "" : `${track.place[2].toFixed(2)} m`;
  }

  /** Whether it is known where a target is in a frame. */
  known(id, frame) {
    return ![NONE, LOST].includes(this.status(id, frame));
  }

  /** The frames from a time up to one, rising. */
  framesUpTo(frame, seconds) {
    return [...this.#frames.keys()].filter((at) => at <= frame && this.seconds(at) >= seconds);
  }

  #track(id, frame) {
    const row = this.#frames.get(frame)?.rows[id];
    if (!row) return null;
    const [, status, score, x, y, width, height, ...place] = row;
    return { status, score, box: [x, y, width, height], place };
  }
}
