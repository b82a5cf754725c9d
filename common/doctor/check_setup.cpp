#include "common/doctor/check_setup.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "common/base/terminal.hpp"
#include "common/doctor/check_clock.hpp"
#include "common/doctor/check_network.hpp"
#include "common/doctor/check_ports.hpp"
#include "common/doctor/check_serial.hpp"

namespace lifeline::doctor {
namespace {

Findings check_config(const Setup& setup) {
  const std::string where = setup.config_file ? setup.config_file->string() : "configuration";
  if (setup.config_error) return faults("config", where, *setup.config_error);
  if (!setup.config_file)
    return {ok("config", where, "none given (--config): the defaults of docs/parameters.md")};
  return {ok("config", where, "read, every value within its limits")};
}

std::string in_words(const dds::ProfileFacts& profile) {
  std::string text = profile.udp ? "UDP" : "no UDP";
  if (!profile.interfaces.empty())
    text += fmt::format(" on {}", fmt::join(profile.interfaces, ", "));
  text += profile.shared_memory ? ", shared memory" : ", no shared memory";
  if (profile.multicast_discovery) text += "; finds others by multicast";
  if (!profile.peers.empty()) text += fmt::format("; calls {}", fmt::join(profile.peers, ", "));
  return text;
}

bool stays_on_this_machine(const dds::ProfileFacts& profile) {
  const auto is_loopback = [](const std::string& interface) {
    return interface == "lo" || interface.starts_with("127.");
  };
  return !profile.udp ||
         (!profile.interfaces.empty() && std::ranges::all_of(profile.interfaces, is_loopback));
}

Result<dds::ProfileFacts> read_profile(const Setup& setup) {
  if (!setup.qos_file) return forward_error(setup.qos_file);
  return dds::read_profile_facts(*setup.qos_file);
}

Findings check_dds(const Setup& setup, const dds::ProfileFacts& profile,
                   const std::filesystem::path& root) {
  Findings found{ok("qos", setup.qos_file->string(), in_words(profile))};
  if (const auto interfaces = read_interfaces()) {
    append(found, check_interfaces(profile, *interfaces));
    append(found, check_counted_interface(setup.counted_interface, *interfaces));
  } else {
    append(found, faults("interface", "network interfaces", interfaces.error()));
  }
  append(found, check_socket_buffers(profile, root));
  append(found, check_shared_memory(profile, root));
  append(found, check_domain(setup.domain, profile, root));
  return found;
}

Findings check_tcp_ports(const Setup& setup) {
  Findings found;
  for (const Setup::TcpPort& wish : setup.tcp_ports) {
    Findings judged = check_tcp_port(wish.check, wish.address, wish.port, wish.advice);
    for (Finding& finding : judged) {
      if (!wish.is_needed && finding.level == Level::fault) finding.level = Level::warning;
    }
    append(found, std::move(judged));
  }
  return found;
}

Findings check_sensors(const Setup& setup, const std::filesystem::path& root) {
  Findings found;
  for (const Setup::SerialDevice& wish : setup.serial_devices)
    append(found, check_serial_port(wish.device, wish.baud, root));
  if (setup.wants_sensors && setup.serial_devices.empty()) found = check_plugged_in(root);
  return found;
}

// What was written here before: the program itself, too.
Findings check_time(const Setup& setup, bool alone, const std::filesystem::path& root) {
  std::vector<std::filesystem::path> places{root / "proc/self/exe"};
  if (setup.config_file) places.push_back(*setup.config_file);
  for (const Setup::Folder& folder : setup.folders) places.emplace_back(folder.path);
  return check_clock(read_clock(), newest_of(places), alone);
}

Findings check_folders(const Setup& setup) {
  Findings found;
  for (const Setup::Folder& folder : setup.folders) {
    if (folder.path == "off") {
      found.push_back(ok(folder.check, folder.setting, "off, nothing is kept on disk"));
    } else {
      append(found, check_folder(folder.check, folder.path, folder.setting, folder.need));
    }
  }
  return found;
}

}  // namespace

Findings check_setup(const Setup& setup, const std::filesystem::path& root) {
  Findings found = check_config(setup);
  const auto profile = read_profile(setup);
  append(found, profile ? check_dds(setup, *profile, root)
                        : faults("qos", setup.qos_file ? setup.qos_file->string() : "QoS profiles",
                                 profile.error()));
  append(found, check_tcp_ports(setup));
  append(found, check_sensors(setup, root));
  append(found, check_folders(setup));
  append(found, check_time(setup, profile && stays_on_this_machine(*profile), root));
  return found;
}

int print_findings(const Findings& findings, bool json) {
  fmt::print("{}", json ? to_json(findings) : to_text(findings, wants_colour(STDOUT_FILENO)));
  std::fflush(stdout);
  return exit_status(findings);
}

}  // namespace lifeline::doctor
