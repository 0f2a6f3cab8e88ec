// SPDX-License-Identifier: MIT
// A lane for each target: its status and score over the frames, its drawn boxes; a click goes there.

import { clock } from "./model.js";
import { LOST, NONE, OCCLUDED, STATUS_NAMES } from "./targets.js";

const RULER = 18, LANE = 22, GAP = 3; // pixels
const MAX_HEIGHT = 190; // unless lanes and gaps are as thin as can be
const MIN_LANE = 2, MIN_GAP = 1;
const STEPS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 30, 60, 120, 300, 600, 1800]; // seconds between marks

export class Timeline {
  #due = false;

  /** went(frame): called when the user has gone to a frame. */
  constructor(canvas, model, went) {
    Object.assign(this, { canvas, model, went });
    new ResizeObserver(() => this.draw()).observe(canvas);
    for (const name of ["state", "tracks", "frame", "choice"]) model.addEventListener(name, () => this.draw());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    canvas.addEventListener("pointerdown", (event) => {
      canvas.focus({ preventScroll: true }); // what is being written is done before another target is chosen
      canvas.setPointerCapture(event.pointerId);
      this.#go(event, true);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (canvas.hasPointerCapture(event.pointerId)) this.#go(event, false);
    });
  }

  draw() {
    if (this.#due) return;
    this.#due = true;
    requestAnimationFrame(() => {
      this.#due = false;
      if (this.model.state) this.#paint();
    });
  }

  #go(event, pressed) {
    const { left, top } = this.canvas.getBoundingClientRect();
    const share = (event.clientX - left) / this.canvas.clientWidth;
    const [height, gap] = this.#lane();
    const lane = Math.floor((event.clientY - top - RULER) / (height + gap));
    const target = this.model.state.targets[lane];
    if (pressed && target && event.clientY - top > RULER) this.model.choose(target.id);
    this.went(Math.floor(share * this.model.state.frames));
  }

  /** The height of a lane, and of the gap below it. */
  #lane() {
    const each = (MAX_HEIGHT - RULER) / Math.max(this.model.state.targets.length, 1);
    const gap = each < 9 ? MIN_GAP : GAP;
    return [Math.max(MIN_LANE, Math.min(LANE, each - gap)), gap];
  }

  #paint() {
    const { canvas, model } = this;
    const ratio = devicePixelRatio || 1;
    const { targets, frames } = model.state;
    const [lane, gap] = this.#lane();
    const height = RULER + Math.max(targets.length, 1) * (lane + gap);
    canvas.style.height = `${height}px`;
    const width = canvas.clientWidth;
    Object.assign(canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.ink = getComputedStyle(canvas);
    this.#paintRuler(pen, width);
    if (!targets.length) this.#paintEmpty(pen, width, lane);
    targets.forEach((target, index) => this.#paintLane(pen, target, RULER + index * (lane + gap), width, lane));
    const at = ((model.frame + 0.5) / frames) * width;
    pen.fillStyle = this.#color("--ink");
    pen.fillRect(at - 0.75, 0, 1.5, height);
    pen.beginPath();
    pen.moveTo(at - 6, 0);
    pen.lineTo(at + 6, 0);
    pen.lineTo(at, 8);
    pen.fill();
    this.#label();
  }

  #color(name) {
    return this.ink.getPropertyValue(name);
  }

  #paintRuler(pen, width) {
    const { model } = this;
    const { frames, fps } = model.state;
    const whole = model.seconds(frames - 1) + 1 / fps;
    const step = STEPS.find((each) => (each / whole) * width > 64) ?? 3600;
    pen.fillStyle = this.#color("--soft");
    pen.font = "11px system-ui, sans-serif";
    pen.textBaseline = "middle";
    let free = 0; // from where on nothing is written yet
    for (let time = 0; time < whole; time += step) {
      const frame = model.frameAt(time), begin = model.seconds(frame);
      const end = frame + 1 < frames ? model.seconds(frame + 1) : whole;
      const at = ((frame + Math.min((time - begin) / (end - begin), 1)) / frames) * width;
      pen.fillRect(at, 10, 1, RULER - 12);
      const text = clock(time, step < 1 ? 1 : 0);
      const right = at + pen.measureText(text).width + 6;
      if (at < free || right >= width) continue;
      pen.fillText(text, at + 4, 8);
      free = right;
    }
  }

  #paintEmpty(pen, width, lane) {
    pen.fillStyle = this.#color("--ground");
    pen.fillRect(0, RULER, width, lane);
  }

  #paintLane(pen, target, top, width, height) {
    const { model } = this;
    const { frames } = model.state;
    const tracks = model.tracks.get(target.id);
    pen.fillStyle = this.#color(target.id === model.chosen ? "--press" : "--ground");
    pen.fillRect(0, top, width, height);
    if (tracks) this.#paintTracks(pen, tracks, model.color(target.id), top, width, height, frames);
    pen.fillStyle = this.#color("--ink");
    pen.strokeStyle = this.#color("--panel");
    pen.lineWidth = 1;
    const side = Math.min(5, height / 2 + 2); // of a drawn box's mark, half of it
    for (const frame of target.drawn) {
      const x = Math.min(Math.max(((frame + 0.5) / frames) * width, 6), width - 6), y = top + height / 2;
      pen.beginPath();
      pen.moveTo(x, y - side);
      pen.lineTo(x + side, y);
      pen.lineTo(x, y + side);
      pen.lineTo(x - side, y);
      pen.closePath();
      pen.fill();
      pen.stroke();
    }
    if (target.id === model.chosen) {
      pen.strokeStyle = this.#color("--mark");
      pen.strokeRect(0.5, top + 0.5, width - 1, height - 1);
    }
  }

  /** A column of the screen shows the worst that is in its frames, so that nothing lost is overlooked. */
  #paintTracks(pen, tracks, color, top, width, height, frames) {
    const lost = this.#color("--lost"), hidden = this.#color("--hidden");
    const columns = Math.ceil(width);
    for (let column = 0; column < columns; column++) {
      const from = Math.floor((column / columns) * frames);
      const to = Math.max(from + 1, Math.floor(((column + 1) / columns) * frames));
      let worst = NONE, sum = 0, count = 0;
      for (let at = from; at < to; at++) {
        const status = tracks.status[at];
        if (status === NONE) continue;
        worst = worst === NONE ? status : Math.max(worst, status);
        sum += tracks.score[at];
        count++;
      }
      if (!count) continue;
      if (worst === LOST) {
        pen.fillStyle = lost;
        pen.fillRect(column, top, 1, height);
      } else if (worst === OCCLUDED) {
        pen.fillStyle = hidden;
        if (column % 4 < 2) pen.fillRect(column, top, 1, height);
      } else {
        const high = Math.max(0.15, sum / count) * height;
        pen.globalAlpha = 0.85;
        pen.fillStyle = color;
        pen.fillRect(column, top + height - high, 1, high);
        pen.globalAlpha = 1;
      }
    }
  }

  #label() {
    const { canvas, model } = this;
    const { frames } = model.state;
    canvas.setAttribute("aria-valuemax", frames - 1);
    canvas.setAttribute("aria-valuenow", model.frame);
    const target = model.target();
    const status = target ? STATUS_NAMES[model.status(target.id, model.frame)] || "no box" : "";
    const text = `frame ${model.frame} of ${frames - 1}, ${clock(model.seconds(model.frame))}`;
    canvas.setAttribute("aria-valuetext", target ? `${text}, ${target.name}: ${status}` : text);
  }
}
