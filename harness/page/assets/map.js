const ellipse95 = Math.sqrt(-2 * Math.log(0.05));  // of a plane's Gaussian: in standard deviations

/** The half axes of a covariance's 95 % ellipse, and the angle of the longer one. */
function ellipseOf([xx, xy, yy]) {
  const mean = (xx + yy) / 2;
  const gap = Math.hypot((xx - yy) / 2, xy);
  return {long: ellipse95 * Math.sqrt(Math.max(mean + gap, 0)), short: ellipse95 * Math.sqrt(Math.max(mean - gap, 0)),
          angle: Math.atan2(2 * xy, xx - yy) / 2};
}

function pairs(flat) {
  const made = [];
  for (let i = 0; i + 1 < flat.length; i += 2) made.push([flat[i], flat[i + 1]]);
  return made;
}

/** Where metres lie on a canvas, both axes to one scale. */
function planScale(points, width) {
  const finite = points.filter(([x, y]) => x !== null && y !== null);
  const range = (axis) => finite.reduce(([low, high], p) => [Math.min(low, p[axis]), Math.max(high, p[axis])],
                                        [Infinity, -Infinity]);
  const [[left, right], [low, high]] = finite.length > 0 ? [range(0), range(1)] : [[0, 1], [0, 1]];
  const wide = Math.max(right - left, 1e-6) * 1.08;
  const tall = Math.max(high - low, 1e-6) * 1.08;
  const height = Math.round(Math.min(Math.max(width * tall / wide, 260), Math.max(0.75 * width, 360), 640));
  const scale = Math.min(width / wide, height / tall);
  return {height, scale,
          x: (metres) => width / 2 + scale * (metres - (left + right) / 2),
          y: (metres) => height / 2 - scale * (metres - (low + high) / 2)};
}

/** Draws a map at an instant. `state`: {step, times, hidden}. */
class MapDrawing {
  constructor(map, canvas, state) {
    Object.assign(this, {map, canvas, state});
    this.walls = map.walls.map(pairs);
    this.sightings = map.sightings.map(pairs);
    this.paths = map.estimates.map(({path}) => pairs(path));
  }

  draw() {
    const width = this.canvas.clientWidth || 640;
    const known = this.map.truth.filter((pose) => pose !== null);
    this.plan = planScale([...this.walls.flat(), ...known, ...this.map.landmarks.map(({at}) => at),
                           ...(known.length === 0 ? this.paths.flat() : [])], width);
    const dense = Math.min(devicePixelRatio || 1, 3);
    this.canvas.width = Math.round(width * dense);
    this.canvas.height = Math.round(this.plan.height * dense);
    this.canvas.style.height = `${this.plan.height}px`;
    this.ink = this.canvas.getContext('2d');
    this.ink.scale(dense, dense);
    this.ink.fillStyle = paint('paper');
    this.ink.fillRect(0, 0, width, this.plan.height);
    for (const wall of this.walls) this.line(wall, paint('faint'), 2);
    this.drawTruth();
    this.map.estimates.forEach((estimate, i) => {
      if (!this.state.hidden.has(estimate.name)) this.drawEstimate(estimate, i);
    });
    this.scaleBar(width);
  }

  line(points, colour, width, dash = []) {
    const {ink, plan} = this;
    ink.strokeStyle = colour;
    ink.lineWidth = width;
    ink.setLineDash(dash);
    ink.beginPath();
    let drawn = false;
    for (const point of points) {
      const gone = !point || point[0] === null || point[1] === null;
      if (!gone) ink[drawn ? 'lineTo' : 'moveTo'](plan.x(point[0]), plan.y(point[1]));
      drawn = !gone;
    }
    ink.stroke();
    ink.setLineDash([]);
  }

  disc([x, y], radius, fill, stroke) {
    const {ink, plan} = this;
    ink.beginPath();
    ink.arc(plan.x(x), plan.y(y), radius, 0, 2 * Math.PI);
    ink.fillStyle = fill;
    ink.fill();
    ink.strokeStyle = stroke;
    ink.lineWidth = 1;
    ink.stroke();
  }

  drawTruth() {
    const {map, state, ink, plan} = this;
    this.line(map.truth, paint('line'), 3);
    this.line(map.truth.slice(0, state.step + 1), paint('true'), 3);
    const pose = map.truth[state.step];
    for (const at of pose ? this.sightings[state.step] ?? [] : []) this.line([pose, at], paint('true'), 1, [2, 3]);
    for (const {at, colour} of map.landmarks) this.disc(at, 6, colour || paint('paper'), paint('ink'));
    if (!pose) return;
    ink.save();
    ink.translate(plan.x(pose[0]), plan.y(pose[1]));
    ink.rotate(-pose[2]);
    ink.beginPath();
    ink.moveTo(11, 0);
    ink.lineTo(-7, 6);
    ink.lineTo(-7, -6);
    ink.closePath();
    ink.fillStyle = paint('true');
    ink.fill();
    ink.restore();
  }

  /** An estimate with its error drawn `times` as large. */
  enlarged(at, truth) {
    if (!truth || at[0] === null) return at;
    const times = this.state.times;
    return [truth[0] + times * (at[0] - truth[0]), truth[1] + times * (at[1] - truth[1])];
  }

