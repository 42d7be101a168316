// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace plumescout {

// Memory for numbers of any value, which is kept for the next who ask: to clear it first would take
// as long as to write to it.
class Room {
 public:
  // For so many numbers at least. What was there is lost if that is more than before.
  double* For(std::size_t size) {
    if (size > size_) {
      values_ = std::make_unique_for_overwrite<double[]>(size);
      size_ = size;
    }
    return values_.get();
  }

  double* data() { return values_.get(); }
  const double* data() const { return values_.get(); }

 private:
  std::unique_ptr<double[]> values_;
  std::size_t size_ = 0;
};

}  // namespace plumescout
