// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "client/planner_client.h"
#include "core/types/grid.h"
#include "lab/bench/attacks/attack.h"
#include "lab/bench/attacks/front_process.h"
#include "lab/bench/load/load_robot.h"
#include "lab/bench/load/memory_budget.h"
#include "lab/bench/load/server_process.h"

namespace plumescout::lab {

// What honest callers met with for a while.
struct HonestFigures {
  std::vector<double> plan_ms;   // of a robot that plans five times a second
  std::vector<double> quick_ms;  // of an operator's lists of missions, 50 a second
  double failures = 0.0;
};

struct BedOptions {
  std::vector<std::string> settings = {};  // of the server, besides its budget of memory
  std::optional<int> max_descriptors = std::nullopt;
  bool log_unread = false;
  bool behind_front = false;  // if there is one
};

// A server with an honest robot and an honest operator on it, in mission "honest". They were at
// work for a while before the attack begins.
class AttackBed {
  struct Private {
    explicit Private() = default;
  };

 public:
  AttackBed(Private, const AttackSettings& settings, MemoryBudget budget,
            std::unique_ptr<ServerProcess> server, std::unique_ptr<FrontProcess> front);
  static absl::StatusOr<std::unique_ptr<AttackBed>> Start(const AttackSettings& settings,
                                                          const BedOptions& options = {});
  ~AttackBed();

  // Where to call: the server, or the front before it.
  const std::string& target() const { return target_; }
  ServerProcess& server() { return *server_; }
  client::PlannerClient& operator_client() { return *operator_; }
  const Grid<std::uint8_t>& walls() const { return walls_; }
  const HonestFigures& before() const { return before_; }

  // What they met with since the last call.
  HonestFigures Take();
  // What every attack has to bear: plans and lists as before or nearly so, no call failed, whoever
  // has not called before answered now, the server alive and within its budget of memory.
  // `during`: since the attack began.
  std::vector<Bar> Judge(const HonestFigures& during);
  // Whether a caller that has not called before is answered.
  bool IsNewcomerServed() const;
  // CPU that the server has used, seconds; NaN once it has ended.
  double Cpu_s() const;

 private:
  void RunOperator();

  const Grid<std::uint8_t> walls_;
  const absl::Duration patience_;
  const MemoryBudget budget_;
  const std::unique_ptr<ServerProcess> server_;
  const std::unique_ptr<FrontProcess> front_;  // null: none
  const std::string target_;
  const std::unique_ptr<client::PlannerClient> operator_;
  HonestFigures before_;
  std::unique_ptr<LoadRobot> robot_;

  absl::Mutex mutex_;
  std::vector<double> quick_ms_ ABSL_GUARDED_BY(mutex_);
  double failures_ ABSL_GUARDED_BY(mutex_) = 0.0;
  std::atomic<bool> stopping_ = false;
  std::thread operator_thread_;
};

inline constexpr char kHonestMission[] = "honest";

}  // namespace plumescout::lab
