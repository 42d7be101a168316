// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/belief_propagation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plumescout::lab {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// East and west, north and south: where a message sent that way arrives.
constexpr int Opposite(int direction) { return (direction + 2) % 4; }

}  // namespace

BeliefPropagation::BeliefPropagation(const GmrfGraph& graph, const GasOptions& gas,
                                     const BeliefPropagationOptions& options)
    : gas_(gas), options_(options), nodes_(static_cast<std::size_t>(graph.variables())) {
  for (Node& node : nodes_) {
    node.neighbour.fill(VariableIndex::kNone);
    node.own.precision = gas.background_precision_per_ppm2;
  }
  for (int i = 0; i < graph.variables(); ++i) {
    const auto variable = static_cast<VariableIndex>(i);
    const auto& later = graph.later_neighbours(variable);
    for (int direction = 0; direction < 2; ++direction) {
      const VariableIndex neighbour = later[static_cast<std::size_t>(direction)];
      if (neighbour == VariableIndex::kNone) continue;
      nodes_[ToSize(variable)].neighbour[static_cast<std::size_t>(direction)] = neighbour;
      nodes_[ToSize(neighbour)].neighbour[static_cast<std::size_t>(Opposite(direction))] = variable;
    }
  }
  for (int i = 0; i < graph.variables(); ++i) Note(static_cast<VariableIndex>(i), kUnbounded);
}

void BeliefPropagation::SetEvidence(VariableIndex variable, const Evidence& evidence) {
  nodes_[ToSize(variable)].own = {gas_.background_precision_per_ppm2 + evidence.precision,
                                  evidence.weighted_deviation};
  Note(variable, kUnbounded);
}

std::int64_t BeliefPropagation::Propagate(std::int64_t max_sends) {
  std::int64_t sends = 0;
  while (waiting_ > 0 && sends < max_sends) {
    std::pop_heap(queue_.begin(), queue_.end(), IsServedAfter);
    const Place place = queue_.back();
    queue_.pop_back();
    const Node& node = nodes_[ToSize(place.variable)];
    const bool left_behind =
        options_.schedule == MessageSchedule::kResidual && place.urgency != node.residual;
    if (!node.waiting || left_behind) continue;
    Send(place.variable);
    ++sends;
  }
  return sends;
}

Posterior BeliefPropagation::Beliefs() const {
  Posterior posterior;
  posterior.mean_ppm.reserve(nodes_.size());
  posterior.variance_ppm2.reserve(nodes_.size());
  for (const Node& node : nodes_) {
    const Message total = Total(node);
    posterior.mean_ppm.push_back(gas_.background_mean_ppm + total.information / total.precision);
    posterior.variance_ppm2.push_back(1.0 / total.precision);
  }
  return posterior;
}

bool BeliefPropagation::IsServedAfter(const Place& a, const Place& b) {
  return a.urgency != b.urgency ? a.urgency < b.urgency : a.turn > b.turn;
}

BeliefPropagation::Message BeliefPropagation::Total(const Node& node) {
  Message total = node.own;
  for (const Message& message : node.incoming) {
    total.precision += message.precision;
    total.information += message.information;
  }
  return total;
}

double BeliefPropagation::Distance(const Message& before, const Message& after) const {
  if (before.precision == 0.0) return kUnbounded;  // the first word
  const double mean_change_ppm =
      after.information / after.precision - before.information / before.precision;
  const double variance_before_ppm2 = 1.0 / before.precision;
  const double variance_after_ppm2 = 1.0 / after.precision;
  if (options_.distance == MessageDistance::kEuclidean) {
    return std::hypot(mean_change_ppm, variance_after_ppm2 - variance_before_ppm2);
  }
  const double sum_ppm2 = variance_before_ppm2 + variance_after_ppm2;
  const double geometric_ppm2 = std::sqrt(variance_before_ppm2 * variance_after_ppm2);
  return 0.25 * mean_change_ppm * mean_change_ppm / sum_ppm2 +
         0.5 * std::log(0.5 * sum_ppm2 / geometric_ppm2);
}

void BeliefPropagation::Note(VariableIndex variable, double change) {
  Node& node = nodes_[ToSize(variable)];
  if (!(change > node.residual)) return;
  node.residual = change;
  if (!(change > options_.threshold)) return;
  const bool by_residual = options_.schedule == MessageSchedule::kResidual;
  if (node.waiting && !by_residual) return;  // keeps its place
  if (!node.waiting) ++waiting_;
  node.waiting = true;
  queue_.push_back({by_residual ? change : 0.0, turn_++, variable});
  std::push_heap(queue_.begin(), queue_.end(), IsServedAfter);
}

// To each neighbour all that is known here but what it said itself, through the prior factor
// lambda_p (m_i - m_j)^2: marginalising m_i out of N(eta, lambda) leaves lambda_p lambda /
// (lambda_p + lambda) with the same mean.
void BeliefPropagation::Send(VariableIndex variable) {
  Node& node = nodes_[ToSize(variable)];
  node.waiting = false;
  node.residual = 0.0;
  --waiting_;
  const Message total = Total(node);
  for (int direction = 0; direction < kDirections; ++direction) {
    const auto side = static_cast<std::size_t>(direction);
    if (node.neighbour[side] == VariableIndex::kNone) continue;
    const double precision = total.precision - node.incoming[side].precision;
    const double information = total.information - node.incoming[side].information;
    const double passed =
        gas_.prior_precision_per_ppm2 / (gas_.prior_precision_per_ppm2 + precision);
    const Message message{passed * precision, passed * information};
    Message& heard = nodes_[ToSize(node.neighbour[side])]
                         .incoming[static_cast<std::size_t>(Opposite(direction))];
    const double change = Distance(heard, message);
    heard = message;
    Note(node.neighbour[side], change);
  }
}

}  // namespace plumescout::lab
