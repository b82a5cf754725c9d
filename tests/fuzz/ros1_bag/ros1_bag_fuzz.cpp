// Any bytes as a ROS 1 bag: its topics, and every message of each, as scan and as attitude.

#include <cstdint>
#include <cstdlib>

#include "agents/sources/laser_messages.hpp"
#include "agents/sources/ros1_bag.hpp"
#include "tests/support/memory_file.hpp"

namespace {

using namespace lifeline::sources;

void play(const std::string& path, const std::string& topic) {
  const auto messages = open_ros1_topic(path, topic);
  if (!messages) return;
  for (;;) {
    const auto message = (*messages)();
    if (!message || !*message) return;
    if ((*message)->bytes.size() > kMaxMessageBytes) std::abort();
    (void)decode_laser_scan((*message)->bytes, RosVersion::ros1);
    (void)decode_imu((*message)->bytes, RosVersion::ros1);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const lifeline::test::MemoryFile bag({data, size});
  const auto topics = ros1_topics(bag.path());
  if (!topics) return 0;
  constexpr std::size_t kEnough = 3;
  for (std::size_t i = 0; i < topics->size() && i < kEnough; ++i)
    play(bag.path(), (*topics)[i].name);
  return 0;
}
