// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/journal/event_codec_v4.h"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "formats/journal/enumerators.h"
#include "formats/little_endian.h"

namespace plumescout {
namespace {

constexpr std::int64_t kStartNumber = 0;  // events of a mission count from 1

template <typename T>
concept Number = std::is_arithmetic_v<T> && !std::same_as<T, bool>;

template <typename T>
concept Enum = std::is_enum_v<T>;

// The members that the layout has, in its order. A binding names all members of the struct, so that
// one added since does not compile until it is passed over here.
template <typename T, typename Struct>
concept Is = std::same_as<std::remove_const_t<T>, Struct>;

void Visit(auto& archive, Is<Cell> auto& cell) {
  auto& [x, y] = cell;
  archive(x, y);
}
void Visit(auto& archive, Is<Point2> auto& point) {
  auto& [x_m, y_m] = point;
  archive(x_m, y_m);
}
void Visit(auto& archive, Is<Pose2> auto& pose) {
  auto& [x_m, y_m, yaw_rad] = pose;
  archive(x_m, y_m, yaw_rad);
}
void Visit(auto& archive, Is<Scan> auto& scan) {
  auto& [start_angle_rad, angle_step_rad, max_range_m, ranges_m] = scan;
  archive(start_angle_rad, angle_step_rad, max_range_m, ranges_m);
}
void Visit(auto& archive, Is<GasReading> auto& reading) {
  auto& [concentration_ppm, variance_ppm2] = reading;
  archive(concentration_ppm, variance_ppm2);
}
void Visit(auto& archive, Is<SequenceGap> auto& gap) {
  auto& [first_sequence, last_sequence] = gap;
  archive(first_sequence, last_sequence);
}
void Visit(auto& archive, Is<Observation> auto& observation) {
  auto& [sequence, sample_time_ns, pose, payload] = observation;
  archive(sequence, sample_time_ns, pose, payload);
}
void Visit(auto& archive, Is<Waypoint> auto& waypoint) {
  auto& [pose, arrival_time_s, dwell_s, speed_mps] = waypoint;
  archive(pose, arrival_time_s, dwell_s, speed_mps);
}
void Visit(auto& archive, Is<Trajectory> auto& trajectory) {
  auto& [waypoints, length_m, duration_s] = trajectory;
  archive(waypoints, length_m, duration_s);
}
void Visit(auto& archive, Is<Goal> auto& goal) {
  auto& [kind, cell, position, centroid, frontier_cells] = goal;
  archive(kind, cell, position, centroid, frontier_cells);
}
void Visit(auto& archive, Is<Candidate> auto& candidate) {
  auto& [goal, path, source, cost, penalty, length_m, mean_ucb, mean_ppm, duration_s,
         information_nats, reward, stops] = candidate;
  archive(goal, path, source, cost, penalty, length_m, mean_ucb, mean_ppm, duration_s,
          information_nats, reward, stops);
}
void Visit(auto& archive, Is<RejectedGoal> auto& rejected) {
  auto& [goal, reason, detail] = rejected;
  archive(goal, reason, detail);
}
void Visit(auto& archive, Is<PlanEffort> auto& effort) {
  auto& [samples, vertices, edges_evaluated, goals_by_guard, batches] = effort;
  archive(samples, vertices, edges_evaluated, goals_by_guard, batches);
}
void Visit(auto& archive, Is<Plan> auto& plan) {
  auto& [id, robot, strategy, belief_revision, seed, phase, end, chosen, candidates, rejected,
         trajectory, effort, field_flat, goal_kept, start_escaped, explanation, cpu_s] = plan;
  archive(id, robot, strategy, belief_revision, seed, phase, end, chosen, candidates, rejected,
          trajectory, effort, field_flat, goal_kept, start_escaped, explanation, cpu_s);
}
void Visit(auto& archive, Is<RobotRegistered> auto& event) {
  auto& [robot, radius_m, lease_token, log_epoch] = event;  // log_epoch is younger
  archive(robot, radius_m, lease_token);
}
void Visit(auto& archive, Is<ObservationReceived> auto& event) {
  auto& [robot, observation] = event;
  archive(robot, observation);
}
void Visit(auto& archive, Is<PosteriorRefreshed> auto& event) {
  auto& [time_ns] = event;
  archive(time_ns);
}
void Visit(auto& archive, Is<PlanIssued> auto& event) {
  auto& [plan] = event;
  archive(plan);
}
void Visit(auto& archive, Is<ProgressReported> auto& event) {
  auto& [robot, plan_id, outcome] = event;
  archive(robot, plan_id, outcome);
}
void Visit(auto& archive, Is<EpochBegun> auto& event) {
  auto& [time_ns] = event;
  archive(time_ns);
}
void Visit(auto&, Is<EpochAdopted> auto&) {
  static_assert(std::is_empty_v<EpochAdopted>);  // no members, so no binding to name them in
}
void Visit(auto& archive, Is<RobotRemoved> auto& event) {
  auto& [robot] = event;
  archive(robot);
}
void Visit(auto& archive, Is<Event> auto& event) {
  auto& [number, body] = event;
  archive(number, body);
}

// After the first damage every further read does nothing.
class Decoder {
 public:
  explicit Decoder(absl::string_view bytes) : rest_(bytes) {}

