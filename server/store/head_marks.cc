// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/head_marks.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <tuple>
#include <utility>

#include "absl/memory/memory.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "core/types/status_macros.h"
#include "formats/crc32c.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

// A slot: checksum of the rest, version, length of the key, epoch, head, chain, writes, the key;
// the numbers little-endian. A slot of zeros is free.
constexpr std::size_t kSlotBytes = 256;
constexpr std::uint64_t kSlotVersion = 1;
constexpr std::size_t kVersionAt = 4;
constexpr std::size_t kKeySizeAt = 6;
constexpr std::size_t kEpochAt = 8;
constexpr std::size_t kHeadAt = 16;
constexpr std::size_t kChainAt = 24;
constexpr std::size_t kWritesAt = 32;
constexpr std::size_t kKeyAt = 40;
static_assert(kKeyAt + kMaxMissionKeyBytes <= kSlotBytes);

void PutNumber(std::string& slot, std::size_t at, std::size_t size, std::uint64_t value) {
  for (std::size_t i = 0; i < size; ++i) {
    slot[at + i] = static_cast<char>((value >> (8 * i)) & 0xFFU);
  }
}

std::uint64_t NumberAt(absl::string_view slot, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = size; i > 0; --i) {
    value = (value << 8U) | static_cast<std::uint8_t>(slot[at + i - 1]);
  }
  return value;
}

std::string EncodeSlot(const HeadMark& mark) {
  std::string slot(kSlotBytes, '\0');
  PutNumber(slot, kVersionAt, 2, kSlotVersion);
  PutNumber(slot, kKeySizeAt, 2, mark.key.size());
  PutNumber(slot, kEpochAt, 8, static_cast<std::uint64_t>(mark.epoch));
  PutNumber(slot, kHeadAt, 8, static_cast<std::uint64_t>(mark.head));
  PutNumber(slot, kChainAt, 4, mark.chain);
  PutNumber(slot, kWritesAt, 8, static_cast<std::uint64_t>(mark.writes));
  std::copy(mark.key.begin(), mark.key.end(), slot.begin() + kKeyAt);
  PutNumber(slot, 0, 4, Crc32c(absl::string_view(slot).substr(kVersionAt)));
  return slot;
}

// Nothing if the slot is damaged.
std::optional<HeadMark> DecodeSlot(absl::string_view slot) {
  if (slot.size() != kSlotBytes) return std::nullopt;
  if (NumberAt(slot, 0, 4) != Crc32c(slot.substr(kVersionAt))) return std::nullopt;
  const auto key_bytes = static_cast<std::size_t>(NumberAt(slot, kKeySizeAt, 2));
  if (NumberAt(slot, kVersionAt, 2) != kSlotVersion || key_bytes > kMaxMissionKeyBytes) {
    return std::nullopt;
  }
  HeadMark mark;
  mark.key = std::string(slot.substr(kKeyAt, key_bytes));
  mark.epoch = static_cast<std::int64_t>(NumberAt(slot, kEpochAt, 8));
  mark.head = static_cast<std::int64_t>(NumberAt(slot, kHeadAt, 8));
  mark.chain = static_cast<std::uint32_t>(NumberAt(slot, kChainAt, 4));
  mark.writes = static_cast<std::int64_t>(NumberAt(slot, kWritesAt, 8));
  return mark;
}

bool IsFree(absl::string_view slot) {
  return slot.find_first_not_of('\0') == absl::string_view::npos;
}

absl::Status MarksError(absl::string_view what, const std::string& path) {
  return StoreUnavailable(absl::StrCat("cannot ", what, " ", path, ": ", strerror(errno)));
}

absl::StatusOr<std::string> ReadAll(int descriptor, const std::string& path) {
  std::string bytes;
  std::array<char, 256 * kSlotBytes> piece{};
  while (true) {
    const ssize_t size =
        pread(descriptor, piece.data(), piece.size(), static_cast<off_t>(bytes.size()));
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) return MarksError("read", path);
    if (size == 0) return bytes;
    bytes.append(piece.data(), static_cast<std::size_t>(size));
  }
}

