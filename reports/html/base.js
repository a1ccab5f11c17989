// What all parts share: the data, numbers as the tables write them, small helpers for the page.
'use strict';
const vm = {
  results: JSON.parse(document.getElementById('results').textContent),
  model: JSON.parse(document.getElementById('model').textContent),
};

// The file writes numbers that are not finite as null, with what they were in `nulls`.
for (const result of vm.results.results)
  for (const [pointer, reason] of Object.entries(result.nulls ?? {})) {
    const path = pointer.split('/').slice(1);
    const holder = path.slice(0, -1).reduce((node, key) => node?.[key], result);
    if (holder) holder[path.at(-1)] = { infinity: Infinity, '-infinity': -Infinity }[reason] ?? NaN;
  }

vm.byId = (id) => document.getElementById(id);

// An element with properties and children; text is never read as HTML.
vm.make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};

vm.scientific = (value) => {
  if (value === null || value === undefined || Number.isNaN(value)) return 'n/a';
  if (value === 0) return '0';
  if (!Number.isFinite(value)) return value > 0 ? 'infinite' : '-infinite';
  return value.toExponential(2);
};

vm.number = (value) => {
  if (value === null || value === undefined || Number.isNaN(value)) return 'n/a';
  if (value === 0 || !Number.isFinite(value)) return vm.scientific(value);
  const exponent = Number(value.toExponential(2).split('e')[1]);
  if (exponent < -3 || exponent > 5) return vm.scientific(value);
  return Number(value.toPrecision(3)).toFixed(Math.max(0, 2 - exponent));
};

vm.ms = (seconds) => vm.number(seconds * 1e3);
vm.signed = (value) => (value < 0 ? '\u2212' : '+') + Math.abs(value).toFixed(4);

vm.say = (text) => { vm.byId('live').textContent = text; };

vm.copy = async (text) => {
  try {
    await navigator.clipboard.writeText(text);
  } catch {  // no permission, or not a secure context
    const area = vm.make('textarea', { value: text });
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
};

vm.commandBox = (command) => {
  const button = vm.make('button', { type: 'button', className: 'copy', textContent: 'copy' });
  button.dataset.copy = command;
  // As in the tables: lines end between words, not at the hyphens of an option.
  const words = command.split(' ').flatMap((word, i) => [i > 0 ? ' ' : '', vm.make('span', { textContent: word })]);
  return vm.make('span', { className: 'command' }, vm.make('code', {}, ...words), button);
};

// "raycast on gl, step 0.5"
vm.cellName = (cell) => {
  const key = vm.results.results[cell].key;
  const settings = vm.model.settings[cell];
  return `${key.method} on ${key.backend}${settings ? `, ${settings}` : ''}`;
};
