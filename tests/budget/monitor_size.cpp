#include "lib/monitor/monitor.hpp"

/// Never linked: its symbol's size is the monitor's.
extern "C" {
extern char morepro_monitor[sizeof(morepro::BoardMonitor)];
char morepro_monitor[sizeof(morepro::BoardMonitor)];
}
