// SPDX-License-Identifier: MIT
// The keys of a page: those that all pages have, and who gets a key that is pressed.

const TYPING = "input:not([type=checkbox]), select, textarea";
const REPEATED = ["ArrowLeft", "ArrowRight", "+", "=", "-"]; // while they are held
const PRESSED_BY_KEYS = "button, a, input, summary"; // by blank and enter

/** Keys, by their names, that zoom, choose targets, and show or hide trails. */
export function commonKeys(model, stage) {
  const keys = {
    p: () => document.getElementById("trail").click(),
    "+": () => stage.zoomBy(1.5),
    "=": () => stage.zoomBy(1.5),
    "-": () => stage.zoomBy(1 / 1.5),
    0: () => stage.zoomBy(0),
    Escape() {
      stage.cancel();
      model.choose(null);
    },
  };
  for (let number = 1; number <= 9; number++) {
    keys[number] = () => {
      const target = model.state.targets[number - 1];
      if (target) model.choose(target.id);
    };
  }
  return keys;
}

/** Let a list in which one chose with the pointer, or a box that one ticked with it, leave the keys to the page. */
export function leaveKeys(control) {
  let pressed = false;
  const area = control.type === "checkbox" ? control.closest("label") : control;
  area.addEventListener("pointerdown", () => (pressed = true));
  control.addEventListener("blur", () => (pressed = false));
  control.addEventListener("change", () => pressed && control.blur());
}

/** Do what keys stand for, with the event, unless someone types, a dialog is open, or nothing is loaded.
 *  withControl: takes one that is pressed together with Ctrl, and says whether it did something. */
export function listenToKeys(model, keys, withControl = () => false) {
  document.addEventListener("keydown", (event) => {
    if (!model.state || document.querySelector("dialog[open]") || event.altKey) return;
    const { target, key } = event;
    if (target.matches(TYPING)) return;
    if (event.ctrlKey || event.metaKey) {
      if (withControl(event)) event.preventDefault();
      return;
    }
    if (target.matches(PRESSED_BY_KEYS) && (key === " " || key === "Enter")) return;
    const action = keys[key] ?? keys[key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    if (!event.repeat || REPEATED.includes(key)) action(event);
  });
}
