// SPDX-License-Identifier: MIT
// The frame with the boxes in it, where boxes are drawn, moved and resized.

import { LOST, OCCLUDED, STATUS_NAMES } from "./targets.js";
import { drawTrail } from "./trail.js";

const HANDLE = 7; // pixels of the screen, half a handle's side
const TOUCH_HANDLE = 18; // how far from a corner a finger may be
const MIN_BOX = 3; // pixels of the frame; less is a click
const MAX_ZOOM = 24;
const CORNERS = [[0, 0], [1, 0], [1, 1], [0, 1]];

export class Stage {
  #image = null;
  #shown = -1; // the frame of that image
  #drag = null;
  #pointers = new Map();
  #zoom = 1;
  #middle = [0.5, 0.5]; // of what is seen, as shares of the frame
  #due = false;
  coarse = false;
  trail = false; // whether the targets' trails are drawn

  /** drawn(frame, box, target): called when the user has drawn a box, with the id of the target that was chosen
   * at the press, null for none. clicked(id): called when the user has clicked a target's box. held(frame): called
   * with the frame in which someone begins to draw, and with null when that is over. refused(): called after a
   * drag or a click during a run, when no box can be drawn. */
  constructor(canvas, model, { drawn, clicked, held = () => {}, refused = () => {} }) {
    Object.assign(this, { canvas, model, drawn, clicked, held, refused });
    new ResizeObserver(() => this.draw()).observe(canvas);
    canvas.addEventListener("pointerdown", (event) => this.#press(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => this.#release(event));
    canvas.addEventListener("pointercancel", (event) => this.#cancel(event));
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    for (const name of ["state", "tracks", "choice"]) model.addEventListener(name, () => this.draw());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  get shown() {
    return this.#shown;
  }

  /** The picture of that frame, null if there is none. */
  get image() {
    return this.#image;
  }

  /** Whether someone is drawing in the picture. */
  get busy() {
    return Boolean(this.#drag) && this.#drag.kind !== "view";
  }

  /** Show a frame's picture, null for a frame that has none. coarse: whether it may have fewer pixels than the frame. */
  show(frame, image, coarse = false) {
    this.#image = image;
    this.coarse = coarse;
    this.#shown = frame;
    this.draw();
  }

  /** Zoom in or out around the middle; 0 shows the whole frame. */
  zoomBy(factor, [x, y] = this.#middleOfCanvas()) {
    if (!this.#image) return;
    const before = this.#toFrame(x, y);
    this.#zoom = factor === 0 ? 1 : Math.min(Math.max(this.#zoom * factor, 1), MAX_ZOOM);
    const after = this.#toFrame(x, y);
    const [width, height] = this.model.state.size;
    this.#middle[0] += (before[0] - after[0]) / width;
    this.#middle[1] += (before[1] - after[1]) / height;
    this.#bound();
    this.draw();
  }

  cancel() {
    this.#letGo(null);
    this.draw();
  }

  draw() {
    if (this.#due) return;
    this.#due = true;
    requestAnimationFrame(() => {
      this.#due = false;
      this.#paint();
    });
  }

  #middleOfCanvas() {
    return [this.canvas.clientWidth / 2, this.canvas.clientHeight / 2];
  }

  #bound() {
    const half = 0.5 / this.#zoom;
    this.#middle = this.#middle.map((value) => Math.min(Math.max(value, half), 1 - half));
  }

  /** Screen pixels per pixel of the frame, and where the frame's corner is. */
  #view() {
    const [width, height] = this.model.state.size;
    const { clientWidth, clientHeight } = this.canvas;
    const scale = Math.min(clientWidth / width, clientHeight / height) * this.#zoom;
    return {
      scale,
      left: clientWidth / 2 - this.#middle[0] * width * scale,
      top: clientHeight / 2 - this.#middle[1] * height * scale,
    };
  }

  #toFrame(x, y) {
    const { scale, left, top } = this.#view();
    return [(x - left) / scale, (y - top) / scale];
  }

  #at(event) {
    const { left, top } = this.canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  #inside([x, y]) {
    const [width, height] = this.model.state.size;
    return [Math.min(Math.max(x, 0), width), Math.min(Math.max(y, 0), height)];
  }

  /** A box somewhere else, a part of it still inside. */
  #movedBy([x, y, width, height], right, down) {
    const [across, high] = this.model.state.size;
    const clamp = (value, side, whole) => Math.min(Math.max(value, MIN_BOX - side), whole - MIN_BOX);
    return [clamp(x + right, width, across), clamp(y + down, height, high), width, height];
  }

  // Drawing

