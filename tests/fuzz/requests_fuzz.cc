// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Requests of every kind, in any order.

#include <cstdint>
#include <cstring>
#include <string>

#include "tests/fuzz/request_steps.h"
#include "tests/fuzz/small_service.h"
#include "tests/fuzz/step_mutator.h"

namespace {

absl::string_view Text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using plumescout::fuzz::HandledRequests;
  plumescout::fuzz::SmallService service;
  for (const plumescout::fuzz::Step& step : plumescout::fuzz::ParseSteps(Text(data, size))) {
    HandledRequests()[step.kind].handle(service, *step.request);
  }
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned int seed) {
  plumescout::Rng rng(seed);
  plumescout::fuzz::Steps steps = plumescout::fuzz::ParseSteps(Text(data, size));
  plumescout::fuzz::MutateSteps(steps, rng);
  const std::string bytes = plumescout::fuzz::SerializeSteps(steps);
  if (bytes.size() > max_size) return size;  // as it was
  std::memcpy(data, bytes.data(), bytes.size());
  return bytes.size();
}
