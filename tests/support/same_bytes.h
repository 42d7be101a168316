// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>

#include "core/types/grid.h"

namespace plumescout::support {

// Bitwise equality of rasters: NaN equals NaN.
template <typename T>
bool SameBytes(const Grid<T>& a, const Grid<T>& b) {
  if (a.geometry() != b.geometry()) return false;
  return a.size() == 0 ||  // no data to point to
         std::memcmp(a.values().data(), b.values().data(), a.size() * sizeof(T)) == 0;
}

}  // namespace plumescout::support
