#pragma once

// For the sources of common/dds only.

#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>

#include "common/dds/fastdds_version.hpp"

namespace lifeline::dds {

/// What a reader of GuardedType hands out.
template <typename Idl>
struct Sample {
  Idl value;
  bool decodable = true;
};

/// A generated type support, made fit for input from outside:
/// - the generated deserialize() lets exceptions out of the receiving thread (a boolean octet of 2
///   is enough to end the process), cuts long texts silently, and when it says no the sample
///   vanishes uncounted. Here the sample arrives, marked as not decodable;
/// - the generated getKey() works in one buffer for all threads. Here one at a time;
/// - no type objects are announced: other DDS implementations drop endpoints that have them.
template <typename Generated>
class GuardedType final : public Generated {
 public:
  using Idl = typename Generated::type;
  using Data = Sample<Idl>;
  using Payload = rtps::SerializedPayload_t;

  GuardedType() {
    this->auto_fill_type_information(false);
    this->auto_fill_type_object(false);
  }

  bool serialize(void* data, Payload* payload) override {
    return Generated::serialize(&value_of(data), payload);
  }

  bool deserialize(Payload* payload, void* data) override {
    auto& sample = *static_cast<Data*>(data);
    sample.decodable = decode(payload, sample.value);
    return true;
  }

  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return Generated::getSerializedSizeProvider(&value_of(data));
  }

  void* createData() override { return new Data(); }
  void deleteData(void* data) override { delete static_cast<Data*>(data); }

  bool getKey(void* data, rtps::InstanceHandle_t* handle, bool force_md5) override {
    const auto& sample = *static_cast<const Data*>(data);
    if (!sample.decodable) {
      // Any defined handle: the sample must reach the reader to be counted.
      handle->value[0] = rtps::octet{1};
      return true;
    }
    const std::lock_guard lock(key_mutex_);
    return Generated::getKey(&value_of(data), handle, force_md5);
  }

 private:
  static Idl& value_of(void* data) { return static_cast<Data*>(data)->value; }

  bool decode(Payload* payload, Idl& value) {
    constexpr std::uint32_t kEncapsulation = 4;
    constexpr std::uint32_t kMaxPadding = 3;
    try {
      if (payload->length < kEncapsulation || !Generated::deserialize(payload, &value)) {
        return false;
      }
      // A text that was too long, or held a zero octet, is shorter now; or octets are left over.
      const auto size = Idl::getCdrSerializedSize(value) + kEncapsulation;
      return payload->length >= size && payload->length <= size + kMaxPadding;
    } catch (const std::exception&) {
      value = Idl();
      return false;
    }
  }

  std::mutex key_mutex_;
};

}  // namespace lifeline::dds