  template <typename... T>
  void operator()(T&... values) {
    (Get(values), ...);
  }
  // Whether everything was well formed and nothing is left.
  bool Finished() const { return ok_ && rest_.empty(); }

 private:
  // Whether `count` more bytes are there; if not, the rest is damaged.
  bool Has(std::size_t count) {
    ok_ = ok_ && rest_.size() >= count;
    return ok_;
  }
  void Get(Number auto& value) {
    if (!Has(sizeof(value))) return;
    value = LoadLittleEndian<std::remove_reference_t<decltype(value)>>(rest_.data());
    rest_.remove_prefix(sizeof(value));
  }
  // A byte below `count`; 0 if it is not.
  std::uint8_t GetBelow(std::size_t count) {
    std::uint8_t byte = 0;
    Get(byte);
    ok_ = ok_ && byte < count;
    return ok_ ? byte : std::uint8_t{0};
  }
  void Get(bool& value) { value = GetBelow(2) != 0; }
  template <Enum T>
  void Get(T& value) {
    std::uint8_t byte = 0;
    Get(byte);
    ok_ = ok_ && IsEnumerator(static_cast<T>(byte));
    value = ok_ ? static_cast<T>(byte) : T{};
  }
  void Get(std::string& text) {
    std::uint32_t size = 0;
    Get(size);
    if (!Has(size)) return;
    text.assign(rest_.data(), size);
    rest_.remove_prefix(size);
  }
  // Grows with what is really there: a damaged length does not allocate.
  template <typename T>
  void Get(std::vector<T>& list) {
    std::uint32_t size = 0;
    Get(size);
    list.clear();
    for (std::uint32_t i = 0; i < size && ok_; ++i) Get(list.emplace_back());
  }
  template <typename T>
  void Get(std::optional<T>& value) {
    bool present = false;
    Get(present);
    value.reset();
    if (present) Get(value.emplace());
  }
  template <typename... T>
  void Get(std::variant<T...>& choice) {
    GetAlternative(choice, GetBelow(sizeof...(T)), std::index_sequence_for<T...>());
  }
  template <typename Variant, std::size_t... kIndex>
  void GetAlternative(Variant& choice, std::size_t index, std::index_sequence<kIndex...>) {
    ((index == kIndex ? Get(choice.template emplace<kIndex>()) : void()), ...);
  }
  template <typename T>
  requires std::is_class_v<T>
  void Get(T& value) { Visit(*this, value); }

  absl::string_view rest_;
  bool ok_ = true;
};

}  // namespace

absl::StatusOr<Event> DecodeEventV4(absl::string_view bytes) {
  Event event;
  Decoder decoder(bytes);
  decoder(event);
  if (!decoder.Finished()) return absl::DataLossError("the event does not decode");
  return event;
}

absl::StatusOr<JournalStart> DecodeStartV4(absl::string_view bytes) {
  std::int64_t number = -1;
  JournalStart start;
  Decoder decoder(bytes);
  decoder(number, start.code_version, start.mission_options);
  if (!decoder.Finished() || number != kStartNumber) {
    return absl::DataLossError("the mission's options do not decode");
  }
  return start;
}

}  // namespace plumescout
