// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/event_codec.h"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "lab/formats/little_endian.h"

namespace plumescout::lab {
namespace {

constexpr std::int64_t kStartNumber = 0;  // events of a mission count from 1

template <typename T>
concept Number = std::is_arithmetic_v<T> && !std::same_as<T, bool>;

template <typename T>
concept Enum = std::is_enum_v<T>;

// Whether a stored value is one of the enumerators; another is damage. Each switch names all of
// them, so that one more does not compile until it is added here.
constexpr bool IsOne(MissionPhase phase) {
  switch (phase) {
    case MissionPhase::kExploring:
    case MissionPhase::kGasProbing:
    case MissionPhase::kFallback:
    case MissionPhase::kComplete:
    case MissionPhase::kReturning:
    case MissionPhase::kSurvey:
    case MissionPhase::kSampling:
      return true;
  }
  return false;
}
constexpr bool IsOne(GoalKind kind) {
  switch (kind) {
    case GoalKind::kOccupancyFrontier:
    case GoalKind::kGasFrontier:
    case GoalKind::kRandomFreeSpace:
    case GoalKind::kHome:
    case GoalKind::kInformation:
    case GoalKind::kSite:
      return true;
  }
  return false;
}
constexpr bool IsOne(PathSource source) {
  switch (source) {
    case PathSource::kTree:
    case PathSource::kGridGuard:
    case PathSource::kGridSearch:
      return true;
  }
  return false;
}
constexpr bool IsOne(RejectionReason reason) {
  switch (reason) {
    case RejectionReason::kUnreachable:
    case RejectionReason::kTooSmall:
    case RejectionReason::kSetAside:
    case RejectionReason::kClaimed:
    case RejectionReason::kNotDrawn:
    case RejectionReason::kTooClose:
    case RejectionReason::kSearchStopped:
    case RejectionReason::kOverBudget:
    case RejectionReason::kKeptOut:
    case RejectionReason::kGone:
      return true;
  }
  return false;
}
constexpr bool IsOne(PlanEnd end) {
  switch (end) {
    case PlanEnd::kAllGoalsReached:
    case PlanEnd::kQueueExhausted:
    case PlanEnd::kStopped:
    case PlanEnd::kNoGoals:
    case PlanEnd::kMissionComplete:
    case PlanEnd::kStartOccupied:
    case PlanEnd::kAllGoalsRejected:
      return true;
  }
  return false;
}
constexpr bool IsOne(ProgressOutcome outcome) {
  switch (outcome) {
    case ProgressOutcome::kReached:
    case ProgressOutcome::kBlocked:
    case ProgressOutcome::kAborted:
      return true;
  }
  return false;
}

// A struct is visited by naming all its members in a structured binding, so that a member added
// to the struct does not compile until it is added here. The same list serves both directions.
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
  auto& [robot, radius_m, lease_token] = event;
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

class Encoder {
 public:
  explicit Encoder(std::string& bytes) : bytes_(bytes) {}

  template <typename... T>
  void operator()(const T&... values) {
    (Put(values), ...);
  }

 private:
  void Put(Number auto value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes_.append(raw, sizeof(value));
  }
  void Put(bool value) { Put(static_cast<std::uint8_t>(value)); }
  void Put(Enum auto value) { Put(static_cast<std::uint8_t>(value)); }
  void Put(const std::string& text) {
    Put(static_cast<std::uint32_t>(text.size()));
    bytes_.append(text);
  }
  template <typename T>
  void Put(const std::vector<T>& list) {
    Put(static_cast<std::uint32_t>(list.size()));
    for (const T& element : list) Put(element);
  }
  template <typename T>
  void Put(const std::optional<T>& value) {
    Put(value.has_value());
    if (value) Put(*value);
  }
  template <typename... T>
  void Put(const std::variant<T...>& choice) {
    Put(static_cast<std::uint8_t>(choice.index()));
    std::visit([this](const auto& value) { this->Put(value); }, choice);
  }
  template <typename T>
  requires std::is_class_v<T>
  void Put(const T& value) { Visit(*this, value); }

  std::string& bytes_;
};

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
    ok_ = ok_ && IsOne(static_cast<T>(byte));
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

std::string EncodeEvent(const Event& event) {
  std::string bytes;
  Encoder encoder(bytes);
  encoder(event);
  return bytes;
}

absl::StatusOr<Event> DecodeEvent(absl::string_view bytes) {
  Event event;
  Decoder decoder(bytes);
  decoder(event);
  if (!decoder.Finished()) return absl::DataLossError("the event does not decode");
  return event;
}

std::string EncodeStart(const RecordingStart& start) {
  std::string bytes;
  Encoder encoder(bytes);
  encoder(kStartNumber, start.code_version, start.mission_options);
  return bytes;
}

absl::StatusOr<RecordingStart> DecodeStart(absl::string_view bytes) {
  std::int64_t number = -1;
  RecordingStart start;
  Decoder decoder(bytes);
  decoder(number, start.code_version, start.mission_options);
  if (!decoder.Finished() || number != kStartNumber) {
    return absl::DataLossError("the mission's options do not decode");
  }
  return start;
}

}  // namespace plumescout::lab
