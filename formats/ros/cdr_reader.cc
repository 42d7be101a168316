// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/ros/cdr_reader.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace plumescout::ros {
namespace {

constexpr std::size_t kEncapsulation_bytes = 4;
constexpr std::size_t kMostPadding_bytes = 7;  // to the next multiple of what some writers align to

}  // namespace

CdrReader::CdrReader(absl::string_view bytes) {
  if (bytes.size() < kEncapsulation_bytes) {
    Fail("no encapsulation");
    return;
  }
  const int encoding =
      static_cast<unsigned char>(bytes[0]) << 8 | static_cast<unsigned char>(bytes[1]);
  if (encoding > 1) Fail(absl::StrCat("encoding ", encoding, " is not plain CDR (0 or 1)"));
  swapped_ = encoding == 0;
  bytes_ = bytes.substr(kEncapsulation_bytes);
}

absl::Status CdrReader::Finish() {
  if (status_.ok() && left() > kMostPadding_bytes) {
    Fail(absl::StrCat(left(), " bytes beyond the message: another version of the type?"));
  }
  return status_;
}

void CdrReader::ReadNumber(void* number, std::size_t size) {
  if (!status_.ok()) return;
  const std::size_t begin = (at_ + size - 1) / size * size;
  if (begin > bytes_.size() || bytes_.size() - begin < size) {
    return Fail(absl::StrCat("it ends at byte ", bytes_.size(), ", within a field"));
  }
  auto* const to = static_cast<unsigned char*>(number);
  std::memcpy(to, bytes_.data() + begin, size);
  if (swapped_) std::reverse(to, to + size);
  at_ = begin + size;
}

void CdrReader::Read(std::string& text) {
  std::uint32_t size = 0;
  Read(size);
  if (!status_.ok()) return;
  if (size > left()) return Fail("a text is longer than the message");
  if (size > 0 && bytes_[at_ + size - 1] != '\0') return Fail("a text has no end");
  text.assign(bytes_.data() + at_, size > 0 ? size - 1 : 0);
  at_ += size;
}

void CdrReader::Fail(absl::string_view why) {
  if (status_.ok()) status_ = absl::InvalidArgumentError(why);
}

}  // namespace plumescout::ros
