// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "formats/journal/event_codec.h"
#include "formats/view/mission_view.h"

namespace plumescout {

// The events of a mission as a MissionView: the mission is replayed for that, event by event, and
// shows its map every map_period_s, if the ration allows it. Memory: that of the mission, and as of
// MissionView. The same events give the same bytes. Single-threaded.
class MissionMcap {
 public:
  // `mission` is that of the start's options, before its first event. `map_period_s` is in the
  // mission's time, at least; 0: after each event. `map_share`: as of MapRation.
  MissionMcap(const JournalStart& start, std::unique_ptr<Mission> mission, double map_period_s,
              double map_share = MissionView::kMapShare);

  // Applies the event. `record` is its bytes in a journal. kDataLoss if the mission refuses the
  // event or gives it another number; kInternal as of McapEncoder.
  absl::Status Add(const Event& event, absl::string_view record);
  // The file ends here.
  absl::Status Finish() { return view_.Finish(mission_->Snapshot()); }

  // As of McapEncoder.
  std::string Take() { return view_.Take(); }
  std::size_t ready_bytes() const { return view_.ready_bytes(); }
  const Mission& mission() const { return *mission_; }

 private:
  std::unique_ptr<Mission> mission_;
  MapTimer map_timer_;
  MissionView view_;
};

}  // namespace plumescout
