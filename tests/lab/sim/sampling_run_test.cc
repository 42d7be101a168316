// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/sampling_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "lab/local/local_planner_client.h"
#include "tests/lab/sim/fake_service.h"

namespace plumescout::lab {
namespace sampling_run_test {

// A field of 8 x 4 cells of 1 m in which the concentration is the number of the column.
Scene ColumnsScene() {
  Scene scene;
  const GridGeometry geometry{0.0, 0.0, 1.0, 8, 4};
  scene.occupancy = Grid<CellState>(geometry, CellState::kFree);
  scene.conc_mean_ppm = Grid<float>(geometry);
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    scene.conc_mean_ppm[i] = static_cast<float>(geometry.CellAtIndex(i).x);
  }
  return scene;
}

GasReading ReadColumn(const Dwell& dwell, Rng&) { return {std::floor(dwell.place.x_m), 0.0}; }

// Along the bottom row at 0.5 m/s with a sample of 4 s after every second metre: in all 8 s of
// driving for each 4 m, and 8 s of standing.
Plan TwoSamples(const client::PlanQuery& query) {
  const Pose2 start = query.request.start.value();
  Plan plan;
  plan.id = 7;
  plan.trajectory.waypoints = {{start, 0.0, 0.0},
                               {{start.x_m + 1.0, start.y_m, 0.0}, 2.0, 0.0},
                               {{start.x_m + 2.0, start.y_m, 0.0}, 4.0, 4.0},
                               {{start.x_m + 2.0, start.y_m + 2.0, 0.0}, 12.0, 4.0}};
  plan.trajectory.length_m = 4.0;
  plan.trajectory.duration_s = 16.0;
  return plan;
}

class SamplingRunTest : public ::testing::Test {
 protected:
  SamplingRunTest() : truth_(ColumnsScene()), service_("robot-1") {
    options_.participation = {.mission = "study", .robot = "robot-1", .create = MissionOptions{}};
    options_.start = {0.5, 0.5, 0.0};
    options_.first_dwell_s = 2.0;
  }

  // Plans TwoSamples that many times, then says that the mission is complete.
  void PlanTimes(int times) {
    plans_left_ = times;
    service_.server().set_script([this](const client::PlanQuery& query) {
      return plans_left_-- > 0 ? TwoSamples(query) : client::CompletePlan();
    });
  }

  absl::StatusOr<SamplingRecord> Run(const StopFn& stop = NeverStop()) {
    return RunSampling(service_, truth_, ReadColumn, options_, stop);
  }

