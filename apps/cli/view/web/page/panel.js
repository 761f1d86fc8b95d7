/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   The parts of the page beside the stage that hold words: facts, legend, values of the frame, its image, notes. */

const element = (id) => document.getElementById(id);

function child(parent, kind, text, className) {
  const made = document.createElement(kind);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  parent.append(made);
  return made;
}

const grouped = (n) => String(n).replace(/\B(?=(\d{3})+$)/g, '\u202f');

class Panel {
  constructor(data, states) {
    this.data = data;
    this.states = states;
    const {map} = data, words = [`${grouped(map.count)} Gaussians`, `colours of SH degree ${map.degree}`];
    if (data.times.length > 0) words.push(`${grouped(data.times.length)} frames`);
    element('facts').textContent = words.join(' · ');
    this.writeNotes();
  }

  writeNotes() {
    const {data} = this, {map} = data, notes = [];
    if (map.thinned) {
      notes.push(`The map has ${grouped(map.total)} Gaussians; shown are the ${grouped(map.count)} most visible, ` +
                 `${(100 * map.share).toFixed(1)} % of the visibility: the rendering has more holes than the map's.`);
    } else if (map.count < map.total) {
      notes.push(`${grouped(map.total - map.count)} Gaussians are left out that are too transparent ever to be drawn.`);
    }
    if (map.degree < map.map_degree) {
      notes.push(`The colours' spherical harmonics are reduced from degree ${map.map_degree} to ${map.degree}: reflections ` +
                 'and gloss differ from the map.');
    }
    notes.push(`Gaussians are blended by ${map.order === 'distance' ? 'distance from the camera' : 'depth'}, as the map's header says` +
               `${map.compensated ? ', with compensated opacity' : ''}.`);
    if (data.runs.some((run) => run.position_error_m)) {
      const words = {none: 'no alignment', se3: 'alignment by a rigid motion', sim3: 'alignment by a similarity'};
      notes.push(`Errors are those of "odosplat eval --align ${data.alignment}": after ${words[data.alignment]}, poses of ` +
                 'the same time within 10 ms.');
      for (const run of data.runs.filter((r) => r.ate_m)) {
        notes.push(`${run.name}: ATE RMSE ${lengthText(run.ate_m.rmse)}, median ${lengthText(run.ate_m.median)}, max ` +
                   `${lengthText(run.ate_m.max)}; rotation RMSE ${degreesText(run.are_deg.rmse)}; ${run.pairs} pairs.`);
      }
    }
    if (data.runs.some((run) => run.sigma_m)) {
      notes.push('Sigma: root of the trace of the covariance that the tracker gave for the pose when the frame came.');
    }
    if (!data.camera && (data.runs.length > 0 || data.truth)) {
      notes.push('The camera is not known: views from poses are shown with 64° from left to right.');
    }
    if (data.images.length > 0) {
      notes.push(`${data.images.length} images of the sequence are embedded, reduced and without lens distortion.`);
    }
    for (const note of notes) child(element('notes'), 'li', note);
    child(element('notes'), 'li', `Times count from ${data.start || '0'} s. Made by odosplat ${data.version}.`);
  }

  writeLegend(way, shown) {
    const legend = element('legend');
    legend.textContent = '';
    legend.hidden = !shown || (this.data.runs.length === 0 && !this.data.truth);
    const swatch = (color, words) => {
      const item = child(legend, 'span', undefined, 'swatch');
      child(item, 'i').style.background = color;
      child(item, 'span', words);
    };
    if (way.key) {
      const unit = way.unit(way.end);
      child(legend, 'span', `${way.words} [${unit.name}]`);
      child(legend, 'span', '0');
      child(legend, 'i', undefined, 'bar').style.background = `linear-gradient(90deg, ${this.states.scale.colors.join(',')})`;
      child(legend, 'span', `≥ ${shortTick(way.end * unit.factor)}`);
      swatch(stateColors.unknown, 'unknown');
    } else if (way.name === 'state') {
      for (const [key, words] of [['ok', 'in the map'], ['relocalised', 'relocalised'], ['outside', 'not confirmed']]) {
        swatch(stateColors[key], words);
      }
    } else {
      this.data.runs.forEach((run, index) => swatch(runColor(index), run.name));
    }
    if (this.data.runs.length > 0) swatch('repeating-linear-gradient(90deg, #fff 0 4px, #000 4px 8px)', 'lost');
    if (this.data.truth) swatch('linear-gradient(#000 30%, #fff 30% 70%, #000 70%)', 'truth');
  }

  /* Index of the embedded image nearest to a frame; -1 if there is none. */
  nearestImage(frame) {
    let best = -1;
    this.data.images.forEach((image, k) => {
      if (best < 0 || Math.abs(image.frame - frame) < Math.abs(this.data.images[best].frame - frame)) best = k;
    });
    return best;
  }

  writeFrame(state) {
    const {data, states} = this, frame = state.frame, values = element('values');
    values.textContent = '';
    if (data.times.length > 0) {
      this.row(values, 'frame', String(frame));
      this.row(values, 'time', `${data.times[frame].toFixed(3)} s`);
    }
    const run = data.runs[state.path];
    if (run) for (const [name, text] of states.facts(run, frame)) this.row(values, name, text);
    const k = this.nearestImage(frame), figure = element('picture');
    figure.hidden = k < 0;
    if (k < 0) return;
    const image = data.images[k];
    if (this.shownImage !== k) {
      this.shownImage = k;
      for (const id of ['photo', 'thumbnail']) element(id).src = `data:image/jpeg;base64,${image.jpeg}`;
    }
    const where = image.frame === frame ? 'Image of this frame' : `Nearest image: frame ${image.frame}`;
    element('picture-name').textContent = image.name ? `${where}, ${image.name}` : where;
  }

  row(list, name, text) {
    child(list, 'dt', name);
    child(list, 'dd', text);
  }
}
