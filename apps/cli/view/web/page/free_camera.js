/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   A camera that the user moves: around the point that it looks at (orbit), or in place (fly). It stays level. */

class FreeCamera {
  constructor(extent) {
    this.extent = extent;
    this.up = extent.up;
    this.north = unit(cross(this.up, Math.abs(this.up[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0]));
    this.east = cross(this.north, this.up);
    this.overview();
  }

  /* From above at an angle, the whole map in view. */
  overview() {
    this.yaw = 0.6;
    this.pitch = -0.9;
    this.distance = 1.9 * this.extent.radius;
    this.position = sub(this.extent.middle, times(this.distance, this.forward()));
  }

  /* Where a camera of the data is, without its roll. */
  take(pose, distance) {
    const forward = axesOf(pose.q)[2];
    this.position = pose.t;
    this.pitch = Math.asin(limited(dot(forward, this.up), -0.999, 0.999));
    this.yaw = Math.atan2(dot(forward, this.east), dot(forward, this.north));
    this.distance = distance;
  }

  forward() {
    const c = Math.cos(this.pitch), level = add(times(Math.cos(this.yaw), this.north), times(Math.sin(this.yaw), this.east));
    return add(times(c, level), times(Math.sin(this.pitch), this.up));
  }

  right() { return unit(cross(this.forward(), this.up)); }

  pivot() { return add(this.position, times(this.distance, this.forward())); }

  /* Turns by angles [rad]; around the pivot or in place. */
  turn(yaw, pitch, inPlace) {
    const pivot = this.pivot();
    this.yaw += yaw;
    this.pitch = limited(this.pitch + pitch, -1.55, 1.55);
    if (!inPlace) this.position = sub(pivot, times(this.distance, this.forward()));
  }

  /* Moves by metres to the right, up in the image and forward. */
  move(right, up, forward) {
    const f = this.forward(), r = this.right(), u = cross(r, f);
    this.position = add(this.position, add(times(right, r), add(times(up, u), times(forward, f))));
  }

  /* Approaches the pivot by a factor; it moves on when it is near. */
  dolly(factor) {
    const least = 0.02 * this.extent.radius, distance = limited(this.distance * factor, least, 20 * this.extent.radius);
    this.move(0, 0, this.distance * (1 - factor) > 0 && distance === least ? 0.3 * least : this.distance - distance);
    this.distance = distance;
  }

  /* The view of an image [px] with the longer side seen under 64 degrees. */
  view(width, height) {
    const forward = this.forward(), right = this.right(), f = 0.8 * Math.max(width, height);
    return {rotation: rowsOf([right, cross(forward, right), forward]), centre: this.position, fx: f, fy: f,
            cx: 0.5 * width - 0.5, cy: 0.5 * height - 0.5, width, height};
  }
}
