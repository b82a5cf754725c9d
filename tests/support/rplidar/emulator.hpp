#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/base/time.hpp"
#include "tests/support/pseudo_terminal.hpp"
#include "tests/support/rplidar/frame_maker.hpp"
#include "tests/support/rplidar/line_noise.hpp"

namespace lifeline::test {

/// The modes that an A3 lists, and a dense one as newer devices have it.
[[nodiscard]] std::vector<EmulatedMode> a3_modes();

struct EmulatorOptions {
  std::vector<EmulatedMode> modes = a3_modes();
  World world = room(3.0, 2.0);
  int baud = 256'000;  ///< at any other rate both sides read garbage
  double rotor_Hz = 10.0;
  bool real_time = true;  ///< else as fast as the other side reads
  bool has_motor_board = true;
  bool keep_frames = false;  ///< for frames()
  std::uint64_t seed = 1;    ///< of the noise
};

/// An RPLIDAR on a pseudo-terminal, in a thread of its own: answers requests, turns its rotor,
/// streams what it measures, and has faults when told to. All functions may be called at any time.
class RplidarEmulator {
 public:
  /// `link`: a name that stays the same when the device is plugged in again; may be empty.
  explicit RplidarEmulator(EmulatorOptions options = {}, std::string link = {});
  ~RplidarEmulator();

  [[nodiscard]] std::string device() const;

  // Faults. They stay until taken back.
  void set_noise(NoiseRates rates);
  void set_silent(bool silent) { silent_ = silent; }
  void set_stalled(bool stalled) { stalled_ = stalled; }
  /// Status 0 good, 1 warning, 2 error; an error is what a reset does not mend.
  void set_health(std::uint8_t status, std::uint16_t code);
  /// The next reset makes the health good.
  void heal_at_reset() { heals_ = true; }
  void unplug();
  void plug_in();

  // What it saw and did.
  [[nodiscard]] bool scanning() const { return scanning_; }
  [[nodiscard]] int motor_pwm() const { return pwm_; }
  [[nodiscard]] int resets() const { return resets_; }
  [[nodiscard]] int scans_started() const { return scans_; }
  [[nodiscard]] std::uint64_t frames_made() const { return frames_made_; }
  /// The frames of the last scan as they went out, before any noise.
  [[nodiscard]] std::vector<EmulatedFrame> frames() const;

 private:
  void run(const std::stop_token& stop);
  void step();
  void receive();
  [[nodiscard]] bool take_request();
  void handle(std::uint8_t command, std::span<const std::uint8_t> payload);
  void answer(std::uint8_t type, std::vector<std::uint8_t> data, bool repeating = false,
              std::size_t length = 0);
  void answer_conf(std::span<const std::uint8_t> payload);
  void begin_scan(std::size_t mode);
  void stream();
  void send(std::span<const std::uint8_t> bytes, bool noisy);

  const EmulatorOptions options_;
  mutable std::mutex mutex_;  ///< of the terminal, the noise and the frames
  PseudoTerminal terminal_;
  LineNoise noise_;
  NoiseRates rates_;
  std::vector<std::uint8_t> inbox_, outbox_;
  std::optional<FrameMaker> maker_;
  std::optional<EmulatedFrame> pending_;  ///< made, and not due yet
  std::size_t mode_ = 0;
  SteadyTime scan_began_{};
  double angle_deg_ = 0.0;
  std::vector<EmulatedFrame> frames_;
  std::uint8_t health_status_ = 0;
  std::uint16_t health_code_ = 0;
  std::atomic<bool> silent_{false}, stalled_{false}, heals_{false}, scanning_{false};
  std::atomic<int> pwm_{0}, resets_{0}, scans_{0};
  std::atomic<std::uint64_t> frames_made_{0};
  std::jthread thread_;  // last: it uses all the others
};

}  // namespace lifeline::test
