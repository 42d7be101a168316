// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A mission with a dwell time and a robot whose gas sensor is slow.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lab/local/local_planner_client.h"
#include "tests/e2e/hall_run.h"

namespace plumescout::lab {
namespace stop_and_sample_test {

constexpr double kDwell_s = 5.0;
constexpr double kSettling_s = 4.0;
constexpr double kAmbient_ppm = 400.0;

// The gas hall as it is at the end of its frames: air that does not change while a robot stands.
const SceneWorld& SteadyHall() {
  static const SceneWorld world(GasHall().scene(), {.ambient_ppm = kAmbient_ppm});
  return world;
}

EpisodeOptions SlowOptions(client::Following following) {
  EpisodeOptions options = HallOptions();
  options.duration_s = 90.0;
  options.following = following;
  options.create->planning.dwell_s = kDwell_s;
  options.create->planning.speed_mps = 0.5;
  options.create->gas.background_mean_ppm = kAmbient_ppm;
  options.gas_settling_s = kSettling_s;
  options.simulated.scene_start_s = 1000.0;  // beyond the last frame
  options.simulated.gas_sensor = CarbonDioxideCell();
  options.simulated.gas_sensor.noise_sigma_ppm = 0.0;
  options.simulated.gas_sensor.noise_share = 0.0;
  options.simulated.gas_sensor.resolution_ppm = 0.0;
  return options;
}

struct Outcome {
  EpisodeResult episode;
  std::vector<Observation> readings;
};

Outcome RunSlow(const EpisodeOptions& options) {
  Outcome outcome;
  LocalPlannerClient local;
  const auto planner = WithTap(local, [&](const Observation& observation) {
    if (std::holds_alternative<GasReading>(observation.payload)) {
      outcome.readings.push_back(observation);
    }
    return observation;
  });
  auto episode = RunEpisode(*planner, SteadyHall(), options);
  EXPECT_TRUE(episode.ok()) << episode.status();
  if (episode.ok()) outcome.episode = *std::move(episode);
  return outcome;
}

double TimeOf_s(const Observation& reading, const EpisodeOptions& options) {
  return static_cast<double>(reading.sample_time_ns - options.simulated.start_time_ns) * 1e-9;
}

TEST(StopAndSampleTest, TheRobotStandsBeforeEveryReadingItSends) {
  for (const auto following : {client::Following::kIdeal, client::Following::kProportional}) {
    const EpisodeOptions options = SlowOptions(following);
    const Outcome outcome = RunSlow(options);
    ASSERT_GT(outcome.readings.size(), 5u);
    for (const Observation& reading : outcome.readings) {
      const double time_s = TimeOf_s(reading, options);
      for (const DrivenPose& driven : outcome.episode.path) {
        const double before_s = time_s - driven.time_s;
        if (before_s < -1e-6 || before_s > kSettling_s - 0.11) continue;  // but for a tick
        EXPECT_LT(Distance_m(driven.pose.position(), reading.pose.position()), 1e-9)
            << before_s << " s before the reading at " << time_s;
      }
    }
  }
}

TEST(StopAndSampleTest, SettledReadingsAreTheAirAroundTheRobot) {
  EpisodeOptions options = SlowOptions(client::Following::kIdeal);
  const Outcome outcome = RunSlow(options);
  double highest_ppm = 0.0;
  for (const Observation& reading : outcome.readings) {
    const double told_ppm = std::get<GasReading>(reading.payload).concentration_ppm;
    const double truth_ppm = SteadyHall().Concentration_ppm(reading.pose.position(), 1000.0);
    EXPECT_NEAR(told_ppm, truth_ppm, 1e-6 * truth_ppm);
    highest_ppm = std::max(highest_ppm, truth_ppm);
  }
  EXPECT_GT(highest_ppm, kAmbient_ppm + 1.0) << "some of it in gas";
}

TEST(StopAndSampleTest, WithTheLagLeftInReadingsAreSettledAsFarAsTheSensorIs) {
  EpisodeOptions options = SlowOptions(client::Following::kIdeal);
  options.correct_gas_lag = false;
  const Outcome outcome = RunSlow(options);
  ASSERT_FALSE(outcome.readings.empty());
  bool any_lag = false;
  for (const Observation& reading : outcome.readings) {
    const double told_ppm = std::get<GasReading>(reading.payload).concentration_ppm;
    const double truth_ppm = SteadyHall().Concentration_ppm(reading.pose.position(), 1000.0);
    any_lag = any_lag || std::abs(told_ppm - truth_ppm) > 0.01;
  }
  EXPECT_TRUE(any_lag);
}

TEST(StopAndSampleTest, ItStandsAtEveryVertexOfItsTrajectories) {
  const EpisodeOptions options = SlowOptions(client::Following::kIdeal);
  const Outcome outcome = RunSlow(options);
  int vertices = 0;
  for (const IssuedPlan& issued : outcome.episode.plans) {
    const Trajectory& trajectory = issued.plan.trajectory;
    if (issued.time_s + trajectory.duration_s > options.duration_s) continue;  // cut short
    for (std::size_t i = 1; i < trajectory.waypoints.size(); ++i) {
      const Waypoint& waypoint = trajectory.waypoints[i];
      EXPECT_EQ(waypoint.dwell_s, kDwell_s);
      ++vertices;
      const auto standing = std::count_if(
          outcome.episode.path.begin(), outcome.episode.path.end(), [&](const DrivenPose& driven) {
            return Distance_m(driven.pose.position(), waypoint.pose.position()) < 1e-9;
          });
      EXPECT_GE(standing, 50) << "ticks of 0.1 s";
    }
  }
  EXPECT_GT(vertices, 3);
}

}  // namespace stop_and_sample_test
}  // namespace plumescout::lab
