// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumescout {

// A cell that a search has reached, and how.
template <typename Length>
struct TravelEntry {
  int cell;  // index of a padded raster
  int way;   // which of the straight, or of the diagonal, steps led there
  Length travel_m;
};

// Entries that a search is to go on from, in the order in which they came; the slots behind `count`
// are room to write into.
template <typename Length>
struct TravelBucket {
  static constexpr std::size_t kRoom = 4;  // as many as one visit may reach by steps of a length

  // Where `kRoom` entries may be written.
  TravelEntry<Length>* Tail() {
    if (slots.size() < count + kRoom) slots.resize(2 * (count + kRoom));
    return slots.data() + count;
  }

  std::vector<TravelEntry<Length>> slots;
  std::size_t count = 0;
};

// Entries that need no order among themselves, by what they were reached.
template <typename Length>
struct TravelLevel {
  bool IsWaiting() const { return sources.count + straight.count + diagonal.count > 0; }
  void Clear() { sources.count = straight.count = diagonal.count = 0; }

  TravelBucket<Length> sources;
  TravelBucket<Length> straight;
  TravelBucket<Length> diagonal;
};

// The levels of a search that are in use at once: one that is gone through, and the next two.
template <typename Length>
class TravelLevels {
 public:
  TravelLevel<Length>& At(std::int64_t level) {
    return levels_[static_cast<std::size_t>(level) % kLevels];
  }
  // Whether there are entries on any.
  bool IsWaiting() const {
    return std::any_of(levels_.begin(), levels_.end(),
                       [](const TravelLevel<Length>& level) { return level.IsWaiting(); });
  }

 private:
  static constexpr std::size_t kLevels = 4;  // three are in use; a power of two is quicker

  std::array<TravelLevel<Length>, kLevels> levels_;
};

}  // namespace plumescout
