/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   The slider over the frames, and playing. choose(frame): the user, or playing, picked a frame. */

class TimeLine {
  constructor(data, choose) {
    this.data = data;
    this.choose = choose;
    this.slider = element('slider');
    this.button = element('play');
    this.words = element('when');
    this.slider.max = Math.max(0, data.times.length - 1);
    element('time').hidden = data.times.length === 0;
    this.slider.addEventListener('input', () => {
      this.stop();
      choose(Number(this.slider.value));
    });
    this.button.addEventListener('click', () => this.toggle());
    element('before').addEventListener('click', () => this.stepped(-1));
    element('after').addEventListener('click', () => this.stepped(1));
  }

  stepped(by) {
    this.stop();
    this.choose(Number(this.slider.value) + by, by);
  }

  show(frame) {
    this.slider.value = frame;
    const time = this.data.times[frame];
    this.slider.setAttribute('aria-valuetext', `frame ${frame}, ${time.toFixed(2)} seconds`);
    this.words.textContent = `${frame} / ${this.data.times.length - 1} · ${time.toFixed(2)} s`;
  }

  toggle() { return this.playing ? this.stop() : this.start(); }

  stop() {
    this.playing = false;
    this.button.textContent = '▶';
    this.button.setAttribute('aria-label', 'play');
  }

  /* At the rate of the stamps; frames are skipped where drawing takes longer. */
  start() {
    const {times} = this.data, last = times.length - 1;
    let at = Number(this.slider.value);
    if (last < 1) return;
    if (at >= last) at = 0;
    this.playing = true;
    this.button.textContent = '❚❚';
    this.button.setAttribute('aria-label', 'pause');
    let since = null;
    const from = times[at];
    const tick = (now) => {
      if (!this.playing) return;
      if (since === null) since = now;
      const time = from + (now - since) / 1000;
      let frame = at;
      while (frame < last && times[frame + 1] <= time) ++frame;
      if (frame !== at) {
        at = frame;
        this.choose(frame);
      }
      if (frame >= last) return this.stop();
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }
}
