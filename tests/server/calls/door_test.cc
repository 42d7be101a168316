// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/door.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/mutex.h"
#include "core/types/error_reason.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace door_test {

const Principal kScout = {"scout", "acme", Role::kRobot, true};

// What the door says of a call that is let in.
absl::StatusOr<CallInfo> Enter(const Door& door, Rpc rpc, const grpc::CallbackServerContext& call) {
  CallInfo info;
  const absl::Status status = door.Enter(rpc, call, info);
  if (!status.ok()) return status;
  return info;
}

Authenticate AlwaysSay(const absl::StatusOr<Principal>& caller) {
  return [caller](const grpc::CallbackServerContext&) -> absl::StatusOr<Identity> {
    if (!caller.ok()) return caller.status();
    return Identity{*caller, [] { return absl::UnauthenticatedError("revoked since"); }};
  };
}

TEST(DoorTest, WhoIsLetInCanBeAskedAboutLater) {
  const Door door(AlwaysSay(kScout));
  const grpc::CallbackServerContext call;
  const auto info = Enter(door, Rpc::kGetMap, call);
  ASSERT_TRUE(info.ok());
  EXPECT_EQ(info->recheck(), absl::UnauthenticatedError("revoked since"));
}

TEST(DoorTest, WithoutAnybodyToAskEverybodyIsAnAnonymousAdmin) {
  const Door door;
  const grpc::CallbackServerContext call;
  const auto info = Enter(door, Rpc::kDrainServer, call);
  ASSERT_TRUE(info.ok()) << info.status();
  EXPECT_EQ(info->caller, Principal{});
  EXPECT_EQ(info->deadline, SteadyTime::max());
  EXPECT_EQ(info->request_id.size(), 16u);
  EXPECT_NE(Enter(door, Rpc::kDrainServer, call)->request_id, info->request_id);
}

TEST(DoorTest, WhoIsNotKnownIsNotLetIn) {
  const Door door(AlwaysSay(absl::UnauthenticatedError("no token")));
  const grpc::CallbackServerContext call;
  for (const RpcRow& row : RpcTable()) {
    EXPECT_EQ(Enter(door, row.rpc, call).status(), absl::UnauthenticatedError("no token"));
  }
}

TEST(DoorTest, RolesOpenWhatTheTableSays) {
  for (const Role role : {Role::kRobot, Role::kViewer, Role::kOperator, Role::kAdmin}) {
    const Door door(AlwaysSay(Principal{"who", "acme", role}));
    const grpc::CallbackServerContext call;
    for (const RpcRow& row : RpcTable()) {
      const auto info = Enter(door, row.rpc, call);
      EXPECT_EQ(info.ok(), IsAllowed(role, row.rpc)) << row.method;
      if (!info.ok()) {
        EXPECT_EQ(info.status(),
                  absl::PermissionDeniedError(absl::StrCat("who may not call ", row.method)));
      }
    }
  }
}

TEST(DoorTest, ObserversHearOfEveryCallOnce) {
  std::vector<std::string> heard;
  Door door(AlwaysSay(kScout));
  door.AddObserver([&](const CallInfo& info, const CallEnd& end) {
    EXPECT_GE(end.duration, absl::ZeroDuration());
    heard.push_back(absl::StrCat(RowOf(info.rpc).method, " ", info.caller.name, " ",
                                 absl::StatusCodeToString(end.status.code())));
  });
  grpc::CallbackServerContext call;
  Visit visit;
  ASSERT_TRUE(visit.Enter(door, Rpc::kGetMap, call).ok());
  EXPECT_TRUE(heard.empty());
  EXPECT_EQ(visit.Leave(absl::CancelledError("")), absl::CancelledError(""));
  EXPECT_TRUE(visit.Leave(absl::OkStatus()).ok());
  EXPECT_EQ(heard, std::vector<std::string>{"GetMap scout CANCELLED"});
  Visit refused;
  EXPECT_FALSE(refused.Enter(door, Rpc::kDrainServer, call).ok());
  EXPECT_TRUE(refused.Leave(absl::OkStatus()).ok());
  ASSERT_EQ(heard.size(), 2u);
  EXPECT_EQ(heard[1], "DrainServer scout PERMISSION_DENIED");
}

