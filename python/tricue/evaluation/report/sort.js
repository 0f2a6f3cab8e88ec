// SPDX-License-Identifier: MIT
// A click on a table's heading sorts by that column, a second click in reverse. The page is complete without it.
for (const table of document.querySelectorAll("table.sortable")) {
  const heads = [...table.tHead.rows[0].cells], body = table.tBodies[0];
  const value = (row, at) => {
    const cell = row.cells[at];
    return at === 0 ? cell.innerText.toLowerCase() : Number(cell.dataset.value ?? NaN);
  };
  heads.forEach((head, at) => {
    const button = document.createElement("button");
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const down = head.ariaSort ? head.ariaSort === "ascending" : at > 0;
      heads.forEach((each) => each.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      const order = (a, b) => (a < b ? -1 : a > b ? 1 : 0) * (down ? -1 : 1);
      const last = (x) => Number.isNaN(x);
      body.append(...[...body.rows].sort((one, other) => {
        const [a, b] = [value(one, at), value(other, at)];
        return last(a) - last(b) || order(a, b);
      }));
    });
  });
}
