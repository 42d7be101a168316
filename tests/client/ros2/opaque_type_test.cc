// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/opaque_type.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <gtest/gtest.h>

namespace plumescout::client {
namespace opaque_type_test {

TEST(OpaqueType, ASampleIsItsBytes) {
  ddsi_sertype* const type = NewOpaqueType("a::msg::dds_::B_");
  EXPECT_STREQ(type->type_name, "a::msg::dds_::B_");
  const std::string bytes("\0\1\0\0abcdef", 10);
  ddsi_serdata* const sample = ddsi_serdata_from_sample(type, SDK_DATA, &bytes);
  EXPECT_EQ(BytesOf(*sample), bytes);
  EXPECT_EQ(ddsi_serdata_size(sample), bytes.size());
  std::string out(12, 'x');
  ddsi_serdata_to_ser(sample, 0, out.size(), out.data());
  EXPECT_EQ(out, bytes + std::string(2, '\0'));
  std::string taken;
  EXPECT_TRUE(ddsi_serdata_to_sample(sample, &taken, nullptr, nullptr));
  EXPECT_EQ(taken, bytes);
  ddsi_serdata_unref(sample);
  ddsi_sertype_unref(type);
}

}  // namespace opaque_type_test
}  // namespace plumescout::client
