/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   The page's state and what changes it. The state is in the address too: #frame=12&mode=follow&compare=side. */

const modes = ['follow', 'orbit', 'fly'];
const comparisons = ['rendering', 'image', 'side', 'swipe', 'blend'];

class Page {
  static async open() {
    try {
      const data = await readData();
      window.odosplat = new Page(data, new PackedMap(await readBlock('map'), data.map));
    } catch (error) {
      element('message').textContent = `The page cannot be shown: ${error.message}`;
      element('message').hidden = false;
      throw error;
    }
  }

  constructor(data, map) {
    this.data = data;
    this.states = new RunStates(data);
    const posed = data.runs.length > 0 || Boolean(data.truth);
    this.state = {frame: 0, mode: posed ? 'follow' : 'orbit', compare: 'rendering', mix: 50,
                  path: data.runs.length > 0 ? '0' : 'truth', color: this.states.way('').name, paths: true, cut: 100};
    if (/mode=orbit/.test(location.hash) || !posed) this.state.cut = 70; /* so that one sees into a room from above */
    this.panel = new Panel(data, this.states);
    this.stage = new Stage(data, map, this.states, this.state);
    this.timeLine = new TimeLine(data, (frame, by) => this.chooseFrame(frame, by));
    this.fillChoices(posed);
    this.makePlots();
    this.listen();
    this.readAddress();
    const pose = posed ? this.stage.pose(this.state.frame) : null;
    if (pose && this.state.mode !== 'orbit') this.stage.free.take(pose, 0.5 * this.stage.extent.radius);
    this.update();
  }

  fillChoices(posed) {
    const {data} = this, option = (select, value, words) => {
      const made = child(element(select), 'option', words);
      made.value = value;
    };
    data.runs.forEach((run, index) => option('path', String(index), run.name));
    if (data.truth) option('path', 'truth', 'truth');
    for (const way of this.states.ways) option('color', way.name, way.words);
    element('path-row').hidden = element('path').options.length < 2;
    element('color-row').hidden = this.states.ways.length < 2;
    element('paths-row').hidden = !posed;
    element('mode-follow').hidden = !posed;
  }

