// SPDX-License-Identifier: MIT
// The list of targets: a button for each that chooses it, in its color, with room for what it does now.

/** Bring the list up to date; buttons stay what they are, so that they can be clicked and keep the focus meanwhile. */
export function listTargets(list, model) {
  const { targets } = model.state;
  for (const item of [...list.children]) if (!model.target(idOf(item))) item.remove();
  targets.forEach((target, index) => {
    const there = list.children[index] ?? null;
    const item = there && idOf(there) === target.id ? there : list.insertBefore(newItem(target.id, model), there);
    const button = item.firstChild;
    button.querySelector("b").textContent = target.name;
    button.title = index < 9 ? `Choose (${index + 1})` : "Choose";
    button.setAttribute("aria-pressed", target.id === model.chosen);
  });
}

function newItem(id, model) {
  const item = document.createElement("li"), button = document.createElement("button");
  const swatch = document.createElement("i");
  swatch.style.background = model.color(id);
  button.append(swatch, document.createElement("b"), document.createElement("span"));
  button.dataset.target = id;
  button.addEventListener("click", () => model.choose(id));
  item.append(button);
  return item;
}

function idOf(item) {
  return Number(item.firstChild.dataset.target);
}
