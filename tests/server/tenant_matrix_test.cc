// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What a tenant hears of another's missions: every method, by the descriptors of the services,
// about a mission of its own, one of another tenant, one that is not there, and what is no name.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "plumescout/v1/ingest_service.pb.h"
#include "plumescout/v1/mission_service.pb.h"
#include "plumescout/v1/robot_service.pb.h"
#include "tests/server/access_fixture.h"

namespace plumescout::server {
namespace tenant_matrix_test {

constexpr char kGhost[] = "ghost";  // not there, then another tenant's
constexpr char kHall[] = "hall";    // alice's own
constexpr auto kOk = grpc::StatusCode::OK;

class TenantMatrixTest : public AccessTest {
 protected:
  // Methods that ask about a mission or a robot.
  std::vector<const Method*> AboutMissions() const {
    std::vector<const Method*> methods;
    for (const Method* method : methods_) {
      const bool names_one = method->input_type()->field_count() > 0 &&
                             method->name() != "ListMissions" &&
                             method->name() != "CreateMission" && method->name() != "ImportMission";
      if (names_one) methods.push_back(method);
    }
    return methods;
  }
  // What every method answers alice about a mission.
  std::map<std::string, Answer> AskAll(const std::string& mission) {
    std::map<std::string, Answer> answers;
    for (const Method* method : AboutMissions()) {
      answers[ShortName(*method)] = Ask(*method, {mission}, kAlice);
    }
    return answers;
  }
  Answer Create(const std::string& mission, const std::string& token) {
    return AskFor("MissionService.CreateMission", {mission}, token);
  }
  // Bob's mission, with a robot that has told something.
  void MakeBobsGhost() {
    ASSERT_EQ(Create(kGhost, kBob).code, kOk);
    const Answer registered = AskFor("RobotService.RegisterRobot", {kGhost}, kBob);
    ASSERT_EQ(registered.code, kOk) << registered;
    v1::RegisterRobotResponse robot;
    ASSERT_TRUE(robot.ParseFromString(registered.response));
    v1::BatchIngestObservationsRequest request;
    request.mutable_open()->set_robot(robot.robot());
    request.mutable_open()->set_lease_token(robot.lease_token());
    v1::Observation& observation = *request.mutable_batch()->add_observations();
    observation.set_sequence(1);
    observation.set_sample_time_ns(1);
    observation.mutable_pose();
    observation.mutable_gas()->set_concentration_ppm(7.0);
    const auto* method = v1::BatchIngestObservationsRequest::descriptor()
                             ->file()
                             ->FindServiceByName("IngestService")
                             ->FindMethodByName("BatchIngestObservations");
    ASSERT_EQ(AnyCall(channel_, *method, kBob).Make(request).code, kOk);
  }
};

TEST_F(TenantMatrixTest, AnothersMissionIsAsOneThatIsNotThere) {
  const auto absent = AskAll(kGhost);
  MakeBobsGhost();
  const auto others = AskAll(kGhost);
  EXPECT_GE(absent.size(), 14u);
  for (const auto& [method, answer] : absent) {
    EXPECT_EQ(answer.code, grpc::StatusCode::NOT_FOUND) << method << ": " << answer;
    EXPECT_EQ(others.at(method), answer) << method;
  }
  EXPECT_EQ(AskFor("MissionService.GetMission", {kGhost}, kBob).code, kOk);
}

// The comparison above would hold if the methods answered nobody.
TEST_F(TenantMatrixTest, OnesOwnMissionIsAnswered) {
  for (const Method* method : AboutMissions()) {
    const grpc::StatusCode made = Create(kHall, kAlice).code;
    ASSERT_TRUE(made == kOk || made == grpc::StatusCode::ALREADY_EXISTS);
    const Answer absent = Ask(*method, {kGhost}, kAlice);
    const Answer own = Ask(*method, {kHall}, kAlice);
    const bool not_found =
        own.code == absent.code && own.message == "MISSION_NOT_FOUND: missions/hall";
    EXPECT_FALSE(not_found) << ShortName(*method) << ": " << own;
    EXPECT_NE(own.code, grpc::StatusCode::PERMISSION_DENIED) << ShortName(*method);
  }
}

TEST_F(TenantMatrixTest, WhatIsNoNameIsNeverLookedUp) {
  const std::vector<std::string> names = {
      "",        ".",     "..",     "../ghost", "ghost/",   "/ghost",      "ghost/.", "other/ghost",
      "%67host", "GHOST", "ghost ", "gh*st",    "ghost\\0", "gh\xc3\xb6st"};
  std::map<std::string, std::map<std::string, Answer>> before;
  for (const std::string& name : names) before[name] = AskAll(name);
  MakeBobsGhost();
  for (const std::string& name : names) {
    for (const auto& [method, answer] : AskAll(name)) {
      EXPECT_EQ(answer.code, grpc::StatusCode::INVALID_ARGUMENT) << method << " " << name << answer;
      EXPECT_EQ(answer, before[name][method]) << method << " " << name;
    }
  }
}

TEST_F(TenantMatrixTest, NamesThatOthersTookAreFree) {
  const Answer first = Create(kGhost, kAlice);
  ASSERT_EQ(first.code, kOk) << first;
  ASSERT_EQ(AskFor("MissionService.DeleteMission", {kGhost}, kAlice).code, kOk);
  MakeBobsGhost();
  EXPECT_EQ(Create(kGhost, kAlice), first);
  // Each has one of that name now.
  ASSERT_EQ(AskFor("MissionService.DeleteMission", {kGhost}, kAlice).code, kOk);
  EXPECT_EQ(AskFor("MissionService.GetMission", {kGhost}, kAlice).code,
            grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(AskFor("MissionService.GetMission", {kGhost}, kBob).code, kOk);
}

TEST_F(TenantMatrixTest, ListsHoldOnesOwn) {
  ASSERT_EQ(Create(kHall, kAlice).code, kOk);
  const Answer before = AskFor("MissionService.ListMissions", {}, kAlice);
  MakeBobsGhost();
  EXPECT_EQ(AskFor("MissionService.ListMissions", {}, kAlice), before);
  EXPECT_EQ(AskFor("MissionService.ListMissions", {}, kEve), before);
  v1::ListMissionsResponse all;
  ASSERT_TRUE(all.ParseFromString(AskFor("MissionService.ListMissions", {}, kRoot).response));
  EXPECT_EQ(all.missions_size(), 2);
}

TEST_F(TenantMatrixTest, AdminsReachEverybodysMissionsUnlessTwoHaveTheName) {
  MakeBobsGhost();
  EXPECT_EQ(AskFor("MissionService.GetMission", {kGhost}, kRoot).code, kOk);
  ASSERT_EQ(Create(kGhost, kAlice).code, kOk);
  EXPECT_EQ(AskFor("MissionService.GetMission", {kGhost}, kRoot).code,
            grpc::StatusCode::FAILED_PRECONDITION);
  ASSERT_EQ(AskFor("MissionService.DeleteMission", {kGhost}, kBob).code, kOk);
  EXPECT_EQ(AskFor("MissionService.DeleteMission", {kGhost}, kRoot).code, kOk);
  EXPECT_EQ(AskFor("MissionService.GetMission", {kGhost}, kAlice).code,
            grpc::StatusCode::NOT_FOUND);
}

}  // namespace tenant_matrix_test
}  // namespace plumescout::server
