// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "core/types/pose2.h"

namespace plumescout {

// Where and when gas sensors met: readings of two that were taken near each other soon after one
// another should say the same, so what they differ by tells of the sensors. Sensors are numbers
// from 0. Thread-compatible.
class SensorCrossings {
 public:
  static constexpr double kNear_m = 1.0;
  static constexpr std::int64_t kSoon_ns = 60'000'000'000;
  // Of two sensors, before their offsets can be told apart from the field.
  static constexpr std::int64_t kEnough = 20;
  // Readings that are remembered of each sensor: those of kSoon_ns at 8 Hz.
  static constexpr std::size_t kMostRecent = 480;

  // `tells(other)`: whether meeting that sensor counts. Cost: O(sensors * kMostRecent).
  void Add(int sensor, std::int64_t time_ns, Point2 position, double concentration_ppm,
           const std::function<bool(int)>& tells = {});

  // Readings of it or of another near it, so far.
  std::int64_t Count(int sensor) const;
  // Whether it met another kEnough times.
  bool IsLinked(int sensor) const;
  // Whether its readings differ from those of another by other than before, by more than `most_ppm`
  // and than chance allows.
  bool IsDrifting(int sensor, double most_ppm) const;

  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);

 private:
  struct Recent {
    std::int64_t time_ns = 0;
    Point2 position;
    double concentration_ppm = 0.0;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };
  // What the readings of the second of two sensors are above those of the first: the latest ones,
  // and mean and sum of squared deviations of those before.
  struct Pair {
    std::int64_t crossings = 0;
    std::vector<double> latest_ppm;  // the oldest first
    double mean_ppm = 0.0;
    double squares_ppm2 = 0.0;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };

  void Note(Pair& pair, double difference_ppm);
  static bool HasChanged(const Pair& pair, double most_ppm);

  std::vector<std::vector<Recent>> recent_;  // by sensor, in the order of arrival
  std::map<std::pair<int, int>, Pair> pairs_;
};

}  // namespace plumescout
