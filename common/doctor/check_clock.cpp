#include "common/doctor/check_clock.hpp"

#include <system_error>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/timex.h>

namespace lifeline::doctor {
namespace {

namespace fs = std::filesystem;
const std::string kClockCheck = "clock";
const std::string kWhere = "system clock";
// Files of another machine, or written over the network, may be a little ahead.
constexpr Duration kStepTolerance = std::chrono::seconds(2);
constexpr Duration kWorstError = std::chrono::milliseconds(100);

std::optional<Timestamp> written_at(const fs::path& file) {
  struct stat facts {};
  if (stat(file.c_str(), &facts) != 0) return std::nullopt;
  return Timestamp(std::chrono::seconds(facts.st_mtim.tv_sec) +
                   std::chrono::nanoseconds(facts.st_mtim.tv_nsec));
}

void take(std::optional<Written>& newest, const fs::path& file) {
  const auto at = written_at(file);
  if (at && (!newest || *at > newest->at)) newest = Written{file, *at};
}

std::string utc(Timestamp at) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(at.time_since_epoch());
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time_t{seconds.count()}));
}

Finding judge_synchronisation(const ClockState& clock, bool one_machine_alone) {
  const std::string advice =
      "sudo apt install chrony; without the internet, helmets take the vehicle's time (`local "
      "stratum 10` in its chrony.conf)";
  if (one_machine_alone && !(clock.is_known && clock.is_synchronised))
    return ok(kClockCheck, kWhere, "not synchronised, which one machine alone does not need");
  if (!clock.is_known)
    return warning(kClockCheck, kWhere, "the kernel does not say whether it is synchronised",
                   advice);
  if (!clock.is_synchronised) {
    return warning(kClockCheck, kWhere,
                   "not synchronised: times of several machines cannot be compared", advice);
  }
  const double error_ms = 1e3 * to_seconds(clock.max_error);
  if (clock.max_error > kWorstError) {
    return warning(kClockCheck, kWhere,
                   fmt::format("synchronised, but off by up to {:.0f} ms", error_ms),
                   "wait for it to settle; `chronyc tracking` shows how far it is");
  }
  return ok(kClockCheck, kWhere, fmt::format("synchronised, off by at most {:.1f} ms", error_ms));
}

}  // namespace

ClockState read_clock() {
  ClockState clock;
  clock.now = SystemClock().wall_now();
  timex kernel{};
  const int state = adjtimex(&kernel);
  clock.is_known = state >= 0;
  clock.is_synchronised = state != TIME_ERROR && (kernel.status & STA_UNSYNC) == 0;
  clock.max_error = std::chrono::microseconds(kernel.maxerror);
  return clock;
}

std::optional<Written> newest_of(const std::vector<fs::path>& places) {
  std::optional<Written> newest;
  for (const fs::path& place : places) {
    take(newest, place);
    std::error_code problem;
    for (fs::directory_iterator entry(place, problem), end; !problem && entry != end;
         entry.increment(problem)) {
      take(newest, entry->path());
    }
  }
  return newest;
}

Findings check_clock(const ClockState& clock, const std::optional<Written>& newest,
                     bool one_machine_alone) {
  Findings found{judge_synchronisation(clock, one_machine_alone)};
  if (newest && newest->at > clock.now + kStepTolerance) {
    found.push_back(fault(kClockCheck, kWhere,
                          fmt::format("shows {}, but {} was written at {}: it was set back",
                                      utc(clock.now), newest->file.string(), utc(newest->at)),
                          "set it (sudo chronyc makestep, or sudo date --set) before the mission"));
  } else {
    found.push_back(ok(kClockCheck, kWhere, fmt::format("shows {}, not set back", utc(clock.now))));
  }
  return found;
}

}  // namespace lifeline::doctor