  makePlots() {
    const {data, states} = this, box = element('plots'), choose = (frame) => this.chooseFrame(frame);
    this.plots = [];
    const add = (title, key, unitOf) => {
      const runs = data.runs.map((run, index) => ({run, index})).filter(({run}) => run[key]);
      if (runs.length === 0) return;
      const largest = scaleEnd(runs.map(({run}) => run[key]));
      const series = runs.map(({run, index}) => ({name: run.name, values: run[key], color: () => runColor(index),
                                                  gap: run.gap, lost: (f) => states.isLost(run, f)}));
      this.plots.push(new Plot(box, title, series, unitOf(largest), data.times, choose));
    };
    add('Position error', 'position_error_m', lengthUnit);
    add('Rotation error', 'rotation_error_deg', () => ({name: '°', factor: 1}));
    add('Sigma of position', 'sigma_m', lengthUnit);
    for (const run of data.runs.filter((r) => r.status)) {
      this.plots.push(new StateStrip(box, run, data.times, choose, (f) => states.stateText(run, f),
                                     (f) => stateColors[states.stateOf(run, f)]));
    }
    if (data.runs.length > 1) {
      const key = element('plot-key');
      data.runs.forEach((run, index) => {
        const item = child(key, 'span', undefined, 'swatch');
        child(item, 'i').style.background = runColor(index);
        child(item, 'span', run.name);
      });
    }
    box.hidden = this.plots.length === 0;
    new ResizeObserver(() => this.drawPlots()).observe(box);
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.update());
  }

  drawPlots() { for (const plot of this.plots) plot.draw(this.state.frame); }

  listen() {
    const {stage, state} = this;
    for (const mode of modes) element(`mode-${mode}`).addEventListener('click', () => this.chooseMode(mode));
    for (const key of ['path', 'color', 'compare']) {
      element(key).addEventListener('change', () => {
        state[key] = element(key).value;
        this.update();
      });
    }
    for (const key of ['mix', 'cut']) {
      element(key).addEventListener('input', () => {
        state[key] = Number(element(key).value);
        stage.changed();
        this.writeAddress();
      });
    }
    element('paths').addEventListener('change', () => {
      state.paths = element('paths').checked;
      this.update();
    });
    element('overview').addEventListener('click', () => {
      if (state.mode === 'follow') state.mode = 'orbit';
      stage.free.overview();
      if (state.cut >= 100) state.cut = 70;
      this.update();
    });
    element('save').addEventListener('click', () => this.save());
    element('help').addEventListener('click', () => element('keys').showModal());
    window.addEventListener('hashchange', () => {
      this.readAddress();
      this.update();
    });
    stage.controls = new Controls(stage.box, {
      moved: () => stage.changed(),
      free: () => (state.mode === 'follow' ? null : stage.free),
      inPlace: () => state.mode === 'fly',
      drag: (x) => {
        const taken = stage.drag(x);
        if (taken) this.update();
        return taken;
      },
      tap: (x, y) => {
        stage.box.focus({preventScroll: true});
        const point = stage.overlay.nearest(x, y);
        if (point) this.chooseFrame(point.frame);
      },
      hover: (x, y) => this.hover(x, y),
      key: (event) => this.key(event),
    });
  }

  hover(x, y) {
    const tip = element('tip'), point = x >= 0 ? this.stage.overlay.nearest(x, y) : null;
    tip.hidden = !point;
    if (!point) return;
    const run = this.data.runs[point.run];
    const lines = [[run.name, `frame ${point.frame}, ${this.data.times[point.frame].toFixed(2)} s`], ...this.states.facts(run, point.frame)];
    tip.textContent = lines.map(([name, text]) => `${name}: ${text}`).join('\n');
    const box = this.stage.box;
    tip.style.left = `${limited(x + 14, 0, Math.max(0, box.clientWidth - tip.offsetWidth - 4))}px`;
    tip.style.top = `${limited(y + 14, 0, Math.max(0, box.clientHeight - tip.offsetHeight - 4))}px`;
  }

  key(event) {
    const {state} = this, key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const last = this.data.times.length - 1, onButton = event.target.closest('button');
    if (key === ' ' && !onButton) this.timeLine.toggle();
    else if (key === 'ArrowLeft') this.timeLine.stepped(-1);
    else if (key === 'ArrowRight') this.timeLine.stepped(1);
    else if (key === 'Home') this.chooseFrame(0);
    else if (key === 'End') this.chooseFrame(last);
    else if ('123'.includes(key) && !element(`mode-${modes[key - 1]}`).hidden) this.chooseMode(modes[key - 1]);
    else if (key === 'p') this.set({paths: !state.paths});
    else if (key === 'o') element('overview').click();
    else if (key === 'c' && this.data.images.length > 0 && !element('mode-follow').hidden) {
      this.set({mode: 'follow', compare: comparisons[(comparisons.indexOf(state.compare) + 1) % comparisons.length]});
    } else if (key === '?') element('keys').showModal();
    else return false;
    return true;
  }

  set(values) {
    Object.assign(this.state, values);
    this.update();
  }

  chooseMode(mode) {
    const {stage, state} = this, pose = stage.pose(state.frame);
    if (state.mode === 'follow' && mode !== 'follow' && pose) stage.free.take(pose, 0.5 * stage.extent.radius);
    this.set({mode});
  }

  /* by: direction of a step. While an image is compared with the rendering, frames without one are passed over. */
  chooseFrame(frame, by = 0) {
    const {data, state, panel} = this;
    if (data.times.length === 0) return;
    state.frame = limited(frame, 0, data.times.length - 1);
    if (this.stage.comparing() !== 'rendering') {
      let k = panel.nearestImage(state.frame);
      const before = data.images.findIndex((image) => image.frame === frame - by);
      if (by !== 0 && before >= 0) k = limited(before + by, 0, data.images.length - 1);
      state.frame = data.images[k].frame;
    }
    this.update();
  }

  update() {
    const {state, data, stage} = this;
    if (stage.comparing() !== 'rendering') state.frame = data.images[this.panel.nearestImage(state.frame)].frame;
    for (const mode of modes) element(`mode-${mode}`).setAttribute('aria-pressed', String(state.mode === mode));
    for (const key of ['path', 'color', 'compare', 'mix', 'cut']) element(key).value = state[key];
    element('paths').checked = state.paths;
    element('compare-row').hidden = state.mode !== 'follow' || data.images.length === 0;
    element('mix-row').hidden = !['swipe', 'blend'].includes(stage.comparing());
    element('cut-row').hidden = state.mode === 'follow';
    if (data.times.length > 0) this.timeLine.show(state.frame);
    this.panel.writeFrame(state);
    this.panel.writeLegend(this.states.way(state.color), state.paths);
    this.drawPlots();
    stage.changed();
    this.writeAddress();
  }

  readAddress() {
    const {state, data} = this, given = new URLSearchParams(location.hash.slice(1));
    const among = (key, values) => {
      if (values.includes(given.get(key))) state[key] = given.get(key);
    };
    const number = (key, low, high) => {
      const value = Number.parseInt(given.get(key), 10);
      if (Number.isFinite(value)) state[key] = limited(value, low, high);
    };
    number('frame', 0, Math.max(0, data.times.length - 1));
    number('mix', 0, 100);
    number('cut', 0, 100);
    if (data.runs.length > 0 || data.truth) among('mode', modes);
    else among('mode', ['orbit', 'fly']);
    among('compare', comparisons);
    among('path', [...element('path').options].map((o) => o.value));
    among('color', this.states.ways.map((way) => way.name));
    if (given.has('paths')) state.paths = given.get('paths') !== '0';
  }

  /* Some browsers allow few changes of the address in a time: the last one counts. */
  writeAddress() {
    clearTimeout(this.writing);
    this.writing = setTimeout(() => {
      const {frame, mode, compare, path, color, paths, mix, cut} = this.state;
      const words = new URLSearchParams({frame, mode, compare, path, color, paths: paths ? 1 : 0, mix, cut});
      try {
        history.replaceState(null, '', `#${words}`);
      } catch (error) {
        /* Pages without an address of their own, such as in a preview, keep none. */
      }
    }, 300);
  }

  async save() {
    const picture = await this.stage.snapshot();
    if (!picture) return;
    const link = document.createElement('a');
    link.href = picture;
    link.download = `rendering_${String(this.state.frame).padStart(6, '0')}.png`;
    link.click();
  }
}

Page.open();
