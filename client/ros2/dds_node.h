// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "formats/ros/cdr_writer.h"

namespace plumescout::client {

// Quality of service, as far as topics of ROS 2 differ in it.
enum class Delivery {
  kSensor,    // best effort, the last few
  kReliable,  // the last few
  kLatched,   // reliable, and the last ones also for who comes later
};

struct TopicQos {
  Delivery delivery = Delivery::kReliable;
  int depth = 10;
};

// "/robot1/scan" of namespace "robot1" and topic "scan"; a topic that begins with a slash has its
// full name already.
std::string FullTopic(const std::string& ros_namespace, const std::string& topic);
// What DDS calls it: "rt/robot1/scan", and "sensor_msgs::msg::dds_::LaserScan_" for
// "sensor_msgs/msg/LaserScan".
std::string DdsTopic(const std::string& full_topic);
std::string DdsType(const std::string& ros_type);

// A place in a ROS 2 system, by DDS. Publish from any thread, all else from one.
class DdsNode {
 public:
  using Hear = std::function<void(absl::string_view cdr)>;

  // `domain`: ROS_DOMAIN_ID. kUnavailable if DDS does not start.
  static absl::StatusOr<std::unique_ptr<DdsNode>> Open(int domain);
  ~DdsNode();
  DdsNode(const DdsNode&) = delete;
  DdsNode& operator=(const DdsNode&) = delete;

  absl::Status Subscribe(const std::string& full_topic, const std::string& ros_type,
                         const TopicQos& qos, Hear hear);
  absl::StatusOr<int> Advertise(const std::string& full_topic, const std::string& ros_type,
                                const TopicQos& qos);
  // Hands over what has come; waits for it if nothing has, at most so long.
  void Poll(absl::Duration timeout);
  absl::Status PublishBytes(int writer, std::string cdr);
  template <typename Message>
  absl::Status Publish(int writer, const Message& message) {
    return PublishBytes(writer, ros::EncodeCdr(message));
  }

  // Waits until who listens reliably has what was published, at most so long for each topic.
  void AwaitHeard(absl::Duration timeout);

  // How many publish what is subscribed to.
  struct Source {
    std::string topic;
    int publishers = 0;
    std::int64_t heard = 0;
  };
  std::vector<Source> Sources() const;
  // What others on our topics offer or ask for that does not fit, with the way out, by topic; each
  // until it changes.
  std::vector<std::string> TakeMisfits();

 private:
  struct Reader {
    std::string topic;
    std::int32_t entity = 0;
    Hear hear;
    std::int64_t heard = 0;
    std::uint32_t misfits = 0;
  };
  struct Writer {
    std::string topic;
    std::int32_t entity = 0;
    std::uint32_t misfits = 0;
  };

  DdsNode() = default;
  absl::StatusOr<std::int32_t> OpenTopic(const std::string& full_topic,
                                         const std::string& ros_type) const;
  void Take(Reader& reader);

  std::int32_t participant_ = 0;
  std::int32_t waitset_ = 0;
  std::vector<std::unique_ptr<Reader>> readers_;
  std::vector<Writer> writers_;
};

}  // namespace plumescout::client
