// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/journal/event_codec.h"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/journal/enumerators.h"
#include "formats/journal/event_members.h"
#include "formats/journal/range_codec.h"
#include "formats/journal/varint.h"
#include "formats/little_endian.h"

namespace plumescout {
namespace {

constexpr std::int64_t kStartNumber = 0;  // events of a mission count from 1

// What a record begins with: its version, its kind.
constexpr std::size_t kHeadBytes = 2;
constexpr std::uint8_t kVersion = 1;  // of every kind, so far, but for ...
// ... starts that say where the journal ends, robots that tell of their frame or their sensors,
// plans that were assigned, readings of other sensors than the first, and observations of kinds
// that came later.
constexpr std::uint8_t kSecondVersion = 2;
constexpr std::uint8_t kStartKind = 0;
constexpr std::uint8_t kFirstEventKind = 1;  // then in the order of EventBody
constexpr std::size_t kRegisteredKind = 1;
constexpr std::size_t kObservationKind = 2;
constexpr std::size_t kPlanKind = 4;
constexpr std::size_t kFirstNewPayload = 3;
constexpr const char* kKindNames[] = {
    "JournalStart", "RobotRegistered",  "ObservationReceived", "PosteriorRefreshed",
    "PlanIssued",   "ProgressReported", "EpochBegun",          "EpochAdopted",
    "RobotRemoved", "ClockOffsetNoted", "HomeOrdered",         "MapRebuildBegun",
    "MapRebuilt",   "KeepOutChanged"};
static_assert(std::size(kKindNames) == kFirstEventKind + std::variant_size_v<EventBody>);

template <typename T>
concept Integer = std::integral<T> && !std::same_as<T, bool>;

template <typename T>
concept Enum = std::is_enum_v<T>;

// Whole numbers as varints, zigzagged if they have a sign; floating-point numbers as they are;
// texts and lists behind their length; a byte for whether there is a value, and which of several.
class Encoder {
 public:
  explicit Encoder(std::string& bytes) : bytes_(bytes) {}

  template <typename... T>
  void operator()(const T&... values) {
    (Put(values), ...);
  }

 private:
  template <Integer T>
  void Put(T value) {
    if constexpr (std::signed_integral<T>) {
      AppendVarint(ZigZag(value), bytes_);
    } else {
      AppendVarint(value, bytes_);
    }
  }
  void PutByte(std::size_t value) { bytes_.push_back(static_cast<char>(value)); }
  void Put(bool value) { PutByte(value ? 1 : 0); }
  void Put(Enum auto value) { PutByte(static_cast<std::size_t>(value)); }
  void Put(std::floating_point auto value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes_.append(raw, sizeof(value));
  }
  void Put(const std::string& text) {
    Put(text.size());
    bytes_.append(text);
  }
  void Put(const std::vector<float>& ranges_m) { AppendRanges(ranges_m, bytes_); }
  template <typename T>
  void Put(const std::vector<T>& list) {
    Put(list.size());
    for (const T& element : list) Put(element);
  }
  template <typename T>
  void Put(const std::optional<T>& value) {
    Put(value.has_value());
    if (value) Put(*value);
  }
  template <typename... T>
  void Put(const std::variant<T...>& choice) {
    PutByte(choice.index());
    std::visit([this](const auto& value) { this->Put(value); }, choice);
  }
  template <typename T>
  requires std::is_class_v<T>
  void Put(const T& value) { journal::VisitMembers(*this, value); }

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

  template <typename... T>
  void GetAlternative(std::variant<T...>& choice, std::size_t index) {
    GetAlternative(choice, index, std::index_sequence_for<T...>());
  }

