/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Pointer, wheel and keys on the stage. actions: moved(), drag(dx, dy, event) -> whether it took the drag, tap(x, y),
   hover(x, y), key(event) -> whether it took the key, free() -> the camera to move, null if it follows the frames,
   inPlace() -> whether drags turn it in place. */

class Controls {
  constructor(stage, actions) {
    this.stage = stage;
    this.actions = actions;
    this.pointers = new Map();
    this.held = new Set();
    this.travelled = 0;
    stage.addEventListener('pointerdown', (event) => this.down(event));
    stage.addEventListener('pointermove', (event) => this.pointerMoved(event));
    for (const kind of ['pointerup', 'pointercancel']) stage.addEventListener(kind, (event) => this.up(event));
    stage.addEventListener('pointerleave', () => actions.hover(-1, -1));
    stage.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
    stage.addEventListener('contextmenu', (event) => event.preventDefault());
    window.addEventListener('keydown', (event) => this.key(event));
    window.addEventListener('keyup', (event) => this.held.delete(event.key.toLowerCase()));
    window.addEventListener('blur', () => this.held.clear());
  }

  place(event) {
    const box = this.stage.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  down(event) {
    if (event.target.closest('button, input, select, a')) return;
    this.stage.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, this.place(event));
    if (this.pointers.size === 1) this.travelled = 0;
  }

  up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    if (event.type === 'pointerup' && this.pointers.size === 0 && this.travelled < 5) this.actions.tap(...this.place(event));
  }

  pointerMoved(event) {
    const now = this.place(event), before = this.pointers.get(event.pointerId);
    if (!before) return this.actions.hover(...now);
    const dx = now[0] - before[0], dy = now[1] - before[1];
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    this.pointers.set(event.pointerId, now);
    this.travelled += Math.abs(dx) + Math.abs(dy);
    if (others.length === 0 && this.actions.drag(now[0], now[1])) return;
    const camera = this.actions.free();
    if (!camera) return;
    const side = Math.max(this.stage.clientWidth, this.stage.clientHeight);
    if (others.length > 0) {
      /* Of two fingers each moves the middle by half; their distance zooms. */
      const gap = (a) => Math.hypot(a[0] - others[0][0], a[1] - others[0][1]);
      const factor = limited(gap(before) / Math.max(gap(now), 1), 0.5, 2);
      this.pan(camera, 0.5 * dx, 0.5 * dy, side);
      camera.dolly(factor);
    } else if (event.shiftKey || event.buttons & 6) {
      this.pan(camera, dx, dy, side);
    } else {
      /* In place the image follows the pointer, around the pivot the things do. */
      const angle = (this.actions.inPlace() ? -1.4 : 3.2) / side;
      camera.turn(angle * dx, -angle * dy, this.actions.inPlace());
    }
    this.actions.moved();
  }

  pan(camera, dx, dy, side) {
    const metres = camera.distance / (0.8 * side);
    camera.move(-dx * metres, dy * metres, 0);
  }

  wheel(event) {
    const camera = this.actions.free();
    if (!camera) return;
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1);
    const factor = Math.exp(limited(pixels, -200, 200) * 0.0015);
    if (this.actions.inPlace()) {
      camera.move(0, 0, -Math.log(factor) * 0.5 * camera.extent.radius);
    } else {
      camera.dolly(factor);
    }
    this.actions.moved();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.closest('input, select, textarea') && !['Escape'].includes(event.key)) return;
    if (this.actions.key(event)) return event.preventDefault();
    if ('wasdqe'.includes(event.key.toLowerCase()) && this.actions.free()) {
      this.held.add(event.key.toLowerCase());
      this.fast = event.shiftKey;
      this.actions.moved();
    }
  }

  /* Moves the camera by the keys that are held; seconds since the last call. Whether any is held. */
  step(seconds) {
    const camera = this.actions.free();
    if (this.held.size === 0 || !camera) return false;
    const axis = (plus, minus) => (this.held.has(plus) ? 1 : 0) - (this.held.has(minus) ? 1 : 0);
    const metres = (this.fast ? 1.2 : 0.35) * camera.extent.radius * Math.min(seconds, 0.2);
    camera.move(axis('d', 'a') * metres, axis('e', 'q') * metres, axis('w', 's') * metres);
    return true;
  }
}
