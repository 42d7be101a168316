// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <google/protobuf/message.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/string_view.h"

namespace plumescout::fuzz {

// One request to a service.
struct Step {
  std::size_t kind = 0;  // index of HandledRequests()
  std::unique_ptr<google::protobuf::Message> request;
};
using Steps = std::vector<Step>;

// An input is a list of steps, each a byte for the kind (modulo the number of kinds), two for the
// length of the request, and the request. What does not parse ends the list.
Steps ParseSteps(absl::string_view bytes);
std::string SerializeSteps(const Steps& steps);

// Numbers observations one after the other, so that a mission takes them.
void NumberObservations(Steps& steps);

// A request of this kind that the service of small_service.h would grant in its turn.
Step GoodStep(std::size_t kind);
// A short mission: made, joined, seen, planned and read.
Steps GoodSteps();

inline constexpr std::size_t kMaxSteps = 32;

}  // namespace plumescout::fuzz
