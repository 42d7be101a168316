// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/search_meter.h"

#include <algorithm>

namespace plumescout {

void SearchMeter::Begin(std::int64_t samples, std::size_t searches_left) {
  max_draws_ = draws_ + samples;
  if (problem_.max_edge_evaluations <= 0) return;
  const std::int64_t left = problem_.max_edge_evaluations - edges_;
  const auto searches = static_cast<std::int64_t>(std::max<std::size_t>(searches_left, 1));
  max_edges_ = edges_ + (left + searches - 1) / searches;
}

double SearchMeter::Price(Point2 a, Point2 b) {
  const bool same = (a == last_a_ && b == last_b_) || (a == last_b_ && b == last_a_);
  if (has_last_ && same) return last_price_;
  if (edges_ >= max_edges_) {
    out_of_edges_ = true;
    return std::numeric_limits<double>::infinity();
  }
  ++edges_;
  has_last_ = true;
  last_a_ = a;
  last_b_ = b;
  last_price_ = problem_.cost(a, b);
  return last_price_;
}

bool SearchMeter::Over() {
  stopped_ = stopped_ || problem_.stop();
  out_of_edges_ = out_of_edges_ || edges_ >= max_edges_;
  return stopped_ || edges_ >= max_edges_ || draws_ >= max_draws_;
}

}  // namespace plumescout
