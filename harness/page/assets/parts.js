/** An element with attributes and children; texts are shown as they are. */
function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** The same of a drawing. */
function shape(name, attributes = {}, ...children) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

function button(text, act, attributes = {}) {
  const made = element('button', {type: 'button', ...attributes}, text);
  made.addEventListener('click', act);
  return made;
}

function checkbox(text, checked, act) {
  const box = element('input', {type: 'checkbox'});
  box.checked = checked;
  box.addEventListener('change', () => act(box.checked));
  return element('label', {}, box, text);
}

function choice(text, names, act) {
  const menu = element('select', {'aria-label': text});
  names.forEach((name, i) => menu.append(element('option', {value: i}, name)));
  menu.addEventListener('change', () => act(menu.selectedIndex));
  return menu;
}

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {  // the browser does not let files at it
    const area = element('textarea', {});
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
}

/** A command line and a button that copies it. */
function commandLine(text) {
  const said = button('Copy', async () => {
    await copy(text);
    said.textContent = 'Copied';
    setTimeout(() => { said.textContent = 'Copy'; }, 1500);
  }, {'aria-label': `Copy: ${text}`});
  return element('div', {class: 'command'}, element('code', {tabindex: '0'}, text), said);
}

const darkScreen = matchMedia('(prefers-color-scheme: dark)');
const paper = matchMedia('print');
const redraws = [];  // what is drawn in the colours of the screen

function isDark() {
  return darkScreen.matches && !paper.matches;
}

function redrawAll() {
  for (const redraw of redraws) redraw();
}

for (const surface of [darkScreen, paper]) surface.addEventListener('change', redrawAll);

/** Draws what is costly once its place is near the screen or goes to paper, and anew in other colours. */
function drawWhenSeen(place, draw) {
  let isDrawn = false;
  const drawNow = () => {
    isDrawn = true;
    nearness.disconnect();
    draw();
  };
  const nearness = new IntersectionObserver((changes) => {
    if (!isDrawn && changes.some(({isIntersecting}) => isIntersecting)) drawNow();
  }, {rootMargin: '50% 0px'});
  nearness.observe(place);
  redraws.push(() => { if (isDrawn || paper.matches) drawNow(); });
}

/** A colour of the style sheet. */
function paint(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

// Colours of Okabe and Ito, which the colour-blind tell apart: on white, and on black.
const lookColours = [
  ['#0072b2', '#56b4e9'], ['#d55e00', '#ff8a3d'], ['#009e73', '#3ddbb0'], ['#cc79a7', '#e8a3c8'],
  ['#8a6d00', '#f0e442'], ['#56b4e9', '#9bd4f5']];
const greyNames = ['dead_reckoning', 'bound', 'consistent', '95 % band', 'no change'];
const usualPlaces = {  // of what is no filter
  A: 0, B: 1, 'B minus A': 0, 'single detections': 0, found: 0, sd: 1, rms: 1, mean: 1, 'mean, 95 % interval': 1};
const pointStyles = ['circle', 'triangle', 'rect', 'rectRot', 'crossRot', 'star'];
const lookOf = new Map();  // places of filters: the same in all charts

/** How a name is drawn: {colour, dash, point}. What follows a comma does not count. */
function look(name) {
  const base = name in usualPlaces ? name : name.split(', ')[0];
  if (greyNames.includes(base))
    return {colour: isDark() ? '#a3adb7' : '#6b7580', dash: base === 'dead_reckoning' ? [6, 4] : [2, 3],
            point: 'circle'};
  if (base in usualPlaces)
    return {colour: lookColours[usualPlaces[base]][isDark() ? 1 : 0], dash: [], point: base === 'B' ? 'triangle' :
      'circle'};
  if (!lookOf.has(base)) lookOf.set(base, lookOf.size);
  const place = lookOf.get(base);
  const dashes = [[], [8, 3], [2, 2]];
  return {colour: lookColours[place % lookColours.length][isDark() ? 1 : 0],
          dash: dashes[Math.floor(place / lookColours.length) % dashes.length],
          point: pointStyles[place % pointStyles.length]};
}

/** A number for people. */
function shown(value) {
  if (value === null || !Number.isFinite(value)) return '-';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return value.toExponential(2);
  return String(Number(value.toPrecision(3)));
}
