// SPDX-License-Identifier: MIT
// The targets beside the video: the list, and all of the chosen one; depth, right image, path.

import { clock } from "./model.js";
import { drawPath, hasPath } from "./path.js";
import { leaveKeys } from "./keys.js";
import { listTargets } from "./target_list.js";
import { LOST, NONE, OCCLUDED, STATUS_NAMES } from "./targets.js";
import { complain } from "./toasts.js";

const VIEW_INTERVAL = 200; // milliseconds between pictures of another channel
const get = (id) => document.getElementById(id);

export class Panel {
  #viewed = -1;
  #viewing = null;

  /** act(name, values): sends a command. went(frame): goes to a frame. */
  constructor(model, { act, went }) {
    Object.assign(this, { model, act, went });
    get("target-name").addEventListener("change", (event) => this.#rename(event.target.value));
    get("target-name").addEventListener("keydown", (event) => event.key === "Enter" && event.target.blur());
    get("target-tracker").addEventListener("change", (event) => this.#chooseTracker(event.target.value));
    leaveKeys(get("target-tracker"));
    get("box-set").addEventListener("click", () => this.#setBox());
    get("box").addEventListener("keydown", (event) => event.key === "Enter" && event.target.type === "number" && this.#setBox());
    get("box-erase").addEventListener("click", () => act("erase", { target: model.chosen, frame: model.frame }));
    get("delete").addEventListener("click", () => act("delete", { target: model.chosen }));
    model.addEventListener("state", () => this.update());
    model.addEventListener("choice", () => this.update());
    model.addEventListener("tracks", () => this.#updateTracks());
    model.addEventListener("frame", () => this.#updateFrame());
    new ResizeObserver(() => this.#updateViews()).observe(get("path"));
  }

  update() {
    const { model } = this;
    get("selecting").hidden = !model.state.selecting;
    for (const part of [get("target-tracker").parentElement, get("tracker-about")]) part.hidden = model.state.selecting;
    this.#updateList();
    const target = model.target();
    get("target-name").closest("div").hidden = !target;
    if (!get("target-tracker").options.length) this.#fillTrackers();
    if (document.activeElement !== get("target-name")) get("target-name").value = target?.name ?? "";
    get("target-tracker").value = target?.tracker ?? model.state.tracker;
    get("tracker-about").textContent = model.state.trackers[get("target-tracker").value] ?? "isn't installed here";
    this.#updateTracks();
  }

  /** The tracker that a new target gets. */
  get tracker() {
    return this.model.state.tracker;
  }

  #fillTrackers() {
    const options = Object.keys(this.model.state.trackers).map((name) => new Option(name, name));
    get("target-tracker").replaceChildren(...options);
  }

  #updateList() {
    listTargets(get("targets"), this.model);
    this.#updateNow();
  }

  #updateNow() {
    const { model } = this;
    for (const button of get("targets").querySelectorAll("button")) {
      const id = Number(button.dataset.target), status = model.status(id, model.frame);
      const now = button.querySelector("span");
      now.className = STATUS_NAMES[status];
      now.textContent = status === NONE ? "no box" : status ? STATUS_NAMES[status] : model.score(id, model.frame).toFixed(2);
    }
  }

  #updateTracks() {
    if (!this.model.state) return;
    const { model } = this;
    const troubles = model.chosen === null ? [] : model.troubles(model.chosen);
    get("lost").hidden = !troubles.length;
    const items = troubles.map(([first, last, status]) => {
      const item = document.createElement("li"), button = document.createElement("button");
      const frames = first === last ? `${first}` : `${first} to ${last}`;
      button.textContent = `${frames}  ${clock(model.seconds(first))}`;
      button.className = STATUS_NAMES[status];
      button.setAttribute("aria-label", `${STATUS_NAMES[status]} in frames ${frames}, go there`);
      button.addEventListener("click", () => this.went(first));
      item.append(button);
      return item;
    });
    const before = get("lost-ranges");
    if (before.innerHTML !== items.map((item) => item.outerHTML).join("")) before.replaceChildren(...items);
    this.#updateFrame();
  }

  #updateFrame() {
    const { model } = this;
    if (!model.state) return;
    this.#updateNow();
    const box = model.chosen === null ? null : model.box(model.chosen, model.frame);
    const active = document.activeElement;
    if (!(active?.type === "number" && get("box").contains(active))) {
      ["x", "y", "w", "h"].forEach((name, index) => {
        get(`box-${name}`).value = box ? Math.round(box[index] * 10) / 10 : "";
      });
    }
    get("box-erase").disabled = !box;
    this.#updateViews();
  }

  #updateViews() {
    const { model } = this;
    if (!model.state) return;
    const { channels } = model.state;
    const shown = { depth: channels.includes("depth") && channels.includes("color"), right: channels.includes("right") };
    const path = hasPath(model);
    get("views").hidden = !(shown.depth || shown.right || path);
    for (const name of ["depth", "right"]) get(`view-${name}`).hidden = !shown[name];
    get("view-path").hidden = !path;
    if (path) drawPath(get("path"), model, model.frame);
    if ((shown.depth || shown.right) && this.#viewed !== model.frame && !this.#viewing) {
      this.#viewing = setTimeout(() => {
        this.#viewing = null;
        this.#viewed = model.frame;
        for (const name of ["depth", "right"]) {
          if (shown[name]) get(`view-${name}`).querySelector("img").src = `frame/${model.frame}.jpg?channel=${name}`;
        }
      }, VIEW_INTERVAL);
    }
  }

  async #rename(name) {
    const target = this.model.target();
    if (!target || name === target.name) return;
    if (!(await this.act("rename", { target: target.id, name }))) this.update(); // to the name that it has
  }

  #chooseTracker(tracker) {
    this.model.state.tracker = tracker; // new targets get it, too
    if (this.model.target()) this.act("tracker", { target: this.model.chosen, tracker });
    else this.update();
  }

  #setBox() {
    const { model } = this;
    const box = ["x", "y", "w", "h"].map((name) => get(`box-${name}`).valueAsNumber);
    if (box.some(Number.isNaN)) return complain("box: expected four numbers");
    const where = { frame: model.frame, box };
    document.activeElement.blur();
    if (model.target()) return this.act("draw", { target: model.chosen, ...where });
    return this.act("add", { tracker: this.tracker, ...where });
  }
}
