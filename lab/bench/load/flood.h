// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "client/planner_client.h"

namespace plumescout::lab {

// What one robot may do in a second.
struct Quota {
  double plans_per_s = 0.0;
  double readings_per_s = 0.0;
};

// As the server tells. Of one that tells none: what a robot needs that plans every second and
// smells at 10 Hz.
Quota AskQuota(const std::string& target);

struct FloodOptions {
  double plans_per_s = 0.0;     // asked for without waiting for answers; 0: none
  double readings_per_s = 0.0;  // in batches; 0: none
  double spread_m = 5.0;        // readings are taken within so far of the origin on both axes
  std::uint64_t seed = 1;
};

struct FloodFigures {
  std::int64_t plans_asked = 0;
  std::int64_t plans_made = 0;
  std::int64_t readings_sent = 0;  // again and again those that are refused
  std::int64_t readings_taken = 0;
};

// A robot that asks and sends far more than it should, until it is destroyed.
class Flood {
 public:
  // The robot's log must end where `session` says.
  Flood(const std::string& target, const client::RobotSession& session,
        const FloodOptions& options);
  ~Flood();
  Flood(const Flood&) = delete;
  Flood& operator=(const Flood&) = delete;

  FloodFigures figures() const;

 private:
  void AskForPlans();
  void SendReadings();

  const std::string target_;
  const client::RobotSession session_;
  const FloodOptions options_;
  std::atomic<bool> stopping_ = false;
  std::atomic<std::int64_t> plans_asked_ = 0;
  std::atomic<std::int64_t> plans_made_ = 0;
  std::atomic<std::int64_t> readings_sent_ = 0;
  std::atomic<std::int64_t> readings_taken_ = 0;
  std::thread planner_;
  std::thread sensors_;
};

}  // namespace plumescout::lab
