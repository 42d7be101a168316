// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "absl/status/status.h"

namespace plumescout::lab {

// Does task(0) ... task(count - 1), which must not depend on each other, up to `jobs` (>= 1) at a
// time, and returns the error of the lowest number that failed; after a failure no task is begun.
// `progress` (may be empty) is told the finished share, by one thread at a time.
absl::Status RunTasks(std::size_t count, int jobs,
                      const std::function<absl::Status(std::size_t)>& task,
                      const std::function<void(double)>& progress = nullptr);

}  // namespace plumescout::lab