  Scene truth_;
  FakeService service_;
  SamplingRunOptions options_;
  int plans_left_ = 0;
};

TEST_F(SamplingRunTest, SamplesAtTheStartAndWhereItIsToldToStand) {
  PlanTimes(1);
  const auto record = Run();
  ASSERT_TRUE(record.ok()) << record.status();
  EXPECT_EQ(record->end, SamplingEnd::kMissionComplete);
  const std::vector<TakenSample> expected = {{2.0, {0.5, 0.5}, {0.0, 0.0}, 0.0},
                                             {10.0, {2.5, 0.5}, {2.0, 0.0}, 2.0},
                                             {18.0, {2.5, 2.5}, {2.0, 0.0}, 4.0}};
  EXPECT_EQ(record->samples, expected);
  EXPECT_DOUBLE_EQ(record->elapsed_s, 18.0);
  EXPECT_DOUBLE_EQ(record->driven_m, 4.0);
  EXPECT_EQ(record->plans, 2);
}

TEST_F(SamplingRunTest, SendsItsReadingsWithThePoseAndTimeOfTheEndOfTheDwell) {
  options_.start_time_ns = 5'000'000'000;
  PlanTimes(1);
  ASSERT_TRUE(Run().ok());
  const std::vector<Observation> received = service_.server().received();
  ASSERT_EQ(received.size(), 3u);
  for (std::size_t i = 0; i < received.size(); ++i) {
    EXPECT_EQ(received[i].sequence, static_cast<std::int64_t>(i) + 1);
  }
  EXPECT_EQ(received[1].sample_time_ns, 15'000'000'000);
  EXPECT_EQ(received[2].sample_time_ns, 23'000'000'000);
  EXPECT_EQ(received[2].pose.position(), (Point2{2.5, 2.5}));
  EXPECT_EQ(std::get<GasReading>(received[2].payload).concentration_ppm, 2.0);
}

TEST_F(SamplingRunTest, ReportsAPlanAsReachedOnceItsSamplesAreApplied) {
  PlanTimes(1);
  ASSERT_TRUE(Run().ok());
  const std::vector<client::FakePlannerClient::Report> expected = {
      {7, ProgressOutcome::kReached, 3}};
  EXPECT_EQ(service_.server().reports(), expected);
}

TEST_F(SamplingRunTest, AsksForThePlanFromWhereItStandsWithAllThatItKnows) {
  std::vector<client::PlanQuery> queries;
  service_.server().set_script([&](const client::PlanQuery& query) {
    queries.push_back(query);
    return queries.size() < 3 ? TwoSamples(query) : client::CompletePlan();
  });
  ASSERT_TRUE(Run().ok());
  ASSERT_EQ(queries.size(), 3u);
  EXPECT_EQ(queries[0].min_applied_sequence, 1);
  EXPECT_EQ(queries[1].min_applied_sequence, 3);
  EXPECT_EQ(queries[2].request.start->position(), (Point2{4.5, 4.5}));
}

TEST_F(SamplingRunTest, WithoutAFirstDwellItSamplesOnlyWhereToldTo) {
  options_.first_dwell_s = 0.0;
  PlanTimes(1);
  const auto record = Run();
  ASSERT_TRUE(record.ok()) << record.status();
  ASSERT_EQ(record->samples.size(), 2u);
  EXPECT_DOUBLE_EQ(record->samples.front().time_s, 8.0);
  ASSERT_FALSE(record->errors.empty());
  EXPECT_EQ(record->errors.front().time_s, 0.0);  // of the empty map
}

TEST_F(SamplingRunTest, StandsStillWhenTheTimeIsUp) {
  options_.time_limit_s = 12.0;  // 2 s after the first sample, halfway to the second
  PlanTimes(1);
  const auto record = Run();
  ASSERT_TRUE(record.ok()) << record.status();
  EXPECT_EQ(record->end, SamplingEnd::kTimeLimit);
  EXPECT_DOUBLE_EQ(record->elapsed_s, 12.0);
  EXPECT_DOUBLE_EQ(record->driven_m, 3.0);
  EXPECT_EQ(record->samples.size(), 2u);
  const auto reports = service_.server().reports();
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports.front().outcome, ProgressOutcome::kAborted);
}

TEST_F(SamplingRunTest, ADwellThatEndsWithTheTimeCountsAndALongerOneDoesNot) {
  options_.time_limit_s = 18.0;
  PlanTimes(2);
  EXPECT_EQ(Run().value().samples.size(), 3u);
  options_.time_limit_s = 17.9;
  options_.participation.mission = "another";
  service_.server().Restart();
  PlanTimes(2);
  EXPECT_EQ(Run().value().samples.size(), 2u);
}

TEST_F(SamplingRunTest, EndsIfAPlanLeadsNowhere) {
  service_.server().set_script([](const client::PlanQuery&) { return Plan{}; });
  const auto record = Run();
  ASSERT_TRUE(record.ok()) << record.status();
  EXPECT_EQ(record->end, SamplingEnd::kNowhereToGo);
  EXPECT_EQ(record->plans, 1);
}

TEST_F(SamplingRunTest, StopsBetweenSamplesWhenToldTo) {
  PlanTimes(100);
  const auto record = Run([this] { return service_.server().applied() >= 4; });
  ASSERT_TRUE(record.ok()) << record.status();
  EXPECT_EQ(record->end, SamplingEnd::kStopped);
  EXPECT_EQ(record->samples.size(), 4u);
}

// The map of the fake knows the cells that were sampled: each takes its error away.
TEST_F(SamplingRunTest, JudgesTheMapAfterEverySample) {
  service_.set_draw([this](const std::vector<Observation>& received, MapSnapshot& map) {
    map.gas_mean_ppm = Grid<float>(truth_.geometry(), std::numeric_limits<float>::quiet_NaN());
    for (const Observation& observation : received) {
      const Cell cell = truth_.geometry().CellAt(observation.pose.position());
      map.gas_mean_ppm[cell] =
          static_cast<float>(std::get<GasReading>(observation.payload).concentration_ppm);
    }
  });
  PlanTimes(1);
  const auto record = Run();
  ASSERT_TRUE(record.ok()) << record.status();
  const double squares = 4.0 * (1 + 4 + 9 + 16 + 25 + 36 + 49);
  ASSERT_EQ(record->errors.size(), 3u);
  EXPECT_DOUBLE_EQ(record->errors[0].rmse_ppm, std::sqrt(squares / 32.0));
  EXPECT_DOUBLE_EQ(record->errors[1].time_s, 10.0);
  EXPECT_DOUBLE_EQ(record->errors[1].rmse_ppm, std::sqrt((squares - 4.0) / 32.0));
  EXPECT_DOUBLE_EQ(record->errors[2].rmse_ppm, std::sqrt((squares - 8.0) / 32.0));
}

TEST_F(SamplingRunTest, JudgesNoOftenerThanAskedButAfterEveryPlan) {
  options_.judge_period_s = 12.0;
  PlanTimes(3);
  std::vector<double> told_s;
  options_.on_map = [&](const ErrorPoint& point, const MapSnapshot&) {
    told_s.push_back(point.time_s);
  };
  const auto record = Run();
  ASSERT_TRUE(record.ok()) << record.status();
  EXPECT_EQ(told_s, (std::vector<double>{2.0, 18.0, 34.0, 50.0}));
  EXPECT_EQ(record->errors.size(), told_s.size());
}

TEST_F(SamplingRunTest, IsRepeatable) {
  const DwellSensor noisy = [](const Dwell& dwell, Rng& rng) {
    return GasReading{dwell.place.x_m + rng.Uniform01(), 0.0};
  };
  const auto run = [&] {
    FakeService service("robot-1");
    int left = 5;
    service.server().set_script([&](const client::PlanQuery& query) {
      return left-- > 0 ? TwoSamples(query) : client::CompletePlan();
    });
    return RunSampling(service, truth_, noisy, options_).value();
  };
  const SamplingRecord first = run();
  const SamplingRecord second = run();
  EXPECT_EQ(first.samples, second.samples);
  EXPECT_EQ(first.errors, second.errors);
}

TEST_F(SamplingRunTest, AReadingThatIsRefusedEndsTheRun) {
  service_.server().RefuseObservation(2);
  PlanTimes(1);
  EXPECT_FALSE(Run().ok());
}

TEST_F(SamplingRunTest, AMapThatCannotBeHadEndsTheRun) {
  service_.FailMaps(absl::PermissionDeniedError("no"), 1);
  PlanTimes(1);
  EXPECT_TRUE(absl::IsPermissionDenied(Run().status()));
}

TEST_F(SamplingRunTest, OptionsOutOfRangeAreNamed) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  options_.time_limit_s = 0.0;
  EXPECT_TRUE(absl::IsInvalidArgument(Run().status()));
  options_.time_limit_s = 1.0;
  options_.first_dwell_s = kNaN;
  EXPECT_NE(Run().status().message().find("first_dwell_s"), absl::string_view::npos);
  options_.first_dwell_s = 1.0;
  options_.start.x_m = kNaN;
  EXPECT_TRUE(absl::IsInvalidArgument(Run().status()));
}

// Scans from the middle of a wide room without walls, three of them: a cell is free from then on.
void ScanAround(client::PlannerClient& planner, const MissionId& mission, Point2 middle) {
  Scan scan;
  scan.start_angle_rad = -M_PI;
  scan.angle_step_rad = 2.0 * M_PI / 720.0;
  scan.max_range_m = 4.0;
  scan.ranges_m.assign(720, std::numeric_limits<float>::infinity());
  const auto session = planner.RegisterRobot(mission, "surveyor", 0.2, false).value();
  const auto stream = planner.OpenObservationStream(session).value();
  for (std::int64_t i = 1; i <= 3; ++i) {
    ASSERT_TRUE(stream->Write({{i, i * 1'000'000, {middle.x_m, middle.y_m, 0.0}, scan}}).ok());
  }
}

// Gas of 5 ppm everywhere, and plans of the service itself: every reading makes its map better.
TEST(SamplingRunLocalTest, FollowsThePlansOfAService) {
  Scene truth = ColumnsScene();
  truth.conc_mean_ppm = Grid<float>(truth.geometry(), 5.0F);
  const DwellSensor sensor = [](const Dwell&, Rng&) { return GasReading{5.0, 0.0}; };
  MissionOptions mission;
  mission.occupancy.resolution_m = 0.25;
  mission.planning.dwell_s = 2.0;
  LocalPlannerClient planner;
  ASSERT_TRUE(planner.CreateMission("study", mission).ok());
  ScanAround(planner, "study", {4.0, 3.0});  // not where the other robot is to begin
  SamplingRunOptions options;
  options.participation = {.mission = "study", .robot = "robot-1", .create = std::nullopt};
  options.start = {4.0, 2.0, 0.0};
  options.start_time_ns = 1'000'000'000;  // after the scans
  options.time_limit_s = 60.0;
  const auto record = RunSampling(planner, truth, sensor, options);
  ASSERT_TRUE(record.ok()) << record.status();
  EXPECT_GE(record->samples.size(), 5u);
  EXPECT_GT(record->driven_m, 1.0);
  EXPECT_LE(record->elapsed_s, 60.0);
  EXPECT_LT(record->errors.back().rmse_ppm, 0.5 * record->errors.front().rmse_ppm);
}

TEST(SamplingRunLocalTest, AMissionWithoutAMapSaysSo) {
  LocalPlannerClient planner;
  SamplingRunOptions options;
  options.participation = {.mission = "study", .robot = "robot-1", .create = MissionOptions{}};
  options.start = {0.5, 0.5, 0.0};
  const auto record = RunSampling(planner, ColumnsScene(), ReadColumn, options);
  EXPECT_TRUE(absl::IsInvalidArgument(record.status()));
}

}  // namespace sampling_run_test
}  // namespace plumescout::lab