 private:
  // Whether `count` more bytes are there; if not, the rest is damaged.
  bool Has(std::uint64_t count) {
    ok_ = ok_ && rest_.size() >= count;
    return ok_;
  }
  std::uint64_t GetVarint() {
    std::uint64_t value = 0;
    ok_ = ok_ && TakeVarint(rest_, value);
    return ok_ ? value : 0;
  }
  template <Integer T>
  void Get(T& value) {
    const std::uint64_t bits = GetVarint();
    if constexpr (std::signed_integral<T>) {
      Narrow(UnZigZag(bits), value);
    } else {
      Narrow(bits, value);
    }
  }
  template <typename From, typename T>
  void Narrow(From from, T& value) {
    ok_ = ok_ && std::in_range<T>(from);
    if (ok_) value = static_cast<T>(from);
  }
  std::uint8_t GetByte() {
    if (!Has(1)) return 0;
    const auto byte = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }
  // A byte below `count`; 0 if it is not.
  std::uint8_t GetBelow(std::size_t count) {
    const std::uint8_t byte = GetByte();
    ok_ = ok_ && byte < count;
    return ok_ ? byte : std::uint8_t{0};
  }
  void Get(bool& value) { value = GetBelow(2) != 0; }
  template <Enum T>
  void Get(T& value) {
    const std::uint8_t byte = GetByte();
    ok_ = ok_ && IsOne(static_cast<T>(byte));
    value = ok_ ? static_cast<T>(byte) : T{};
  }
  template <std::floating_point T>
  void Get(T& value) {
    if (!Has(sizeof(T))) return;
    value = LoadLittleEndian<T>(rest_.data());
    rest_.remove_prefix(sizeof(T));
  }
  void Get(std::string& text) {
    const std::uint64_t size = GetVarint();
    if (!Has(size)) return;
    text.assign(rest_.data(), static_cast<std::size_t>(size));
    rest_.remove_prefix(static_cast<std::size_t>(size));
  }
  void Get(std::vector<float>& ranges_m) { ok_ = ok_ && TakeRanges(rest_, ranges_m); }
  // Grows with what is really there: a damaged length does not allocate.
  template <typename T>
  void Get(std::vector<T>& list) {
    const std::uint64_t size = GetVarint();
    list.clear();
    for (std::uint64_t i = 0; i < size && ok_; ++i) Get(list.emplace_back());
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
    GetAlternative(choice, GetBelow(sizeof...(T)));
  }
  template <typename Variant, std::size_t... kIndex>
  void GetAlternative(Variant& choice, std::size_t index, std::index_sequence<kIndex...>) {
    ((index == kIndex ? Get(choice.template emplace<kIndex>()) : void()), ...);
  }
  template <typename T>
  requires std::is_class_v<T>
  void Get(T& value) { journal::VisitMembers(*this, value); }

