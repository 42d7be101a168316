// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/about/cpu_time.h"

#include <time.h>

#include <utility>
#include <vector>

#include "core/types/quantile.h"

namespace plumescout::lab {

double ThreadCpu_ms() {
  constexpr double kMsPerS = 1e3;
  constexpr double kMsPerNs = 1e-6;
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * kMsPerS + static_cast<double>(now.tv_nsec) * kMsPerNs;
}

double MedianCpu_ms(int repeats, const std::function<void()>& run) {
  run();
  std::vector<double> times_ms;
  for (int i = 0; i < repeats; ++i) {
    const double start_ms = ThreadCpu_ms();
    run();
    times_ms.push_back(ThreadCpu_ms() - start_ms);
  }
  return Median(std::move(times_ms));
}

}  // namespace plumescout::lab
