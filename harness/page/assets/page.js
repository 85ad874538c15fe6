const whenPlaced = [];  // what can be drawn once it has a size

function textView({lines}) {
  if (lines.length === 0) return '';
  if (lines.length === 1) return element('p', {}, lines[0]);
  return element('ul', {class: 'lines'}, ...lines.map((line) => element('li', {}, line)));
}

const views = {
  text: textView,
  table: (content, title) => tableView(content, title),
  charts: chartsView,
  map: mapView,
  frames: framesView,
};

function blockView(block, i) {
  const {title, note, commands, identity, chapter, content} = block;
  const section = element('section', {id: identity || `part-${i + 1}`});
  if (content.kind === 'table') section.classList.add('long');
  section.append(element('h2', chapter ? {class: 'chapter'} : {}, title));
  for (const line of note.split('\n').filter((text) => text)) section.append(element('p', {class: 'note'}, line));
  section.append(views[content.kind](content, title));
  for (const command of commands) section.append(commandLine(command));
  return section;
}

function show(page) {
  document.title = `${page.title} - stereobench`;
  const sections = page.blocks.map(blockView);
  const chapters = page.blocks.some(({chapter}) => chapter);
  const links = page.blocks.flatMap(({title, chapter}, i) => (chapters && !chapter ? [] :
    [element('li', {}, element('a', {href: `#${sections[i].id}`}, title))]));
  document.body.append(element('main', {}, element('h1', {}, page.title),
                               element('ul', {class: 'facts'}, ...page.facts.map((fact) => element('li', {}, fact))),
                               element('nav', {'aria-label': 'parts'}, element('ul', {}, ...links)), ...sections));
  for (const draw of whenPlaced) draw();
}

show(JSON.parse(document.getElementById('page').textContent));
