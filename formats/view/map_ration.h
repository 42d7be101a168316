// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace plumescout {

// How much of a mission's file is for maps, which tell nothing that cannot be replayed from the
// journal beside them. A layer of the map is shown if all that were shown, and it, take no more
// than a share of the journal so far, as packed; so often a large map of robots that say little is
// not shown. The first of each layer is, and one that was not for long enough.
class MapRation {
 public:
  // What a layer is not kept from being shown for longer.
  static constexpr std::int64_t kLongest_ns = 120'000'000'000;

  // `share` of the journal's bytes; infinity: all are shown.
  explicit MapRation(double share) : share_(share) {}

  // A record of the journal, as it is.
  void NoteRecord(std::size_t bytes) { journal_bytes_ += static_cast<double>(bytes); }
  // Whether a layer of so many bytes, packed, is shown now; notes that it is.
  bool Allows(const std::string& layer, std::size_t packed_bytes, std::int64_t time_ns) {
    const auto bytes = static_cast<double>(packed_bytes);
    const auto shown = shown_ns_.find(layer);
    const bool is_over = map_bytes_ + bytes > share_ * journal_bytes_;
    if (is_over && shown != shown_ns_.end() && time_ns - shown->second < kLongest_ns) return false;
    map_bytes_ += bytes;
    shown_ns_[layer] = time_ns;
    return true;
  }

 private:
  const double share_;
  double journal_bytes_ = 0.0;
  double map_bytes_ = 0.0;
  std::map<std::string, std::int64_t> shown_ns_;
};

}  // namespace plumescout
