// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/npy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "formats/file_io.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace npy_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Shape = std::vector<std::size_t>;

// A file of version 1.0 as the NumPy format document describes it, made without the code under
// test. `data` are the raw bytes of the values.
std::string MakeNpy(const std::string& type, const std::string& order, const std::string& shape,
                    const std::string& data) {
  const std::string header = absl::StrCat("{'descr': '", type, "', 'fortran_order': ", order,
                                          ", 'shape': ", shape, ", }\n");
  const std::string length = {static_cast<char>(header.size()), '\0'};
  return absl::StrCat("\x93NUMPY", std::string("\x01\x00", 2), length, header, data);
}

template <typename T>
std::string Raw(const std::vector<T>& values) {
  return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

absl::StatusOr<NpyArray> ReadBytes(const std::string& bytes) {
  const TempFolder folder;
  EXPECT_TRUE(WriteFile(folder.File("array.npy"), bytes).ok());
  return ReadNpy(folder.File("array.npy"));
}

TEST(Npy, ReadsFloat32) {
  const auto array =
      ReadBytes(MakeNpy("<f4", "False", "(2, 3)", Raw<float>({1, 2, 3, 4, 5, 6.5F})));
  ASSERT_TRUE(array.ok()) << array.status();
  EXPECT_THAT(array->shape, ElementsAre(2, 3));
  EXPECT_THAT(array->values, ElementsAre(1, 2, 3, 4, 5, 6.5F));
}

TEST(Npy, ReadsFloat64AsTheNearestFloat32) {
  const auto array = ReadBytes(MakeNpy("<f8", "False", "(2,)", Raw<double>({0.1, -1e300 / 1e290})));
  ASSERT_TRUE(array.ok()) << array.status();
  EXPECT_THAT(array->values, ElementsAre(0.1F, -1e10F));
}

TEST(Npy, ReadsAScalar) {
  const auto array = ReadBytes(MakeNpy("<f4", "False", "()", Raw<float>({7})));
  ASSERT_TRUE(array.ok()) << array.status();
  EXPECT_THAT(array->shape, IsEmpty());
  EXPECT_THAT(array->values, ElementsAre(7));
}

TEST(Npy, ReadsAnArrayWithoutValues) {
  const auto array = ReadBytes(MakeNpy("<f4", "False", "(0, 5)", ""));
  ASSERT_TRUE(array.ok()) << array.status();
  EXPECT_THAT(array->shape, ElementsAre(0, 5));
  EXPECT_THAT(array->values, IsEmpty());
}

TEST(Npy, ReadsVersion2) {
  std::string bytes = MakeNpy("<f4", "False", "(1,)", Raw<float>({3}));
  bytes[6] = 2;
  bytes.insert(10, 2, '\0');  // the length takes four bytes
  const auto array = ReadBytes(bytes);
  ASSERT_TRUE(array.ok()) << array.status();
  EXPECT_THAT(array->values, ElementsAre(3));
}

TEST(Npy, WhatIsWrittenComesBackBitForBit) {
  const TempFolder folder;
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<float> values = {0.0F, -0.0F, inf, 1e-45F, std::nanf("0x1234"), -1.5F};
  ASSERT_TRUE(WriteNpy(folder.File("a.npy"), Shape{3, 1, 2}, values).ok());
  const auto array = ReadNpy(folder.File("a.npy"));
  ASSERT_TRUE(array.ok()) << array.status();
  EXPECT_THAT(array->shape, ElementsAre(3, 1, 2));
  EXPECT_EQ(Raw(array->values), Raw(values));
}

TEST(Npy, DataAreAlignedAsNumpyWritesThem) {
  const TempFolder folder;
  for (const Shape& shape : {Shape{1}, Shape{1, 1, 1, 1}, Shape{}}) {
    ASSERT_TRUE(WriteNpy(folder.File("a.npy"), shape, std::vector<float>{1.0F}).ok());
    const std::string bytes = *ReadFile(folder.File("a.npy"), 4096);
    EXPECT_EQ((bytes.size() - sizeof(float)) % 64, 0U);
    EXPECT_EQ(bytes[bytes.size() - sizeof(float) - 1], '\n');
  }
}

TEST(Npy, AOneDimensionalShapeIsWrittenAsATuple) {
  const TempFolder folder;
  ASSERT_TRUE(WriteNpy(folder.File("a.npy"), Shape{2}, std::vector<float>{1, 2}).ok());
  EXPECT_THAT(*ReadFile(folder.File("a.npy"), 4096), HasSubstr("'shape': (2,)"));
}

TEST(Npy, AMissingFileIsNotFound) {
  EXPECT_EQ(ReadNpy("/nowhere/a.npy").status().code(), absl::StatusCode::kNotFound);
}

TEST(Npy, EveryTruncationIsDataLossAndNamesTheFile) {
  const std::string bytes = MakeNpy("<f4", "False", "(2, 2)", Raw<float>({1, 2, 3, 4}));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto array = ReadBytes(bytes.substr(0, size));
    ASSERT_EQ(array.status().code(), absl::StatusCode::kDataLoss) << size;
    ASSERT_THAT(std::string(array.status().message()), HasSubstr("array.npy"));
  }
}

TEST(Npy, BytesLeftOverAreDataLoss) {
  const auto array = ReadBytes(MakeNpy("<f4", "False", "(1,)", Raw<float>({1}) + "x"));
  EXPECT_EQ(array.status().code(), absl::StatusCode::kDataLoss);
}

TEST(Npy, OtherTypesAndOrdersAreRefused) {
  for (const char* type : {"<i4", ">f4", "<f2", "|b1", "<c8"}) {
    EXPECT_EQ(ReadBytes(MakeNpy(type, "False", "(1,)", "1234")).status().code(),
              absl::StatusCode::kInvalidArgument)
        << type;
  }
  EXPECT_EQ(ReadBytes(MakeNpy("<f4", "True", "(1,)", "1234")).status().code(),
            absl::StatusCode::kInvalidArgument);
}

TEST(Npy, SizesThatOverflowAreRefused) {
  for (const char* shape : {"(4294967296, 4294967296)", "(268435457,)", "(65536, 65536)",
                            "(0, 18446744073709551615)", "(1, 1, 1, 1, 1, 1, 1, 1, 1)"}) {
    EXPECT_EQ(ReadBytes(MakeNpy("<f4", "False", shape, "1234")).status().code(),
              absl::StatusCode::kInvalidArgument)
        << shape;
  }
}

TEST(Npy, ShapesThatDoNotParseAreDataLoss) {
  for (const char* shape : {"(-1,)", "(x,)", "3", "(99999999999999999999,)", "(1"}) {
    EXPECT_EQ(ReadBytes(MakeNpy("<f4", "False", shape, "1234")).status().code(),
              absl::StatusCode::kDataLoss)
        << shape;
  }
}

TEST(Npy, AnUnknownVersionIsRefused) {
  std::string bytes = MakeNpy("<f4", "False", "(1,)", "1234");
  bytes[6] = 9;
  EXPECT_EQ(ReadBytes(bytes).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(Npy, ADoubleBeyondFloat32IsRefused) {
  const auto array = ReadBytes(MakeNpy("<f8", "False", "(1,)", Raw<double>({1e39})));
  EXPECT_EQ(array.status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(Npy, ValuesThatDoNotFillTheShapeAreNotWritten) {
  const TempFolder folder;
  EXPECT_EQ(WriteNpy(folder.File("a.npy"), Shape{2, 2}, std::vector<float>{1, 2, 3}).code(),
            absl::StatusCode::kInvalidArgument);
}

}  // namespace npy_test
}  // namespace plumescout::lab
