'use strict';
// How elements are made, and numbers as people read them. Text is only ever set as text.

const byId = (id) => document.getElementById(id);

function filled(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

/** An HTML element. */
function html(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/** An SVG element. */
function svg(tag, attributes = {}, ...children) {
  return filled(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

/** On which side the cells of a column line up. */
const side = (numeric) => ({ class: numeric ? 'number' : '' });

/** The first row of a table; `numeric` says which columns hold numbers. */
const headed = (names, numeric) => html('tr', {}, ...names.map((name, c) => html('th', {
  scope: 'col', ...side(numeric[c]),
}, name)));

/** Width of a figure in pixels, so that its text is as large on a phone as on a desk. */
const widthOf = (figure) => Math.max(300, Math.round(figure.clientWidth) || 800);

/** A length in metres as people read it. */
function millimetres(metres) {
  const value = metres * 1000;
  return `${value.toFixed(Math.abs(value) < 99.95 ? 1 : 0)} mm`;
}

const degrees = (radians) => `${((radians * 180) / Math.PI).toFixed(1)}°`;
