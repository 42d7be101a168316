// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/opaque_type.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstring>
#include <memory>

namespace plumescout::client {
namespace {

// What Cyclone DDS sees is the base; all samples are of one instance, for no type has a key.
struct Sample : ddsi_serdata {
  std::string bytes;
};

const std::string& Bytes(const ddsi_serdata* sample) {
  return static_cast<const Sample*>(sample)->bytes;
}

Sample* NewSample(const ddsi_sertype* type, ddsi_serdata_kind kind) {
  auto sample = std::make_unique<Sample>();
  ddsi_serdata_init(sample.get(), type, kind);
  sample->hash = type->serdata_basehash;
  return sample.release();
}

bool HaveSameKey(const ddsi_serdata*, const ddsi_serdata*) { return true; }

std::uint32_t SizeOf(const ddsi_serdata* sample) {
  return static_cast<std::uint32_t>(Bytes(sample).size());
}

ddsi_serdata* FromFragments(const ddsi_sertype* type, ddsi_serdata_kind kind,
                            const nn_rdata* fragment, std::size_t size) {
  Sample* const sample = NewSample(type, kind);
  sample->bytes.reserve(size);
  for (; fragment != nullptr; fragment = fragment->nextfrag) {
    const std::size_t known = sample->bytes.size();
    if (fragment->maxp1 <= known) continue;  // they may overlap
    const auto* const payload = reinterpret_cast<const char*>(
        NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment)));
    sample->bytes.append(payload + (known - fragment->min), fragment->maxp1 - known);
  }
  return sample;
}

ddsi_serdata* FromParts(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                        const ddsrt_iovec_t* parts, std::size_t size) {
  Sample* const sample = NewSample(type, kind);
  sample->bytes.reserve(size);
  for (std::size_t i = 0; i < count; ++i) {
    sample->bytes.append(static_cast<const char*>(parts[i].iov_base), parts[i].iov_len);
  }
  return sample;
}

ddsi_serdata* FromKeyhash(const ddsi_sertype* type, const ddsi_keyhash*) {
  return NewSample(type, SDK_KEY);
}

ddsi_serdata* FromString(const ddsi_sertype* type, ddsi_serdata_kind kind, const void* text) {
  Sample* const sample = NewSample(type, kind);
  if (kind == SDK_DATA) sample->bytes = *static_cast<const std::string*>(text);
  return sample;
}

// Up to three bytes beyond the end are asked for, which may be anything.
void ToBytes(const ddsi_serdata* sample, std::size_t offset, std::size_t size, void* buffer) {
  const std::string& bytes = Bytes(sample);
  std::memset(buffer, 0, size);
  std::memcpy(buffer, bytes.data() + offset, std::min(size, bytes.size() - offset));
}

ddsi_serdata* ReferTo(const ddsi_serdata* sample, std::size_t offset, std::size_t size,
                      ddsrt_iovec_t* part) {
  // Strings are made longer by their padding when they are written: see DdsNode::Publish.
  part->iov_base = const_cast<char*>(Bytes(sample).data()) + offset;
  part->iov_len = size;
  return ddsi_serdata_ref(sample);
}

void ReferNoMore(ddsi_serdata* sample, const ddsrt_iovec_t*) { ddsi_serdata_unref(sample); }

bool ToString(const ddsi_serdata* sample, void* text, void**, void*) {
  *static_cast<std::string*>(text) = Bytes(sample);
  return true;
}

// All instances are the same: what stands for one need not hold the bytes of a sample.
ddsi_serdata* WithoutType(const ddsi_serdata* sample) {
  Sample* const untyped = NewSample(sample->type, SDK_KEY);
  untyped->type = nullptr;
  return untyped;
}

bool FromNoType(const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) { return true; }

void FreeSample(ddsi_serdata* sample) { delete static_cast<Sample*>(sample); }

std::size_t Print(const ddsi_sertype*, const ddsi_serdata*, char* text, std::size_t) {
  text[0] = '\0';
  return 0;
}

void KeyhashOf(const ddsi_serdata*, ddsi_keyhash* hash, bool) {
  std::memset(hash, 0, sizeof(*hash));
}

const ddsi_serdata_ops kSampleOperations = [] {
  ddsi_serdata_ops operations{};
  operations.eqkey = HaveSameKey;
  operations.get_size = SizeOf;
  operations.from_ser = FromFragments;
  operations.from_ser_iov = FromParts;
  operations.from_keyhash = FromKeyhash;
  operations.from_sample = FromString;
  operations.to_ser = ToBytes;
  operations.to_ser_ref = ReferTo;
  operations.to_ser_unref = ReferNoMore;
  operations.to_sample = ToString;
  operations.to_untyped = WithoutType;
  operations.untyped_to_sample = FromNoType;
  operations.free = FreeSample;
  operations.print = Print;
  operations.get_keyhash = KeyhashOf;
  return operations;
}();

void FreeType(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete type;
}

void ClearStrings(const ddsi_sertype*, void* strings, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) static_cast<std::string*>(strings)[i].clear();
}

bool AreSameType(const ddsi_sertype*, const ddsi_sertype*) { return true; }  // names are compared

std::uint32_t HashOfType(const ddsi_sertype*) { return 0; }

// There is one representation, so what is derived for it is the type itself.
ddsi_sertype* Derive(const ddsi_sertype* type, dds_data_representation_id_t,
                     dds_type_consistency_enforcement_qospolicy_t) {
  return const_cast<ddsi_sertype*>(type);
}

const ddsi_sertype_ops kTypeOperations = [] {
  ddsi_sertype_ops operations{};
  operations.version = ddsi_sertype_v0;
  operations.free = FreeType;
  operations.zero_samples = ClearStrings;
  operations.equal = AreSameType;
  operations.hash = HashOfType;
  operations.derive_sertype = Derive;
  return operations;
}();

}  // namespace

ddsi_sertype* NewOpaqueType(const std::string& dds_name) {
  auto type = std::make_unique<ddsi_sertype>();
  ddsi_sertype_init_flags(type.get(), dds_name.c_str(), &kTypeOperations, &kSampleOperations,
                          DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  return type.release();
}

const std::string& BytesOf(const ddsi_serdata& sample) { return Bytes(&sample); }

}  // namespace plumescout::client
