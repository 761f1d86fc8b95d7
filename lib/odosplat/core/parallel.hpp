// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>

namespace odosplat {

/// Threads that parallel_for uses: set_threads(n), n >= 1; by default the machine's cores.
void set_threads(int n);
int threads();

/// Calls body(begin, end) for consecutive chunks of [0, n) of `chunk` elements (the last may be shorter), on several
/// threads. Chunk borders depend on n and chunk alone, never on the number of threads: results that are kept per chunk
/// and summed in chunk order are bit-identical on any machine. If body throws, no further chunks are started and the
/// first exception is rethrown here once all threads have ended. Nested calls run in the calling thread.
void parallel_for(int n, int chunk, const std::function<void(int begin, int end)>& body);

}  // namespace odosplat
