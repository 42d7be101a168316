// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bags/bag_intake.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/ros/cdr_reader.h"
#include "formats/ros/messages.h"

namespace plumescout::lab {
namespace {

constexpr std::int64_t kGiveUp_ns = 60'000'000'000;  // longer than anything is waited for

}  // namespace

BagIntake::BagIntake(const BagTopics& topics, const client::IntakeOptions& options,
                     client::RobotIntake::Complain complain, Sink sink)
    : topics_(topics), intake_(options, std::move(complain)), sink_(std::move(sink)) {}

template <typename Message, typename HearMessage>
void BagIntake::HearAs(const BagMessage& message, HearMessage hear) {
  if (message.type != Message::kType) {
    return intake_.Refuse(
        message.topic, absl::InvalidArgumentError(
                           absl::StrCat("its type is ", message.type, ", not ", Message::kType)));
  }
  absl::StatusOr<Message> decoded = ros::DecodeCdr<Message>(message.cdr);
  if (!decoded.ok()) return intake_.Refuse(message.topic, decoded.status());
  hear(*std::move(decoded));
}

void BagIntake::Hear(const BagMessage& message) {
  const std::string& topic = message.topic;
  const std::int64_t time_ns = message.log_time_ns;
  if (topic == topics_.tf || topic == topics_.tf_static) {
    HearAs<ros::TfMessage>(message, [&](const ros::TfMessage& heard) {
      intake_.OnTransforms(heard, topic == topics_.tf_static);
    });
  } else if (topic == topics_.odometry) {
    HearAs<ros::Odometry>(message, [&](const ros::Odometry& heard) { intake_.OnOdometry(heard); });
  } else if (topic == topics_.scan) {
    HearAs<ros::LaserScan>(
        message, [&](ros::LaserScan heard) { intake_.OnScan(std::move(heard), time_ns); });
  } else if (topic == topics_.gas) {
    HearAs<ros::GasSensor>(message,
                           [&](ros::GasSensor heard) { intake_.OnGas(std::move(heard), time_ns); });
  }
}

absl::Status BagIntake::Take(const BagMessage& message) {
  log_time_ns_ = std::max(log_time_ns_, message.log_time_ns);
  Hear(message);
  return HandOn();
}

absl::Status BagIntake::Finish() {
  log_time_ns_ += kGiveUp_ns;
  return HandOn();
}

absl::Status BagIntake::HandOn() {
  if (auto correction = intake_.TakeCorrection()) {
    const auto now = intake_.LatestPose();
    if (now.ok()) {
      PLUMESCOUT_RETURN_IF_ERROR(sink_(intake_.newest_ns(), now->pose, *std::move(correction)));
    }
  }
  while (auto scan = intake_.TakeScan(log_time_ns_)) {
    PLUMESCOUT_RETURN_IF_ERROR(sink_(scan->time_ns, scan->pose, std::move(scan->reading)));
  }
  while (auto gas = intake_.TakeGas(log_time_ns_)) {
    PLUMESCOUT_RETURN_IF_ERROR(sink_(gas->time_ns, gas->pose, gas->reading));
  }
  return absl::OkStatus();
}

}  // namespace plumescout::lab
