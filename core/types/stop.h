// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace plumescout {

// Asked now and then by long computations; true means: return what you have, soon. What has said so
// goes on saying so.
// Carries an RPC's deadline and cancellation into the core, which has no clock.
using StopFn = std::function<bool()>;

inline StopFn NeverStop() {
  return [] { return false; };
}

// Whether `stop` says so; an empty one never does.
inline bool Stops(const StopFn& stop) { return stop && stop(); }

// Work on so many cells, some tens of nanoseconds each, may lie between two asks.
inline constexpr std::size_t kCellsPerStop = 16384;

// Calls visit(first, end) for one piece of [0, cells) after the other, and asks `stop` before each.
// False once it says so: the rest is left out.
template <typename Visit>
bool InPieces(std::size_t cells, const StopFn& stop, const Visit& visit) {
  for (std::size_t first = 0; first < cells; first += kCellsPerStop) {
    if (Stops(stop)) return false;
    visit(first, std::min(cells, first + kCellsPerStop));
  }
  return true;
}

// The same with visit(y) for each row y, of `width` cells, from `begin` up to but without `end`.
template <typename Visit>
bool ByRows(int begin, int end, int width, const StopFn& stop, const Visit& visit) {
  const int rows = std::max(1, static_cast<int>(kCellsPerStop) / std::max(1, width));
  for (int y = begin; y < end; ++y) {
    if ((y - begin) % rows == 0 && Stops(stop)) return false;
    visit(y);
  }
  return true;
}

}  // namespace plumescout
