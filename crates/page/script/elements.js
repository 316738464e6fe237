'use strict';
// Creation of elements, and formats of numbers. Text is never parsed as HTML.

const byId = (id) => document.getElementById(id);

function filled(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

/** Returns an HTML element. */
function html(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/** Returns an SVG element. */
function svg(tag, attributes = {}, ...children) {
  return filled(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

/** Returns the alignment class of a column. */
const side = (numeric) => ({ class: numeric ? 'number' : '' });

/** Returns the header row of a table; `numeric` marks the columns of numbers. */
const headed = (names, numeric) => html('tr', {}, ...names.map((name, c) => html('th', {
  scope: 'col', ...side(numeric[c]),
}, name)));

/** Returns the width of a figure, pixels, so that its text is equally large on all screens. */
const widthOf = (figure) => Math.max(300, Math.round(figure.clientWidth) || 800);

/** Formats a number with a fixed number of digits, and zero without a sign. */
const fixed = (value, digits) => value.toFixed(digits).replace(/^-(?=0\.?0*$)/, '');

/** Formats a length given in metres. */
function millimetres(metres) {
  const value = metres * 1000;
  return `${fixed(value, Math.abs(value) < 99.95 ? 1 : 0)} mm`;
}

const degrees = (radians) => `${fixed((radians * 180) / Math.PI, 1)}°`;
