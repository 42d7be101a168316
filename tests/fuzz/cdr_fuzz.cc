// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Bytes as any message of ROS 2: they are refused, or what was read is written and read again
// alike.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "formats/ros/cdr_reader.h"
#include "formats/ros/cdr_writer.h"
#include "formats/ros/messages.h"

namespace {

namespace ros = plumescout::ros;

template <typename Message>
void Try(const std::string& bytes) {
  const auto message = ros::DecodeCdr<Message>(bytes);
  if (!message.ok()) return;
  const std::string written = ros::EncodeCdr(*message);
  const auto again = ros::DecodeCdr<Message>(written);
  if (!again.ok() || ros::EncodeCdr(*again) != written) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 5) {
    case 0:
      Try<ros::LaserScan>(bytes);
      break;
    case 1:
      Try<ros::TfMessage>(bytes);
      break;
    case 2:
      Try<ros::Odometry>(bytes);
      break;
    case 3:
      Try<ros::GasSensor>(bytes);
      break;
    default:
      Try<ros::Anemometer>(bytes);
      break;
  }
  return 0;
}
