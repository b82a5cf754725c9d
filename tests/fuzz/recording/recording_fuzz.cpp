// Any octets as a message of a recording: the first octet says of which topic. What is taken for a
// sample is the same after it was recorded again.

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/dds/cdr_samples.hpp"
#include "common/recording/topic_names.hpp"
#include "coordinator/recording/replay.hpp"

namespace {

using namespace lifeline;

void require(bool condition) {
  if (!condition) std::abort();
}

std::string topic_of(std::uint8_t number) {
  static const std::array<std::string, 11> kTopics{recorded_topic<wire::HelmetPose>().name,
                                                   recorded_topic<wire::HelmetScan>().name,
                                                   recorded_topic<wire::TsdTile>().name,
                                                   recorded_topic<wire::TileRequest>().name,
                                                   recorded_topic<wire::TileCopy>().name,
                                                   recorded_topic<wire::MergeDirective>().name,
                                                   recorded_topic<wire::MergeEvidence>().name,
                                                   recorded_topic<wire::AgentStatus>().name,
                                                   recorded_topic<wire::Detection>().name,
                                                   recorded_topic<wire::Alert>().name,
                                                   "/tf"};
  return kTopics[number % kTopics.size()];
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const bag::Message message{{topic_of(data[0]), ""}, Timestamp{}, {data + 1, data + size}};
  const auto heard = to_heard(message);
  if (!heard) require(heard.error().text.find('\n') == std::string::npos);
  if (!heard || !*heard) return 0;
  std::visit(
      []<typename Sample>(const Sample& sample) {
        const auto again = dds::to_cdr(sample);
        require(again.has_value());
        const auto back = dds::from_cdr<Sample>(*again);
        require(back.has_value() && dds::to_cdr(*back).value() == *again);
      },
      **heard);
  return 0;
}
