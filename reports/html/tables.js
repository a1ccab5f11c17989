// Tables that sort by their headings, and the filter of the cells.
vm.startSorting = () => {
  const value = (row, column) => {
    const cell = row.cells[column];
    const exact = cell?.dataset.value;
    if (exact === 'inf') return Infinity;
    if (exact !== undefined && exact !== '' && !Number.isNaN(Number(exact))) return Number(exact);
    const text = cell?.textContent.trim() ?? '';
    return text === '-' || text === 'n/a' ? null : text;
  };
  const compare = (a, b) => {
    if (a === null || b === null) return (a === null) - (b === null);  // what is missing comes last either way
    if (typeof a === 'number' && typeof b === 'number') return a - b;
    return String(a).localeCompare(String(b), 'en', { numeric: true });
  };
  const sort = (table, heading) => {
    const column = heading.cellIndex;
    const descending = heading.getAttribute('aria-sort') === 'ascending';
    for (const other of table.tHead.rows[0].cells)
      if (other.hasAttribute('aria-sort')) other.setAttribute('aria-sort', 'none');
    heading.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
    vm.closeDetails(table);
    const rows = [...table.tBodies[0].rows].map((row) => ({ row, key: value(row, column) }));
    rows.sort((a, b) => (descending && a.key !== null && b.key !== null ? compare(b.key, a.key) : compare(a.key, b.key)));
    table.tBodies[0].append(...rows.map(({ row }) => row));
    vm.say(`Sorted by ${heading.textContent.trim()}, ${descending ? 'descending' : 'ascending'}`);
  };
  for (const button of document.querySelectorAll('.sort'))
    button.addEventListener('click', () => sort(button.closest('table'), button.closest('th')));
};

vm.startFilter = () => {
  const table = vm.byId('cell-table');
  const field = vm.byId('cell-filter');
  const rows = [...table.tBodies[0].rows];
  const apply = () => {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    vm.closeDetails(table);
    for (const row of rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !words.every((word) => text.includes(word));
      shown += row.hidden ? 0 : 1;
    }
    vm.byId('cell-count').textContent = words.length > 0 ? `${shown} of ${rows.length} cells` : `${rows.length} cells`;
  };
  field.addEventListener('input', apply);
  apply();
};
