// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/types/options.h"
#include "core/types/pose2.h"

namespace plumescout {

enum class ObjectiveState {
  kPursued,
  kMet,
  kRefuted,  // what was to be confirmed is wrong: gas where the air was to be clean, or no source
  kCannotBeMet,  // the mission has ended without either
};

// How far a mission has come with its objective, by its latest assessment.
struct ObjectiveStatus {
  ObjectiveState state = ObjectiveState::kPursued;
  // That what the objective says is true at `place`, its most doubtful cell; of a refuted one that
  // it is not, at the clearest. 0: nobody has measured there.
  double confidence = 0.0;
  double undecided_area_m2 = 0.0;              // of the reachable cells
  int open_frontiers = 0;                      // of the map: what they hide is not known
  std::optional<Point2> place = std::nullopt;  // none before there is a reachable cell
  double mean_ppm = 0.0;                       // there
  double stddev_ppm = 0.0;
  // Of a source that is sought: the place that is the strongest as far as is known.
  std::optional<Point2> strongest = std::nullopt;
  std::int64_t since_ns = 0;  // sample time at which the state became this one

  friend bool operator==(const ObjectiveStatus&, const ObjectiveStatus&) = default;
};

// Nothing is to be learnt any more.
inline bool IsConcluded(const ObjectiveStatus& status) {
  return status.state == ObjectiveState::kMet || status.state == ObjectiveState::kRefuted;
}

// One sentence for an operator. REQUIRES: `options` are not of kind kCompleteMap.
std::string Describe(const ObjectiveStatus& status, const ObjectiveOptions& options);

}  // namespace plumescout
