// Sorting and searching the table of a library; without it the table stands as it was written, best score first.
(function () {
  'use strict';
  const table = document.getElementById('models');
  const search = document.getElementById('search');
  if (!table) { search.hidden = true; return; }
  const body = table.tBodies[0];
  const heads = Array.from(table.tHead.rows[0].cells);

  function valueOf(row, column) {
    const text = row.cells[column].dataset.value;
    const number = Number(text);
    return text === '' || Number.isNaN(number) || column === 0 ? text : number;
  }

  function sortBy(column) {
    const head = heads[column];
    // Of numbers the largest first, of names the first one.
    const first = column === 0 ? 'ascending' : 'descending';
    const second = column === 0 ? 'descending' : 'ascending';
    const order = head.getAttribute('aria-sort') === first ? second : first;
    for (const other of heads) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', order);
    const sign = order === 'ascending' ? 1 : -1;
    const rows = Array.from(body.rows);
    rows.sort((a, b) => {
      const x = valueOf(a, column);
      const y = valueOf(b, column);
      return sign * (column === 0 ? x.localeCompare(y, undefined, { numeric: true }) : x - y);
    });
    body.append(...rows);
  }

  heads.forEach((head, column) => {
    head.tabIndex = 0;
    head.addEventListener('click', () => sortBy(column));
    head.addEventListener('keydown', (event) => { if (event.key === 'Enter') sortBy(column); });
  });
  heads[1].setAttribute('aria-sort', 'descending');

  search.addEventListener('input', () => {
    const wanted = search.value.trim().toLowerCase();
    for (const row of body.rows) row.hidden = !row.cells[0].dataset.value.toLowerCase().includes(wanted);
  });
})();
