#include "agents/rplidar/rplidar_source.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <numbers>
#include <utility>
#include <vector>

#include "agents/rplidar/line_watch.hpp"
#include "agents/rplidar/sample_decoder.hpp"
#include "agents/rplidar/sweep_assembler.hpp"
#include "agents/serial/retry_wait.hpp"
#include "common/base/log.hpp"
#include "common/base/steady_stamp.hpp"

namespace lifeline::rplidar {
namespace {

using sensing::RawScan;

SteadyTime now() {
  return std::chrono::steady_clock::now();
}

const char* advice(LineFault fault) {
  switch (fault) {
    case LineFault::silent:
      return "silent; check power and cable";
    case LineFault::garbage:
      return "sends nothing that can be read; check cable and power";
    case LineFault::stalled:
      return "its rotor does not turn; check that nothing blocks it, and power";
    case LineFault::none:
      break;
  }
  return "works";
}

/// A scan under way: from bytes to sweeps.
struct RunningScan {
  RunningScan(const ScanMode& mode, int baud, const SweepSettings& settings)
      : decoder(static_cast<AnswerType>(mode.answer_type), mode.us_per_sample, baud),
        assembler(settings) {}

  SampleDecoder decoder;
  SweepAssembler assembler;
};

class RplidarSource final : public sensing::ScanSource {
 public:
  RplidarSource(std::unique_ptr<Device> device, RplidarOptions options, std::stop_token stop)
      : options_(std::move(options)),
        stop_(stop),
        retry_(stop),
        device_(std::move(device)),
        wall_minus_steady_(stamp_of(SteadyTime{}).time_since_epoch()),
        left_at_(now()) {}

  Result<std::optional<RawScan>> next() override {
    if (scan_) watch_.excuse(now() - left_at_);
    while (sweeps_.empty() && !stop_.stop_requested()) {
      if (scan_ ? read() : start()) continue;
      retry_.wait();
    }
    left_at_ = now();
    if (stop_.stop_requested()) return std::nullopt;
    std::optional<RawScan> sweep = std::move(sweeps_.front());
    sweeps_.pop_front();
    return sweep;
  }

 private:
  /// Opens the device if need be, and begins to scan; false where that failed.
  bool start() {
    if (!device_) {
      auto opened = Device::open(options_.device, stop_);
      if (!opened) return lose(opened.error().text);
      device_ = *std::move(opened);
    }
    const auto first = device_->start_scan();
    if (!first) return lose(first.error().text);
    scan_.emplace(device_->mode(), device_->baud(), sweep_settings());
    watch_.start(now());
    take(*first);
    return true;
  }

  /// Reads what there is; false where the scan has ended.
  bool read() {
    std::array<std::uint8_t, 4096> bytes{};
    const auto size = device_->read(bytes, watch_.deadline());
    if (!size) return lose(size.error().text);
    take(Bytes(bytes).first(*size));
    const LineFault fault = watch_.fault(now());
    if (fault == LineFault::none || stop_.stop_requested()) return true;
    return lose(fmt::format("{}: {}", options_.device.device, advice(fault)));
  }

  void take(Bytes bytes) {
    if (bytes.empty()) return;
    const SteadyTime arrived = now();
    samples_.clear();
    scan_->decoder.push(bytes, arrived, samples_);
    const std::uint64_t turns = scan_->assembler.turns();
    for (const Sample& sample : samples_) {
      auto sweep = scan_->assembler.add(sample);
      if (!sweep) continue;
      sweep->stamp += wall_minus_steady_;
      // Sweeps before were read so late that they seem younger: left out, time never goes back.
      if (sweep->stamp <= last_stamp_) continue;
      last_stamp_ = sweep->stamp;
      sweeps_.push_back(*std::move(sweep));
    }
    watch_.note(arrived, !samples_.empty(), scan_->assembler.turns() > turns);
    if (!sweeps_.empty()) tell_of_return();
  }

