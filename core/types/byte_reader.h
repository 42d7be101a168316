// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "core/types/byte_archive.h"
#include "core/types/grid.h"

namespace plumescout {

// Reads what ByteWriter wrote. After the first damage every further read does nothing. Lists grow
// with what is really there, runs to `most_bytes` together, so damage does not allocate.
class ByteReader {
 public:
  static constexpr bool kReads = true;
  static constexpr bool kHashes = false;

  // `version`: of the state, see Since.
  ByteReader(absl::string_view bytes, std::size_t most_bytes,
             std::uint32_t version = std::numeric_limits<std::uint32_t>::max())
      : rest_(bytes), room_bytes_(most_bytes), version_(version) {}

  template <typename... T>
  void operator()(T&... values) {
    (Get(values), ...);
  }
  // As StateWalker: nothing to read if the state is older.
  template <typename... T>
  void Since(std::uint32_t version, T&... values) {
    if (version_ >= version) (Get(values), ...);
  }
  template <typename T>
  void Runs(std::vector<T>& values) {
    values.clear();
    std::uint64_t size = 0;
    Get(size);
    Require(size <= room_bytes_ / sizeof(T), "a raster is too large");
    if (!ok()) return;
    room_bytes_ -= static_cast<std::size_t>(size) * sizeof(T);
    while (values.size() < size && ok()) {
      std::uint8_t run = 0;
      T value{};
      (*this)(run, value);
      Require(run > 0 && run <= size - values.size(), "a run has another length");
      if (ok()) values.insert(values.end(), run, value);
    }
  }

  // What is read has to fit together.
  void Require(bool holds, absl::string_view what) {
    if (!holds && what_.empty()) what_ = std::string(what);
  }
  bool ok() const { return what_.empty(); }
  // Beyond what may be allocated for rasters.
  std::size_t room_bytes() const { return room_bytes_; }
  // kDataLoss, saying what was found first, unless all was well formed and nothing is left.
  absl::Status Finish() {
    Require(rest_.empty(), "bytes are left over");
    return ok() ? absl::OkStatus() : absl::DataLossError(what_);
  }

 private:
  bool Has(std::size_t count) {
    Require(rest_.size() >= count, "bytes are missing");
    return ok();
  }
  void Get(ArchivedNumber auto& value) {
    if (!ok() || !Has(sizeof(value))) return;
    std::memcpy(&value, rest_.data(), sizeof(value));
    rest_.remove_prefix(sizeof(value));
  }
  // A byte up to `most`; 0 if it is not.
  std::uint8_t GetUpTo(std::size_t most) {
    std::uint8_t byte = 0;
    Get(byte);
    Require(byte <= most, "a byte is out of range");
    return ok() ? byte : std::uint8_t{0};
  }
  void Get(bool& value) { value = GetUpTo(1) != 0; }
  template <ArchivedEnum T>
  void Get(T& value) {
    std::uint8_t byte = 0;
    Get(byte);
    Require(IsOne(static_cast<T>(byte)), "an enumerator is unknown");
    value = ok() ? static_cast<T>(byte) : T{};
  }
  std::uint32_t GetSize() {
    std::uint32_t size = 0;
    Get(size);
    return size;
  }
  void Get(std::string& text) {
    const std::uint32_t size = GetSize();
    if (!Has(size)) return;
    text.assign(rest_.data(), size);
    rest_.remove_prefix(size);
  }
  template <typename T>
  void Get(std::vector<T>& list) {
    list.clear();
    const std::uint32_t size = GetSize();
    for (std::uint32_t i = 0; i < size && ok(); ++i) Get(list.emplace_back());
  }
  template <typename T>
  void Get(std::set<T>& all) {
    all.clear();
    const std::uint32_t size = GetSize();
    for (std::uint32_t i = 0; i < size && ok(); ++i) {
      T element{};
      Get(element);
      Require(all.empty() || *all.rbegin() < element, "elements are out of order");
      if (ok()) all.insert(all.end(), std::move(element));
    }
  }
  template <typename Key, typename T>
  void Get(std::map<Key, T>& all) {
    all.clear();
    const std::uint32_t size = GetSize();
    for (std::uint32_t i = 0; i < size && ok(); ++i) {
      std::pair<Key, T> entry;
      Get(entry);
      Require(all.empty() || all.rbegin()->first < entry.first, "keys are out of order");
      if (ok()) all.emplace_hint(all.end(), std::move(entry.first), std::move(entry.second));
    }
  }
  template <typename A, typename B>
  void Get(std::pair<A, B>& both) {
    (*this)(both.first, both.second);
  }
  template <std::size_t kSize>
  void Get(std::array<double, kSize>& numbers) {
    numbers = {};
    const std::size_t used = GetUpTo(kSize);
    for (std::size_t i = 0; i < used; ++i) Get(numbers[i]);
  }
  template <typename T>
  void Get(std::optional<T>& value) {
    bool present = false;
    Get(present);
    value.reset();
    if (present) Get(value.emplace(T{}));  // T{}: clang 14 takes no emplace() of a nested aggregate
  }
  template <typename T>
  void Get(std::shared_ptr<const T>& value) {
    bool present = false;
    Get(present);
    value = nullptr;
    if (!present) return;
    auto read = std::make_shared<T>();
    Get(*read);
    value = std::move(read);
  }
  template <typename T>
  void Get(Grid<T>& grid) {
    GridGeometry geometry;
    Get(geometry);
    std::vector<T> values;
    Runs(values);
    Require(geometry.width >= 0 && geometry.width <= kMostArchivedSide_cells &&
                geometry.height >= 0 && geometry.height <= kMostArchivedSide_cells &&
                geometry.size() == values.size(),
            "a raster has another size");
    if (!ok()) return;
    grid = Grid<T>(geometry);
    grid.values() = std::move(values);
  }
  template <typename T>
  requires std::is_class_v<T>
  void Get(T& value) {
    if constexpr (requires { T::VisitState(*this, value); }) {
      T::VisitState(*this, value);
    } else {
      Visit(*this, value);
    }
  }

  absl::string_view rest_;
  std::size_t room_bytes_;
  std::uint32_t version_;
  std::string what_;  // is damaged
};

}  // namespace plumescout
