// SPDX-License-Identifier: MIT
// What the pages of recordings and of cameras both know: the server's state, its targets, and which one is chosen.

export const TRACKED = 0, OCCLUDED = 1, LOST = 2, NONE = 255;
export const STATUS_NAMES = { [TRACKED]: "tracked", [OCCLUDED]: "occluded", [LOST]: "lost", [NONE]: "" };

// Those of tricue.draw.targets.TARGET_COLORS, so that a target has the same color in the exported video.
const COLORS = ["#56b4e9", "#e69f00", "#009e73", "#f0e442", "#cc79a7", "#0072b2", "#d55e00"];

/** Tells by the events "state" and "choice" what has changed. */
export class Targets extends EventTarget {
  state = null;
  chosen = null; // a target's id
  #gone = null; // that of the target which was chosen when it was removed, until another is chosen

  tell(name) {
    this.dispatchEvent(new Event(name));
  }

  setState(state) {
    this.state = state;
    if (this.chosen !== null && !this.target()) {
      this.#gone = this.chosen;
      this.chosen = null;
    } else if (this.#gone !== null && this.target(this.#gone)) {
      this.chosen = this.#gone;
      this.#gone = null;
    }
    this.tell("state");
  }

  choose(id) {
    this.#gone = null;
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
