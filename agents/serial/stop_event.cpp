#include "agents/serial/stop_event.hpp"

#include <cstdint>

#include <sys/eventfd.h>

namespace lifeline::serial {

StopEvent::StopEvent(const std::stop_token& stop)
    : stop_(stop), event_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), on_stop_(stop, [this] {
        const std::uint64_t one = 1;
        // Fails only where the counter is full, and then it is readable all the same.
        [[maybe_unused]] const auto written = ::write(event_.get(), &one, sizeof one);
      }) {}

}  // namespace lifeline::serial
