#include "tests/bench/radio/radio_traffic.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <future>
#include <optional>

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/bench/radio/rtps_tally.hpp"

namespace lifeline::bench {
namespace {

/// Opens the socket from within the net's namespace: for the calling thread alone.
Result<int> open_on_air(const RadioNet& net) {
  const std::string path = "/var/run/netns/" + net.air();
  const int space = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool entered = space >= 0 && setns(space, CLONE_NEWNET) == 0;
  if (space >= 0) close(space);
  if (!entered) return fail(ErrorCode::unavailable, "{}: {}", path, std::strerror(errno));
  const int heard = socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC, htons(ETH_P_ALL));
  if (heard < 0) return fail(ErrorCode::unavailable, "packet socket: {}", std::strerror(errno));
  const int buffer = 64 << 20;
  (void)setsockopt(heard, SOL_SOCKET, SO_RCVBUFFORCE, &buffer, sizeof buffer);
  const timeval patience{0, 100'000};
  (void)setsockopt(heard, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  return heard;
}

}  // namespace

Result<std::unique_ptr<RadioTraffic>> RadioTraffic::listen(const RadioNet& net,
                                                           const std::set<int>& hosts) {
  std::promise<Result<std::unique_ptr<RadioTraffic>>> ready;
  auto made = ready.get_future();
  // Only a thread that nobody else uses may move to another namespace.
  std::thread([&] {
    const auto opened = open_on_air(net);
    if (!opened) {
      ready.set_value(forward_error(opened));
      return;
    }
    std::unique_ptr<RadioTraffic> traffic(new RadioTraffic(*opened));
    for (const int host : hosts) {
      traffic->interfaces_.insert(
          static_cast<int>(if_nametoindex(fmt::format("p{}", host).c_str())));
    }
    ready.set_value(std::move(traffic));
  }).join();
  auto traffic = made.get();
  if (traffic) (*traffic)->thread_ = std::thread([listener = traffic->get()] { listener->hear(); });
  return traffic;
}

RadioTraffic::~RadioTraffic() {
  (void)stop();
  close(socket_);
}

void RadioTraffic::hear() {
  RtpsTally tally;
  std::array<std::uint8_t, 2048> frame{};
  sockaddr_ll from{};
  while (!stopping_) {
    socklen_t size = sizeof from;
    const ssize_t octets =
        recvfrom(socket_, frame.data(), frame.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
    // Each frame is seen again where it leaves the bridge.
    if (octets <= 0 || from.sll_pkttype == PACKET_OUTGOING) continue;
    const std::span heard(frame.data(), static_cast<std::size_t>(octets));
    tally.take(heard, interfaces_.contains(from.sll_ifindex));
  }
  tally_ = tally.octets();
}

RadioTraffic::Tally RadioTraffic::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
  return tally_;
}

}  // namespace lifeline::bench
