/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Plots of values over time, and strips of states, each on a canvas of its own, with the cursor of the time line. */

class Plot {
  /* series: [{name, values, color()}]; unit: {name, factor} of the values. choose(frame): the user picked a frame. */
  constructor(parent, title, series, unit, times, choose) {
    Object.assign(this, {series, unit, times, choose, title});
    const figure = document.createElement('figure'), caption = document.createElement('figcaption');
    caption.textContent = `${title} [${unit.name}]`;
    this.readout = document.createElement('span');
    this.readout.className = 'readout';
    caption.append(this.readout);
    this.canvas = document.createElement('canvas');
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', `${title} in ${unit.name} over time in seconds`);
    figure.append(caption, this.canvas);
    parent.append(figure);
    this.top = roundedUp(Math.max(0, ...series.map((s) => s.values.reduce((m, v) => (v > m ? v : m), 0))) * unit.factor);
    const frameAt = (event) => this.frameAt(event.clientX - this.canvas.getBoundingClientRect().left);
    this.canvas.addEventListener('pointerdown', (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      choose(frameAt(event));
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (event.buttons) choose(frameAt(event));
      this.hovered = frameAt(event);
      this.draw(this.frame);
    });
    this.canvas.addEventListener('pointerleave', () => {
      this.hovered = undefined;
      this.draw(this.frame);
    });
  }

  area() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    return {left: 40, right: width - 8, top: 6, bottom: height - 20};
  }

  x(frame, area) {
    const last = this.times[this.times.length - 1] || 1;
    return area.left + (area.right - area.left) * this.times[frame] / last;
  }

  frameAt(x) {
    const area = this.area(), last = this.times[this.times.length - 1] || 1;
    const time = (x - area.left) / Math.max(area.right - area.left, 1) * last;
    let best = 0;
    for (let f = 0; f < this.times.length; ++f) if (Math.abs(this.times[f] - time) < Math.abs(this.times[best] - time)) best = f;
    return best;
  }

  draw(frame) {
    this.frame = frame;
    const pixel = window.devicePixelRatio || 1, c = this.canvas.getContext('2d'), area = this.area();
    this.canvas.width = Math.round(this.canvas.clientWidth * pixel);
    this.canvas.height = Math.round(this.canvas.clientHeight * pixel);
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue('--ink'), line = style.getPropertyValue('--line');
    c.setTransform(pixel, 0, 0, pixel, 0, 0);
    c.font = '11px system-ui, sans-serif';
    c.textBaseline = 'middle';
    const y = (value) => area.bottom - (area.bottom - area.top) * value * this.unit.factor / this.top;
    c.lineWidth = 1;
    c.fillStyle = ink;
    c.textAlign = 'right';
    for (const share of [0, 0.5, 1]) {
      const at = Math.round(area.bottom - (area.bottom - area.top) * share) + 0.5;
      c.strokeStyle = line;
      c.beginPath();
      c.moveTo(area.left, at);
      c.lineTo(area.right, at);
      c.stroke();
      c.fillText(shortTick(share * this.top), area.left - 5, at);
    }
    this.timeTicks(c, area);
    for (const series of this.series) this.curve(c, area, series, y);
    const at = this.x(frame, area);
    c.strokeStyle = ink;
    c.lineWidth = 1.5;
    c.beginPath();
    c.moveTo(at, area.top - 4);
    c.lineTo(at, area.bottom + 3);
    c.stroke();
    const shown = this.hovered ?? frame;
    const words = this.series.map((s) => (this.series.length > 1 ? `${s.name} ` : '') + shortNumber(s.values[shown] * this.unit.factor));
    this.readout.textContent = `${this.times[shown].toFixed(2)} s: ${words.join(', ')}`;
  }

  timeTicks(c, area) {
    const last = this.times[this.times.length - 1] || 1, step = roundedUp(last / 5);
    c.textAlign = 'center';
    for (let t = 0; t <= last * 1.001; t += step) {
      const at = area.left + (area.right - area.left) * t / last;
      c.fillText(`${shortTick(t)}${t + step > last * 1.001 ? ' s' : ''}`, Math.min(at, area.right - 8), area.bottom + 11);
    }
  }

  curve(c, area, series, y) {
    c.strokeStyle = c.fillStyle = series.color();
    c.lineWidth = 1.6;
    c.beginPath();
    let open = false;
    for (let f = 0; f < this.times.length; ++f) {
      const value = series.values[f];
      if (!Number.isFinite(value)) {
        /* A gap where the frame is known to be lost; runs at other rates have no value at this frame. */
        if (series.lost && series.lost(f)) open = false;
        continue;
      }
      const at = [this.x(f, area), y(value)];
      if (open && !(series.gap && series.gap[f])) c.lineTo(...at);
      else c.moveTo(...at);
      open = true;
    }
    c.stroke();
    c.fillStyle = stateColors.lost;
    if (series.lost) {
      for (let f = 0; f < this.times.length; ++f) if (series.lost(f)) c.fillRect(this.x(f, area) - 0.5, area.bottom - 4, 1.5, 4);
    }
  }
}

const shortTick = (value) => String(Number(value.toPrecision(3)));

/* A row of states over time: a coloured mark per frame. */
class StateStrip extends Plot {
  constructor(parent, run, times, choose, nameOf, colorOf) {
    super(parent, `State: ${run.name}`, [], {name: '', factor: 1}, times, choose);
    this.canvas.className = 'strip';
    this.canvas.setAttribute('aria-label', `State of ${run.name} over time`);
    this.caption = this.canvas.previousSibling;
    this.caption.firstChild.textContent = `State: ${run.name}`;
    this.nameOf = nameOf;
    this.colorOf = colorOf;
  }

  draw(frame) {
    this.frame = frame;
    if (!this.nameOf) return;
    const pixel = window.devicePixelRatio || 1, c = this.canvas.getContext('2d'), area = this.area();
    this.canvas.width = Math.round(this.canvas.clientWidth * pixel);
    this.canvas.height = Math.round(this.canvas.clientHeight * pixel);
    c.setTransform(pixel, 0, 0, pixel, 0, 0);
    const n = this.times.length;
    for (let f = 0; f < n; ++f) {
      /* On whole pixels, else the edges of the marks show. */
      const [from, to] = [this.x(f, area), f + 1 < n ? this.x(f + 1, area) : area.right].map((x) => Math.round(x * pixel) / pixel);
      c.fillStyle = this.colorOf(f);
      const lost = this.nameOf(f).startsWith('lost');
      c.fillRect(from, lost ? 9 : 3, Math.max(to - from, 1), lost ? 3 : 12);
    }
    c.fillStyle = getComputedStyle(document.documentElement).getPropertyValue('--ink');
    c.fillRect(this.x(frame, area) - 0.75, 0, 1.5, 18);
    const shown = this.hovered ?? frame;
    this.readout.textContent = `${this.times[shown].toFixed(2)} s: ${this.nameOf(shown)}`;
  }
}