  /// The device does not scan, and why. Told once, not at every attempt. Always false.
  bool lose(const std::string& why) {
    if (stop_.stop_requested()) return false;
    if (scan_) tell_of_damage();
    if (why != told_) spdlog::warn("{}", why);
    told_ = why;
    scan_.reset();
    device_.reset();
    if (!lost_at_) lost_at_ = now();
    return false;
  }

  void tell_of_return() {
    retry_.reset();
    if (!lost_at_) return;
    spdlog::info("{}: scans again, after {:.1f} s", options_.device.device,
                 to_seconds(now() - *lost_at_));
    lost_at_.reset();
    told_.clear();
  }

  void tell_of_damage() const {
    const DecoderCounts& counts = scan_->decoder.counts();
    if (counts.skipped == 0) return;
    spdlog::info("{}: {} of {} bytes could not be used, in {} places", options_.device.device,
                 counts.skipped, counts.bytes, counts.gaps);
  }

  [[nodiscard]] SweepSettings sweep_settings() const {
    const ScanMode& mode = device_->mode();
    const auto format = frame_format(static_cast<AnswerType>(mode.answer_type));
    SweepSettings settings;
    settings.us_per_sample = mode.us_per_sample;
    settings.range_max_m = std::min(mode.max_distance_m, format->max_distance_m);
    settings.yaw_rad = options_.yaw_rad;
    settings.inverted = options_.inverted;
    return settings;
  }

  const RplidarOptions options_;
  const std::stop_token stop_;
  serial::RetryWait retry_;
  std::unique_ptr<Device> device_;   ///< empty while it is lost
  std::optional<RunningScan> scan_;  ///< only with a device
  LineWatch watch_;
  const Duration wall_minus_steady_;
  SteadyTime left_at_;  ///< when next() was last left
  std::vector<Sample> samples_;
  std::deque<RawScan> sweeps_;
  Timestamp last_stamp_ = Timestamp::min();
  std::optional<SteadyTime> lost_at_;
  std::string told_;
};

}  // namespace

Result<RplidarOptions> read_rplidar_options(const sources::SourceSpec& spec) {
  if (auto known = spec.allow_options({"mode", "baud", "pwm", "yaw", "inverted"}); !known) {
    return forward_error(known);
  }
  const auto baud = spec.integer("baud", 256'000, 9'600, 3'000'000);
  if (!baud) return forward_error(baud);
  const auto pwm = spec.integer("pwm", 600, 1, 1023);
  if (!pwm) return forward_error(pwm);
  const auto yaw_deg = spec.number("yaw", 0.0, -360.0, 360.0);
  if (!yaw_deg) return forward_error(yaw_deg);
  const auto inverted = spec.choice("inverted", "no", {"no", "yes"});
  if (!inverted) return forward_error(inverted);
  RplidarOptions options;
  options.device = {spec.target, static_cast<int>(*baud), static_cast<std::uint16_t>(*pwm),
                    spec.text("mode", "")};
  options.yaw_rad = *yaw_deg * std::numbers::pi / 180.0;
  options.inverted = *inverted == "yes";
  return options;
}

Result<std::unique_ptr<sensing::ScanSource>> open_rplidar_source(const sources::SourceSpec& spec,
                                                                 const std::stop_token& stop) {
  auto options = read_rplidar_options(spec);
  if (!options) return forward_error(options);
  auto device = Device::open(options->device, stop);
  if (!device) return forward_error(device);
  const DeviceInfo& info = (*device)->info();
  const ScanMode& mode = (*device)->mode();
  spdlog::info(
      "{}: RPLIDAR model {:#04x}, firmware {}.{:02}, hardware {}, serial number {}; mode "
      "{}, {:.1f}k samples/s, {:.0f} m",
      spec.target, info.model, info.firmware_major, info.firmware_minor, info.hardware,
      info.serial_number, mode.name, 1e-3 * mode.samples_per_s(), mode.max_distance_m);
  return std::make_unique<RplidarSource>(*std::move(device), *std::move(options), stop);
}

}  // namespace lifeline::rplidar
