// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/mission_service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "absl/synchronization/notification.h"
#include "proto/convert/map.h"
#include "proto/convert/options.h"
#include "server/missions/mission_strategy.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace mission_service_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr auto kNotFound = absl::StatusCode::kNotFound;
constexpr auto kExhausted = absl::StatusCode::kResourceExhausted;

class MissionServiceTest : public ServiceTest {
 protected:
  absl::StatusOr<v1::GetMissionResponse> Get(const std::string& name) {
    v1::GetMissionRequest request;
    request.set_name(name);
    return Call(missions_, &v1::MissionService::Stub::GetMission, request);
  }
  absl::StatusOr<v1::ListMissionsResponse> List(int page_size, const std::string& token = "") {
    v1::ListMissionsRequest request;
    request.set_page_size(page_size);
    request.set_page_token(token);
    return Call(missions_, &v1::MissionService::Stub::ListMissions, request);
  }
};

std::vector<std::string> Names(const v1::ListMissionsResponse& page) {
  std::vector<std::string> names;
  for (const v1::Mission& mission : page.missions()) names.push_back(mission.name());
  return names;
}

TEST_F(MissionServiceTest, NewMissionHasTheServersOptionsButThoseGiven) {
  ServerConfig config;
  config.mission.gas.refresh_period_s = 7.0;
  StartServer(config);
  v1::MissionOptions options;
  options.mutable_occupancy()->set_resolution_m(0.5);
  const auto response = CreateMission("attic", options);
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->mission().name(), "missions/attic");
  EXPECT_EQ(response->mission().revision(), 0);
  EXPECT_EQ(response->mission().phase(), v1::MISSION_PHASE_EXPLORING);
  MissionOptions expected = config.mission;
  expected.occupancy.resolution_m = 0.5;
  EXPECT_EQ(response->mission().options().SerializeAsString(),
            ToProto(expected).SerializeAsString());
}

v1::MissionOptions KnowingARoom() {
  MissionOptions options;
  Grid<CellState> map({0.0, 0.0, 0.1, 40, 30}, CellState::kOccupied);
  for (int y = 1; y < 29; ++y) {
    for (int x = 1; x < 39; ++x) map[Cell{x, y}] = CellState::kFree;
  }
  options.prior_map = std::make_shared<const Grid<CellState>>(std::move(map));
  return ChangesToProto(options);
}

TEST_F(MissionServiceTest, OnlyGetMissionReturnsThePriorMap) {
  StartServer();
  const v1::MissionOptions options = KnowingARoom();
  const auto created = CreateMission("attic", options);
  ASSERT_TRUE(created.ok()) << created.status();
  EXPECT_FALSE(created->mission().options().has_prior_map());
  EXPECT_EQ(Get("missions/attic")->mission().options().prior_map().SerializeAsString(),
            options.prior_map().SerializeAsString());
  const auto page = List(10);
  ASSERT_TRUE(page.ok()) << page.status();
  for (const v1::Mission& mission : page->missions()) {
    EXPECT_FALSE(mission.options().has_prior_map()) << mission.name();
  }
}

