// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/packed_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumescout {
namespace {

constexpr double kFarthestStep = 65534.0;
constexpr std::int64_t kObjectBytes =
    160;  // itself, and what allocations take beside their content

std::uint16_t StepOf(float range_m, double max_range_m) {
  const auto range = static_cast<double>(range_m);
  if (std::isinf(range) && range > 0.0) return PackedScan::kNoReturn;
  if (!(range > 0.0)) return PackedScan::kSaysNothing;
  const double step = std::round(range / max_range_m * kFarthestStep);
  if (step > kFarthestStep) return PackedScan::kSaysNothing;
  return static_cast<std::uint16_t>(std::max(step, 1.0));
}

float RangeOf_m(std::uint16_t step, double max_range_m) {
  if (step == PackedScan::kSaysNothing) return std::numeric_limits<float>::quiet_NaN();
  if (step == PackedScan::kNoReturn) return std::numeric_limits<float>::infinity();
  return static_cast<float>(static_cast<double>(step) * max_range_m / kFarthestStep);
}

}  // namespace

std::int64_t PackedScan::bytes() const {
  return kObjectBytes + static_cast<std::int64_t>(steps.size() * sizeof(steps[0]) +
                                                  masks.size() * sizeof(MaskDisc));
}

PackedScan Pack(const Scan& scan, std::vector<MaskDisc> masks) {
  PackedScan packed{.start_angle_rad = scan.start_angle_rad,
                    .angle_step_rad = scan.angle_step_rad,
                    .max_range_m = scan.max_range_m,
                    .steps = {},
                    .masks = std::move(masks)};
  packed.steps.reserve(scan.ranges_m.size());
  for (const float range_m : scan.ranges_m) {
    packed.steps.push_back(StepOf(range_m, scan.max_range_m));
  }
  return packed;
}

Scan Unpack(const PackedScan& packed) {
  Scan scan{packed.start_angle_rad, packed.angle_step_rad, packed.max_range_m, {}};
  scan.ranges_m.reserve(packed.steps.size());
  for (const std::uint16_t step : packed.steps) {
    scan.ranges_m.push_back(RangeOf_m(step, packed.max_range_m));
  }
  return scan;
}

}  // namespace plumescout
