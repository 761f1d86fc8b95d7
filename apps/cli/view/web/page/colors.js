/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Colours of errors, states and runs; numbers with units. */

const statusNames = ['unknown', 'ok', 'relocalised', 'lost'];
/* Okabe and Ito 2008: distinct for colour-blind readers. */
const stateColors = {ok: '#0072b2', relocalised: '#e69f00', outside: '#cc79a7', lost: '#5b6066', unknown: '#8a8f96'};
const runColors = {light: ['#0072b2', '#d55e00', '#00805c', '#a8518a', '#8a6d00', '#2b8cc4'],
                   dark: ['#56b4e9', '#e69f00', '#1fc796', '#df9cc1', '#f0e442', '#8fb8ff']};

const isDark = () => window.matchMedia('(prefers-color-scheme: dark)').matches;
const runColor = (index) => runColors[isDark() ? 'dark' : 'light'][index % 6];
const cssColor = (rgb) => `rgb(${rgb[0]},${rgb[1]},${rgb[2]})`;

class ErrorScale {
  constructor(colors) {
    this.colors = colors.map(cssColor);
    this.dark = colors.map((c) => 0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2] < 110);
  }
  /* Index of the colour of a share 0..1 of the largest error. */
  index(share) { return Math.round(limited(share, 0, 1) * (this.colors.length - 1)); }
}

/* The 99th percentile of the finite values, rounded up to 1, 2 or 5 times a power of ten. */
function scaleEnd(arrays) {
  const values = [];
  for (const array of arrays) for (const v of array) if (Number.isFinite(v)) values.push(v);
  values.sort((a, b) => a - b);
  return roundedUp(values.length ? values[Math.ceil(0.99 * (values.length - 1))] : 0);
}

function roundedUp(value) {
  if (!(value > 0)) return 1e-3;
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].find((m) => m * power >= value * 0.9999) * power;
}

/* The unit in which lengths up to `largest` metres are shown. */
function lengthUnit(largest) {
  if (largest < 0.1) return {name: 'mm', factor: 1000};
  return largest < 1 ? {name: 'cm', factor: 100} : {name: 'm', factor: 1};
}

function shortNumber(value) {
  if (!Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size === 0) return '0';
  return size >= 100 ? value.toFixed(0) : size >= 10 ? value.toFixed(1) : size >= 1 ? value.toFixed(2) : value.toPrecision(2);
}

function lengthText(metres) {
  if (!Number.isFinite(metres)) return '–';
  const unit = lengthUnit(Math.abs(metres));
  return `${shortNumber(unit.factor * metres)}\u00a0${unit.name}`;
}

const degreesText = (degrees) => (Number.isFinite(degrees) ? `${shortNumber(degrees)}°` : '–');
