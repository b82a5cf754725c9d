#include "tests/support/ahrs/ahrs_emulator.hpp"

#include <cmath>
#include <utility>

namespace lifeline::test {

AhrsEmulator::AhrsEmulator(AhrsEmulatorOptions options, std::string link)
    : options_(std::move(options)),
      terminal_(std::move(link)),
      noise_(options_.seed),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::string AhrsEmulator::device() const {
  const std::lock_guard lock(mutex_);
  return terminal_.device();
}

void AhrsEmulator::set_noise(NoiseRates rates) {
  const std::lock_guard lock(mutex_);
  rates_ = rates;
}

void AhrsEmulator::unplug() {
  const std::lock_guard lock(mutex_);
  terminal_.unplug();
  told_to_speak_ = false;
}

void AhrsEmulator::plug_in() {
  const std::lock_guard lock(mutex_);
  terminal_.plug_in();
}

void AhrsEmulator::run(const std::stop_token& stop) {
  const Duration interval = from_seconds(1.0 / options_.samples_per_s);
  SteadyTime due = std::chrono::steady_clock::now();
  while (!stop.stop_requested()) {
    due += interval;
    std::this_thread::sleep_until(due);
    const std::lock_guard lock(mutex_);
    if (!terminal_.is_plugged_in()) continue;
    hear();
    if (!silent_ && (options_.kind == AhrsKind::vectornav || told_to_speak_)) speak(due);
  }
}

void AhrsEmulator::hear() {
  for (const std::uint8_t byte : terminal_.receive(0)) {
    heard_.push_back(static_cast<char>(byte));
    if (byte != '\n') continue;
    if (heard_.find("printtrigger 0") != std::string::npos) told_to_speak_ = false;
    if (heard_.find("printtrigger printmask set drop") != std::string::npos) told_to_speak_ = true;
    heard_.clear();
    const std::string answer = "OK\r\n";
    (void)terminal_.send({reinterpret_cast<const std::uint8_t*>(answer.data()), answer.size()});
  }
}

void AhrsEmulator::speak(SteadyTime now) {
  const double t_s = to_seconds(now.time_since_epoch());
  const HeadAt head = [this](double at_s) {
    sensing::Attitude attitude = options_.head(at_s);
    attitude.yaw_rad += yaw_offset_rad_;
    return attitude;
  };
  const NedState state = ned_state(head, t_s);
  std::string line =
      options_.kind == AhrsKind::vectornav
          ? vnymr(state, options_.checksum, options_.rate_scale)
          : ahrs8_line(state, static_cast<unsigned>(std::lround(1e3 * t_s)), options_.rate_scale);
  if (!frozen_) {
    frozen_line_ = line;
  } else {
    line = frozen_line_;
  }
  line += "\r\n";
  (void)terminal_.send(
      noise_.damage({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()}, rates_));
  ++sentences_;
}

}  // namespace lifeline::test