  absl::string_view rest_;
  bool ok_ = true;
};

std::string Head(std::size_t kind, std::uint8_t version = kVersion) {
  return {static_cast<char>(version), static_cast<char>(kind)};
}

bool SaysEnd(const JournalStart& start) { return start.last_number != 0 || start.last_digest != 0; }

std::uint8_t VersionOf(const EventBody& body) {
  if (const auto* registered = std::get_if<RobotRegistered>(&body)) {
    const bool is_plain = registered->frame == RobotFrame() && registered->sensors.empty();
    return is_plain ? kVersion : kSecondVersion;
  }
  if (const auto* received = std::get_if<ObservationReceived>(&body)) {
    const auto& payload = received->observation.payload;
    const auto* reading = std::get_if<GasReading>(&payload);
    const bool is_new =
        payload.index() >= kFirstNewPayload || (reading != nullptr && reading->sensor != 0);
    return is_new ? kSecondVersion : kVersion;
  }
  if (const auto* issued = std::get_if<PlanIssued>(&body)) {
    return issued->assigned ? kSecondVersion : kVersion;
  }
  return kVersion;
}

// What only records of the second version hold, behind what all hold.
void VisitSecond(auto& archive, auto& body) {
  if (auto* registered = std::get_if<RobotRegistered>(&body)) {
    archive(registered->frame, registered->sensors);
  } else if (auto* received = std::get_if<ObservationReceived>(&body)) {
    auto* reading = std::get_if<GasReading>(&received->observation.payload);
    if (reading != nullptr) archive(reading->sensor);
  } else if (auto* issued = std::get_if<PlanIssued>(&body)) {
    archive(issued->assigned);
  }
}

bool HasSecondVersion(std::size_t kind) {
  return kind == kStartKind || kind == kRegisteredKind || kind == kObservationKind ||
         kind == kPlanKind;
}

// What a record begins with, taken from the front of `bytes`.
struct RecordHead {
  std::size_t kind = 0;
  bool second = false;  // of the second version
};
absl::StatusOr<RecordHead> TakeHead(absl::string_view& bytes) {
  if (bytes.size() < kHeadBytes) return absl::DataLossError("the record has no version and kind");
  const auto version = static_cast<std::uint8_t>(bytes[0]);
  const std::size_t kind = static_cast<std::uint8_t>(bytes[1]);
  bytes.remove_prefix(kHeadBytes);
  if (kind >= std::size(kKindNames)) {
    return absl::DataLossError(
        absl::StrCat("a record of version ", version, " and the unknown kind ", kind));
  }
  const std::uint8_t newest = HasSecondVersion(kind) ? kSecondVersion : kVersion;
  if (version >= kVersion && version <= newest) return RecordHead{kind, version == kSecondVersion};
  return absl::DataLossError(absl::StrCat("a record ", kKindNames[kind], " of version ", version,
                                          ", this program reads version ", newest));
}

absl::Status DoesNotDecode(std::size_t kind) {
  return absl::DataLossError(absl::StrCat("the record ", kKindNames[kind], " does not decode"));
}

Plan ForReplay(Plan plan) {
  std::vector<Candidate> kept;
  if (plan.chosen >= 0 && static_cast<std::size_t>(plan.chosen) < plan.candidates.size()) {
    kept.push_back(std::move(plan.candidates[static_cast<std::size_t>(plan.chosen)]));
    plan.chosen = 0;
  }
  plan.candidates = std::move(kept);
  const auto wanted = std::find_if(
      plan.rejected.begin(), plan.rejected.end(),
      [](const RejectedGoal& goal) { return goal.reason == RejectionReason::kTraffic; });
  plan.rejected = wanted == plan.rejected.end() ? std::vector<RejectedGoal>()
                                                : std::vector<RejectedGoal>{std::move(*wanted)};
  return plan;
}

}  // namespace

std::string EncodeEvent(const Event& event, PlanDetail detail) {
  if (const auto* issued = std::get_if<PlanIssued>(&event.body);
      issued != nullptr && detail == PlanDetail::kForReplay) {
    return EncodeEvent({event.number, PlanIssued{ForReplay(issued->plan), issued->assigned}},
                       PlanDetail::kWhole);
  }
  const std::uint8_t version = VersionOf(event.body);
  std::string bytes = Head(kFirstEventKind + event.body.index(), version);
  Encoder encoder(bytes);
  encoder(event.number);
  std::visit([&encoder](const auto& body) { encoder(body); }, event.body);
  if (version == kSecondVersion) VisitSecond(encoder, event.body);
  return bytes;
}

absl::StatusOr<Event> DecodeEvent(absl::string_view bytes) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RecordHead head, TakeHead(bytes));
  if (head.kind < kFirstEventKind) return absl::DataLossError("a start where an event belongs");
  Event event;
  Decoder decoder(bytes);
  decoder(event.number);
  decoder.GetAlternative(event.body, head.kind - kFirstEventKind);
  if (head.second) VisitSecond(decoder, event.body);
  if (!decoder.Finished()) return DoesNotDecode(head.kind);
  return event;
}

std::string EncodeStart(const JournalStart& start) {
  std::string bytes = Head(kStartKind, SaysEnd(start) ? kSecondVersion : kVersion);
  Encoder encoder(bytes);
  encoder(kStartNumber, start);
  if (SaysEnd(start)) encoder(start.last_number, start.last_digest);
  return bytes;
}

absl::StatusOr<JournalStart> DecodeStart(absl::string_view bytes) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RecordHead head, TakeHead(bytes));
  if (head.kind != kStartKind) return absl::DataLossError("an event where the start belongs");
  std::int64_t number = -1;
  JournalStart start;
  Decoder decoder(bytes);
  decoder(number, start);
  if (head.second) decoder(start.last_number, start.last_digest);
  if (!decoder.Finished() || number != kStartNumber) return DoesNotDecode(head.kind);
  return start;
}

}  // namespace plumescout
