#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "common/base/time.hpp"
#include "tests/support/ahrs/sentences.hpp"
#include "tests/support/pseudo_terminal.hpp"
#include "tests/support/rplidar/line_noise.hpp"

namespace lifeline::test {

enum class AhrsKind { vectornav, ahrs8 };

struct AhrsEmulatorOptions {
  AhrsKind kind = AhrsKind::vectornav;
  HeadAt head;  ///< seconds of the steady clock
  double samples_per_s = 80.0;
  Checksum checksum = Checksum::exclusive_or;
  double rate_scale = 1.0;  ///< of the rates, to have them in another unit
  std::uint64_t seed = 1;   ///< of the noise
};

/// An attitude sensor on a pseudo-terminal, in a thread of its own, with faults when told to. An
/// AHRS-8 speaks only once it was told to, and forgets that when it is unplugged. All functions may
/// be called at any time.
class AhrsEmulator {
 public:
  /// `link`: a name that stays the same when the device is plugged in again; may be empty.
  explicit AhrsEmulator(AhrsEmulatorOptions options, std::string link = {});

  [[nodiscard]] std::string device() const;

  // Faults. They stay until taken back.
  void set_noise(NoiseRates rates);
  void set_silent(bool silent) { silent_ = silent; }
  void set_frozen(bool frozen) { frozen_ = frozen; }
  void unplug();
  void plug_in();
  /// The sensor finds another north: its yaw leaps by this much.
  void set_yaw_offset(double offset_rad) { yaw_offset_rad_ = offset_rad; }

  [[nodiscard]] std::uint64_t sentences() const { return sentences_; }

 private:
  void run(const std::stop_token& stop);
  void hear();
  void speak(SteadyTime now);

  const AhrsEmulatorOptions options_;
  mutable std::mutex mutex_;  ///< of the terminal and the noise
  PseudoTerminal terminal_;
  LineNoise noise_;
  NoiseRates rates_;
  std::string heard_;
  std::string frozen_line_;
  bool told_to_speak_ = false;
  std::atomic<bool> silent_{false}, frozen_{false};
  std::atomic<double> yaw_offset_rad_{0.0};
  std::atomic<std::uint64_t> sentences_{0};
  std::jthread thread_;  // last: it uses all the others
};

}  // namespace lifeline::test
