/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors

   One step of Adam (Kingma, Ba 2015, algorithm 1) on an array of n floats. `pattern` [stride + 16] holds the relative
   rate of each element of a row of `stride` elements, repeated: element i moves at rate * pattern[i % stride].
   inverse_bias1 = 1 / (1 - beta1^t), inverse_bias2 = 1 / sqrt(1 - beta2^t). A work-item updates 16 elements. */
__kernel void adam_step(__global float* restrict parameters, const __global float* restrict gradients,
                        __global float* restrict first, __global float* restrict second,
                        const __global float* restrict pattern, uint n, uint stride, float rate, float beta1,
                        float beta2, float inverse_bias1, float inverse_bias2, float epsilon) {
  const uint i = (uint)get_global_id(0) * 16u;
  if (i >= n) return;
  const __global float* rates = pattern + i % stride;
  if (i + 16u <= n) {
    const float16 g = vload16(0, gradients + i);
    const float16 m = beta1 * vload16(0, first + i) + (1.0f - beta1) * g;
    const float16 v = beta2 * vload16(0, second + i) + (1.0f - beta2) * g * g;
    const float16 move = rate * vload16(0, rates) * (m * inverse_bias1) / (sqrt(v) * inverse_bias2 + epsilon);
    vstore16(m, 0, first + i);
    vstore16(v, 0, second + i);
    vstore16(vload16(0, parameters + i) - move, 0, parameters + i);
    return;
  }
  for (uint k = 0; i + k < n; ++k) {
    const float g = gradients[i + k];
    const float m = beta1 * first[i + k] + (1.0f - beta1) * g;
    const float v = beta2 * second[i + k] + (1.0f - beta2) * g * g;
    first[i + k] = m;
    second[i + k] = v;
    parameters[i + k] -= rate * rates[k] * (m * inverse_bias1) / (sqrt(v) * inverse_bias2 + epsilon);
  }
}

/* parameters [n] = min(parameters, bound [n]). A work-item updates 16 elements. */
__kernel void limit_above(__global float* restrict parameters, const __global float* restrict bound, uint n) {
  const uint i = (uint)get_global_id(0) * 16u;
  if (i >= n) return;
  if (i + 16u <= n) {
    vstore16(fmin(vload16(0, parameters + i), vload16(0, bound + i)), 0, parameters + i);
    return;
  }
  for (uint k = i; k < n; ++k) parameters[k] = fmin(parameters[k], bound[k]);
}
