// Tables whose rows are sorted by a click on a column's head.
'use strict';

/** Numbers by size, words by the alphabet, what is not known last. */
function compareKeys(a, b, direction) {
  if (a === null || b === null) return (a === null) - (b === null);
  return direction * (typeof a === 'string' ? a.localeCompare(b) : a - b);
}

function headOf(column, sort) {
  const button = element('button', {type: 'button', title: column.hint ?? ''}, column.title);
  button.addEventListener('click', sort);
  return element('th', {scope: 'col', class: column.words ? 'words' : 'number'}, button);
}

function rowOf(columns, row) {
  const cells = columns.map((column, i) => {
    const attributes = {class: column.words ? 'words' : 'number'};
    if (i === 0) attributes.scope = 'row';
    return element(i === 0 ? 'th' : 'td', attributes, column.cell(row));
  });
  return element('tr', {}, ...cells);
}

/**
 * A table of `rows`. A column has a `title`, perhaps a `hint` and `words: true`, `key(row)` to sort by and `cell(row)`
 * to show. It is sorted by column `by` at first.
 */
function sortableTable(caption, columns, rows, by = 0) {
  const body = element('tbody');
  const heads = columns.map((column, i) => headOf(column, () => sort(i)));
  let sorted = -1, direction = 1;
  function sort(index) {
    direction = index === sorted ? -direction : 1;
    sorted = index;
    const ordered = [...rows].sort((a, b) => compareKeys(columns[index].key(a), columns[index].key(b), direction));
    body.replaceChildren(...ordered.map(row => rowOf(columns, row)));
    heads.forEach(head => head.removeAttribute('aria-sort'));
    heads[index].setAttribute('aria-sort', direction > 0 ? 'ascending' : 'descending');
  }
  sort(by);
  const table = element(
      'table', {class: 'sortable'}, element('caption', {}, element('span', {}, caption)),
      element('thead', {}, element('tr', {}, ...heads)), body);
  return element('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': caption}, table);
}

/** A value with its interval in brackets, which are smaller. */
function intervalCell(bounded) {
  const [, value, brackets = '', power = ''] = interval(bounded).match(/^(.*?)( \[.*\])?(\u202f.*)?$/);
  return element('span', {}, value, element('span', {class: 'brackets'}, brackets), power);
}
