/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   The stage: rendering, paths and image in one place, drawn when something has changed. While the view moves, the
   rendering's resolution is lowered as far as a slow device needs; when it rests, it is drawn once more in full. */

const defaultCamera = {width: 640, height: 480, fx: 512, fy: 512, cx: 319.5, cy: 239.5};

class Stage {
  constructor(data, map, states, state) {
    Object.assign(this, {data, states, state});
    this.box = document.getElementById('stage');
    this.canvas = document.getElementById('splats');
    this.photo = document.getElementById('photo');
    this.divider = document.getElementById('divider');
    this.message = document.getElementById('message');
    this.lens = data.camera || defaultCamera;
    const positions = map.positions();
    this.extent = extentOf(positions, data.up);
    this.free = new FreeCamera(this.extent);
    this.overlay = new Overlay(document.getElementById('overlay'), data, states.scale);
    this.motionScale = 1;
    this.lastMoved = 0;
    this.frameTime = 0;
    this.waiting = [];
    try {
      this.renderer = new SplatRenderer(this.canvas, map, data.map);
      this.sorter = new Sorter(positions, map.reaches(), data.map.order === 'distance', (order) => {
        this.renderer.setOrder(order);
        this.changed(false);
        for (const done of this.waiting.splice(0)) done();
      });
      this.canvas.addEventListener('webglcontextrestored', () => this.changed(false));
    } catch (error) {
      this.renderer = null;
      this.failure = error.message;
    }
    new ResizeObserver(() => this.changed(false)).observe(this.box);
  }

  /* The pose that is followed at a frame; null: none. */
  pose(frame) {
    const {runs, truth} = this.data, run = runs[this.state.path];
    if (run) return poseAt(run.poses, frame);
    return truth && this.state.path === 'truth' ? unalignedPose(this.alignment(), poseAt(truth.poses, frame)) : null;
  }

  /* Of the run whose world the map is in. */
  alignment() {
    const run = this.data.runs[this.state.path] || this.data.runs[0];
    return run ? run.align : undefined;
  }

  following() { return this.state.mode === 'follow'; }

  comparing() { return this.following() && this.data.images.length > 0 ? this.state.compare : 'rendering'; }

  /* Rectangles of rendering and image on a stage of this size [px]. */
  layout(width, height) {
    const whole = {x: 0, y: 0, width, height};
    if (!this.following()) return {rendering: whole, image: null};
    if (this.comparing() !== 'side') {
      const rect = fittedRect(this.lens, whole);
      return {rendering: rect, image: rect};
    }
    const across = width / height > this.lens.width / this.lens.height;
    const w = across ? Math.floor(width / 2) : width, h = across ? height : Math.floor(height / 2);
    return {rendering: fittedRect(this.lens, {x: 0, y: 0, width: w, height: h}),
            image: fittedRect(this.lens, {x: width - w, y: height - h, width: w, height: h})};
  }

  /* The view in a rectangle; null if the frame has no pose. */
  view(rect) {
    if (!this.following()) return this.free.view(rect.width, rect.height);
    const pose = this.pose(this.state.frame);
    if (!pose) return null;
    return {...resizedLens(this.lens, rect.width, rect.height), rotation: rowsOf(axesOf(pose.q)), centre: pose.t};
  }

  cut() {
    if (this.following() || this.state.cut >= 100) return [0, 0, 0, 1];
    const {up, floor, ceiling} = this.extent;
    return [...up, floor + (ceiling - floor) * (0.02 + 0.98 * this.state.cut / 100)];
  }

  /* To be called when anything has changed; moving: the view does, and will probably go on. */
  changed(moving = true) {
    document.documentElement.dataset.settled = '0';
    if (moving) this.moved = true; /* until the next tick, however late that comes */
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame((time) => this.tick(time));
  }

  tick(time) {
    this.scheduled = false;
    const passed = time - (this.lastTick || time);
    if (this.moved || (this.controls && this.controls.step(passed / 1000))) this.lastMoved = performance.now();
    this.moved = false;
    const moving = performance.now() - this.lastMoved < (this.motionScale < 0.9 ? 600 : 250);
    if (moving && this.wasMoving && passed > 0) this.adapt(passed);
    this.wasMoving = moving;
    this.lastTick = time;
    this.draw(moving ? this.motionScale : 1);
    if (moving) {
      this.changed(false);
    } else if (!this.sorter || (!this.sorter.busy && !this.sorter.wanted)) {
      document.documentElement.dataset.settled = '1';
    }
  }

  adapt(milliseconds) {
    this.frameTime = this.frameTime ? 0.8 * this.frameTime + 0.2 * milliseconds : milliseconds;
    if (milliseconds > 50) this.motionScale *= limited(Math.sqrt(40 / milliseconds), 0.3, 1);
    if (milliseconds < 22) this.motionScale *= 1.06;
    this.motionScale = limited(this.motionScale, 0.2, 1);
  }

