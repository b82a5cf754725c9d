#include "agents/serial/stop_event.hpp"

#include <cstdint>

#include <poll.h>
#include <sys/eventfd.h>

namespace lifeline::serial {

StopEvent::StopEvent(const std::stop_token& stop)
    : stop_(stop), event_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), on_stop_(stop, [this] {
        const std::uint64_t one = 1;
        // Fails only where the counter is full, and then it is readable all the same.
        [[maybe_unused]] const auto written = ::write(event_.get(), &one, sizeof one);
      }) {}

void StopEvent::wait(Duration duration) const {
  const auto ms = std::chrono::ceil<std::chrono::milliseconds>(duration).count();
  pollfd watched{event_.get(), POLLIN, 0};
  (void)::poll(&watched, 1, static_cast<int>(ms));
}

}  // namespace lifeline::serial
