// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/sensor_crossings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumescout {
namespace {

// Plumes fluctuate, with long tails: chance has to be out of the question.
constexpr double kSigmas = 6.0;

std::int64_t Apart_ns(std::int64_t a_ns, std::int64_t b_ns) {
  return a_ns > b_ns ? a_ns - b_ns : b_ns - a_ns;
}

}  // namespace

void SensorCrossings::Add(int sensor, std::int64_t time_ns, Point2 position,
                          double concentration_ppm, const std::function<bool(int)>& tells) {
  const auto own = static_cast<std::size_t>(sensor);
  if (recent_.size() <= own) recent_.resize(own + 1);
  for (std::size_t other = 0; other < recent_.size(); ++other) {
    if (other == own || (tells && !tells(static_cast<int>(other)))) continue;
    const Recent* nearest = nullptr;  // in time
    for (const Recent& reading : recent_[other]) {
      const std::int64_t apart_ns = Apart_ns(reading.time_ns, time_ns);
      if (apart_ns > kSoon_ns || Distance_m(reading.position, position) > kNear_m) continue;
      if (nearest == nullptr || apart_ns <= Apart_ns(nearest->time_ns, time_ns)) nearest = &reading;
    }
    if (nearest == nullptr) continue;
    const double above_ppm = concentration_ppm - nearest->concentration_ppm;
    const int another = static_cast<int>(other);
    if (another < sensor) {
      Note(pairs_[{another, sensor}], above_ppm);
    } else {
      Note(pairs_[{sensor, another}], -above_ppm);
    }
  }
  std::vector<Recent>& recent = recent_[own];
  std::erase_if(recent,
                [&](const Recent& reading) { return time_ns - reading.time_ns > kSoon_ns; });
  if (recent.size() >= kMostRecent) recent.erase(recent.begin());
  recent.push_back({time_ns, position, concentration_ppm});
}

void SensorCrossings::Note(Pair& pair, double difference_ppm) {
  ++pair.crossings;
  pair.latest_ppm.push_back(difference_ppm);
  if (static_cast<std::int64_t>(pair.latest_ppm.size()) <= kEnough) return;
  const double oldest_ppm = pair.latest_ppm.front();
  pair.latest_ppm.erase(pair.latest_ppm.begin());
  const double count = static_cast<double>(pair.crossings - kEnough);
  const double from_mean_ppm = oldest_ppm - pair.mean_ppm;
  pair.mean_ppm += from_mean_ppm / count;
  pair.squares_ppm2 += from_mean_ppm * (oldest_ppm - pair.mean_ppm);
}

bool SensorCrossings::HasChanged(const Pair& pair, double most_ppm) {
  const std::int64_t before = pair.crossings - kEnough;
  if (before < kEnough) return false;
  const auto latest = static_cast<double>(pair.latest_ppm.size());
  const double mean_ppm =
      std::accumulate(pair.latest_ppm.begin(), pair.latest_ppm.end(), 0.0) / latest;
  const double change_ppm = std::abs(mean_ppm - pair.mean_ppm);
  const double variance_ppm2 = pair.squares_ppm2 / static_cast<double>(before - 1);
  const double chance_ppm2 = variance_ppm2 * (1.0 / latest + 1.0 / static_cast<double>(before));
  return change_ppm > most_ppm && change_ppm * change_ppm > kSigmas * kSigmas * chance_ppm2;
}

std::int64_t SensorCrossings::Count(int sensor) const {
  std::int64_t count = 0;
  for (const auto& [sensors, pair] : pairs_) {
    if (sensors.first == sensor || sensors.second == sensor) count += pair.crossings;
  }
  return count;
}

bool SensorCrossings::IsLinked(int sensor) const {
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const auto& entry) {
    const auto& [sensors, pair] = entry;
    return (sensors.first == sensor || sensors.second == sensor) && pair.crossings >= kEnough;
  });
}

bool SensorCrossings::IsDrifting(int sensor, double most_ppm) const {
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const auto& entry) {
    const auto& [sensors, pair] = entry;
    return (sensors.first == sensor || sensors.second == sensor) && HasChanged(pair, most_ppm);
  });
}

}  // namespace plumescout
