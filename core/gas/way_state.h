// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/gas/way_readings.h"
#include "core/types/visit_types.h"

namespace plumescout {

template <typename Archive, typename Self>
void WayReadings::Point::VisitState(Archive& archive, Self& self) {
  auto& [time_ns, pose] = self;
  archive(time_ns, pose);
}

template <typename Archive, typename Self>
void WayReadings::State::VisitState(Archive& archive, Self& self) {
  auto& [mean, sensor, both, air] = self;
  archive(mean, sensor, both, air);
}

template <typename Archive, typename Self>
void WayReadings::Span::VisitState(Archive& archive, Self& self) {
  auto& [middle, stay_s, way_m, kept, predicted] = self;
  archive(middle, stay_s, way_m, kept, predicted);
}

template <typename Archive, typename Self>
void WayReadings::Interval::VisitState(Archive& archive, Self& self) {
  auto& [spans, surprise, gain, variance] = self;
  archive(spans, surprise, gain, variance);
}

template <typename Archive, typename Self>
void WayReadings::VisitState(Archive& archive, Self& self) {
  archive(self.points_, self.latest_deviation_ppm_, self.state_, self.untold_);
  if constexpr (Archive::kReads) {
    archive.Require(self.IsWhole(), "what a sensor that lags has read is damaged");
  }
}

}  // namespace plumescout
