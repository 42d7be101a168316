// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/patient_attempt.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>

#include "core/types/error_reason.h"
#include "server/base/errors.h"
#include "tests/server/fake_nodes.h"
#include "tests/server/stored_run.h"

namespace plumescout::server {
namespace patient_attempt_test {

class PatientAttemptTest : public testing::Test {
 protected:
  PatientAttemptTest() {
    PutMission(store_, "hall", {}, {{1, RobotRegistered{"r1", 0.2, 7}}});
    RegistryHooks hooks;
    hooks.store = &store_;
    registry_ = std::make_unique<MissionRegistry>(RegistryOptions(), hooks);
    context_.registry = registry_.get();
    context_.limits.recovery_patience = absl::Hours(1);
  }
  // What the last of the attempts to find the mission said, once that is known.
  std::future<absl::Status> Begin(SteadyTime deadline = SteadyTime::max()) {
    const auto said = std::make_shared<std::promise<absl::Status>>();
    AttemptPatiently(
        context_, deadline,
        [this] {
          ++attempts_;
          return registry_->Find("hall").status();
        },
        [said](const absl::Status& status) { said->set_value(status); });
    return said->get_future();
  }
  static bool IsKnown(const std::future<absl::Status>& said) {
    return said.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }

  SharedStore store_;
  std::unique_ptr<MissionRegistry> registry_;
  ServiceContext context_;
  std::atomic<int> attempts_ = 0;
};

TEST_F(PatientAttemptTest, CallsWaitUntilTheMissionIsThere) {
  auto first = Begin();
  auto second = Begin();
  EXPECT_FALSE(IsKnown(first));
  EXPECT_FALSE(IsKnown(second));
  EXPECT_TRUE(registry_->RecoverNext());
  EXPECT_TRUE(first.get().ok());
  EXPECT_TRUE(second.get().ok());
  EXPECT_EQ(attempts_, 4);
  EXPECT_TRUE(Begin().get().ok());
  EXPECT_EQ(attempts_, 5) << "it is there";
}

TEST_F(PatientAttemptTest, WhoWaitsHearsWhereTheMissionIs) {
  store_.SetOwner("hall", "n2");
  auto said = Begin();
  EXPECT_FALSE(IsKnown(said));
  EXPECT_TRUE(registry_->RecoverNext());
  EXPECT_EQ(NodeElsewhere(said.get()), "n2");
}

TEST_F(PatientAttemptTest, PatienceEnds) {
  context_.limits.recovery_patience = absl::Milliseconds(5);
  EXPECT_EQ(ErrorReason(Begin().get()), reason::kRecovering);
  context_.limits.recovery_patience = absl::Hours(1);
  EXPECT_EQ(ErrorReason(Begin(After(SteadyNow(), absl::Milliseconds(25))).get()),
            reason::kRecovering)
      << "before the call's deadline";
  EXPECT_EQ(ErrorReason(Begin(SteadyNow()).get()), reason::kRecovering) << "at once";
  EXPECT_TRUE(registry_->RecoverNext());
  EXPECT_EQ(attempts_, 3) << "nobody looks who has given up";
}

TEST_F(PatientAttemptTest, WaitsEndWithTheServer) {
  auto said = Begin();
  registry_->EndWaits(Draining());
  EXPECT_TRUE(absl::IsUnavailable(said.get()));
}

TEST_F(PatientAttemptTest, WaitsEndWithTheLease) {
  auto said = Begin();
  store_.SetLeaseUntil(SteadyTime());
  registry_->LoseAll(absl::UnavailableError("lost"));
  EXPECT_EQ(ErrorReason(said.get()), reason::kStoreUnavailable);
}

}  // namespace patient_attempt_test
}  // namespace plumescout::server