HeadMarkList Decode(absl::string_view bytes) {
  HeadMarkList list;
  for (; !bytes.empty(); ++list.slots) {
    const absl::string_view slot = bytes.substr(0, kSlotBytes);
    bytes.remove_prefix(slot.size());
    std::optional<HeadMark> mark = DecodeSlot(slot);
    if (IsFree(slot)) {
      list.free_slots.push_back(list.slots);
    } else if (mark.has_value()) {
      list.marks.push_back({list.slots, *std::move(mark)});
    } else {
      list.damaged_slots.push_back(list.slots);
    }
  }
  return list;
}

}  // namespace

absl::StatusOr<HeadMarkList> ReadHeadMarks(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0 && errno == ENOENT) return HeadMarkList{};
  if (descriptor < 0) return MarksError("open", path);
  absl::StatusOr<std::string> bytes = ReadAll(descriptor, path);
  close(descriptor);
  PLUMESCOUT_RETURN_IF_ERROR(bytes.status());
  return Decode(*bytes);
}

absl::StatusOr<std::unique_ptr<HeadMarks>> HeadMarks::Open(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const HeadMarkList list, ReadHeadMarks(path));
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) return MarksError("open", path);
  return absl::WrapUnique(new HeadMarks(path, descriptor, list));
}

absl::StatusOr<std::unique_ptr<const HeadMarks>> HeadMarks::OpenToRead(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const HeadMarkList list, ReadHeadMarks(path));
  return absl::WrapUnique<const HeadMarks>(new HeadMarks(path, -1, list));
}

HeadMarks::HeadMarks(std::string path, int descriptor, const HeadMarkList& list)
    : path_(std::move(path)),
      descriptor_(descriptor),
      damaged_slots_(list.damaged_slots.size()),
      free_(list.free_slots),
      end_(list.slots) {
  free_.insert(free_.end(), list.damaged_slots.begin(), list.damaged_slots.end());
  for (const HeadMarkList::Placed& found : list.marks) {
    HeadMarkList::Placed& placed = placed_[found.mark.key];
    const bool is_newer = std::tie(found.mark.epoch, found.mark.writes, found.mark.head) >=
                          std::tie(placed.mark.epoch, placed.mark.writes, placed.mark.head);
    if (is_newer) placed = found;
  }
}

HeadMarks::~HeadMarks() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::optional<HeadMark> HeadMarks::Find(const std::string& key) const {
  absl::MutexLock lock(&mutex_);
  const auto found = placed_.find(key);
  if (found == placed_.end()) return std::nullopt;
  return found->second.mark;
}

std::vector<HeadMark> HeadMarks::All() const {
  absl::MutexLock lock(&mutex_);
  std::vector<HeadMark> marks;
  for (const auto& [key, placed] : placed_) marks.push_back(placed.mark);
  return marks;
}

absl::Status HeadMarks::Set(const HeadMark& mark) {
  absl::MutexLock lock(&mutex_);
  const auto found = placed_.find(mark.key);
  if (found != placed_.end()) {
    found->second.mark = mark;
    return Write(found->second.slot, EncodeSlot(mark));
  }
  std::size_t number = end_;
  if (free_.empty()) {
    ++end_;
  } else {
    number = free_.back();
    free_.pop_back();
  }
  placed_[mark.key] = {number, mark};
  return Write(number, EncodeSlot(mark));
}

absl::Status HeadMarks::Clear(const std::string& key) {
  absl::MutexLock lock(&mutex_);
  const auto found = placed_.find(key);
  if (found == placed_.end()) return absl::OkStatus();
  PLUMESCOUT_RETURN_IF_ERROR(Write(found->second.slot, std::string(kSlotBytes, '\0')));
  if (fdatasync(descriptor_) != 0) return MarksError("sync", path_);
  free_.push_back(found->second.slot);
  placed_.erase(found);
  return absl::OkStatus();
}

absl::Status HeadMarks::Write(std::size_t slot, const std::string& bytes) {
  const auto at = static_cast<off_t>(slot * kSlotBytes);
  const ssize_t written = pwrite(descriptor_, bytes.data(), bytes.size(), at);
  if (written == static_cast<ssize_t>(bytes.size())) return absl::OkStatus();
  if (written >= 0) errno = ENOSPC;
  return MarksError("write", path_);
}

}  // namespace plumescout::server
