#pragma once

#include <benchmark/benchmark.h>

#include <ctime>

namespace nacre {

/// Milliseconds of computing, of all threads, that `draw` takes.
template <class Draw>
double computing_ms(const Draw& draw) {
  const std::clock_t begin = std::clock();
  benchmark::DoNotOptimize(draw());
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

}  // namespace nacre
