/** Where a label is held so that it stays in the picture. */
function anchor(x, width) {
  return x < width / 8 ? 'start' : x > 7 * width / 8 ? 'end' : 'middle';
}

function outline({corners, label, fate}, size, width) {
  const points = pairs(corners);
  const drawn = [shape('polygon', {class: fate, points: points.map(([x, y]) => `${x + 0.5},${y + 0.5}`).join(' ')})];
  const top = points.reduce((least, point) => (point[1] < least[1] ? point : least), points[0]);
  if (label && top)
    drawn.push(shape('text', {class: 'label', x: top[0], y: top[1] - 0.4 * size, 'font-size': size,
                              'text-anchor': anchor(top[0], width)}, label));
  return drawn;
}

function centre({at: [x, y], label, fate}, size, width) {
  const arm = 0.45 * size;
  const drawn = [shape('path', {class: fate, d: `M${x + 0.5 - arm} ${y + 0.5}h${2 * arm}M${x + 0.5} ${y + 0.5 - arm}v${
    2 * arm}`})];
  if (label)
    drawn.push(shape('text', {class: 'label', x, y: y + 1.6 * size, 'font-size': size,
                              'text-anchor': anchor(x, width)}, label));
  return drawn;
}

function panelView(panel, content, title) {
  const [width, height] = [content.width_px, content.height_px];
  const size = width / 48;
  const drawing = shape('svg', {viewBox: `0 0 ${width} ${height}`, 'aria-hidden': 'true'},
                        shape('g', {class: 'truth'}, ...panel.truth.flatMap((ball) => outline(ball, size, width))),
                        shape('g', {class: 'seen'}, ...panel.detections.flatMap((seen) => centre(seen, size, width))));
  const view = element('div', {class: 'view'});
  if (panel.picture === null) {
    drawing.prepend(shape('text', {class: 'nothing', x: width / 2, y: height - size, 'font-size': size,
                                   'text-anchor': 'middle'}, 'no picture of this pair was kept'));
  } else {
    view.append(element('img', {src: `data:image/jpeg;base64,${content.pictures[panel.picture]}`,
                                alt: `${title}, ${panel.title}: ${panel.truth.length} balls, ${
                                  panel.detections.length} detections`}));
  }
  view.append(drawing);
  return element('figure', {}, view, element('figcaption', {}, panel.title));
}

/** What the arrow keys leaf through: the frames that were touched last. */
let leafed = null;

function framesView(content) {
  const panels = element('div', {class: 'panels'});
  const view = element('div', {class: 'frames', tabindex: '0', role: 'group', 'aria-label': 'stereo pairs'});
  const said = element('div', {'aria-live': 'polite'});
  let at = 0;
  const menu = choice('which pair', content.frames.map(({title}, i) => `${i + 1}. ${title}`), (i) => show(i));
  const show = (i) => {
    at = Math.max(0, Math.min(content.frames.length - 1, i));
    const frame = content.frames[at];
    menu.selectedIndex = at;
    panels.replaceChildren(...frame.panels.map((panel) => panelView(panel, content, frame.title)));
    said.replaceChildren(element('p', {}, element('strong', {}, `${at + 1} of ${content.frames.length}: ${frame.title}`),
                                 frame.note ? `. ${frame.note}` : ''));
    if (frame.command) said.append(commandLine(frame.command));
  };
  const overlay = (text, name) => checkbox(text, true, (checked) => view.classList.toggle(`no-${name}`, !checked));
  const browser = {step: (by) => show(at + by), view};
  view.append(element('div', {class: 'tools'}, button('Previous', () => browser.step(-1)),
                      button('Next', () => browser.step(1)), menu, overlay('truth', 'truth'),
                      overlay('detections', 'seen'), overlay('labels', 'labels')),
              panels, said);
  for (const event of ['focusin', 'pointerdown']) view.addEventListener(event, () => { leafed = browser; });
  leafed ??= browser;
  show(0);
  return view;
}

addEventListener('keydown', (event) => {
  const by = {ArrowLeft: -1, ArrowRight: 1}[event.key];
  if (!by || !leafed || event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
  if (event.target.closest?.('input, select, textarea, .scroll')) return;
  event.preventDefault();
  leafed.step(by);
});
