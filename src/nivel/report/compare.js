"use strict";
(() => {
  // a legend entry that is pointed at, or has the focus, shows its curve alone
  const drawings = [...document.querySelectorAll(".precision")];
  const show = (number) => {
    for (const drawing of drawings) {
      drawing.classList.toggle("one", number !== null);
      for (const curve of drawing.querySelectorAll(".curve")) curve.classList.toggle("chosen", curve.dataset.curve === number);
    }
  };
  for (const entry of document.querySelectorAll(".legend button")) {
    for (const kind of ["pointerenter", "focus"]) entry.addEventListener(kind, () => show(entry.dataset.curve));
    for (const kind of ["pointerleave", "blur"]) entry.addEventListener(kind, () => show(null));
  }

  // a heading sorts the table by its column; a second time the other way round; rows without the number stay last
  const table = document.querySelector(".cells table");
  for (const button of table ? table.querySelectorAll("thead button") : []) {
    button.addEventListener("click", () => {
      const head = button.parentElement, column = head.cellIndex;
      const falling = head.getAttribute("aria-sort") === "ascending";
      for (const other of head.parentElement.cells) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", falling ? "descending" : "ascending");
      const value = (row) => {
        const cell = row.cells[column];
        return cell && cell.dataset.value !== undefined ? cell.dataset.value : null;
      };
      const compare = (a, b) => {
        const x = value(a), y = value(b);
        if (x === null || y === null) return (x === null) - (y === null);
        const order = column === 0 ? x.localeCompare(y) : Number(x) - Number(y);
        return falling ? -order : order;
      };
      const body = table.tBodies[0];
      body.append(...[...body.rows].sort(compare));
    });
  }
})();