  draw(scale) {
    const pixel = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round(this.box.clientWidth * pixel)), height = Math.max(1, Math.round(this.box.clientHeight * pixel));
    const full = this.layout(width, height), view = this.view(full.rendering);
    this.say(view);
    if (this.renderer && this.comparing() !== 'image') this.drawSplats(view, width, height, scale);
    this.drawPaths(view, full.rendering, width, height, pixel);
    this.placePhoto(full, pixel);
  }

  say(view) {
    const run = this.data.runs[this.state.path];
    let words = this.failure || '';
    if (!words && !view) words = run ? `Frame ${this.state.frame}: ${this.states.stateText(run, this.state.frame)}` : 'No pose at this frame';
    if (this.message.textContent !== words) this.message.textContent = words;
    this.message.hidden = words === '';
  }

  resize(canvas, width, height) {
    if (canvas.width === width && canvas.height === height) return;
    canvas.width = width;
    canvas.height = height;
  }

  drawSplats(view, width, height, scale) {
    const w = Math.max(1, Math.round(width * scale)), h = Math.max(1, Math.round(height * scale));
    this.resize(this.canvas, w, h);
    if (!view) return this.renderer.clear();
    const rect = this.layout(w, h).rendering;
    this.sorter.request(view);
    this.renderer.draw(this.view(rect), rect.x, rect.y, this.cut());
  }

  drawPaths(view, rect, width, height, pixel) {
    const {overlay, data, states, state} = this, way = states.way(state.color);
    this.resize(overlay.canvas, width, height);
    if (!view || !state.paths) {
      overlay.points = [];
      return overlay.context.clearRect(0, 0, width, height);
    }
    overlay.begin(view, rect, pixel);
    if (data.truth) overlay.truth(data.truth.path, this.alignment());
    data.runs.forEach((run, index) => {
      overlay.run(run, index, states.paint(run, index, way), data.runs.length > 1 && state.path !== String(index));
    });
    if (!this.following()) this.drawCameras();
    overlay.end();
  }

  /* Of the frame; not those that the view is inside of. */
  drawCameras() {
    const size = 0.06 * this.extent.radius, {data, state, overlay} = this;
    const draw = (pose, color) => {
      if (pose && norm(sub(pose.t, overlay.view.centre)) > 2.5 * size) overlay.camera(pose, this.lens, size, color);
    };
    const truth = data.truth && unalignedPose(this.alignment(), poseAt(data.truth.poses, state.frame));
    draw(truth, '#000');
    data.runs.forEach((run, index) => draw(poseAt(run.poses, state.frame), runColor(index)));
  }

  placePhoto(full, pixel) {
    const kind = this.comparing(), shown = this.following() && ['image', 'side', 'swipe', 'blend'].includes(kind);
    this.photo.hidden = !shown;
    this.divider.hidden = kind !== 'swipe' || !shown;
    if (!shown) return;
    const {x, y, width, height} = full.image, mix = this.state.mix;
    Object.assign(this.photo.style, {left: `${x / pixel}px`, top: `${y / pixel}px`, width: `${width / pixel}px`,
                                     height: `${height / pixel}px`, opacity: kind === 'blend' ? mix / 100 : 1,
                                     clipPath: kind === 'swipe' ? `inset(0 0 0 ${100 - mix}%)` : 'none'});
    Object.assign(this.divider.style, {left: `${(x + width * (1 - mix / 100)) / pixel}px`, top: `${y / pixel}px`,
                                       height: `${height / pixel}px`});
  }

  /* In compare mode swipe a drag moves the edge. */
  drag(x) {
    if (this.comparing() !== 'swipe') return false;
    const pixel = window.devicePixelRatio || 1, rect = this.layout(this.box.clientWidth * pixel, this.box.clientHeight * pixel).image;
    this.state.mix = Math.round(limited(1 - (x * pixel - rect.x) / rect.width, 0, 1) * 100);
    return true;
  }

  /* A PNG (data URL) of the rendering alone: the followed camera's image in its own size, or the free view. null if
     there is none. */
  async snapshot() {
    if (!this.renderer) return null;
    const size = this.following() ? this.lens : {width: this.box.clientWidth, height: this.box.clientHeight};
    const view = this.view({x: 0, y: 0, width: size.width, height: size.height});
    if (!view) return null;
    do {
      this.sorter.request(view);
      if (this.sorter.busy) await new Promise((done) => this.waiting.push(done));
    } while (!this.sorter.same(this.sorter.asked, view) || this.sorter.busy);
    this.resize(this.canvas, size.width, size.height);
    this.renderer.draw(view, 0, 0, this.cut());
    const picture = this.canvas.toDataURL('image/png');
    this.changed(false);
    return picture;
  }
}
