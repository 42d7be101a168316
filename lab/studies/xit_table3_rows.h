// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include "absl/status/statusor.h"
#include "core/types/options.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {

// Mean and standard deviation as printed; NaN where the paper has no such row.
struct Printed {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double stddev = std::numeric_limits<double>::quiet_NaN();
};

enum class RowKind {
  kPublished,  // of Table III, to the letter
  kReading,    // likewise, but the other way to read what the paper says of "Euclidean"
  kOurs,
};

struct Table3Row {
  const char* name;
  const char* method;
  const char* cost;
  const char* strategy;
  RowKind kind;
  CostKind expansion;
  CostKind selection;
  Printed rmse_ppm = {};
  Printed entropy_nats = {};
};

// Those of a kind stand together, published ones first.
std::span<const Table3Row> Table3Rows();
inline constexpr std::size_t kPaperBaseline = 0;   // stops when no frontier is left
inline constexpr std::size_t kPaperBest = 5;       // XIT-GFF with UCB
inline constexpr std::size_t kStrongBaseline = 8;  // ours: goes to random places then
inline constexpr std::size_t kOwnStrategy = 10;

// "XIT-GFF, UCB".
std::string LabelOf(const Table3Row& row);

// All rows drive the robot that xit_calibration settled. Errors: as ApplyStrategyRow.
absl::StatusOr<StudyRow> MakeTable3Row(const Table3Row& row);

}  // namespace plumescout::lab
