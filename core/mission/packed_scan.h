// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/occupancy/scan_inserter.h"
#include "core/types/byte_archive.h"
#include "core/types/scan.h"

namespace plumescout {

// A scan for keeping: two bytes a beam. Ranges are whole steps of max_range_m / 65534, 0.12 mm at
// 8 m, and come back within half of one. The discs are those that its beams must not end in.
struct PackedScan {
  static constexpr std::uint16_t kSaysNothing = 0;
  static constexpr std::uint16_t kNoReturn = 65535;

  double start_angle_rad = 0.0;
  double angle_step_rad = 0.0;
  double max_range_m = 0.0;
  std::vector<std::uint16_t> steps;
  std::vector<MaskDisc> masks;

  // Of memory, for the budget.
  std::int64_t bytes() const;
};

PackedScan Pack(const Scan& scan, std::vector<MaskDisc> masks);
Scan Unpack(const PackedScan& packed);

void Visit(auto& archive, ConstOr<MaskDisc> auto& disc) {
  auto& [center, radius_m] = disc;
  archive(center, radius_m);
}
void Visit(auto& archive, ConstOr<PackedScan> auto& scan) {
  auto& [start_angle_rad, angle_step_rad, max_range_m, steps, masks] = scan;
  archive(start_angle_rad, angle_step_rad, max_range_m, steps, masks);
}

}  // namespace plumescout
