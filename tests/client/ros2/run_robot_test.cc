// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/run_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "server/server.h"
#include "tests/client/recorded_run.h"
#include "tests/client/ros2/box_robot.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace run_robot_test {

class RunRobotTest : public ::testing::Test {
 protected:
  void SetUp() override {
    KeepDdsToLoopback();
    server::ServerConfig config;
    config.listen = "127.0.0.1:0";
    auto server = server::Server::Start(config, {});
    ASSERT_TRUE(server.ok()) << server.status();
    server_ = *std::move(server);
    flags_.robot.client.target = absl::StrCat("127.0.0.1:", server_->port());
    flags_.robot.loop.participation.mission = "room";
    flags_.robot.loop.participation.robot = "scout";
    flags_.robot.create_mission = true;
    flags_.listen.domain = OwnDomain();
    flags_.listen.topics.ros_namespace = "robot1";
    flags_.tell.map_period_s = 0.2;
  }
  // Until `enough`, or for as long as it could take anywhere.
  absl::Status Run(const StopFn& enough) {
    const absl::Time end = absl::Now() + absl::Seconds(90);
    return RunRobot(
        flags_, [&] { return enough() || absl::Now() > end; }, "test");
  }
  // That the server has, of this mission.
  std::int64_t GasReadings() const {
    const auto map = MakeGrpcPlannerClient({.target = flags_.robot.client.target})->GetMap("room");
    return map.ok() ? map->gas_counters.readings : 0;
  }

  std::unique_ptr<server::Server> server_;
  RunFlags flags_;
};

TEST_F(RunRobotTest, DrivesTheRobotAndShowsItTheMap) {
  BoxRobot robot;
  const absl::Status status = Run(
      [&robot] { return robot.driven_m() > 0.1 && robot.free_cells > 100 && robot.gas_maps > 0; });
  ASSERT_TRUE(status.ok()) << status;
  EXPECT_GT(robot.paths, 0);
  EXPECT_GT(robot.driven_m(), 0.1);
  EXPECT_GT(robot.free_cells, 100);
  EXPECT_GT(robot.gas_maps, 0);
  EXPECT_GT(GasReadings(), 0);
}

TEST_F(RunRobotTest, TheRunIsRecordedIfItIsToldWhere) {
  const TempFolder folder;
  flags_.robot.record_folder = folder.path();
  BoxRobot robot;
  const absl::Status status =
      Run([&] { return robot.paths > 0 && GasReadings() > 0; });  // taken twice a second
  ASSERT_TRUE(status.ok()) << status;
  const std::vector<std::string> files = RecordingsIn(folder.path());
  ASSERT_EQ(files.size(), 1u);
  const RecordedRun run = ReadRun(files[0]);
  EXPECT_EQ(run.torn_end, "");
  EXPECT_GT(run.Count("/observations"), 0u);
  EXPECT_GT(run.Count("/robots/scout/pose"), 0u);
  EXPECT_GT(run.Count("/robots/scout/scan"), 0u);
  EXPECT_GT(run.Count("/robots/scout/gas"), 0u);
  EXPECT_GT(run.Count("/plans"), 0u);
  EXPECT_GT(run.Count("/scene/plans"), 0u);
  EXPECT_THAT(run.log, testing::Contains(testing::HasSubstr("plan 1")));
}

TEST_F(RunRobotTest, WhoElseDrivesHearsThePathAndNoVelocity) {
  flags_.tell.plan.drives = Drives::kPath;
  flags_.tell.map_period_s = 0.0;
  BoxRobot robot;
  const absl::Status status = Run([&robot] { return robot.paths > 0; });
  ASSERT_TRUE(status.ok()) << status;
  EXPECT_GT(robot.paths, 0);
  EXPECT_EQ(robot.velocities, 0);
}

TEST_F(RunRobotTest, RobotThatIsNotThereIsNamed) {
  flags_.patience_s = 0.3;
  const absl::Status status = Run(NeverStop());
  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
  flags_.listen.gas_calibration = "steep";
  EXPECT_TRUE(absl::IsInvalidArgument(Run(NeverStop())));
}

}  // namespace run_robot_test
}  // namespace plumescout::client
