// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/npy.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "absl/strings/string_view.h"
#include "absl/strings/strip.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "formats/little_endian.h"

namespace plumescout::lab {
namespace {

constexpr absl::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kVersionEnd = 8;  // magic, major, minor
constexpr std::size_t kMaxHeaderBytes = 4096;
constexpr std::size_t kMaxDimensions = 8;
constexpr std::size_t kMaxValues = std::size_t{1} << 28;  // 1 GiB of float32
constexpr std::size_t kAlignment = 64;                    // of the data, as NumPy writes it

struct Layout {
  std::vector<std::size_t> shape;
  std::size_t count = 0;       // product of shape
  std::size_t value_size = 0;  // bytes
  std::size_t data_begin = 0;  // offset in the file
};

// The text after "'key':" in the dictionary of the header, or nothing.
std::optional<absl::string_view> FindEntry(absl::string_view header, absl::string_view key) {
  const std::size_t at = header.find(absl::StrCat("'", key, "'"));
  if (at == absl::string_view::npos) return std::nullopt;
  absl::string_view rest = absl::StripLeadingAsciiWhitespace(header.substr(at + key.size() + 2));
  if (!absl::ConsumePrefix(&rest, ":")) return std::nullopt;
  return absl::StripLeadingAsciiWhitespace(rest);
}

absl::StatusOr<std::size_t> ParseValueSize(absl::string_view entry) {
  if (absl::StartsWith(entry, "'<f4'")) return sizeof(float);
  if (absl::StartsWith(entry, "'<f8'")) return sizeof(double);
  return absl::InvalidArgumentError("only little-endian float32 and float64 are read");
}

// "(3, 4), ..." to {3, 4}.
absl::StatusOr<std::vector<std::size_t>> ParseShape(absl::string_view entry) {
  const std::size_t end = entry.find(')');
  if (!absl::ConsumePrefix(&entry, "(") || end == absl::string_view::npos) {
    return absl::DataLossError("the shape does not parse");
  }
  std::vector<std::size_t> shape;
  for (absl::string_view item : absl::StrSplit(entry.substr(0, end - 1), ',')) {
    item = absl::StripAsciiWhitespace(item);
    if (item.empty()) continue;  // after the last comma, or of a scalar
    std::uint64_t length = 0;
    if (!absl::SimpleAtoi(item, &length)) return absl::DataLossError("the shape does not parse");
    shape.push_back(length);
  }
  if (shape.size() > kMaxDimensions) return absl::InvalidArgumentError("more than 8 dimensions");
  return shape;
}

absl::StatusOr<std::size_t> CountValues(std::span<const std::size_t> shape) {
  std::size_t count = 1;
  for (const std::size_t length : shape) {
    if (length > kMaxValues || count * length > kMaxValues) {
      return absl::InvalidArgumentError("more than 2^28 values");
    }
    count *= length;
  }
  return count;
}

// Where the dictionary of the header begins and ends.
absl::StatusOr<absl::string_view> FindHeader(absl::string_view bytes) {
  if (bytes.size() < kVersionEnd || !absl::StartsWith(bytes, kMagic)) {
    return absl::DataLossError("no npy file");
  }
  const int major = bytes[kMagic.size()];
  if (major != 1 && major != 2) return absl::InvalidArgumentError("npy version is not 1 or 2");
  const std::size_t begin =
      kVersionEnd + (major == 1 ? sizeof(std::uint16_t) : sizeof(std::uint32_t));
  if (bytes.size() < begin) return absl::DataLossError("truncated header");
  const char* const length_field = bytes.data() + kVersionEnd;
  const std::size_t length = major == 1 ? LoadLittleEndian<std::uint16_t>(length_field)
                                        : LoadLittleEndian<std::uint32_t>(length_field);
  if (length > kMaxHeaderBytes) return absl::InvalidArgumentError("header of more than 4096 bytes");
  if (bytes.size() - begin < length) return absl::DataLossError("truncated header");
  return bytes.substr(begin, length);
}

absl::StatusOr<Layout> ParseLayout(absl::string_view bytes) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const absl::string_view header, FindHeader(bytes));
  const auto type = FindEntry(header, "descr");
  const auto fortran = FindEntry(header, "fortran_order");
  const auto shape = FindEntry(header, "shape");
  if (!type || !fortran || !shape) return absl::DataLossError("the header lacks an entry");
  if (!absl::StartsWith(*fortran, "False")) return absl::InvalidArgumentError("Fortran order");
  Layout layout;
  PLUMESCOUT_ASSIGN_OR_RETURN(layout.value_size, ParseValueSize(*type));
  PLUMESCOUT_ASSIGN_OR_RETURN(layout.shape, ParseShape(*shape));
  PLUMESCOUT_ASSIGN_OR_RETURN(layout.count, CountValues(layout.shape));
  layout.data_begin = static_cast<std::size_t>(header.data() - bytes.data()) + header.size();
  const std::size_t expected = layout.count * layout.value_size;
  if (bytes.size() - layout.data_begin != expected) {
    return absl::DataLossError(absl::StrCat("the shape needs ", expected,
                                            " bytes of data, there are ",
                                            bytes.size() - layout.data_begin));
  }
  return layout;
}