  ellipse([x, y], covariance, colour) {
    const {ink, plan, state} = this;
    if (x === null || !covariance || covariance.includes(null)) return;
    const {long, short, angle} = ellipseOf(covariance);
    const size = state.times * plan.scale;
    ink.strokeStyle = colour;
    ink.lineWidth = 1.2;
    ink.beginPath();
    ink.ellipse(plan.x(x), plan.y(y), size * long, size * short, -angle, 0, 2 * Math.PI);
    ink.stroke();
  }

  drawEstimate(estimate, i) {
    const {map, state} = this;
    const {colour, dash} = look(estimate.name);
    const last = Math.min(state.step, this.paths[i].length - 1);
    const path = this.paths[i].slice(0, last + 1).map((at, k) => this.enlarged(at, map.truth[k]));
    this.line(path, colour, 1.6, dash);
    for (const landmark of estimate.landmarks) {
      const truth = landmark.true_one === null ? null : map.landmarks[landmark.true_one].at;
      const at = this.enlarged(landmark.at, truth);
      this.cross(at, colour);
      this.ellipse(at, landmark.covariance, colour);
    }
    if (path.length === 0) return;
    this.disc(path.at(-1), 3.5, colour, colour);
    this.ellipse(path.at(-1), estimate.covariances[last], colour);
  }

  cross([x, y], colour) {
    const {ink, plan} = this;
    if (x === null) return;
    ink.strokeStyle = colour;
    ink.lineWidth = 1.4;
    ink.beginPath();
    for (const side of [-1, 1]) {
      ink.moveTo(plan.x(x) - 4, plan.y(y) - 4 * side);
      ink.lineTo(plan.x(x) + 4, plan.y(y) + 4 * side);
    }
    ink.stroke();
  }

  scaleBar(width) {
    const {ink, plan} = this;
    const rough = width / 6 / plan.scale;
    const power = 10 ** Math.floor(Math.log10(rough));
    const metres = power * [5, 2, 1].find((step) => step * power <= rough);
    ink.strokeStyle = ink.fillStyle = paint('ink');
    ink.lineWidth = 2;
    ink.beginPath();
    ink.moveTo(12, plan.height - 12);
    ink.lineTo(12 + metres * plan.scale, plan.height - 12);
    ink.stroke();
    ink.font = '12px sans-serif';
    ink.fillText(`${shown(metres)} m`, 12, plan.height - 18);
  }
}

/** How far each estimate is from the truth at an instant: [name, metres or null]. */
function errorsAt(drawing, step) {
  const truth = drawing.map.truth[step];
  return drawing.map.estimates.map(({name}, i) => {
    const at = drawing.paths[i][step];
    return [name, truth && at && at[0] !== null ? Math.hypot(at[0] - truth[0], at[1] - truth[1]) : null];
  });
}

function mapView(map) {
  const canvas = element('canvas', {role: 'img'});
  const state = {step: Math.max(map.time_s.length - 1, 0), times: 1, hidden: new Set()};
  const drawing = new MapDrawing(map, canvas, state);
  const slider = element('input', {type: 'range', min: 0, max: state.step, step: 1, 'aria-label': 'time'});
  const time = element('output', {});
  const errors = element('div', {class: 'tools legend'});
  const draw = () => {
    slider.value = state.step;
    const text = `${shown(map.time_s[state.step] ?? null)} s`;
    slider.setAttribute('aria-valuetext', text);
    time.textContent = `${text}, ${state.step} of ${Number(slider.max)}`;
    const now = errorsAt(drawing, state.step);
    canvas.setAttribute('aria-label', `${map.words} At ${text}: ${now.filter(([, metres]) => metres !== null)
      .map(([name, metres]) => `${name} is ${shown(metres)} m off`).join(', ')}.`);
    errors.replaceChildren(...now.map(([name, metres]) => {
      const line = element('span', {class: 'swatch'});
      line.style.borderTopColor = look(name).colour;
      line.style.borderTopStyle = look(name).dash.length > 0 ? 'dashed' : 'solid';
      const box = checkbox('', !state.hidden.has(name), (checked) => {
        state.hidden[checked ? 'delete' : 'add'](name);
        drawing.draw();
      });
      box.append(line, `${name}${metres === null ? '' : `: ${shown(metres)} m`}`);
      return box;
    }));
    drawing.draw();
  };
  slider.addEventListener('input', () => { state.step = Number(slider.value); draw(); });
  let timer = null;
  const play = button('Play', () => {
    if (timer !== null || state.step >= Number(slider.max)) state.step = timer === null ? 0 : state.step;
    if (timer !== null) {
      clearInterval(timer);
      timer = null;
    } else {
      timer = setInterval(() => {
        if (state.step >= Number(slider.max)) play.click();
        else { state.step += 1; draw(); }
      }, Math.max(30, 8000 / Math.max(map.time_s.length, 1)));
    }
    play.textContent = timer === null ? 'Play' : 'Pause';
  });
  const factors = [1, 10, 100, 1000, 10000];
  const enlarge = choice('errors and ellipses are drawn', factors.map((times) => `errors and ellipses x ${times}`),
                         (i) => { state.times = factors[i]; draw(); });
  const tools = element('div', {class: 'tools'}, play, slider, time);
  if (map.truth.some((pose) => pose !== null)) tools.append(enlarge);
  redraws.push(draw);
  whenPlaced.push(draw);
  addEventListener('resize', draw);
  return element('div', {class: 'map'}, tools, canvas, errors);
}
