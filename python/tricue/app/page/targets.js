// SPDX-License-Identifier: MIT
// What the pages of recordings and of cameras both know: the server's state, its targets, and which one is chosen.

export const TRACKED = 0, OCCLUDED = 1, LOST = 2, NONE = 255;
export const STATUS_NAMES = { [TRACKED]: "tracked", [OCCLUDED]: "occluded", [LOST]: "lost", [NONE]: "" };

const COLORS = ["#4cc38a", "#58a6ff", "#f2b04c", "#d387e8", "#56d4dd", "#f78166", "#c9d152", "#ff9bce"];

/** Tells by the events "state" and "choice" what has changed. */
export class Targets extends EventTarget {
  state = null;
  chosen = null; // a target's id

  tell(name) {
    this.dispatchEvent(new Event(name));
  }

  setState(state) {
    this.state = state;
    if (this.chosen !== null && !this.target()) this.chosen = null;
    this.tell("state");
  }

  choose(id) {
    if (this.chosen === id) return;
    this.chosen = id;
    this.tell("choice");
  }

  target(id = this.chosen) {
    return this.state?.targets.find((each) => each.id === id) ?? null;
  }

  color(id) {
    return COLORS[(id - 1) % COLORS.length];
  }
}