  #press(event) {
    if (!this.model.state || !this.#image || event.button > 1) return;
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    this.#pointers.set(event.pointerId, this.#at(event));
    if (this.#pointers.size > 1 || event.button === 1) {
      this.#letGo({ kind: "view", zoom: this.#zoom });
      return this.draw();
    }
    if (this.model.state.run) return;
    const frame = this.#shown, target = this.model.chosen;
    this.held(frame);
    const at = this.#at(event), start = this.#toFrame(...at);
    const box = event.shiftKey ? null : this.#own(); // with Shift a box is always drawn anew
    const reach = event.pointerType === "touch" ? TOUCH_HANDLE : HANDLE + 3;
    const corner = box ? this.#cornerAt(box, at, reach) : -1;
    if (corner >= 0) {
      const [across, down] = CORNERS[(corner + 2) % 4];
      const fixed = [box[0] + across * box[2], box[1] + down * box[3]];
      this.#drag = { kind: "draw", frame, target, start: fixed, box: [...box], moved: false, from: at };
    } else if (box && within(box, start)) {
      this.#drag = { kind: "move", frame, target, start, first: [...box], box: [...box], moved: false, from: at };
    } else {
      this.#drag = { kind: "draw", frame, target, start: this.#inside(start), box: null, moved: false, from: at };
    }
  }

