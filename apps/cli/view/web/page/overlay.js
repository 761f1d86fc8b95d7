/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Paths and cameras, drawn over the rendering on a 2-D canvas: they are never hidden by the map. Every line has an edge
   of the opposite lightness, so that it can be seen on any part of the map. */

class Overlay {
  constructor(canvas, data, scale) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.data = data;
    this.scale = scale;
    this.points = []; /* of the last drawing, for the pointer: {x, y, run, frame} */
  }

  /* view: in pixels of `rect`, a part of the canvas; pixel: size of a CSS pixel. */
  begin(view, rect, pixel) {
    const c = this.context;
    this.view = view;
    this.rect = rect;
    this.pixel = pixel;
    this.points = [];
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    c.save();
    c.beginPath();
    c.rect(rect.x, rect.y, rect.width, rect.height);
    c.clip();
    c.lineJoin = c.lineCap = 'round';
  }

  end() { this.context.restore(); }

  /* [x, y, z] in the canvas and along the axis; z below `near` is behind. */
  project(p) {
    const [x, y, z] = toCamera(this.view, p), v = this.view;
    return [this.rect.x + v.fx * x / z + v.cx + 0.5, this.rect.y + v.fy * y / z + v.cy + 0.5, z];
  }

  /* A line from a to b in world coordinates, cut off in front of the camera; null if all of it is behind. */
  segment(a, b) {
    const near = 0.03, za = toCamera(this.view, a)[2], zb = toCamera(this.view, b)[2];
    if (za < near && zb < near) return null;
    const cutAt = () => add(a, times((near - za) / (zb - za), sub(b, a)));
    return [this.project(za < near ? cutAt() : a), this.project(zb < near ? cutAt() : b)];
  }

  strokes(lines, color, width, dashes = []) {
    const c = this.context;
    c.setLineDash(dashes.map((d) => d * this.pixel));
    c.strokeStyle = color;
    c.lineWidth = width * this.pixel;
    c.beginPath();
    for (const [a, b] of lines) {
      c.moveTo(a[0], a[1]);
      c.lineTo(b[0], b[1]);
    }
    c.stroke();
    c.setLineDash([]);
  }

  /* The true path: a thin white line with a black edge. */
  truth(path, align) {
    const lines = [];
    let before = null;
    for (let k = 0; k + 2 < path.length; k += 3) {
      const p = unaligned(align, [path[k], path[k + 1], path[k + 2]]);
      const line = before && this.segment(before, p);
      if (line) lines.push(line);
      before = p;
    }
    this.strokes(lines, '#000', 3.2);
    this.strokes(lines, '#fff', 1.2);
  }

  /* The path of a run. paint(frame): {color, dark}; gaps are dashed. */
  run(run, index, paint, faint) {
    const byColor = new Map(), edges = {light: [], dark: []}, gaps = [];
    let before = null;
    for (let f = 0; f < this.data.times.length; ++f) {
      const pose = poseAt(run.poses, f);
      if (!pose) continue;
      const line = before && this.segment(before, pose.t);
      if (line && run.gap[f]) {
        gaps.push(line);
      } else if (line) {
        const {color, dark} = paint(f);
        if (!byColor.has(color)) byColor.set(color, []);
        byColor.get(color).push(line);
        edges[dark ? 'light' : 'dark'].push(line);
      }
      const at = this.project(pose.t);
      if (at[2] > 0.03) this.points.push({x: at[0], y: at[1], run: index, frame: f});
      before = pose.t;
    }
    const width = faint ? 1.6 : 3.4;
    this.strokes(edges.dark, 'rgba(0,0,0,.8)', width + 2.2);
    this.strokes(edges.light, 'rgba(255,255,255,.9)', width + 2.2);
    for (const [color, lines] of byColor) this.strokes(lines, color, width);
    this.strokes(gaps, '#000', 3.2);
    this.strokes(gaps, '#fff', 1.4, [4, 5]);
  }

  /* A pyramid of the camera's shape, `size` metres deep. */
  camera(pose, lens, size, color) {
    const axes = axesOf(pose.q), lines = [];
    const corner = (u, v) => add(pose.t, add(times(size, axes[2]), add(times(size * (u - lens.cx) / lens.fx, axes[0]),
                                                                       times(size * (v - lens.cy) / lens.fy, axes[1]))));
    const [w, h] = [lens.width - 0.5, lens.height - 0.5];
    const corners = [corner(-0.5, -0.5), corner(w, -0.5), corner(w, h), corner(-0.5, h)];
    for (let k = 0; k < 4; ++k) {
      for (const end of [pose.t, corners[(k + 1) % 4]]) {
        const line = this.segment(corners[k], end);
        if (line) lines.push(line);
      }
    }
    this.strokes(lines, '#000', 4);
    this.strokes(lines, '#fff', 2.6);
    this.strokes(lines, color, 1.6);
  }

  /* The nearest pose that was drawn within 14 CSS pixels of (x, y) [CSS px]; null if there is none. */
  nearest(x, y) {
    let found = null, least = 14 * this.pixel;
    for (const point of this.points) {
      const distance = Math.hypot(point.x - x * this.pixel, point.y - y * this.pixel);
      if (distance < least) [found, least] = [point, distance];
    }
    return found;
  }
}
