// Elements of the page: found, read and made.
'use strict';

const find = id => document.getElementById(id);
const read = id => JSON.parse(find(id).textContent);

/** An element with attributes and children, which are elements or text. */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** A list of terms and what they are. */
function fillFacts(list, facts) {
  for (const [term, text] of facts) list.append(element('div', {}, element('dt', {}, term), element('dd', {}, text)));
}

function fillSelect(select, names, chosen = 0) {
  names.forEach((name, i) => select.append(new Option(name, i, i === chosen, i === chosen)));
}

/** A text that opens on demand. */
const foldedText = (title, text) =>
    element('details', {}, element('summary', {}, title), element('pre', {tabindex: '0'}, text));
