// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/linalg/symmetric_matrix.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "tests/core/linalg/dense_oracle.h"

namespace plumescout {
namespace symmetric_matrix_test {

// [ 4 -1  . ]
// [-1  5 -2 ]
// [ . -2  6 ]
SymmetricMatrix Example() {
  return SymmetricFromTriplets(
             3,
             std::vector<Triplet>{{1, 0, -1.0}, {2, 2, 6.0}, {0, 0, 4.0}, {2, 1, -2.0}, {1, 1, 5}})
      .value();
}

TEST(SymmetricFromTripletsTest, SortsColumnsAndRows) {
  const SymmetricMatrix matrix = Example();
  EXPECT_EQ(matrix.column_start, (std::vector<int>{0, 2, 4, 5}));
  EXPECT_EQ(matrix.row, (std::vector<int>{0, 1, 1, 2, 2}));
  EXPECT_EQ(matrix.value, (std::vector<double>{4.0, -1.0, 5.0, -2.0, 6.0}));
}

TEST(SymmetricFromTripletsTest, SumsDuplicates) {
  const auto matrix =
      SymmetricFromTriplets(2, std::vector<Triplet>{{1, 0, 1.0}, {0, 0, 2.0}, {1, 0, 0.5}});
  ASSERT_TRUE(matrix.ok());
  EXPECT_EQ(matrix->value, (std::vector<double>{2.0, 1.5, 0.0}));
}

TEST(SymmetricFromTripletsTest, StoresDiagonalsThatNoTripletNames) {
  const auto matrix = SymmetricFromTriplets(2, {});
  ASSERT_TRUE(matrix.ok());
  EXPECT_TRUE(Validate(*matrix).ok());
  EXPECT_EQ(matrix->row, (std::vector<int>{0, 1}));
}

TEST(SymmetricFromTripletsTest, RefusesIndicesOutsideTheLowerTriangle) {
  for (const Triplet& bad : {Triplet{0, 1, 1.0}, {2, 0, 1.0}, {0, -1, 1.0}}) {
    EXPECT_EQ(SymmetricFromTriplets(2, std::vector<Triplet>{bad}).status().code(),
              absl::StatusCode::kInvalidArgument);
  }
  EXPECT_EQ(SymmetricFromTriplets(-1, {}).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(ValidateSymmetricMatrixTest, AcceptsTheEmptyMatrix) {
  EXPECT_TRUE(Validate(SymmetricMatrix{}).ok());
}

TEST(ValidateSymmetricMatrixTest, RefusesValuesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    SymmetricMatrix matrix = Example();
    matrix.value[3] = bad;
    EXPECT_EQ(Validate(matrix).code(), absl::StatusCode::kInvalidArgument);
  }
}

TEST(ValidateSymmetricMatrixTest, RefusesMalformedPatterns) {
  const auto broken = [](auto&& edit) {
    SymmetricMatrix matrix = Example();
    edit(matrix);
    return Validate(matrix).code() == absl::StatusCode::kInvalidArgument;
  };
  EXPECT_TRUE(broken([](SymmetricMatrix& m) { m.n = -1; }));
  EXPECT_TRUE(broken([](SymmetricMatrix& m) { m.n = 4; }));
  EXPECT_TRUE(broken([](SymmetricMatrix& m) { m.value.pop_back(); }));
  EXPECT_TRUE(broken([](SymmetricMatrix& m) { m.column_start = {0, 4, 2, 5}; }));
  EXPECT_TRUE(broken([](SymmetricMatrix& m) { m.column_start = {0, 0, 4, 5}; }));
  EXPECT_TRUE(broken([](SymmetricMatrix& m) { m.row[1] = 0; }));
  EXPECT_TRUE(broken([](SymmetricMatrix& m) { m.row[1] = 3; }));
  EXPECT_TRUE(broken([](SymmetricMatrix& m) { m.row[0] = 1; }));
}

TEST(MultiplyTest, AgreesWithTheDenseProduct) {
  Rng rng(1);
  const SymmetricMatrix matrix = testing::RandomPositiveDefinite(40, 0.2, rng);
  const std::vector<double> x = testing::RandomVector(matrix.n, rng);
  std::vector<double> y(x.size());
  Multiply(matrix, x, y);
  const Eigen::VectorXd expected =
      testing::ToDense(matrix) * Eigen::Map<const Eigen::VectorXd>(x.data(), matrix.n);
  // Sums of 40 products below 40 each: 40 * 40 * 2^-53 < 1e-12.
  for (int i = 0; i < matrix.n; ++i)
    EXPECT_NEAR(y[static_cast<std::size_t>(i)], expected(i), 1e-12);
}

}  // namespace symmetric_matrix_test
}  // namespace plumescout
