// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/gas/gmrf_graph.h"
#include "core/gas/information.h"
#include "core/types/options.h"
#include "lab/rivals/posterior.h"

namespace plumescout::lab {

// Which variable sends its messages next.
enum class MessageSchedule {
  kWildfire,  // in the order in which changes reached them: a front that spreads from the evidence
  kResidual,  // the one whose incoming messages have changed most since it last sent
};

// How far apart two messages are, seen as Gaussians of mean and variance.
enum class MessageDistance { kEuclidean, kBhattacharyya };

struct BeliefPropagationOptions {
  MessageSchedule schedule = MessageSchedule::kWildfire;
  MessageDistance distance = MessageDistance::kEuclidean;
  // A variable whose incoming messages have changed by no more than this does not send, >= 0.
  double threshold = 1e-4;
};

// Loopy Gaussian belief propagation on the field of GmrfGraph: the solver of [GBP], which [XIT] and
// [LHR] use. Its means converge to the exact ones; its variances do not: information that comes
// round a loop counts again, so that they are too small wherever there are loops, on indoor maps
// by a median of 0.4 to 0.6. Kept to reproduce those studies and as a rival; missions use
// PosteriorSolver. Deterministic: ties are broken by the order of variables. Thread-compatible.
class BeliefPropagation {
 public:
  // Without evidence, and with every message still to be sent. REQUIRES: Validate(gas).ok().
  BeliefPropagation(const GmrfGraph& graph, const GasOptions& gas,
                    const BeliefPropagationOptions& options);

  // Replaces what the readings of one cell say. The change spreads at the next Propagate.
  void SetEvidence(VariableIndex variable, const Evidence& evidence);

  // Lets variables send until none has more than the threshold to say, or after `max_sends`.
  // Returns how many have sent; each costs four messages and, by residual, O(log n).
  std::int64_t Propagate(std::int64_t max_sends = std::numeric_limits<std::int64_t>::max());
  bool converged() const { return waiting_ == 0; }

  // Marginals by variable, as the messages stand.
  Posterior Beliefs() const;

 private:
  static constexpr int kDirections = 4;  // east, north, west, south

  // A Gaussian over a deviation from the background, in information form.
  struct Message {
    double precision = 0.0;    // ppm^-2; 0: says nothing
    double information = 0.0;  // precision times mean, ppm^-1
  };
  struct Node {
    Message own;  // background and readings
    std::array<Message, kDirections> incoming;
    std::array<VariableIndex, kDirections> neighbour;
    double residual = 0.0;  // largest change of an incoming message since it last sent
    bool waiting = false;   // to send
  };
  // A place in the queue. One whose urgency has grown since takes another and leaves this behind.
  struct Place {
    double urgency;
    std::int64_t turn;
    VariableIndex variable;
  };
  static bool IsServedAfter(const Place& a, const Place& b);

  static Message Total(const Node& node);
  double Distance(const Message& before, const Message& after) const;
  // Notes a change of what `variable` hears, and queues it if that is worth telling.
  void Note(VariableIndex variable, double change);
  void Send(VariableIndex variable);

  const GasOptions gas_;
  const BeliefPropagationOptions options_;
  std::vector<Node> nodes_;
  std::vector<Place> queue_;  // a heap
  std::int64_t turn_ = 0;
  std::int64_t waiting_ = 0;  // variables, each with one valid place
};

}  // namespace plumescout::lab
