// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/dds_node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "absl/time/clock.h"
#include "formats/ros/messages.h"
#include "tests/client/ros2/loopback_dds.h"

namespace plumescout::client {
namespace dds_node_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kTopic[] = "/somewhere/scan";

TEST(DdsNames, AreThoseOfRos) {
  EXPECT_EQ(FullTopic("", "scan"), "/scan");
  EXPECT_EQ(FullTopic("/robot1/", "scan"), "/robot1/scan");
  EXPECT_EQ(FullTopic("robot1", "/tf"), "/tf");
  EXPECT_EQ(DdsTopic("/robot1/scan"), "rt/robot1/scan");
  EXPECT_EQ(DdsType("sensor_msgs/msg/LaserScan"), "sensor_msgs::msg::dds_::LaserScan_");
}

class DdsNodeTest : public ::testing::Test {
 protected:
  DdsNodeTest() {
    KeepDdsToLoopback();
    domain_ = OwnDomain();
    node_ = Open();
  }
  std::unique_ptr<DdsNode> Open() const {
    auto node = DdsNode::Open(domain_);
    EXPECT_TRUE(node.ok()) << node.status();
    return *std::move(node);
  }
  // Polls until it is so, for as long as it could take anywhere.
  bool Await(const std::function<bool()>& holds) const {
    const absl::Time deadline = absl::Now() + absl::Seconds(60);
    while (absl::Now() < deadline) {
      if (holds()) return true;
      node_->Poll(absl::Milliseconds(20));
    }
    return false;
  }
  void Subscribe(Delivery delivery) {
    const auto status =
        node_->Subscribe(kTopic, ros::LaserScan::kType, {.delivery = delivery, .depth = 5},
                         [this](absl::string_view cdr) { heard_.emplace_back(cdr); });
    ASSERT_TRUE(status.ok()) << status;
  }

  int domain_ = 0;
  std::unique_ptr<DdsNode> node_;
  std::vector<std::string> heard_;
};

// Larger than a datagram, and of a length that is no multiple of four.
TEST_F(DdsNodeTest, WhoComesLaterHearsALatchedTopicWhole) {
  std::string bytes;
  for (int i = 0; i < 200'003; ++i) bytes.push_back(static_cast<char>(i % 101));
  const auto writer = Open();
  const auto topic = writer->Advertise(kTopic, ros::LaserScan::kType,
                                       {.delivery = Delivery::kLatched, .depth = 1});
  ASSERT_TRUE(topic.ok()) << topic.status();
  ASSERT_TRUE(writer->PublishBytes(*topic, bytes).ok());
  Subscribe(Delivery::kLatched);
  ASSERT_TRUE(Await([&] { return !heard_.empty(); }));
  EXPECT_EQ(heard_.front(), bytes + '\0');
  EXPECT_EQ(node_->Sources().front().publishers, 1);
  EXPECT_EQ(node_->Sources().front().heard, 1);
}

TEST_F(DdsNodeTest, SaysWhatToDoAboutServiceThatDoesNotFit) {
  Subscribe(Delivery::kLatched);
  const auto writer = Open();
  ASSERT_TRUE(
      writer->Advertise(kTopic, ros::LaserScan::kType, {.delivery = Delivery::kSensor}).ok());
  std::vector<std::string> misfits;
  ASSERT_TRUE(Await([&] {
    misfits = node_->TakeMisfits();
    return !misfits.empty();
  }));
  EXPECT_THAT(misfits, ElementsAre(HasSubstr("/somewhere/scan: a publisher is incompatible in")));
  EXPECT_THAT(node_->TakeMisfits(), ElementsAre());
  EXPECT_EQ(node_->Sources().front().publishers, 0);
}

}  // namespace dds_node_test
}  // namespace plumescout::client