  /** End the drawing, if there is one, for another drag or none. */
  #letGo(drag) {
    const busy = this.busy;
    this.#drag = drag;
    if (busy) this.held(null);
  }

  #move(event) {
    const at = this.#at(event);
    if (!this.#drag) return this.#point(at);
    const before = this.#pointers.get(event.pointerId);
    if (!before) return;
    if (this.#drag.kind === "view") return this.#moveView(event, before, at);
    this.#pointers.set(event.pointerId, at);
    const drag = this.#drag;
    drag.moved ||= Math.hypot(at[0] - drag.from[0], at[1] - drag.from[1]) > 3;
    if (!drag.moved) return;
    const here = this.#toFrame(...at);
    if (drag.kind === "move") {
      drag.box = this.#movedBy(drag.first, here[0] - drag.start[0], here[1] - drag.start[1]);
    } else {
      const [x, y] = this.#inside(here);
      const [left, top] = drag.start;
      drag.box = [Math.min(x, left), Math.min(y, top), Math.abs(x - left), Math.abs(y - top)];
    }
    this.draw();
  }

  #moveView(event, before, at) {
    const others = [...this.#pointers].filter(([id]) => id !== event.pointerId).map(([, where]) => where);
    this.#pointers.set(event.pointerId, at);
    const { scale } = this.#view();
    const [width, height] = this.model.state.size;
    const share = 1 / (others.length + 1);
    this.#middle[0] -= ((at[0] - before[0]) * share) / (scale * width);
    this.#middle[1] -= ((at[1] - before[1]) * share) / (scale * height);
    this.#bound();
    if (others.length) {
      const [other] = others;
      const spread = (from) => Math.max(Math.hypot(from[0] - other[0], from[1] - other[1]), 1);
      const center = [(at[0] + other[0]) / 2, (at[1] + other[1]) / 2];
      this.zoomBy(spread(at) / spread(before), center);
    }
    this.draw();
  }

  #release(event) {
    this.#pointers.delete(event.pointerId);
    const drag = this.#drag;
    if (!drag) {
      if (this.model.state?.run) this.refused();
      return;
    }
    if (drag.kind === "view") {
      if (!this.#pointers.size) this.#drag = null;
      return;
    }
    this.#drag = null;
    if (drag.moved && drag.box && drag.box[2] >= MIN_BOX && drag.box[3] >= MIN_BOX) {
      this.drawn(drag.frame, drag.box.map((value) => Math.round(value * 10) / 10), drag.target);
    } else if (!drag.moved) {
      this.clicked(this.#targetAt(this.#toFrame(...this.#at(event))));
      this.held(null);
    } else {
      this.held(null);
    }
    this.draw();
  }

  #cancel(event) {
    this.#pointers.delete(event.pointerId);
    this.cancel();
  }

  #wheel(event) {
    event.preventDefault();
    this.zoomBy(Math.exp(-event.deltaY / 400), this.#at(event));
  }

  #point(at) {
    const box = this.#own();
    let cursor = "crosshair";
    if (this.model.state?.run) cursor = "default";
    else if (box) {
      const corner = this.#cornerAt(box, at, HANDLE + 3);
      if (corner >= 0) cursor = corner % 2 ? "nesw-resize" : "nwse-resize";
      else if (within(box, this.#toFrame(...at))) cursor = "move";
    }
    this.canvas.style.cursor = cursor;
  }

  /** The chosen target's box in the frame shown. */
  #own() {
    return this.model.chosen === null ? null : this.model.box(this.model.chosen, this.#shown);
  }

  #cornerAt(box, [x, y], reach) {
    const { scale, left, top } = this.#view();
    const found = CORNERS.map(([across, down]) =>
      Math.max(
        Math.abs(left + (box[0] + across * box[2]) * scale - x),
        Math.abs(top + (box[1] + down * box[3]) * scale - y),
      ),
    );
    const nearest = found.indexOf(Math.min(...found));
    return found[nearest] <= reach ? nearest : -1;
  }

  #targetAt(point) {
    const hit = this.model.state.targets.filter((each) => {
      const box = this.model.box(each.id, this.#shown);
      return box && within(box, point);
    });
    hit.sort((a, b) => area(this.model.box(a.id, this.#shown)) - area(this.model.box(b.id, this.#shown)));
    return hit.length ? hit[0].id : null;
  }

  // Painting

  #paint() {
    const ratio = devicePixelRatio || 1;
    const { canvas, model } = this;
    const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    if (!this.#image || !model.state) return;
    const { scale, left, top } = this.#view();
    const [across, down] = model.state.size;
    pen.imageSmoothingEnabled = scale < 3;
    pen.imageSmoothingQuality = "high";
    pen.drawImage(this.#image, left, top, across * scale, down * scale);
    if (this.trail) {
      const place = (x, y) => [left + x * scale, top + y * scale];
      for (const { id } of model.state.targets) drawTrail(pen, model, id, this.#shown, place);
    }
    const drag = this.#drag?.box ? this.#drag : null;
    for (const target of model.state.targets) {
      if (drag?.target === target.id) continue;
      const box = model.box(target.id, this.#shown);
      if (box) this.#paintBox(pen, box, target, target.id === model.chosen);
    }
    if (drag) this.#paintBox(pen, drag.box, model.target(drag.target), true, true);
  }

  #paintBox(pen, box, target, own, drawing = false) {
    const { model } = this;
    const { scale, left, top } = this.#view();
    const at = [left + box[0] * scale, top + box[1] * scale, box[2] * scale, box[3] * scale];
    const status = drawing || !target ? 0 : model.status(target.id, this.#shown);
    const color = target ? model.color(target.id) : "#ffffff";
    pen.setLineDash(status === LOST ? [2, 5] : status === OCCLUDED ? [8, 5] : []);
    pen.lineJoin = "round";
    for (const [ink, thickness] of [["rgb(0 0 0 / 0.65)", own ? 5 : 4], [color, own ? 2.5 : 2]]) {
      pen.strokeStyle = ink;
      pen.lineWidth = thickness;
      pen.strokeRect(...at);
    }
    pen.setLineDash([]);
    if (own && !model.state.run) this.#paintHandles(pen, at, color);
    if (target) this.#paintLabel(pen, at, target, status, color, drawing);
  }

  #paintHandles(pen, [x, y, width, height], color) {
    pen.strokeStyle = "rgb(0 0 0 / 0.65)";
    pen.lineWidth = 1.5;
    for (const [across, down] of CORNERS) {
      pen.fillStyle = color;
      pen.beginPath();
      pen.arc(x + across * width, y + down * height, HANDLE - 2, 0, 2 * Math.PI);
      pen.fill();
      pen.stroke();
    }
  }

  #paintLabel(pen, [x, y, , height], target, status, color, drawing) {
    const drawn = target.drawn.includes(this.#shown);
    const what = drawing ? "" : status ? STATUS_NAMES[status] : drawn ? "drawn" : this.model.score(target.id, this.#shown).toFixed(2);
    const text = what ? `${target.name}  ${what}` : target.name;
    pen.font = "600 12px system-ui, sans-serif";
    const width = pen.measureText(text).width + 10;
    const left = Math.min(Math.max(x, 2), Math.max(this.canvas.clientWidth - width - 2, 2));
    const over = y - 24 > 2 ? y - 24 : Math.min(y + height + 8, this.canvas.clientHeight - 22);
    pen.fillStyle = "rgb(8 11 16 / 0.8)";
    pen.beginPath();
    pen.roundRect(left, over, width, 18, 4);
    pen.fill();
    pen.fillStyle = color;
    pen.textBaseline = "middle";
    pen.fillText(text, left + 5, over + 9.5);
  }
}

function within([x, y, width, height], [px, py]) {
  return px >= x && px < x + width && py >= y && py < y + height;
}

function area([, , width, height]) {
  return width * height;
}
