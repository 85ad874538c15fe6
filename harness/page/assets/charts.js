const beyond = 6;  // pixels around a chart, so that points at its ends are seen whole

/** Draws the interval of each point. */
const intervals = {
  id: 'intervals',
  beforeDatasetDraw(chart, {index}) {
    const dataset = chart.data.datasets[index];
    if (!dataset.intervals || !chart.isDatasetVisible(index)) return;
    const {ctx, scales: {x, y}, chartArea} = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(chartArea.left - beyond, chartArea.top - beyond, chartArea.width + 2 * beyond, chartArea.height + 2 * beyond);
    ctx.clip();
    ctx.strokeStyle = dataset.borderColor;
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    for (const [at, low, high] of dataset.intervals) {
      if (low === null || high === null || (x.type === 'logarithmic' && !(at > 0))) continue;
      const px = x.getPixelForValue(at);
      const within = y.type === 'logarithmic' ? Math.max(low, y.min) : low;  // 0 and less are far below
      const [from, to] = [y.getPixelForValue(within), y.getPixelForValue(high)];
      ctx.moveTo(px, from);
      ctx.lineTo(px, to);
      for (const end of [from, to]) {
        ctx.moveTo(px - 4, end);
        ctx.lineTo(px + 4, end);
      }
    }
    ctx.stroke();
    ctx.restore();
  },
};

/** Points of a chart; those without a place on a logarithmic axis are gaps. */
function points(x, y, {log_x, log_y}) {
  const isLost = (at, value) => (log_x && !(at > 0)) || (log_y && !(value > 0));
  return x.map((at, i) => ({x: at, y: isLost(at, y[i]) ? null : y[i]}));
}

/** A band is two lines, the second of which is filled down to the first. */
function bandDatasets(series, chart, colour) {
  const line = (y, more) => ({
    label: series.name, data: points(series.x, y, chart), borderColor: 'transparent', pointRadius: 0,
    pointHitRadius: 0, spanGaps: false, ...more});
  return [line(series.low, {hiddenInLegend: true, fill: false}),
          line(series.high, {fill: '-1', backgroundColor: `${colour}38`})];
}

function datasetsOf(series, chart) {
  const {colour, dash, point} = look(series.name);
  if (series.look === 'band') return bandDatasets(series, chart, colour);
  const isPoints = series.look === 'points';
  const many = series.x.length > 300;
  return [{
    label: series.name, data: points(series.x, series.y, chart), borderColor: colour,
    backgroundColor: isPoints && many ? `${colour}88` : colour, showLine: !isPoints, borderWidth: 2,
    pointStyle: !isPoints ? 'line' : many ? 'circle' : point, pointRadius: isPoints ? (many ? 1.5 : 4) : 0, pointHitRadius: 6, spanGaps: false,
    clip: beyond,
    borderDash: series.look === 'dashes' ? [4, 4] : isPoints ? [] : dash,
    intervals: series.low.length > 0 ? series.x.map((at, i) => [at, series.low[i], series.high[i]]) : null,
  }];
}

/** Ticks of a logarithmic axis: 1, 2 and 5 of each power of ten. */
function logarithmicTick(value) {
  const digits = value / 10 ** Math.floor(Math.log10(value) + 1e-9);
  if (![1, 2, 5].some((digit) => Math.abs(digits / digit - 1) < 1e-6)) return null;
  return value < 1e-3 || value >= 1e5 ? value.toExponential(0) : shown(value);
}

/** The least and the greatest of some numbers that an axis can show. */
function limitsOf(numbers, logarithmic) {
  let [low, high] = [Infinity, -Infinity];
  for (const number of numbers) {
    if (number === null || (logarithmic && !(number > 0))) continue;
    low = Math.min(low, number);
    high = Math.max(high, number);
  }
  return low < high ? [low, high] : [undefined, undefined];
}

function axis(title, logarithmic, names, [low, high], isX) {
  const made = {
    type: logarithmic ? 'logarithmic' : 'linear', title: {display: true, text: title, color: paint('ink')},
    grid: {color: paint('line'), borderColor: paint('faint')}, ticks: {color: paint('faint'), maxRotation: 60}};
  if (isX) {
    made.ticks.includeBounds = false;  // so that the others are round
    Object.assign(made, {min: low, max: high, afterBuildTicks: (scale) => {
      scale.ticks = scale.ticks.filter(({value}) => value >= scale.min && value <= scale.max);
    }});
  } else {
    Object.assign(made, {suggestedMin: low, suggestedMax: high});
  }
  if (logarithmic) made.ticks.callback = logarithmicTick;
  if (names.length > 0) {
    Object.assign(made, {min: -0.5, max: names.length - 0.5, afterBuildTicks: (scale) => {
      scale.ticks = names.map((_, i) => ({value: i}));
    }});
    made.ticks.callback = (value) => names[value] ?? null;
    made.ticks.autoSkip = false;
  }
  return made;
}

function configuration(chart) {
  return {
    type: 'line', plugins: [intervals],
    data: {datasets: chart.series.flatMap((series) => datasetsOf(series, chart))},
    options: {
      animation: false, responsive: true, maintainAspectRatio: false,
      interaction: {mode: 'nearest', intersect: false},
      scales: {
        x: axis(chart.x, chart.log_x, chart.x_names, limitsOf(chart.series.flatMap(({x}) => x), chart.log_x), true),
        y: axis(chart.y, chart.log_y, [], limitsOf(chart.series.flatMap(
          ({y, low, high}) => [...y, ...low, ...high]), chart.log_y), false)},
      plugins: {
        legend: {position: 'bottom', labels: {
          color: paint('ink'), usePointStyle: true, boxHeight: 8,
          filter: (item, data) => !data.datasets[item.datasetIndex].hiddenInLegend}},
        tooltip: {callbacks: {
          title: ([item]) => item && `${chart.x}: ${chart.x_names[Math.round(item.parsed.x)] ?? shown(item.parsed.x)}`,
          label: (item) => `${item.dataset.label}: ${shown(item.parsed.y)}`}},
      },
    },
  };
}

function chartsView(content) {
  const canvas = element('canvas', {role: 'img'});
  const view = element('div', {});
  const place = element('div', {class: 'chart'}, canvas);
  let chosen = content.charts[0];
  let drawn = null;
  const describe = () => canvas.setAttribute('aria-label', chosen.words);
  const draw = () => {
    drawn?.destroy();
    drawn = new Chart(canvas, configuration(chosen));
  };
  describe();
  if (content.charts.length > 1)
    view.append(element('div', {class: 'tools'}, choice('which chart', content.charts.map(({name}) => name), (i) => {
      chosen = content.charts[i];
      describe();
      draw();
    })));
  view.append(place);
  drawWhenSeen(place, draw);
  return view;
}
