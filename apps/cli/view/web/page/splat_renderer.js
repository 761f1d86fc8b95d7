/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Draws a packed map on a canvas with WebGL2. A view: {rotation: 9 numbers, rows of world to camera; centre: of the
   camera in the world; fx, fy, cx, cy, width, height [px]}. */

class SplatRenderer {
  /* Throws Error with words for the user if the browser cannot draw it. */
  constructor(canvas, map, facts) {
    this.canvas = canvas;
    this.map = map;
    this.facts = facts;
    this.drawn = 0;
    const options = {alpha: false, antialias: false, depth: false, stencil: false, powerPreference: 'high-performance'};
    this.gl = canvas.getContext('webgl2', options);
    if (!this.gl) {
      throw new Error('This browser gives no WebGL2, which the rendering needs: switch hardware acceleration on, or ' +
                      'use a newer browser. Images and plots are shown all the same.');
    }
    canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => this.make());
    this.make();
  }

  make() {
    const gl = this.gl, defines = `#define SH_DEGREE ${this.facts.degree}\n#define COEFFICIENTS ${this.map.coefficients}\n`;
    this.program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, splatVertexShader], [gl.FRAGMENT_SHADER, splatFragmentShader]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, splatConstants + defines + text);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error('The shaders cannot be compiled here: ' + gl.getProgramInfoLog(this.program));
    }
    this.places = new Map();
    this.width = Math.min(4096, gl.getParameter(gl.MAX_TEXTURE_SIZE));
    this.shapesPerRow = Math.floor(this.width / 3);
    this.colorsPerRow = Math.floor(this.width / this.map.coefficients);
    this.shapes = this.texture(gl.RGBA32F, this.shapesPerRow, 12, (i, to, at) => this.map.shape(i, to, at));
    this.colors = this.texture(gl.RGBA16F, this.colorsPerRow, 4 * this.map.coefficients,
                               (i, to, at) => this.map.color(i, to, at));
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    this.order = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.order);
    gl.bufferData(gl.ARRAY_BUFFER, 4 * this.map.count, gl.DYNAMIC_DRAW);
    const gaussian = gl.getAttribLocation(this.program, 'gaussian');
    gl.enableVertexAttribArray(gaussian);
    gl.vertexAttribIPointer(gaussian, 1, gl.UNSIGNED_INT, 0, 0);
    gl.vertexAttribDivisor(gaussian, 1);
    if (this.last) this.setOrder(this.last);
  }

  /* A texture of `perRow` Gaussians a row with `numbers` numbers each, filled some rows at a time. */
  texture(format, perRow, numbers, fill) {
    const gl = this.gl, count = this.map.count, width = perRow * numbers / 4, rows = Math.ceil(count / perRow);
    if (rows > gl.getParameter(gl.MAX_TEXTURE_SIZE)) {
      throw new Error('The map is too large for the textures of this browser; write the page with a smaller --budget.');
    }
    const texture = gl.createTexture(), step = Math.max(1, Math.floor(65536 / perRow));
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, rows);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    for (let row = 0; row < rows; row += step) {
      const height = Math.min(step, rows - row), texels = new Float32Array(4 * width * height);
      const end = Math.min(count, (row + height) * perRow);
      for (let i = row * perRow; i < end; ++i) fill(i, texels, (i - row * perRow) * numbers);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, width, height, gl.RGBA, gl.FLOAT, texels);
    }
    return texture;
  }

  /* Indices from far to near. */
  setOrder(order) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.order);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, order);
    this.drawn = order.length;
    this.last = order.slice();
  }

  uniform(name) {
    if (!this.places.has(name)) this.places.set(name, this.gl.getUniformLocation(this.program, name));
    return this.places.get(name);
  }

  clear() {
    const gl = this.gl;
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(0, 0, 0, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
  }

  /* Draws a view into the rectangle with upper left corner (x, y) of the canvas [px], on black. cut: four numbers, see
     the shader. */
  draw(view, x, y, cut) {
    const gl = this.gl, below = this.canvas.height - y - view.height;
    this.clear();
    if (this.drawn === 0) return;
    gl.viewport(x, below, view.width, view.height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(x, below, view.width, view.height);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(this.program);
    gl.bindVertexArray(this.array);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.shapes);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.colors);
    gl.uniform1i(this.uniform('shapes'), 0);
    gl.uniform1i(this.uniform('colors'), 1);
    gl.uniform1i(this.uniform('shapesPerRow'), this.shapesPerRow);
    gl.uniform1i(this.uniform('colorsPerRow'), this.colorsPerRow);
    gl.uniformMatrix3fv(this.uniform('rotation'), true, view.rotation);
    gl.uniform3fv(this.uniform('centre'), view.centre);
    gl.uniform4f(this.uniform('lens'), view.fx, view.fy, view.cx, view.cy);
    const marginX = 0.15 * view.width / view.fx, marginY = 0.15 * view.height / view.fy; /* JACOBIAN_MARGIN / 2 */
    gl.uniform4f(this.uniform('clamps'), (-0.5 - view.cx) / view.fx - marginX,
                 (view.width - 0.5 - view.cx) / view.fx + marginX, (-0.5 - view.cy) / view.fy - marginY,
                 (view.height - 0.5 - view.cy) / view.fy + marginY);
    gl.uniform4f(this.uniform('area'), x, below, view.width, view.height);
    gl.uniform4fv(this.uniform('cut'), cut);
    gl.uniform1f(this.uniform('dilation'), this.facts.dilation);
    gl.uniform1i(this.uniform('compensated'), this.facts.compensated ? 1 : 0);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.drawn);
  }
}
