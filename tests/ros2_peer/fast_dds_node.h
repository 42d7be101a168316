// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "tests/ros2_peer/fast_cdr.h"

namespace plumescout::ros2_peer {

enum class Service { kBestEffort, kReliable, kLatched };

// A place in a ROS 2 system, by Fast DDS, on loopback alone. Aborts the program where DDS fails.
class FastDdsNode {
 public:
  using Hear = std::function<void(std::string cdr)>;
  class Writer;  // of a topic

  explicit FastDdsNode(int domain);
  ~FastDdsNode();
  FastDdsNode(const FastDdsNode&) = delete;
  FastDdsNode& operator=(const FastDdsNode&) = delete;

  // By names of DDS: rt/scan, sensor_msgs::msg::dds_::LaserScan_. The writer lives as long as this.
  Writer& Advertise(const std::string& topic, const std::string& type, Service service);
  // `hear` is called on a thread of Fast DDS.
  void Subscribe(const std::string& topic, const std::string& type, Service service, Hear hear);

  void PublishBytes(Writer& writer, std::string cdr);
  template <typename Message>
  void Publish(Writer& writer, const Message& message) {
    PublishBytes(writer, Encode(message));
  }

 private:
  struct Parts;
  const std::unique_ptr<Parts> parts_;
};

}  // namespace plumescout::ros2_peer
