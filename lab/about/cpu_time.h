// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace plumescout::lab {

// CPU time that the calling thread has used.
double ThreadCpu_ms();

// Median CPU time of the calling thread over `repeats` runs, after one that warms up.
double MedianCpu_ms(int repeats, const std::function<void()>& run);

}  // namespace plumescout::lab
