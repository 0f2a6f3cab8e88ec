// SPDX-License-Identifier: MIT
// What went wrong, over the picture, until it is dismissed or old.

const MAX_TOASTS = 3;
const SHOWN_FOR = 20000; // milliseconds

export function complain(text) {
  const toasts = document.getElementById("toasts");
  for (const same of [...toasts.children].filter((each) => each.textContent === text)) same.remove();
  const toast = document.createElement("div"), words = document.createElement("span"), close = document.createElement("button");
  toast.className = "toast";
  words.textContent = text;
  close.setAttribute("aria-label", "Dismiss");
  close.innerHTML = '<svg><use href="#i-close"/></svg>';
  close.addEventListener("click", () => toast.remove());
  toast.append(words, close);
  toasts.append(toast);
  while (toasts.children.length > MAX_TOASTS) toasts.firstChild.remove();
  setTimeout(() => toast.remove(), SHOWN_FOR);
}
