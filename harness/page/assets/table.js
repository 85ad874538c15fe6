/** A change within its margins: worse is to the right. All in units of the margin; an arrow is beyond three. */
function intervalDrawing([low, value, high]) {
  const most = 3;
  const x = (change) => 65 + 20 * Math.max(-most, Math.min(most, change));
  const known = (change, otherwise) => (change === null ? otherwise : change);
  const ends = [known(low, -most), known(high, most)];
  const side = ends[0] > 1 ? 'worse' : ends[1] < -1 ? 'better' : 'unsure';
  return shape('svg', {class: 'interval', viewBox: '0 0 130 16', 'aria-hidden': 'true'},
               shape('rect', {class: 'zone', x: x(-1), y: 1, width: x(1) - x(-1), height: 14}),
               shape('line', {class: 'zero', x1: 65, x2: 65, y1: 0, y2: 16}),
               shape('line', {class: `bar ${side}`, x1: x(ends[0]), x2: x(ends[1]), y1: 8, y2: 8}),
               Math.abs(value) > most ?
                 shape('path', {class: `beyond ${side}`, d: value > 0 ? 'M122 3L130 8L122 13z' : 'M8 3L0 8L8 13z'}) :
                 shape('circle', {class: side, cx: x(known(value, 0)), cy: 8, r: 3}));
}

/** A name of metrics, files or filters, which lines may break behind its dots and dashes. */
function breakable(text) {
  return text.split(/(?<=[._])(?=[A-Za-z])/).flatMap((part, i) => (i === 0 ? [part] : [element('wbr'), part]));
}

function cellContent(cell) {
  if (typeof cell === 'string') return breakable(cell);
  if (cell.interval) return [intervalDrawing(cell.interval)];
  if (cell.link) return [element('a', {href: `#${cell.link}`}, cell.text)];
  if (cell.mark) return [element('span', {class: `mark ${cell.mark}`}, cell.text)];
  return breakable(cell.text);
}

/** What a cell is sorted by: numbers before texts, and what has none last. */
function sortKey(cell) {
  if (typeof cell === 'string') return cell;
  if (typeof cell.number === 'number') return cell.number;
  return cell.text;
}

function compareKeys(a, b) {
  const number = (key) => typeof key === 'number';
  if (number(a) !== number(b)) return number(a) ? -1 : 1;
  return a < b ? -1 : a > b ? 1 : 0;
}

function tableView(content, title) {
  const words = content.header.map((_, column) => content.rows.every(({cells}) => typeof sortKey(cells[column]) ===
    'string' && !/^[-+]?[0-9][^ ]*( [^ ]{1,3})?$/.test(sortKey(cells[column])) && sortKey(cells[column]) !== '-'));
  const rows = content.rows.map(({cells, quiet}) => {
    const row = element('tr', {}, ...cells.map((cell, column) => {
      const isLong = (typeof cell === 'string' ? cell : cell.text || '').length > 60;
      const attributes = words[column] ? {class: isLong ? 'words long' : 'words'} : {};
      return element('td', attributes, ...cellContent(cell));
    }));
    row.hidden = quiet;
    return {row, cells, quiet};
  });
  const body = element('tbody', {}, ...rows.map(({row}) => row));
  const heads = content.header.map((text, column) => {
    const head = element('th', {scope: 'col', class: words[column] ? 'words' : 'number', 'aria-sort': 'none'});
    head.append(button(text, () => {
      const down = head.getAttribute('aria-sort') === 'ascending';
      for (const other of heads) other.setAttribute('aria-sort', 'none');
      head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
      const order = [...rows].sort((a, b) => {
        const [first, second] = [sortKey(a.cells[column]), sortKey(b.cells[column])];
        const comparable = typeof first === typeof second;
        return (down && comparable ? -1 : 1) * compareKeys(first, second);
      });
      body.append(...order.map(({row}) => row));
    }));
    return head;
  });
  const table = element('table', {}, element('thead', {}, element('tr', {}, ...heads)), body);
  const view = element('div', {},
                       element('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': title}, table));
  const quiet = rows.filter((row) => row.quiet);
  if (quiet.length > 0) {
    let open = false;
    const toggle = button('', () => {
      open = !open;
      say();
    });
    const say = () => {
      for (const {row} of quiet) row.hidden = !open;
      table.hidden = !open && quiet.length === rows.length;
      toggle.textContent = `${open ? 'Hide' : 'Show'} ${quiet.length} ${content.quiet}`;
    };
    say();
    view.append(element('div', {class: 'tools'}, toggle));
  }
  return view;
}
