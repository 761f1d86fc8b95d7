/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   The page's side of sort_worker.js: one sort at a time, the newest request wins. */

class Sorter {
  constructor(positions, byDistance, whenSorted) {
    this.byDistance = byDistance;
    this.whenSorted = whenSorted;
    const source = document.getElementById('sort-worker').textContent;
    const address = URL.createObjectURL(new Blob([source], {type: 'text/javascript'}));
    this.worker = new Worker(address);
    this.worker.onmessage = (event) => this.sorted(event.data);
    this.worker.postMessage({positions}, [positions.buffer]);
    this.busy = false;
    this.wanted = null;
    this.spare = null;
    this.asked = null; /* view of the sort that was started last */
  }

  /* Whether the order for `before` is the order for `view`. */
  same(before, view) {
    const equal = (a, b) => a.every((value, k) => value === b[k]);
    return before !== null && equal(before.centre, view.centre) &&
        (this.byDistance || equal(before.rotation.slice(6), view.rotation.slice(6)));
  }

  request(view) {
    this.wanted = this.same(this.asked, view) ? null : view;
    if (!this.busy && this.wanted) this.start();
  }

  start() {
    const view = this.asked = this.wanted;
    this.wanted = null;
    this.busy = true;
    const message = {centre: view.centre, forward: view.rotation.slice(6), byDistance: this.byDistance};
    if (this.spare) message.order = this.spare;
    this.worker.postMessage(message, this.spare ? [this.spare.buffer] : []);
    this.spare = null;
  }

  sorted(message) {
    this.busy = false;
    this.whenSorted(message.order);
    this.spare = message.order;
    if (this.wanted) this.start();
  }
}