absl::StatusOr<std::vector<float>> LoadDoubles(const char* data, std::size_t count) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = LoadLittleEndian<double>(data + i * sizeof(double));
    if (std::isfinite(value) && std::abs(value) > std::numeric_limits<float>::max()) {
      return absl::InvalidArgumentError(absl::StrCat("value ", value, " does not fit float32"));
    }
    values[i] = static_cast<float>(value);
  }
  return values;
}

absl::StatusOr<NpyArray> ParseNpy(absl::string_view bytes) {
  PLUMESCOUT_ASSIGN_OR_RETURN(Layout layout, ParseLayout(bytes));
  NpyArray array{std::move(layout.shape), {}};
  const char* const data = bytes.data() + layout.data_begin;
  if (layout.value_size == sizeof(double)) {
    PLUMESCOUT_ASSIGN_OR_RETURN(array.values, LoadDoubles(data, layout.count));
  } else if (layout.count > 0) {
    array.values.resize(layout.count);
    std::memcpy(array.values.data(), data, layout.count * sizeof(float));
  }
  return array;
}

std::string MakeHeader(std::span<const std::size_t> shape) {
  std::string header = absl::StrCat("{'descr': '<f4', 'fortran_order': False, 'shape': (",
                                    absl::StrJoin(shape.begin(), shape.end(), ", "),
                                    shape.size() == 1 ? ",), }" : "), }");
  const std::size_t prefix = kVersionEnd + sizeof(std::uint16_t);
  const std::size_t unpadded = prefix + header.size() + 1;  // and the newline
  header.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  return header + '\n';
}

}  // namespace

absl::StatusOr<NpyArray> ReadNpy(const std::string& path) {
  constexpr std::uint64_t kMaxFileBytes = kMaxValues * sizeof(double) + 2 * kMaxHeaderBytes;
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMaxFileBytes));
  absl::StatusOr<NpyArray> array = ParseNpy(bytes);
  if (array.ok()) return array;
  return absl::Status(array.status().code(), absl::StrCat(path, ": ", array.status().message()));
}

absl::Status WriteNpy(const std::string& path, std::span<const std::size_t> shape,
                      std::span<const float> values) {
  const absl::StatusOr<std::size_t> count = CountValues(shape);
  if (shape.size() > kMaxDimensions || !count.ok() || *count != values.size()) {
    return absl::InvalidArgumentError(
        absl::StrCat(path, ": ", values.size(), " values do not fill the shape (",
                     absl::StrJoin(shape.begin(), shape.end(), ", "), ")"));
  }
  const std::string header = MakeHeader(shape);
  std::string bytes(kMagic);
  bytes += '\x01';
  bytes += '\x00';
  bytes += static_cast<char>(header.size() & 0xFF);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  return WriteFile(path, bytes);
}

}  // namespace plumescout::lab
