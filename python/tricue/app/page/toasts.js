// SPDX-License-Identifier: MIT
// Short messages over the picture, until they are dismissed or old.

const MAX_TOASTS = 3;
const COMPLAINT_FOR = 20000, NOTE_FOR = 6000; // milliseconds

/** Say what went wrong. */
export function complain(text) {
  show(text, "toast", COMPLAINT_FOR);
}

/** Say something that isn't wrong. */
export function note(text) {
  show(text, "toast note", NOTE_FOR);
}

function show(text, kind, duration) {
  const toasts = document.getElementById("toasts");
  for (const same of [...toasts.children].filter((each) => each.textContent === text)) same.remove();
  const toast = document.createElement("div"), words = document.createElement("span"), close = document.createElement("button");
  toast.className = kind;
  words.textContent = text;
  close.setAttribute("aria-label", "Dismiss");
  close.innerHTML = '<svg><use href="#i-close"/></svg>';
  close.addEventListener("click", () => toast.remove());
  toast.append(words, close);
  toasts.append(toast);
  while (toasts.children.length > MAX_TOASTS) toasts.firstChild.remove();
  setTimeout(() => toast.remove(), duration);
}
