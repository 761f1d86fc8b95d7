/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   The page's side of sort_worker.js: one sort at a time, the newest request wins. */

class Sorter {
  /* positions, reaches: see sort_worker.js; they are given away. */
  constructor(positions, reaches, byDistance, whenSorted) {
    this.byDistance = byDistance;
    this.whenSorted = whenSorted;
    const source = document.getElementById('sort-worker').textContent;
    const address = URL.createObjectURL(new Blob([source], {type: 'text/javascript'}));
    this.worker = new Worker(address);
    this.worker.onmessage = (event) => this.sorted(event.data);
    this.worker.postMessage({positions, reaches}, [positions.buffer, reaches.buffer]);
    this.busy = false;
    this.wanted = null;
    this.spare = null;
    this.asked = null; /* view of the sort that was started last */
  }

  /* Whether the order for `before` is the order for `view`. */
  same(before, view) {
    const equal = (a, b) => a.every((value, k) => value === b[k]);
    return before !== null && equal(before.centre, view.centre) && equal(before.rotation, view.rotation) &&
        equal(this.limits(before), this.limits(view));
  }

  /* The image in x/z and y/z, with a margin of a quarter of its half for views that move on while they are sorted (and
     for the pixels that dilation adds to every splat). */
  limits(view) {
    const x = 0.125 * view.width / view.fx, y = 0.125 * view.height / view.fy;
    return [(-0.5 - view.cx) / view.fx - x, (view.width - 0.5 - view.cx) / view.fx + x,
            (-0.5 - view.cy) / view.fy - y, (view.height - 0.5 - view.cy) / view.fy + y];
  }

  request(view) {
    this.wanted = this.same(this.asked, view) ? null : view;
    if (!this.busy && this.wanted) this.start();
  }

  start() {
    const view = this.asked = this.wanted;
    this.wanted = null;
    this.busy = true;
    const limits = this.limits(view), t = Math.max(...limits.map(Math.abs)) * 1.1;
    /* A row of the projection is (axis - t depth) / z with |t| up to the Jacobian's margin. */
    const message = {centre: view.centre, rotation: view.rotation, limits, stretch: Math.sqrt(1 + t * t),
                     byDistance: this.byDistance, order: this.spare};
    this.worker.postMessage(message, this.spare ? [this.spare] : []);
    this.spare = null;
  }

  sorted(message) {
    this.busy = false;
    this.whenSorted(new Uint32Array(message.order, 0, message.count));
    this.spare = message.order;
    if (this.wanted) this.start();
  }
}
