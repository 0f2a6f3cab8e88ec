// SPDX-License-Identifier: MIT
// What the page knows: the server's state, the tracks of each target, and what is looked at.

import { LOST, NONE, OCCLUDED, Targets } from "./targets.js";

/** The tracks of one target, by frame. */
class Tracks {
  constructor(frames) {
    this.status = new Uint8Array(frames).fill(NONE);
    this.score = new Float32Array(frames);
    this.boxes = new Float32Array(4 * frames);
    this.places = new Float32Array(3 * frames).fill(NaN);
    this.placed = false; // whether any has a position
  }

  put(rows) {
    for (const [at, status, score, x, y, width, height, ...place] of rows) {
      this.status[at] = status;
      this.score[at] = score;
      this.boxes.set([x, y, width, height], 4 * at);
      this.placed ||= place.length > 0 && place[0] !== null;
      this.places.set(place.length ? place.map((value) => value ?? NaN) : [NaN, NaN, NaN], 3 * at);
    }
  }

  box(at) {
    return this.status[at] === NONE ? null : this.boxes.subarray(4 * at, 4 * at + 4);
  }

  place(at) {
    const place = this.places.subarray(3 * at, 3 * at + 3);
    return Number.isNaN(place[0]) ? null : place;
  }
}

/** Tells by the events "state", "tracks", "frame" and "choice" what has changed. */
export class Model extends Targets {
  frame = 0;
  times = [];
  tracks = new Map();

  setState(state) {
    for (const id of this.tracks.keys()) if (!state.targets.some((each) => each.id === id)) this.tracks.delete(id);
    super.setState(state);
  }

  setTracks(id, rows, whole) {
    if (whole || !this.tracks.has(id)) this.tracks.set(id, new Tracks(this.state.frames));
    this.tracks.get(id).put(rows);
    this.tell("tracks");
  }

  go(frame) {
    const last = this.state.frames - 1;
    const to = Math.min(Math.max(Math.round(frame) || 0, 0), last);
    if (to === this.frame) return;
    this.frame = to;
    this.tell("frame");
  }

  seconds(frame) {
    return this.times[frame] ?? frame / this.state.fps;
  }

  /** The last frame up to a time; the first one before it. */
  frameAt(seconds) {
    let first = 0, beyond = this.state.frames;
    while (beyond - first > 1) {
      const middle = (first + beyond) >> 1;
      if (this.seconds(middle) <= seconds) first = middle;
      else beyond = middle;
    }
    return first;
  }

  box(id, frame) {
    return this.tracks.get(id)?.box(frame) ?? null;
  }

  status(id, frame) {
    return this.tracks.get(id)?.status[frame] ?? NONE;
  }

  score(id, frame) {
    return this.tracks.get(id)?.score[frame] ?? 0;
  }

  /** Whether it is known where a target is in a frame. */
  known(id, frame) {
    return ![NONE, LOST].includes(this.status(id, frame));
  }

  /** The frames from a time up to one, rising. */
  framesUpTo(frame, seconds) {
    let first = frame;
    while (first > 0 && this.seconds(first - 1) >= seconds) first--;
    return Array.from({ length: frame - first + 1 }, (_, index) => first + index);
  }

  /** The ranges [first, last, status] in which a target is lost or occluded. */
  troubles(id) {
    const status = this.tracks.get(id)?.status ?? [];
    const found = [];
    for (let at = 0; at < status.length; at++) {
      if (status[at] !== LOST && status[at] !== OCCLUDED) continue;
      const last = found[found.length - 1];
      if (last && last[1] === at - 1 && last[2] === status[at]) last[1] = at;
      else found.push([at, at, status[at]]);
    }
    return found;
  }
}

/** Seconds as 1:02.35, or 1:01:02.35 from an hour on; with so many decimals. */
export function clock(seconds, decimals = 2) {
  const unit = 10 ** decimals, whole = Math.max(0, Math.round(seconds * unit));
  const minutes = Math.floor(whole / unit / 60) % 60, hours = Math.floor(whole / unit / 3600);
  const two = (value) => String(value).padStart(2, "0");
  const head = hours ? `${hours}:${two(minutes)}` : minutes;
  const rest = decimals ? `.${String(whole % unit).padStart(decimals, "0")}` : "";
  return `${head}:${two(Math.floor(whole / unit) % 60)}${rest}`;
}
