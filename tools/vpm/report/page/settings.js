// Settings with what is said of them, and commands.
'use strict';

/** The little Markdown that settings are described with: code, and links, of which the text is left. */
function fromMarkdown(text) {
  const parts = [];
  let from = 0;
  for (const match of text.matchAll(/`([^`]*)`|\[([^\]]*)\]\([^)]*\)/g)) {
    parts.push(text.slice(from, match.index), match[1] === undefined ? match[2] : element('code', {}, match[1]));
    from = match.index + match[0].length;
  }
  return element('span', {}, ...parts, text.slice(from));
}

function meaningCell({meaning, values, reason}) {
  const cell = element(
      'span', {class: 'meaning'}, fromMarkdown(meaning),
      element('span', {class: 'muted'}, ' Allowed: ', fromMarkdown(values)));
  if (reason) cell.append(element('span', {class: 'reason'}, element('strong', {}, 'Chosen: '), reason));
  return cell;
}

const valueCell = ({value, is_default: isUsual}) => element(isUsual ? 'span' : 'strong', {}, value);

function settingsTable(settings) {
  const rows = settings.map((row, place) => ({...row, place}));
  const columns = [
    {title: 'setting', words: true, key: row => row.place, cell: row => element('code', {}, row.key)},
    {title: 'value', words: true, key: row => row.value, cell: valueCell},
    {title: 'default', words: true, key: row => row.default, cell: row => fromMarkdown(row.default)},
    {title: 'what it is', words: true, key: row => row.meaning, cell: meaningCell},
  ];
  return sortableTable('Settings of the render', columns, rows);
}

function aboutSettings(settings) {
  const chosen = settings.filter(row => row.reason).length, changed = settings.filter(row => !row.is_default).length;
  return `${changed} of ${settings.length} are not the default; these are bold. ` +
      `${chosen === 0 ? 'None' : chosen} of them ${chosen === 1 ? 'was' : 'were'} chosen by the render. ` +
      'Settings that would change nothing are left out. Meanings are those of scenes/README.md, where what is "below" is found.';
}

function commandList(commands) {
  return commands.flatMap(
      ({does,
        command}) => [element('p', {}, `This ${does}:`), element('pre', {tabindex: '0', class: 'command'}, command)]);
}
