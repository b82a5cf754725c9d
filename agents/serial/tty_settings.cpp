#include "agents/serial/tty_settings.hpp"

#include <cerrno>

#include <asm/termbits.h>
#include <linux/serial.h>
#include <sys/ioctl.h>

namespace lifeline::serial {

int make_raw(int descriptor, int baud) {
  struct termios2 settings {};
  if (::ioctl(descriptor, TCGETS2, &settings) != 0) return errno;
  settings.c_iflag = 0;
  settings.c_oflag = 0;
  settings.c_lflag = 0;
  settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | (BOTHER << IBSHIFT);
  settings.c_ispeed = static_cast<speed_t>(baud);
  settings.c_ospeed = static_cast<speed_t>(baud);
  // With VMIN = 0 an idle line and a hung-up one would read alike: both 0 bytes.
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  return ::ioctl(descriptor, TCSETS2, &settings) == 0 ? 0 : errno;
}

int actual_baud(int descriptor) {
  struct termios2 settings {};
  return ::ioctl(descriptor, TCGETS2, &settings) == 0 ? static_cast<int>(settings.c_ospeed) : 0;
}

void ask_for_low_latency(int descriptor) {
  struct serial_struct serial {};
  if (::ioctl(descriptor, TIOCGSERIAL, &serial) != 0) return;
  serial.flags |= ASYNC_LOW_LATENCY;
  (void)::ioctl(descriptor, TIOCSSERIAL, &serial);
}

void discard_input(int descriptor) {
  (void)::ioctl(descriptor, TCFLSH, TCIFLUSH);
}

}  // namespace lifeline::serial
