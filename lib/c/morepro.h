#ifndef MOREPRO_H
#define MOREPRO_H
/// The monitor of a machine tool's spindle and feed axis, for programs in C99; start with morepro_monitor.h.
/// No header includes anything but <stdint.h>.
#include "morepro_configuration.h"
#include "morepro_error.h"
#include "morepro_frame.h"
#include "morepro_health.h"
#include "morepro_machine.h"
#include "morepro_monitor.h"
#include "morepro_plant.h"

#endif
