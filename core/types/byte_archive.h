// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "absl/strings/string_view.h"
#include "core/types/grid.h"

namespace plumescout {

// State as bytes, and as a hash. A struct is visited by naming all its members in a structured
// binding, so that a member added to it does not compile until it is added to the list, which
// serves writing, reading and hashing alike:
//
//   void Visit(auto& archive, ConstOr<Point2> auto& point) {
//     auto& [x_m, y_m] = point;
//     archive(x_m, y_m);
//   }
//
// A class with private members declares `static void VisitState(Archive&, Self&)` instead. An
// enumeration says by IsOne(value) which values are its enumerators; others are damage.

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

template <typename T, typename Struct>
concept ConstOr = std::same_as<std::remove_const_t<T>, Struct>;

template <typename T>
concept ArchivedNumber = std::is_arithmetic_v<T> && !std::same_as<T, bool>;
template <typename T>
concept ArchivedEnum = std::is_enum_v<T>;

// Sizes of rasters that are read stay below this, so that sums of corners and sizes do not
// overflow.
inline constexpr int kMostArchivedSide_cells = 1 << 29;
constexpr bool IsNearOrigin(std::int64_t coordinate_cells) {
  return coordinate_cells >= -kMostArchivedSide_cells &&
         coordinate_cells <= kMostArchivedSide_cells;
}
inline constexpr std::size_t kLongestRun = 255;

// Whether they are the same to the bit.
template <typename T>
bool ContinuesRun(const T& a, const T& b) {
  static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

// Whoever differs in one word has another hash, for each step is a bijection.
class Hash64 {
 public:
  void Add(std::uint64_t word) {
    hash_ = (hash_ ^ word) * 0x9E3779B97F4A7C15ULL;
    hash_ ^= hash_ >> 32U;
  }
  void Add(absl::string_view bytes) {
    Add(static_cast<std::uint64_t>(bytes.size()));
    while (!bytes.empty()) {
      std::uint64_t word = 0;
      const std::size_t size = bytes.size() < sizeof(word) ? bytes.size() : sizeof(word);
      std::memcpy(&word, bytes.data(), size);
      Add(word);
      bytes.remove_prefix(size);
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0x243F6A8885A308D3ULL;  // any but 0
};

// What ByteWriter and StateHasher have in common: takes what is visited apart into numbers.
template <typename Sink>
class StateWalker {
 public:
  static constexpr bool kReads = false;
  static constexpr bool kHashes = Sink::kHashes;

  template <typename... T>
  void operator()(const T&... values) {
    (Put(values), ...);
  }
  // For members that version `version` of the state brought. A reader of an older one leaves them
  // as they are; a hash passes over those that have no value, so that it is what it was before.
  template <typename... T>
  void Since(std::uint32_t version, const T&... values) {
    std::uint32_t place = 0;
    (PutSince(version, ++place, values), ...);
  }
  // For lists in which the same value often comes several times in a row.
  template <typename T>
  void Runs(const std::vector<T>& values) {
    Put(static_cast<std::uint64_t>(values.size()));
    for (std::size_t i = 0; i < values.size();) {
      std::size_t end = i + 1;
      while (end < values.size() && end - i < kLongestRun && ContinuesRun(values[end], values[i])) {
        ++end;
      }
      Put(static_cast<std::uint8_t>(end - i));
      Put(values[i]);
      i = end;
    }
  }
  Sink& sink() { return sink_; }

 private:
  template <typename T>
  static bool SaysNothing(const T& value) {
    if constexpr (requires { value.empty(); }) {
      return value.empty();
    } else {
      return value == T{};
    }
  }
  template <typename T>
  void PutSince(std::uint32_t version, std::uint32_t place, const T& value) {
    if constexpr (kHashes) {
      if (SaysNothing(value)) return;
      Put(version);
      Put(place);
    }
    Put(value);
  }
  void Put(ArchivedNumber auto value) { sink_.Add(value); }
  void Put(bool value) { Put(static_cast<std::uint8_t>(value)); }
  void Put(ArchivedEnum auto value) { Put(static_cast<std::uint8_t>(value)); }
  void PutSize(std::size_t size) { Put(static_cast<std::uint32_t>(size)); }
  void Put(const std::string& text) {
    PutSize(text.size());
    sink_.Add(text);
  }
  template <typename T>
  void Put(const std::vector<T>& list) {
    PutSize(list.size());
    for (const T& element : list) Put(element);
  }
  template <typename T>
  void Put(const std::set<T>& all) {
    PutSize(all.size());
    for (const T& element : all) Put(element);
  }
  template <typename Key, typename T>
  void Put(const std::map<Key, T>& all) {
    PutSize(all.size());
    for (const auto& [key, value] : all) (*this)(key, value);
  }
  template <typename A, typename B>
  void Put(const std::pair<A, B>& both) {
    (*this)(both.first, both.second);
  }
  // Without the zeros at its end.
  template <std::size_t kSize>
  void Put(const std::array<double, kSize>& numbers) {
    std::size_t used = kSize;
    while (used > 0 && ContinuesRun(numbers[used - 1], 0.0)) --used;
    Put(static_cast<std::uint8_t>(used));
    for (std::size_t i = 0; i < used; ++i) Put(numbers[i]);
  }
  template <typename T>
  void Put(const std::optional<T>& value) {
    Put(value.has_value());
    if (value) Put(*value);
  }
  template <typename T>
  void Put(const std::shared_ptr<const T>& value) {
    Put(value != nullptr);
    if (value != nullptr) Put(*value);
  }
  template <typename T>
  void Put(const Grid<T>& grid) {
    Put(grid.geometry());
    Runs(grid.values());
  }
  template <typename T>
  requires std::is_class_v<T>
  void Put(const T& value) {
    if constexpr (requires { T::VisitState(*this, value); }) {
      T::VisitState(*this, value);
    } else {
      Visit(*this, value);
    }
  }

  Sink sink_;
};

struct ByteSink {
  static constexpr bool kHashes = false;
  void Add(ArchivedNumber auto value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes.append(raw, sizeof(value));
  }
  void Add(const std::string& text) { bytes.append(text); }

  std::string bytes;
};
using ByteWriter = StateWalker<ByteSink>;

struct HashSink {
  static constexpr bool kHashes = true;
  void Add(ArchivedNumber auto value) {
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof(value));
    hash.Add(word);
  }
  void Add(const std::string& text) { hash.Add(text); }

  Hash64 hash;
};
using StateHasher = StateWalker<HashSink>;

}  // namespace plumescout
