// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What every PlannerClient promises is tested against each of them: the *_contract_test.cc
// instantiate this fixture with AllBackends().
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "client/planner_client.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::client {

// A service and a client of it.
class Backend {
 public:
  virtual ~Backend() = default;
  virtual PlannerClient& client() = 0;
};

struct BackendKind {
  std::string name;
  std::function<std::unique_ptr<Backend>()> make;

  friend std::ostream& operator<<(std::ostream& out, const BackendKind& kind) {
    return out << kind.name;
  }
};

std::vector<BackendKind> AllBackends();
std::string BackendName(const ::testing::TestParamInfo<BackendKind>& info);

// A service with one mission, "house".
class PlannerClientContract : public ::testing::TestWithParam<BackendKind> {
 protected:
  static constexpr double kRadius_m = 0.2;

  void SetUp() override;

  PlannerClient& client() { return backend_->client(); }
  RobotSession Register(const RobotId& robot = "scout");
  // Null, and the test has failed, if it cannot be opened.
  std::unique_ptr<ObservationStream> Open(const RobotSession& session);
  static PlanQuery Query(const RobotSession& session, std::int64_t min_applied_sequence = 0);

 private:
  const std::unique_ptr<Backend> backend_ = GetParam().make();
};

}  // namespace plumescout::client
