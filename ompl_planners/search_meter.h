// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "core/plan/paths/path_planner.h"

namespace plumescout {

// Prices the edges of a search and says when it is over. Libraries that look at the same edge twice
// in a row, for its validity and then for its price, pay for one walk.
class SearchMeter {
 public:
  explicit SearchMeter(const PathProblem& problem) : problem_(problem) {}

  // The next search of `searches_left` begins: it may draw `samples` states and spend an even share
  // of the edges that are left.
  void Begin(std::int64_t samples, std::size_t searches_left);

  // +infinity if blocked, and for new edges once the share is spent.
  double Price(Point2 a, Point2 b);
  void CountDraw() { ++draws_; }

  // Whether the search begun last has to end.
  bool Over();
  bool stopped() const { return stopped_; }
  // Whether `stop` or the budget of edges ended any search so far.
  bool cut_short() const { return stopped_ || out_of_edges_; }

  int draws() const { return static_cast<int>(draws_); }
  int edges() const { return static_cast<int>(edges_); }

 private:
  static constexpr std::int64_t kNoBound = std::numeric_limits<std::int64_t>::max();

  const PathProblem& problem_;
  std::int64_t draws_ = 0;
  std::int64_t max_draws_ = 0;
  std::int64_t edges_ = 0;
  std::int64_t max_edges_ = kNoBound;
  bool stopped_ = false;
  bool out_of_edges_ = false;
  // The edge priced last.
  bool has_last_ = false;
  Point2 last_a_;
  Point2 last_b_;
  double last_price_ = 0.0;
};

}  // namespace plumescout
