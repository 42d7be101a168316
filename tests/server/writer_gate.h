// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <variant>

#include "absl/synchronization/notification.h"
#include "core/types/event.h"
#include "server/missions/mission_registry.h"

namespace plumescout::server {

// Holds up the writers of missions at the first observation, as a long refresh would, until Release
// or its own end.
class WriterGate {
 public:
  WriterGate() = default;
  ~WriterGate() { Release(); }
  WriterGate(const WriterGate&) = delete;
  WriterGate& operator=(const WriterGate&) = delete;

  EventSink MakeSink() const {
    return [state = state_](const Event& event) {
      if (!std::holds_alternative<ObservationReceived>(event.body)) return;
      if (!state->held.HasBeenNotified()) state->held.Notify();
      state->released.WaitForNotification();
    };
  }
  // Of one mission: two writers must not come to the gate at one time.
  RegistryHooks Hooks() const {
    RegistryHooks hooks;
    hooks.make_event_sink = [sink = MakeSink()](const MissionId&, const MissionOptions&) {
      return sink;
    };
    return hooks;
  }
  // Returns once a writer is held up.
  void AwaitHeld() const { state_->held.WaitForNotification(); }
  void Release() {
    if (!state_->released.HasBeenNotified()) state_->released.Notify();
  }

 private:
  struct State {
    absl::Notification held;
    absl::Notification released;
  };
  const std::shared_ptr<State> state_ = std::make_shared<State>();
};

}  // namespace plumescout::server
