/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   What is known of the frames of the runs, and how their paths are painted. */

class RunStates {
  constructor(data) {
    this.data = data;
    this.scale = new ErrorScale(data.scale);
    /* Ways to colour a path: {name, key of the values, words of the legend, text of a value}. */
    this.ways = [
      {name: 'error', key: 'position_error_m', words: 'position error', text: lengthText, unit: lengthUnit},
      {name: 'rotation', key: 'rotation_error_deg', words: 'rotation error', text: degreesText,
       unit: () => ({name: '°', factor: 1})},
      {name: 'sigma', key: 'sigma_m', words: 'sigma of position', text: lengthText, unit: lengthUnit},
    ].filter((way) => data.runs.some((run) => run[way.key]));
    for (const way of this.ways) way.end = scaleEnd(data.runs.filter((run) => run[way.key]).map((run) => run[way.key]));
    if (data.runs.some((run) => run.status)) this.ways.push({name: 'state', words: 'state'});
    if (data.runs.length > 0) this.ways.push({name: 'run', words: 'run'});
  }

  way(name) { return this.ways.find((way) => way.name === name) || this.ways[0] || {name: 'run', words: 'run'}; }

  isLost(run, frame) { return Boolean(run.status) && run.status[frame] === 3; }

  stateOf(run, frame) {
    if (this.isLost(run, frame)) return 'lost';
    if (!run.status || run.status[frame] === 0) return 'unknown';
    if (run.in_map[frame] === 0) return 'outside';
    return statusNames[run.status[frame]];
  }

  stateText(run, frame) {
    const state = this.stateOf(run, frame), reason = run.reasons && run.reasons[frame];
    if (state === 'outside') return `${statusNames[run.status[frame]]}, not confirmed in the map (in_map 0)`;
    if (state === 'unknown') return poseAt(run.poses, frame) ? 'posed' : 'no pose at this time';
    return reason ? `${state}: ${reason}` : state;
  }

  /* Colour of the path at a frame, and whether it is dark. */
  paint(run, index, way) {
    return (frame) => {
      if (way.name === 'run') return {color: runColor(index), dark: !isDark()};
      if (way.name === 'state') return {color: stateColors[this.stateOf(run, frame)], dark: true};
      const value = run[way.key] ? run[way.key][frame] : NaN;
      if (!Number.isFinite(value)) return {color: stateColors.unknown, dark: true};
      const k = this.scale.index(value / way.end);
      return {color: this.scale.colors[k], dark: this.scale.dark[k]};
    };
  }

  /* Lines about a frame: [name, text]. */
  facts(run, frame) {
    const lines = [['state', this.stateText(run, frame)]];
    const number = (name, key, text) => {
      if (run[key] && Number.isFinite(run[key][frame])) lines.push([name, text(run[key][frame])]);
    };
    number('position error', 'position_error_m', lengthText);
    number('rotation error', 'rotation_error_deg', degreesText);
    number('sigma of position', 'sigma_m', lengthText);
    number('sigma of rotation', 'sigma_deg', degreesText);
    number('map seen from here', 'confirmed', (p) => `${(100 * p).toFixed(1)}\u00a0%`);
    number('keyframe', 'keyframe', (k) => (k ? 'yes' : 'no'));
    return lines;
  }
}
