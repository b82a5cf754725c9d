#include "agents/ahrs/ahrs_source.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "agents/ahrs/fault_text.hpp"
#include "agents/ahrs/line_receiver.hpp"
#include "agents/serial/retry_wait.hpp"
#include "agents/serial/serial_port.hpp"
#include "common/base/bounded_queue.hpp"
#include "common/base/log.hpp"
#include "common/base/steady_stamp.hpp"

namespace lifeline::ahrs {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kQueued = 1024;  ///< samples: five seconds of 200 Hz
constexpr Duration kReadWait = milliseconds(100), kCommandWait = milliseconds(200);
/// A sensor that says nothing for so long is opened anew: it may have been restarted, and some need
/// to be told to speak.
constexpr Duration kReopenAfter = std::chrono::seconds(2);

SteadyTime now() {
  return std::chrono::steady_clock::now();
}

Result<serial::SerialPort> open_port(const AhrsOptions& options, const std::stop_token& stop) {
  return serial::SerialPort::open(options.device, options.baud, stop);
}

class AhrsSource final : public sensing::AttitudeSource {
 public:
  AhrsSource(AhrsOptions options, serial::SerialPort port, std::stop_source stop,
             const std::stop_token& outer)
      : options_(std::move(options)),
        stop_(std::move(stop)),
        on_outer_stop_(outer, [own = stop_]() mutable { own.request_stop(); }),
        retry_(stop_.get_token()),
        port_(std::move(port)),
        receiver_(make_decoder(options_.kind), options_.baud),
        thread_([this] { run(); }) {}

  ~AhrsSource() override { stop_.request_stop(); }

  Result<sensing::AttitudeRead> next(SteadyTime deadline) override {
    const sensing::AttitudeHealth health = health_;
    const bool speaks =
        health == sensing::AttitudeHealth::good || health == sensing::AttitudeHealth::degraded;
    const Duration patience = speaks ? std::max(deadline - now(), Duration{0}) : Duration{0};
    auto sample = samples_.pop(patience);
    const bool ended = !sample && samples_.finished();
    return sensing::AttitudeRead{std::move(sample), ended};
  }

  [[nodiscard]] sensing::AttitudeHealth health() const override { return health_; }

 private:
  void run() {
    if (port_) begin();
    while (!stop_.stop_requested()) {
      if (port_ ? read() : reopen()) continue;
      retry_.wait();
    }
    samples_.close();
  }

  /// The port is open: lets the sensor speak.
  void begin() {
    receiver_.start(now());
    heard_ = now();
    spoke_ = false;
    const std::string commands = receiver_.decoder().start_commands();
    if (commands.empty()) return;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(commands.data());
    const auto sent = port_->write({bytes, commands.size()}, now() + kCommandWait);
    if (!sent) lose(sent.error().text);
  }

  bool reopen() {
    auto opened = open_port(options_, stop_.get_token());
    if (!opened) return lose(opened.error().text);
    port_.emplace(*std::move(opened));
    begin();
    return port_.has_value();
  }

  /// Reads what there is; false where the port was lost.
  bool read() {
    std::array<std::uint8_t, 1024> bytes{};
    const auto size = port_->read(bytes, now() + kReadWait);
    if (!size) return lose(size.error().text);
    readings_.clear();
    receiver_.push(std::span(bytes).first(*size), now(), readings_);
    const std::uint64_t spoken = receiver_.watch().counts().readings;
    if (spoken > spoken_) {  // also what must not be used: a frozen sensor is not a silent one
      spoken_ = spoken;
      spoke_ = true;
      heard_ = now();
      retry_.reset();
      told_.clear();
    }
    // What is wrong is known before what it was seen in: nobody uses a reading as a good one. And a
    // port that was only opened anew has not made anything good yet.
    const AttitudeFault fault = receiver_.watch().fault(now());
    if (spoke_ || fault != AttitudeFault::none) report(fault);
    for (const LineReceiver::Reading& each : readings_) {
      samples_.push(
          {stamp_of(each.stamp), each.reading.R_world_body * options_.R_body_sensor.conjugate()});
    }
    if (now() - heard_ < kReopenAfter) return true;
    port_.reset();
    return false;
  }

  /// There is no port, and why. Told once, not at every attempt. Always false.
  bool lose(const std::string& why) {
    port_.reset();
    health_ = sensing::AttitudeHealth::failed;
    if (stop_.stop_requested() || why == told_) return false;
    spdlog::warn("{}; scans go on without attitude", why);
    told_ = why;
    fault_ = AttitudeFault::silent;
    return false;
  }

  void report(AttitudeFault fault) {
    health_ = health_of(fault, receiver_.watch().rate_unit());
    const std::uint64_t damaged = receiver_.watch().counts().damaged;
    if (damaged > damaged_told_ && (damaged_told_ == 0 || damaged >= damaged_told_ + 1000)) {
      spdlog::warn("{}: {} damaged sentences so far, skipped; the last: {}", options_.device,
                   damaged, receiver_.last_damage());
      damaged_told_ = damaged;
    }
    if (fault == fault_) return;
    fault_ = fault;
    if (fault == AttitudeFault::none) {
      spdlog::info("{}: attitude is good", options_.device);
    } else {
      spdlog::warn("{}: {}", options_.device,
                   fault_text(fault, receiver_.watch().rate_unit(), options_.baud));
    }
  }

  const AhrsOptions options_;
  std::stop_source stop_;
  std::stop_callback<std::function<void()>> on_outer_stop_;
  serial::RetryWait retry_;
  std::optional<serial::SerialPort> port_;  ///< empty while it is lost
  LineReceiver receiver_;
  std::vector<LineReceiver::Reading> readings_;
  BoundedQueue<sensing::OrientationSample> samples_{kQueued, Overflow::drop_oldest};
  std::atomic<sensing::AttitudeHealth> health_{sensing::AttitudeHealth::good};
  AttitudeFault fault_ = AttitudeFault::none;
  SteadyTime heard_{};  ///< the last reading, or when the port was opened
  bool spoke_ = false;  ///< since the port was opened
  std::uint64_t spoken_ = 0;
  std::string told_;
  std::uint64_t damaged_told_ = 0;
  std::jthread thread_;  // last: joined before what it uses goes away
};

}  // namespace

Result<std::unique_ptr<sensing::AttitudeSource>> open_ahrs_source(const AhrsOptions& options,
                                                                  const std::stop_token& stop) {
  std::stop_source own;
  auto port = open_port(options, own.get_token());
  if (!port) return forward_error(port);
  return std::make_unique<AhrsSource>(options, *std::move(port), std::move(own), stop);
}

}  // namespace lifeline::ahrs
