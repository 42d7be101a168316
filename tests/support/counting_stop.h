// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "core/types/stop.h"

namespace plumescout::testing {

// Says stop once it was asked more often than `patience`, and counts how often it was.
class CountingStop {
 public:
  explicit CountingStop(int patience = std::numeric_limits<int>::max()) : patience_(patience) {}
  CountingStop(const CountingStop&) = delete;  // `Fn` refers to it
  CountingStop& operator=(const CountingStop&) = delete;

  StopFn Fn() {
    return [this] { return ++asked_ > patience_; };
  }
  int asked() const { return asked_; }

 private:
  int patience_;
  int asked_ = 0;
};

}  // namespace plumescout::testing
