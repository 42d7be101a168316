// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "absl/time/clock.h"
#include "client/ros2/dds_node.h"
#include "formats/ros/cdr_reader.h"
#include "tests/client/ros2/loopback_dds.h"

namespace plumescout::client {

inline std::unique_ptr<DdsNode> OpenNode() {
  KeepDdsToLoopback();
  auto node = DdsNode::Open(OwnDomain());
  EXPECT_TRUE(node.ok()) << node.status();
  return *std::move(node);
}

// Has the last message of a topic.
template <typename Message>
void Keep(DdsNode& node, const std::string& topic, Delivery delivery,
          std::optional<Message>& last) {
  const auto status = node.Subscribe(topic, Message::kType, {.delivery = delivery, .depth = 1},
                                     [&last](absl::string_view cdr) {
                                       auto message = ros::DecodeCdr<Message>(cdr);
                                       ASSERT_TRUE(message.ok()) << message.status();
                                       last = *std::move(message);
                                     });
  ASSERT_TRUE(status.ok()) << status;
}

// Does so again and again, and listens, until it holds, for as long as it could take anywhere.
inline bool Await(DdsNode& node, const std::function<void()>& act,
                  const std::function<bool()>& holds) {
  const absl::Time deadline = absl::Now() + absl::Seconds(60);
  while (!holds() && absl::Now() < deadline) {
    act();
    node.Poll(absl::Milliseconds(50));
  }
  return holds();
}

}  // namespace plumescout::client
