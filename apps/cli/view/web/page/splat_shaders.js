/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Shaders that draw a Gaussian as a quad: the projection of projection.cl and project.cl, the colours of sh.cl and
   shade.cl, and the alpha of composite.cl in the repository's kernels, with the constants of constants.h. Gaussians are
   blended from far to near, so that no pixel ends early: a difference below MIN_TRANSMITTANCE. */

const splatConstants = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
#define LOG2_MIN_ALPHA (-7.99435344)
#define MAX_ALPHA 0.99
#define NEAR_DEPTH 0.05
#define COMPENSATION_FLOOR 0.005
#define HALF_LOG2_E 0.72134752
`;

const splatVertexShader = `
uniform sampler2D shapes; // three texels per Gaussian: place and log2 opacity, quaternion x y z w, deviations
uniform sampler2D colors; // a texel per coefficient
uniform int shapesPerRow, colorsPerRow;
uniform mat3 rotation;    // world to camera
uniform vec3 centre;      // of the camera, in the world
uniform vec4 lens;        // fx fy cx cy [px]
uniform vec4 clamps;      // least and largest x/z, least and largest y/z of the Jacobian's point
uniform vec4 area;        // x y of the lower left corner on the canvas, width, height [px]
uniform vec4 cut;         // Gaussians with dot(cut.xyz, place) > cut.w are left out
uniform float dilation;
uniform bool compensated;
in uint gaussian;
flat out vec4 conic;      // A B C, log2 opacity
flat out vec2 middle;     // on the canvas [px]
flat out vec3 color;

vec3 coefficient(int i, int k) {
  return texelFetch(colors, ivec2(i % colorsPerRow * COEFFICIENTS + k, i / colorsPerRow), 0).rgb;
}

vec3 shade(int i, vec3 d) {
  vec3 sum = vec3(0.5) + 0.28209479 * coefficient(i, 0);
#if SH_DEGREE >= 1
  float x = d.x, y = d.y, z = d.z;
  sum += 0.48860251 * (z * coefficient(i, 2) - y * coefficient(i, 1) - x * coefficient(i, 3));
#endif
#if SH_DEGREE >= 2
  float xx = x * x, yy = y * y, zz = z * z;
  sum += 1.09254843 * (x * y * coefficient(i, 4) - y * z * coefficient(i, 5) - x * z * coefficient(i, 7));
  sum += 0.31539157 * (2.0 * zz - xx - yy) * coefficient(i, 6) + 0.54627422 * (xx - yy) * coefficient(i, 8);
#endif
#if SH_DEGREE >= 3
  sum += -0.59004359 * y * (3.0 * xx - yy) * coefficient(i, 9) + 2.89061144 * x * y * z * coefficient(i, 10);
  sum += -0.45704580 * (4.0 * zz - xx - yy) * (y * coefficient(i, 11) + x * coefficient(i, 13));
  sum += 0.37317633 * z * (2.0 * zz - 3.0 * xx - 3.0 * yy) * coefficient(i, 12);
  sum += 1.44530572 * z * (xx - yy) * coefficient(i, 14) - 0.59004359 * x * (xx - 3.0 * yy) * coefficient(i, 15);
#endif
  return max(sum, 0.0);
}

mat3 matrix_of(vec4 q) {
  float x = q.x, y = q.y, z = q.z, w = q.w;
  return mat3(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y),
              2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x),
              2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y));
}

void main() {
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0); // outside: not drawn
  int i = int(gaussian);
  ivec2 at = ivec2(i % shapesPerRow * 3, i / shapesPerRow);
  vec4 place = texelFetch(shapes, at, 0);
  vec3 p = rotation * (place.xyz - centre);
  if (!(p.z >= NEAR_DEPTH && p.z < 1.0e6) || dot(cut.xyz, place.xyz) > cut.w) return;
  vec2 h = p.xy / p.z;
  vec2 uv = lens.xy * h + lens.zw;
  vec3 deviations = texelFetch(shapes, at + ivec2(2, 0), 0).xyz;
  mat3 M = rotation * matrix_of(texelFetch(shapes, at + ivec2(1, 0), 0));
  vec3 M0 = deviations * vec3(M[0].x, M[1].x, M[2].x), M1 = deviations * vec3(M[0].y, M[1].y, M[2].y);
  vec3 M2 = deviations * vec3(M[0].z, M[1].z, M[2].z);
  vec3 r0 = lens.x / p.z * (M0 - clamp(h.x, clamps.x, clamps.y) * M2);
  vec3 r1 = lens.y / p.z * (M1 - clamp(h.y, clamps.z, clamps.w) * M2);
  vec3 n = cross(r0, r1);
  float a = dot(r0, r0), b = dot(r0, r1), c = dot(r1, r1), det0 = dot(n, n);
  float det = det0 + dilation * (a + c) + dilation * dilation;
  float log2_opacity = place.w;
  if (compensated) log2_opacity += 0.5 * log2(max(det0 / det, COMPENSATION_FLOOR));
  float level = log2_opacity - LOG2_MIN_ALPHA;
  if (!(level >= 0.0 && det > 0.0)) return;
  a += dilation;
  c += dilation;
  float reach = sqrt(level / HALF_LOG2_E); // [standard deviations] where alpha is MIN_ALPHA
  vec2 extent = reach * sqrt(vec2(a, c));
  if (!(extent.x < 1.0e7 && extent.y < 1.0e7) || any(lessThan(uv + extent, vec2(-0.5))) ||
      any(greaterThan(uv - extent, area.zw - 0.5))) return;
  float mean = 0.5 * (a + c), spread = length(vec2(0.5 * (a - c), b));
  float longer = mean + spread, shorter = det / longer;
  vec2 axis = spread > 1.0e-6 * mean ? normalize(a > c ? vec2(longer - c, b) : vec2(b, longer - a)) : vec2(1.0, 0.0);
  vec2 corner = reach * (2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0);
  vec2 pixel = uv + 0.5 + corner.x * sqrt(longer) * axis + corner.y * sqrt(shorter) * vec2(-axis.y, axis.x);
  gl_Position = vec4(2.0 * pixel.x / area.z - 1.0, 1.0 - 2.0 * pixel.y / area.w, 0.0, 1.0);
  conic = vec4(HALF_LOG2_E / det * vec3(c, -2.0 * b, a), log2_opacity);
  middle = vec2(area.x + uv.x + 0.5, area.y + area.w - uv.y - 0.5);
  color = shade(i, normalize(place.xyz - centre));
}`;

const splatFragmentShader = `
flat in vec4 conic;
flat in vec2 middle;
flat in vec3 color;
out vec4 pixel;
void main() {
  vec2 d = gl_FragCoord.xy - middle;
  float e = conic.w - conic.x * d.x * d.x + conic.y * d.x * d.y - conic.z * d.y * d.y; // d.y points up
  if (e < LOG2_MIN_ALPHA) discard;
  float alpha = min(exp2(e), MAX_ALPHA);
  pixel = vec4(alpha * color, alpha);
}`;
