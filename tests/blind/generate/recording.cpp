#include "recording.hpp"

#include <charconv>
#include <fstream>
#include <stdexcept>

namespace blind {
namespace {

void add(std::string& text, double value, int digits) {
  char buffer[40];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr;
  text.append(buffer, end);
  text += ',';
}

void add_row(std::string& text, const Row& row, bool has_position, bool has_angle) {
  add(text, row.time_s, 9);
  for (double value : {row.in.voltage_v, row.in.force_n, row.in.contact, row.in.engagement,
                       row.in.chip_load_mm, row.seen.w, row.seen.v, row.seen.i})
    add(text, value, 7);
  add(text, row.tool_c, 5);
  add(text, row.winding_c, 5);
  if (has_position) add(text, row.seen.x, 7);
  if (has_angle) add(text, row.seen.angle, 9);
  text.back() = '\n';
}

}  // namespace

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << text) || !file.flush()) throw std::runtime_error("cannot write " + path);
}

void write_recording(const std::string& path, const Run& run, bool has_position, bool has_angle) {
  std::string text =
      "time_s,armature_voltage_v,feed_force_n,contact,engagement,chip_load_mm,spindle_speed_rad_s,"
      "feed_speed_m_s,armature_current_a,tool_temperature_degc,winding_temperature_degc";
  if (has_position) text += ",feed_position_m";
  if (has_angle) text += ",spindle_angle_rad";
  text += '\n';
  text.reserve(run.rows.size() * 130);
  for (const Row& row : run.rows)
    if (!row.is_missing) add_row(text, row, has_position, has_angle);
  write_text(path, text);
}

}  // namespace blind