TEST(DoorTest, CallersAreHeldToTheirRatesAndObserversHear) {
  Principal caller = kScout;
  int refused = 0;
  Door door([&](const grpc::CallbackServerContext&) { return Identity{caller}; },
            {.calls_per_s = 1e-3});
  door.AddObserver([&](const CallInfo&, const CallEnd& end) {
    EXPECT_EQ(ErrorReason(end.status), reason::kRateExceeded);
    ++refused;
  });
  const grpc::CallbackServerContext call;
  EXPECT_TRUE(Enter(door, Rpc::kGetMap, call).ok());
  EXPECT_EQ(ErrorReason(Enter(door, Rpc::kGetRobot, call).status()), reason::kRateExceeded);
  caller.tenant = "other";  // another one of that name
  EXPECT_TRUE(Enter(door, Rpc::kGetMap, call).ok());
  EXPECT_EQ(refused, 1);
}

TEST(DoorTest, CallsThatNamedTheNodeOfTheirMissionAndCameHereAreTold) {
  std::vector<OwnedMission> strayed;
  Door door;
  door.SetOnStray([&](const OwnedMission& mission) { strayed.push_back(mission); });
  CallInfo info;
  const absl::Status elsewhere = MissionElsewhere("acme/hall", "n2");
  EXPECT_EQ(door.Redirect(info, elsewhere), elsewhere);
  info.unreached_node = "n3";
  EXPECT_EQ(door.Redirect(info, elsewhere), elsewhere) << "it has moved";
  info.unreached_node = "n2";
  EXPECT_TRUE(door.Redirect(info, absl::OkStatus()).ok());
  EXPECT_TRUE(strayed.empty());
  EXPECT_EQ(ErrorReason(door.Redirect(info, elsewhere)), reason::kNodeUnreached);
  EXPECT_EQ(strayed, (std::vector<OwnedMission>{{"acme/hall", "n2"}}));
}

TEST(DoorTest, AccountsAreOfCallersOrOfTheirMachines) {
  const grpc::CallbackServerContext call;
  EXPECT_EQ(Enter(Door(AlwaysSay(kScout)), Rpc::kGetMap, call)->account, "caller acme scout");
  EXPECT_EQ(Enter(Door(), Rpc::kGetMap, call)->account, "") << "that of a call from nowhere";
}

TEST(DoorTest, ManyMayEnterAtOnce) {
  absl::Mutex mutex;
  int left = 0;
  Door door(AlwaysSay(kScout));
  door.AddObserver([&](const CallInfo&, const CallEnd&) {
    absl::MutexLock lock(&mutex);
    ++left;
  });
  constexpr int kThreads = 4;
  constexpr int kCalls = 200;
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&] {
      grpc::CallbackServerContext call;
      for (int k = 0; k < kCalls; ++k) {
        Visit visit;
        EXPECT_TRUE(visit.Enter(door, Rpc::kGetMap, call).ok());
        EXPECT_TRUE(visit.Leave(absl::OkStatus()).ok());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(left, kThreads * kCalls);
}

TEST(DoorTest, ARobotActsForItselfAlone) {
  EXPECT_TRUE(CheckActsFor(kScout, {"hall", "scout"}).ok());
  EXPECT_EQ(CheckActsFor(kScout, {"hall", "rover"}),
            absl::PermissionDeniedError("scout may not act for robot rover"));
  EXPECT_TRUE(CheckActsFor(Principal{"alice", "acme", Role::kOperator}, {"hall", "rover"}).ok());
}

}  // namespace door_test
}  // namespace plumescout::server
