// A table that sorts by any column and shows some hundreds of rows at a time.

const ROWS = 300;
const LONG = 40; // letters that a line of a cell may have

class SortedTable {
  constructor(parent, { title, columns, rows }, choose) {
    Object.assign(this, { columns, rows, choose, shownRows: ROWS, chosen: null });
    this.order = rows[columns[0].key].map((_, k) => k);
    this.section = parent.appendChild(document.createElement("div"));
    this.section.className = "table";
    this.section.innerHTML = `<h2>${escaped(title)}</h2>
      <div class="scroll" tabindex="0" role="region" aria-label="${escaped(title)}"><table>
      <thead><tr>${columns.map((column) => heading(column, rows[column.key])).join("")}</tr></thead><tbody></tbody></table></div>
      <div class="more"><span></span><button type="button">Show ${ROWS} more</button></div>`;
    this.body = this.section.querySelector("tbody");
    this.section.querySelector("thead").addEventListener("click", (event) => this.sortAt(event.target.closest("th")));
    this.section.querySelector(".more button").addEventListener("click", () => this.draw((this.shownRows += ROWS)));
    this.body.addEventListener("click", (event) => this.pick(event.target.closest("tr")));
    this.draw();
  }

  // The other way round if it is sorted by that column already; at first the largest on top.
  sortAt(head) {
    if (head) this.sort(head.dataset.key, head.getAttribute("aria-sort") === "descending" ? "ascending" : "descending");
  }

  sort(key, direction) {
    const values = this.rows[key];
    const sign = direction === "ascending" ? 1 : -1;
    this.order.sort((a, b) => compared(values[a], values[b], sign) || a - b);
    for (const head of this.section.querySelectorAll("th")) {
      if (head.dataset.key === key) head.setAttribute("aria-sort", direction);
      else head.removeAttribute("aria-sort");
    }
    this.section.querySelector(".scroll").scrollTop = 0;
    this.draw();
  }

  pick(row) {
    if (row && this.rows.contact) this.choose(this.rows.contact[Number(row.dataset.row)]);
  }

  mark(contact) {
    this.chosen = contact;
    for (const row of this.body.rows) row.classList.toggle("chosen", this.isChosen(Number(row.dataset.row)));
  }

  isChosen(k) {
    return this.chosen !== null && this.rows.contact?.[k] === this.chosen;
  }

  draw() {
    const visible = this.order.slice(0, this.shownRows);
    this.body.innerHTML = visible.map((k) => this.row(k)).join("");
    const [note, more] = this.section.querySelectorAll(".more > *");
    note.textContent = visible.length < this.order.length ? `first ${visible.length} of ${this.order.length} rows` : "";
    more.hidden = !note.textContent;
  }

  row(k) {
    const cells = this.columns.map(({ key, error, whole }) => {
      const cell = this.rows[key][k];
      const value = cell === null ? "–" : whole || typeof cell === "string" ? String(cell) : shown(cell);
      if (key === "contact") return `<td><button type="button" aria-label="Show contact ${value}">${value}</button></td>`;
      return `<td class="${kindOf(cell)}">${escaped(value)}${error ? ` <small>± ${shown(this.rows[error][k], 2)}</small>` : ""}</td>`;
    });
    return `<tr data-row="${k}" class="${this.isChosen(k) ? "chosen" : ""}">${cells.join("")}</tr>`;
  }
}

function heading({ key, label, unit }, cells) {
  return `<th scope="col"${typeof cells.find((cell) => cell !== null) === "string" ? ' class="word"' : ""} data-key="${key}"><button type="button">${escaped(label)}<span>${escaped(unit) || "&nbsp;"}</span></button></th>`;
}

function kindOf(cell) {
  return typeof cell !== "string" ? "" : cell.length > LONG ? "word long" : "word";
}

// What there is none of comes last.
function compared(a, b, sign) {
  if (a === null || b === null) return Number(a === null) - Number(b === null);
  return sign * (typeof a === "string" ? a.localeCompare(b) : a - b);
}
