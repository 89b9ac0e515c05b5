#include "recording_file.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace blind {
namespace {

using Table = std::map<std::string, std::vector<double>>;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::stringstream stream(line);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

Table read_table(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error("cannot read " + path);
  Table table;
  std::vector<std::vector<double>*> columns;
  for (const std::string& name : split(line)) columns.push_back(&table[name]);
  while (std::getline(file, line)) {
    const char* place = line.c_str();
    for (auto* column : columns) {
      char* end = nullptr;
      column->push_back(std::strtod(place, &end));
      place = *end == ',' ? end + 1 : end;
    }
  }
  return table;
}

std::vector<double> integral(const std::vector<double>& rate, double step) {
  std::vector<double> sum(rate.size(), 0.0);
  for (std::size_t k = 1; k < rate.size(); ++k) sum[k] = sum[k - 1] + 0.5 * step * (rate[k] + rate[k - 1]);
  return sum;
}

std::map<std::string, std::string> read_settings(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::map<std::string, std::string> settings;
  std::string line, table;
  while (std::getline(file, line)) {
    const auto equals = line.find(" = ");
    if (!line.empty() && line[0] == '[')
      table = line.substr(1, line.find(']') - 1) + ".";
    else if (equals != std::string::npos)
      settings[table + line.substr(0, equals)] = line.substr(equals + 3);
  }
  return settings;
}

}  // namespace

Measured read_recording(const std::string& path) {
  Table t = read_table(path);
  Measured m;
  m.columns = {t["armature_voltage_v"], t["feed_force_n"],       t["contact"],
               t["engagement"],         t["chip_load_mm"],       t["spindle_speed_rad_s"],
               t["feed_speed_m_s"],     t["armature_current_a"], t["tool_temperature_degc"]};
  m.time_s = t["time_s"];
  if (m.time_s.size() < 2 * kWindow) throw std::runtime_error(path + " is too short");
  m.columns.sample_s = (m.time_s.back() - m.time_s.front()) / static_cast<double>(m.time_s.size() - 1);
  m.winding_c = t["winding_temperature_degc"];
  m.x = t["feed_position_m"];
  if (m.x.empty()) m.x = integral(m.columns.v, m.columns.sample_s);
  m.cut_s = integral(m.columns.contact, m.columns.sample_s);
  return m;
}

Machine read_machine(const std::string& path) {
  const auto settings = read_settings(path);
  auto number = [&](const std::string& key) {
    const auto found = settings.find(key);
    return found == settings.end() ? 0.0 : std::strtod(found->second.c_str(), nullptr);
  };
  auto sensor = [&](const std::string& column) {
    return Sensor{number("sensors." + column + ".noise"), number("sensors." + column + ".lsb")};
  };
  Machine m;
  m.is_thesis = settings.at("contact.form") == "\"thesis\"";
  m.torque_constant = number("spindle.torque_constant_nm_a");
  m.back_emf_constant = number("spindle.back_emf_constant_vs_rad");
  m.resistance = number("spindle.resistance_ohm");
  m.inductance = number("spindle.inductance_h");
  m.inertia = number("spindle.inertia_kgm2");
  m.viscous = number("spindle.viscous_friction_nms_rad");
  m.mass = number("feed.mass_kg");
  m.contact_force = number("feed.contact_force_n");
  m.contact_offset = number("feed.contact_offset_n");
  m.feed_viscous = number("feed.viscous_friction_ns_m");
  m.screw_pitch = number("feed.screw_pitch_m");
  m.diameter_mm = number("tool.diameter_mm");
  m.teeth = number("tool.teeth");
  m.viscous_gain = number("contact.viscous_gain_nms");
  m.edge_force = number("contact.edge_force_n");
  m.chip_force = number("contact.chip_force_n_mm");
  m.radius = number("contact.radius_m");
  m.speed_scale = number("contact.speed_scale_rad_s");
  m.speed = sensor("spindle_speed_rad_s");
  m.feed = sensor("feed_speed_m_s");
  m.current = sensor("armature_current_a");
  return m;
}

}  // namespace blind
