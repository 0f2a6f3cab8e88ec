// SPDX-License-Identifier: MIT
// The list of targets: a button for each that chooses it, in its color, with room for what it does now.

/** Fill the list anew; the button that had the focus keeps it. */
export function listTargets(list, model) {
  const items = model.state.targets.map((target, index) => {
    const item = document.createElement("li"), button = document.createElement("button");
    const swatch = document.createElement("i"), name = document.createElement("b"), now = document.createElement("span");
    swatch.style.background = model.color(target.id);
    name.textContent = target.name;
    button.append(swatch, name, now);
    button.dataset.target = target.id;
    button.title = index < 9 ? `Choose (${index + 1})` : "Choose";
    button.setAttribute("aria-pressed", target.id === model.chosen);
    button.addEventListener("click", () => model.choose(target.id));
    item.append(button);
    return item;
  });
  const focused = document.activeElement?.dataset?.target;
  list.replaceChildren(...items);
  if (focused) list.querySelector(`[data-target="${focused}"]`)?.focus();
}
