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
#include "formats/journal/event_members.h"
#include "formats/little_endian.h"

namespace plumescout {
namespace {

constexpr std::int64_t kStartNumber = 0;  // events of a mission count from 1

template <typename T>
concept Number = std::is_arithmetic_v<T> && !std::same_as<T, bool>;

template <typename T>
concept Enum = std::is_enum_v<T>;

// The members that the layout has, in its order: those of the newest one, but for what is younger.
// A struct that changes in event_members.h gets the list that it had here; the golden files tell.
void VisitOld(auto& archive, auto& value) { journal::VisitMembers(archive, value); }
void VisitOld(auto& archive, RobotRegistered& event) {
  auto& [robot, radius_m, lease_token, log_epoch, frame, sensors] =
      event;  // the last three are younger
  archive(robot, radius_m, lease_token);
}
void VisitOld(auto& archive, Event& event) {
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
  void Get(T& value) { VisitOld(*this, value); }

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
