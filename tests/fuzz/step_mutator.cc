// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/step_mutator.h"

#include <cstddef>
#include <memory>
#include <utility>

#include "tests/fuzz/message_mutator.h"
#include "tests/fuzz/small_service.h"

namespace plumescout::fuzz {
namespace {

Step Copy(const Step& step) {
  std::unique_ptr<google::protobuf::Message> request(step.request->New());
  request->CopyFrom(*step.request);
  return {step.kind, std::move(request)};
}

}  // namespace

void MutateSteps(Steps& steps, Rng& rng) {
  if (steps.empty()) steps = GoodSteps();
  const auto any = [&] { return rng.Below(steps.size()); };
  switch (rng.Below(10)) {
    case 0:
      if (steps.size() > 1) steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(any()));
      break;
    case 1:
      std::swap(steps[any()], steps[any()]);
      break;
    case 2:
      if (steps.size() < kMaxSteps) steps.push_back(Copy(steps[any()]));
      break;
    case 3:
      if (steps.size() < kMaxSteps) steps.push_back(GoodStep(rng.Below(HandledRequests().size())));
      break;
    default:
      MutateMessage(*steps[any()].request, rng);
  }
  if (rng.Below(2) == 0) NumberObservations(steps);
}

}  // namespace plumescout::fuzz