// The reactors answer, whatever those who make missions are busy with.
TEST_F(MissionServiceTest, MakingAMissionHoldsUpNoOtherCall) {
  absl::Notification begun;
  absl::Notification go_on;
  RegistryHooks hooks;
  hooks.make_event_sink = [&](const MissionId& id, const MissionOptions&) -> EventSink {
    if (id == "slow") {
      begun.Notify();
      go_on.WaitForNotification();
    }
    return nullptr;
  };
  StartServer({}, hooks);
  absl::Status slow;
  std::thread maker([&] { slow = CreateMission("slow").status(); });
  begun.WaitForNotification();
  EXPECT_TRUE(Get("missions/hall").ok());
  EXPECT_THAT(Names(*List(10)), ElementsAre("missions/hall"));
  EXPECT_THAT(Get("missions/slow").status(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
  go_on.Notify();
  maker.join();
  EXPECT_TRUE(slow.ok()) << slow;
  EXPECT_TRUE(Get("missions/slow").ok());
}

TEST_F(MissionServiceTest, OfMissionsOfOneNameOneIsMade) {
  StartServer();
  constexpr int kCallers = 8;
  std::vector<absl::Status> answers(kCallers);
  std::vector<std::thread> callers;
  for (absl::Status& answer : answers) {
    callers.emplace_back([&] { answer = CreateMission("attic", KnowingARoom()).status(); });
  }
  for (std::thread& caller : callers) caller.join();
  int made = 0;
  for (const absl::Status& answer : answers) {
    made += answer.ok() ? 1 : 0;
    if (!answer.ok()) {
      EXPECT_THAT(answer, Refuses(absl::StatusCode::kAlreadyExists, "MISSION_EXISTS"));
    }
  }
  EXPECT_EQ(made, 1);
}

TEST_F(MissionServiceTest, KnownBuildingIsOnTheMapBeforeAnyRobotIs) {
  StartServer();
  ASSERT_TRUE(CreateMission("attic", KnowingARoom()).ok());
  v1::GetMapRequest request;
  request.set_mission("missions/attic");
  request.set_fresh_posterior(true);
  const auto response = Call(maps_, &v1::MapService::Stub::GetMap, request);
  ASSERT_TRUE(response.ok()) << response.status();
  const auto map = FromProto(*response);
  ASSERT_TRUE(map.ok()) << map.status();
  const Cell inside = map->occupancy.geometry().CellAt({2.0, 1.5});
  EXPECT_EQ(map->occupancy[inside], CellState::kFree);
  EXPECT_GT(map->gas_variance_ppm2[inside], 0.0F);
}

TEST_F(MissionServiceTest, APriorMapThatDoesNotFitMakesNoMission) {
  StartServer();
  v1::MissionOptions options = KnowingARoom();
  options.mutable_occupancy()->set_resolution_m(0.2);
  EXPECT_THAT(CreateMission("attic", options).status(), RefusesField("options.prior_map"));
  EXPECT_THAT(Get("missions/attic").status(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
}

TEST_F(MissionServiceTest, MissionTellsHowLongItsPosteriorTakes) {
  StartServer();
  EXPECT_EQ(Get("missions/hall")->mission().gas_timings().update().sample_count(), 0);
  ASSERT_TRUE(Ingest(kRobot, Lease(), RoomScan(1)).ok());
  v1::GetMapRequest request;
  request.set_mission("missions/hall");
  request.set_fresh_posterior(true);
  ASSERT_TRUE(Call(maps_, &v1::MapService::Stub::GetMap, request).ok());
  const v1::Latency update = Get("missions/hall")->mission().gas_timings().update();
  EXPECT_EQ(update.sample_count(), 1);
  EXPECT_GT(update.max_s(), 0.0);
  EXPECT_EQ(update.max_s(), update.p99_s());
}

TEST_F(MissionServiceTest, NameIsTakenOnce) {
  StartServer();
  EXPECT_THAT(CreateMission("hall").status(),
              Refuses(absl::StatusCode::kAlreadyExists, "MISSION_EXISTS"));
}

TEST_F(MissionServiceTest, RefusedOptionIsNamed) {
  StartServer();
  v1::MissionOptions options;
  options.mutable_occupancy()->set_resolution_m(-1.0);
  EXPECT_THAT(CreateMission("attic", options).status(),
              RefusesField("options.occupancy.resolution_m"));
  EXPECT_THAT(CreateMission("The Attic").status(), RefusesField("mission_id"));
  EXPECT_THAT(Get("missions/attic").status(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
}

TEST_F(MissionServiceTest, DeletedMissionMakesRoom) {
  ServerConfig config;
  config.limits.max_missions = 1;
  StartServer(config);
  EXPECT_THAT(CreateMission("attic").status(), Refuses(kExhausted, "LIMIT_REACHED"));
  ASSERT_TRUE(DeleteMission("hall").ok());
  EXPECT_TRUE(CreateMission("attic").ok());
}

TEST_F(MissionServiceTest, MissionsThatCouldOutgrowTheServerAreRefused) {
  ServerConfig config;
  config.limits.memory_budget_bytes = 2 * config.mission.memory_budget_bytes - 1;
  StartServer(config);
  EXPECT_THAT(CreateMission("attic").status(), Refuses(kExhausted, "LIMIT_REACHED"));
}

TEST_F(MissionServiceTest, OptionsDoNotLiftTheServersLimits) {
  StartServer();
  v1::MissionOptions options;
  options.set_max_beam_count(100'000);
  EXPECT_THAT(CreateMission("attic", options).status(), RefusesField("options.max_beam_count"));
  options.Clear();
  options.set_memory_budget_bytes(std::int64_t{1} << 40);
  EXPECT_THAT(CreateMission("attic", options).status(),
              RefusesField("options.memory_budget_bytes"));
}

TEST_F(MissionServiceTest, GetSaysWhatTheMissionHolds) {
  StartServer();
  ASSERT_TRUE(Ingest(kRobot, Lease(), GasReadings(1, 2)).ok());
  const auto response = Get("missions/hall");
  ASSERT_TRUE(response.ok()) << response.status();
  const v1::MissionMemory& memory = response->mission().memory();
  EXPECT_EQ(memory.budget_bytes(), MissionOptions().memory_budget_bytes);
  EXPECT_GT(memory.used_bytes(), 0);
  EXPECT_LT(memory.used_bytes(), memory.budget_bytes());
  EXPECT_EQ(response->mission().options().gas().lattice_factor(), 1);
}

TEST_F(MissionServiceTest, GetSaysHowTheMissionStands) {
  StartServer();
  ASSERT_TRUE(Ingest(kRobot, Lease(), GasReadings(1, 2)).ok());
  const auto response = Get("missions/hall");
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->mission().robot_count(), 1);
  EXPECT_EQ(response->mission().revision(), 3);
}

TEST_F(MissionServiceTest, UnknownMissionIsNotFound) {
  StartServer();
  EXPECT_THAT(Get("missions/attic").status(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
  EXPECT_THAT(Get("attic").status(), RefusesField("name"));
  EXPECT_THAT(DeleteMission("attic"), Refuses(kNotFound, "MISSION_NOT_FOUND"));
  EXPECT_THAT(DeleteMission(""), RefusesField("name"));
}

TEST_F(MissionServiceTest, PagesFollowEachOtherInOrderOfName) {
  StartServer();
  ASSERT_TRUE(CreateMission("attic").ok());
  ASSERT_TRUE(CreateMission("yard").ok());
  const auto first = List(2);
  ASSERT_TRUE(first.ok()) << first.status();
  EXPECT_THAT(Names(*first), ElementsAre("missions/attic", "missions/hall"));
  const auto last = List(2, first->next_page_token());
  ASSERT_TRUE(last.ok()) << last.status();
  EXPECT_THAT(Names(*last), ElementsAre("missions/yard"));
  EXPECT_THAT(last->next_page_token(), IsEmpty());
}

TEST_F(MissionServiceTest, ListRefusesNegativePagesAndForeignTokens) {
  StartServer();
  EXPECT_THAT(List(-1).status(), RefusesField("page_size"));
  EXPECT_THAT(List(1, "hall").status(), RefusesField("page_token"));
}

TEST_F(MissionServiceTest, DeletedMissionIsGone) {
  StartServer();
  ASSERT_TRUE(DeleteMission("hall").ok());
  EXPECT_THAT(Get("missions/hall").status(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
  EXPECT_THAT(DeleteMission("hall"), Refuses(kNotFound, "MISSION_NOT_FOUND"));
}

// A room of 3 m x 3 m that the robot of StartServer's mission surveys.
v1::MissionOptions LhrOptions() {
  v1::MissionOptions options;
  v1::PlanningOptions& planning = *options.mutable_planning();
  planning.set_strategy("lhr");
  planning.set_speed_mps(1.0);
  planning.set_dwell_s(2.0);
  v1::SiteOptions& sites = *planning.mutable_sites();
  *sites.mutable_region()->mutable_min() = v1::Point2D();
  sites.mutable_region()->mutable_max()->set_x_m(51.0);
  sites.mutable_region()->mutable_max()->set_y_m(51.0);
  return options;
}

TEST_F(MissionServiceTest, MissionOfASamplingStrategyHasTheRewardOfItsRowButForTheOneGiven) {
  StartServer();
  v1::MissionOptions options = LhrOptions();
  const auto lhr = CreateMission("lhr", options);
  ASSERT_TRUE(lhr.ok()) << lhr.status();
  EXPECT_EQ(lhr->mission().options().planning().sites().reward(), v1::SAMPLING_REWARD_UCB);
  EXPECT_FALSE(lhr->mission().has_next_map_update_ns()) << "nobody is sampling yet";
  options.mutable_planning()->set_strategy("ipp_reward");
  const auto ipp = CreateMission("ipp", options);
  ASSERT_TRUE(ipp.ok()) << ipp.status();
  EXPECT_EQ(ipp->mission().options().planning().sites().reward(),
            v1::SAMPLING_REWARD_CONCENTRATION_VARIANCE_PER_TIME);
  options.mutable_planning()->mutable_sites()->set_reward(v1::SAMPLING_REWARD_VARIANCE);
  EXPECT_EQ(CreateMission("doubt", options)->mission().options().planning().sites().reward(),
            v1::SAMPLING_REWARD_VARIANCE);
}

TEST_F(MissionServiceTest, MissionThatItsStrategyCannotPlanIsNotCreated) {
  StartServer();
  v1::MissionOptions options = LhrOptions();
  options.mutable_planning()->mutable_sites()->set_survey_stride(7);
  const absl::Status refused = CreateMission("attic", options).status();
  EXPECT_THAT(refused, RefusesField("options.planning.sites.survey_stride"));
  EXPECT_THAT(Get("missions/attic").status(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
  options.mutable_planning()->mutable_sites()->set_survey_stride(10);
  options.mutable_planning()->mutable_sites()->set_update_period_s(3.0);
  EXPECT_THAT(std::string(CreateMission("attic", options).status().message()),
              ::testing::HasSubstr("Remark 1"));
  EXPECT_THAT(Get("missions/attic").status(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
}

TEST_F(MissionServiceTest, MissionTellsWhenItsMapIsUpdatedNext) {
  ServerConfig config;
  config.mission.planning.strategy = "ipp_reward";
  config.mission.planning.dwell_s = 2.0;
  config.mission.planning.sites.reward = SamplingReward::kVariancePerTime;
  StartServer(config);
  const std::int64_t lease = Lease();
  EXPECT_FALSE(Get("missions/hall")->mission().has_next_map_update_ns());
  for (int i = 1; i <= 3; ++i) ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(i)).ok());
  const auto planned = NextBest(PlanFor(lease));
  ASSERT_TRUE(planned.ok()) << planned.status();
  const v1::Plan& plan = planned->plan();
  ASSERT_EQ(plan.chosen_index(), 0) << plan.explanation();
  EXPECT_EQ(plan.phase(), v1::MISSION_PHASE_SAMPLING);
  EXPECT_EQ(plan.candidates(0).goal().kind(), v1::GOAL_KIND_SITE);
  EXPECT_EQ(plan.candidates(0).stops_size(), 1);
  EXPECT_TRUE(plan.candidates(0).has_reward());
  EXPECT_EQ(plan.map_update_s(), plan.trajectory().duration_s());
  const auto mission = Get("missions/hall");
  ASSERT_TRUE(mission->mission().has_next_map_update_ns());
  const std::int64_t newest_ns = RoomScan(3).observations(0).sample_time_ns();
  EXPECT_EQ(mission->mission().next_map_update_ns(),
            newest_ns + std::llround(plan.map_update_s() * 1e9));
  EXPECT_EQ(mission->mission().phase(), v1::MISSION_PHASE_SAMPLING);
}

TEST_F(MissionServiceTest, PlannersThatHoldAThreadForLongAreForServersThatAllowThem) {
  StartServer();
  v1::MissionOptions options;
  options.mutable_planning()->set_paths(v1::PATH_KIND_RRT_STAR);
  EXPECT_TRUE(absl::IsInvalidArgument(CreateMission("attic", options).status()));
  options.mutable_planning()->set_paths(v1::PATH_KIND_XIT);
  EXPECT_TRUE(CreateMission("attic", options).ok());

  v1::MissionOptions baseline;
  baseline.mutable_planning()->set_strategy("rrt_star_frontier");
  const absl::Status refused = CreateMission("yard", baseline).status();
  EXPECT_TRUE(absl::IsInvalidArgument(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), HasSubstr("planning.paths"));
  ServerConfig config;
  config.planning.rivals = HasRivals();
  StartServer(config);
  EXPECT_EQ(CreateMission("yard", baseline).ok(), HasRivals());
}

}  // namespace mission_service_test
}  // namespace plumescout::server
