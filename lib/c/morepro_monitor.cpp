#include "lib/c/morepro_monitor.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>

#include "lib/c/configuration_conversion.hpp"
#include "lib/c/health_conversion.hpp"
#include "lib/monitor/monitor.hpp"

namespace {

using morepro::BoardMonitor;

static_assert(MOREPRO_HYPOTHESES == morepro::kMonitorHypotheses);
static_assert(sizeof(BoardMonitor) <= MOREPRO_MONITOR_BYTES, "MOREPRO_MONITOR_BYTES is too small");
static_assert(MOREPRO_MONITOR_BYTES <= sizeof(BoardMonitor) + 512, "MOREPRO_MONITOR_BYTES wastes memory");
static_assert(alignof(BoardMonitor) <= alignof(decltype(morepro_monitor::private_memory)));
static_assert(std::is_trivially_copyable_v<BoardMonitor>, "a copy of a morepro_monitor is a monitor");

/// What memory that nobody has made a monitor does not hold: neither zeros nor a pattern of a debugger.
constexpr std::uint64_t kMark = 0x6d6f7265'70726f31U;

bool is_misaligned(const morepro_monitor* monitor) {
  return reinterpret_cast<std::uintptr_t>(monitor) % alignof(morepro_monitor) != 0;
}

morepro_error check(const morepro_monitor* monitor) {
  if (monitor == nullptr) return MOREPRO_ERROR_NULL_POINTER;
  if (is_misaligned(monitor)) return MOREPRO_ERROR_MISALIGNED;
  return monitor->private_mark == kMark ? MOREPRO_OK : MOREPRO_ERROR_NOT_CREATED;
}

BoardMonitor& inside(morepro_monitor& monitor) {
  return *std::launder(reinterpret_cast<BoardMonitor*>(monitor.private_memory.bytes));
}

const BoardMonitor& inside(const morepro_monitor& monitor) {
  return *std::launder(reinterpret_cast<const BoardMonitor*>(monitor.private_memory.bytes));
}

morepro::SensorFrame to_cpp(const morepro_frame& frame) {
  morepro::SensorFrame to{.sequence = frame.sequence, .time_us = frame.time_us, .present = frame.present};
  for (std::size_t i = 0; i < morepro::kChannelCount; ++i) to.value[i] = frame.value[i];
  return to;
}

void write(const BoardMonitor& monitor, morepro_health& health) {
  morepro::c::copy_health(monitor.health(), health);
  for (std::size_t i = 0; i < MOREPRO_HYPOTHESES; ++i) health.probability[i] = monitor.probability(i);
}

morepro_error refuse(morepro_error error, const char* key, const char** refused_key) {
  if (refused_key != nullptr) *refused_key = key;
  return error;
}

}  // namespace

morepro_error morepro_monitor_create(morepro_monitor* monitor, const morepro_configuration* configuration,
                                     const char** refused_key) {
  if (monitor == nullptr || configuration == nullptr)
    return refuse(MOREPRO_ERROR_NULL_POINTER, "", refused_key);
  if (is_misaligned(monitor)) return refuse(MOREPRO_ERROR_MISALIGNED, "", refused_key);
  if (!morepro::c::is_known_form(configuration->machine))
    return refuse(MOREPRO_ERROR_UNKNOWN_CHOICE, "contact.form", refused_key);
  if (configuration->rule > MOREPRO_RULE_THESIS)
    return refuse(MOREPRO_ERROR_UNKNOWN_CHOICE, "rule", refused_key);
  const morepro::MonitorConfiguration wanted = morepro::c::to_cpp(*configuration);
  const auto result = morepro::check(wanted, MOREPRO_HYPOTHESES);
  if (!result.ok()) return refuse(static_cast<morepro_error>(result.error), result.key.data(), refused_key);
  auto* made = ::new (monitor->private_memory.bytes) BoardMonitor;
  (void)made->configure(wanted);  // checked above
  monitor->private_mark = kMark;
  return refuse(MOREPRO_OK, "", refused_key);
}

morepro_error morepro_monitor_step(morepro_monitor* monitor, const morepro_frame* frame,
                                   morepro_health* health) {
  if (frame == nullptr || health == nullptr) return MOREPRO_ERROR_NULL_POINTER;
  if (const morepro_error error = check(monitor); error != MOREPRO_OK) return error;
  (void)inside(*monitor).step(to_cpp(*frame));
  write(inside(*monitor), *health);
  return MOREPRO_OK;
}

morepro_error morepro_monitor_health(const morepro_monitor* monitor, morepro_health* health) {
  if (health == nullptr) return MOREPRO_ERROR_NULL_POINTER;
  if (const morepro_error error = check(monitor); error != MOREPRO_OK) return error;
  write(inside(*monitor), *health);
  return MOREPRO_OK;
}

morepro_error morepro_monitor_reset(morepro_monitor* monitor) {
  const morepro_error error = check(monitor);
  if (error == MOREPRO_OK) inside(*monitor).reset();
  return error;
}

morepro_error morepro_monitor_tool_changed(morepro_monitor* monitor) {
  const morepro_error error = check(monitor);
  if (error == MOREPRO_OK) inside(*monitor).tool_changed();
  return error;
}

morepro_error morepro_monitor_count_corrupt(morepro_monitor* monitor) {
  const morepro_error error = check(monitor);
  if (error == MOREPRO_OK) inside(*monitor).count_corrupt();
  return error;
}
