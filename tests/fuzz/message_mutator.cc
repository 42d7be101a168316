// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/message_mutator.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

// Of libFuzzer: changes bytes in place as it sees fit.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace plumescout::fuzz {
namespace {

using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

template <typename T, std::size_t kSize>
const T& Any(const std::array<T, kSize>& values, Rng& rng) {
  return values[rng.Below(kSize)];
}

double AnyDouble(double now, Rng& rng) {
  constexpr double kMax = std::numeric_limits<double>::max();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr std::array kSpecial = {0.0,
                                   -0.0,
                                   1.0,
                                   -1.0,
                                   0.1,
                                   0.5,
                                   2.0,
                                   1e-3,
                                   1e3,
                                   1e6,
                                   1e9,
                                   -1e9,
                                   1e-300,
                                   1e300,
                                   -1e300,
                                   5e-324,
                                   kMax,
                                   -kMax,
                                   kInf,
                                   -kInf,
                                   9.2e18,
                                   2.1e9,
                                   -2.2e9,
                                   3.1416,
                                   65535.0,
                                   1e-9,
                                   99.9999,
                                   1000.0,
                                   std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::epsilon()};
  switch (rng.Below(4)) {
    case 0:
      return now * rng.Uniform(-2.0, 2.0);
    case 1:
      return std::nextafter(now, rng.Below(2) == 0 ? kInf : -kInf);
    case 2:
      return rng.Uniform(-20.0, 20.0);
    default:
      return Any(kSpecial, rng);
  }
}

std::int64_t AnyInt(std::int64_t now, Rng& rng) {
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  constexpr std::array<std::int64_t, 20> kSpecial = {0,
                                                     1,
                                                     -1,
                                                     2,
                                                     7,
                                                     64,
                                                     100,
                                                     255,
                                                     65535,
                                                     65536,
                                                     100'000,
                                                     16'000'001,
                                                     2147483647,
                                                     -2147483648LL,
                                                     1LL << 53,
                                                     1LL << 61,
                                                     (1LL << 61) + 1,
                                                     1LL << 62,
                                                     kMax,
                                                     -kMax - 1};
  switch (rng.Below(3)) {
    case 0:  // wraps around rather than overflow
      return static_cast<std::int64_t>(static_cast<std::uint64_t>(now) + rng.Below(5) - 2);
    case 1:
      return static_cast<std::int64_t>(rng.Below(20));
    default:
      return Any(kSpecial, rng);
  }
}

std::string AnyText(std::string now, Rng& rng) {
  static const std::array<std::string, 16> kSpecial = {"",
                                                       "r1",
                                                       "hall",
                                                       "missions/hall",
                                                       "missions/hall/robots/r1",
                                                       "missions/hall/robots/r2",
                                                       "missions/hall/plans/1",
                                                       "missions/hall/plans/9223372036854775807",
                                                       "missions//robots/",
                                                       std::string("a\0b", 3),
                                                       "\xFF\xFE\xC0",
                                                       "plumescout",
                                                       "xit_gff",
                                                       "lhr",
                                                       "sweep",
                                                       std::string(300, 'a')};
  if (rng.Below(3) == 0) return Any(kSpecial, rng);
  constexpr std::size_t kRoom = 64;
  const std::size_t size = now.size();
  now.resize(size + kRoom);
  now.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(now.data()), size, now.size()));
  return now;
}

int AnyEnum(const EnumDescriptor& type, Rng& rng) {
  constexpr int kUnknown = 99;
  const auto count = static_cast<std::uint64_t>(type.value_count());
  const std::uint64_t which = rng.Below(count + 1);
  return which == count ? kUnknown : type.value(static_cast<int>(which))->number();
}

// A field of one message, once or as an element of a list.
struct Place {
  Message& message;
  const Reflection& reflection;
  const FieldDescriptor* field;
  int index;  // -1: the field is no list
};

// Calls the setter that fits.
#define PLUMESCOUT_SET(Type, value)                                     \
  (place.index < 0                                                      \
       ? place.reflection.Set##Type(&place.message, place.field, value) \
       : place.reflection.SetRepeated##Type(&place.message, place.field, place.index, value))
#define PLUMESCOUT_GET(Type)                                                \
  (place.index < 0 ? place.reflection.Get##Type(place.message, place.field) \
                   : place.reflection.GetRepeated##Type(place.message, place.field, place.index))

void SetScalar(const Place& place, Rng& rng) {
  switch (place.field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return PLUMESCOUT_SET(Bool, rng.Below(2) == 0);
    case FieldDescriptor::CPPTYPE_INT32:
      return PLUMESCOUT_SET(Int32, static_cast<std::int32_t>(AnyInt(PLUMESCOUT_GET(Int32), rng)));
    case FieldDescriptor::CPPTYPE_INT64:
      return PLUMESCOUT_SET(Int64, AnyInt(PLUMESCOUT_GET(Int64), rng));
    case FieldDescriptor::CPPTYPE_UINT32:
      return PLUMESCOUT_SET(UInt32,
                            static_cast<std::uint32_t>(AnyInt(PLUMESCOUT_GET(UInt32), rng)));
    case FieldDescriptor::CPPTYPE_UINT64:
      return PLUMESCOUT_SET(UInt64, static_cast<std::uint64_t>(AnyInt(0, rng)));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return PLUMESCOUT_SET(Float, static_cast<float>(AnyInt(0, rng)));
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return PLUMESCOUT_SET(Double, AnyDouble(PLUMESCOUT_GET(Double), rng));
    case FieldDescriptor::CPPTYPE_ENUM:
      return PLUMESCOUT_SET(EnumValue, AnyEnum(*place.field->enum_type(), rng));
    case FieldDescriptor::CPPTYPE_STRING:
      return PLUMESCOUT_SET(String, AnyText(PLUMESCOUT_GET(String), rng));
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return;
  }
}

#undef PLUMESCOUT_SET
#undef PLUMESCOUT_GET

void AddElement(Message& message, const FieldDescriptor* field, Rng& rng) {
  const Reflection& reflection = *message.GetReflection();
  const int size = reflection.FieldSize(message, field);
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_MESSAGE: {
      Message* const added = reflection.AddMessage(&message, field);
      if (size > 0) {  // like another one
        const int like = static_cast<int>(rng.Below(static_cast<std::uint64_t>(size)));
        added->CopyFrom(reflection.GetRepeatedMessage(message, field, like));
      }
      return;
    }
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.AddEnumValue(&message, field, AnyEnum(*field->enum_type(), rng));
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection.AddInt32(&message, field, static_cast<std::int32_t>(AnyInt(0, rng)));
    case FieldDescriptor::CPPTYPE_STRING:
      return reflection.AddString(&message, field, AnyText("", rng));
    default:
      return;  // no request has such lists
  }
}

void MutateElement(Message& message, const FieldDescriptor* field, int index, Rng& rng) {
  const Reflection& reflection = *message.GetReflection();
  if (field->message_type() != nullptr) {
    return MutateMessage(*reflection.MutableRepeatedMessage(&message, field, index), rng);
  }
  SetScalar({message, reflection, field, index}, rng);
}

void MutateList(Message& message, const FieldDescriptor* field, Rng& rng) {
  const Reflection& reflection = *message.GetReflection();
  const int size = reflection.FieldSize(message, field);
  if (size == 0) return AddElement(message, field, rng);
  const auto any = [&] { return static_cast<int>(rng.Below(static_cast<std::uint64_t>(size))); };
  constexpr int kMany = 70;
  switch (rng.Below(8)) {
    case 0:
      return AddElement(message, field, rng);
    case 1:
      return reflection.RemoveLast(&message, field);
    case 2:
      return reflection.SwapElements(&message, field, any(), any());
    case 3:
      if (rng.Below(16) > 0) return AddElement(message, field, rng);
      for (int i = 0; i < kMany; ++i) AddElement(message, field, rng);
      return;
    default:
      return MutateElement(message, field, any(), rng);
  }
}

}  // namespace

void MutateMessage(Message& message, Rng& rng) {
  const auto count = static_cast<std::uint64_t>(message.GetDescriptor()->field_count());
  if (count == 0) return;
  const FieldDescriptor* const field =
      message.GetDescriptor()->field(static_cast<int>(rng.Below(count)));
  const Reflection& reflection = *message.GetReflection();
  constexpr int kClearOneIn = 12;
  if (rng.Below(kClearOneIn) == 0) return reflection.ClearField(&message, field);
  if (field->is_repeated()) return MutateList(message, field, rng);
  if (field->message_type() != nullptr) {
    return MutateMessage(*reflection.MutableMessage(&message, field), rng);
  }
  SetScalar({message, reflection, field, -1}, rng);
}

}  // namespace plumescout::fuzz
