#pragma once
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/plant_state.hpp"

#ifndef MOREPRO_GOLDEN_DIR
#error "define MOREPRO_GOLDEN_DIR: the folder tests/golden"
#endif

namespace morepro::test {

/// A golden file that is missing fails the test that wants it.
inline std::ifstream open_golden(const std::string& name) {
  std::ifstream file(std::string(MOREPRO_GOLDEN_DIR) + "/" + name);
  if (!file) throw std::runtime_error("golden file not found: " + name);
  return file;
}

inline nlohmann::json golden_json(const std::string& name) {
  return nlohmann::json::parse(open_golden(name));
}

inline std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

/// One row of a golden table, by column name.
class GoldenRow {
 public:
  GoldenRow(const std::vector<std::string>& header, const std::vector<std::string>& fields) {
    for (std::size_t i = 0; i < header.size(); ++i) field_[header[i]] = fields.at(i);
  }
  const std::string& text(const std::string& column) const { return field_.at(column); }
  double operator[](const std::string& column) const { return std::stod(field_.at(column)); }

 private:
  std::map<std::string, std::string> field_;
};

inline std::vector<GoldenRow> golden_csv(const std::string& name) {
  std::ifstream file = open_golden(name);
  std::vector<GoldenRow> rows;
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> header = split(line);
  while (std::getline(file, line)) rows.emplace_back(header, split(line));
  return rows;
}

/// The machine that a golden file calls THESIS or REF.
inline MachineParameters golden_machine(const std::string& set) {
  if (set == "THESIS") return thesis_machine();
  if (set == "REF") return reference_machine();
  throw std::runtime_error("unknown golden set: " + set);
}

/// The state and input that every golden row of the plant starts with.
template <class Real>
PlantState<Real> golden_state(const GoldenRow& row) {
  return {static_cast<Real>(row["w"]), static_cast<Real>(row["v"]), static_cast<Real>(row["i"])};
}

template <class Real>
PlantInput<Real> golden_input(const GoldenRow& row) {
  return {.armature_voltage_v = static_cast<Real>(row["V"]),
          .feed_force_n = static_cast<Real>(row["F1"]),
          .contact = static_cast<Real>(row["Fc"]),
          .engagement = static_cast<Real>(golden_machine(row.text("set")).feed.engagement),
          .chip_load_mm = static_cast<Real>(row["CL"]),
          .tool_temperature_degc = static_cast<Real>(row["T"])};
}

/// A matrix of a golden file, by rows.
template <class Matrix>
Matrix golden_matrix(const nlohmann::json& values) {
  Matrix matrix;
  for (Eigen::Index k = 0; k < matrix.size(); ++k)
    matrix(k / matrix.cols(), k % matrix.cols()) = values.at(static_cast<std::size_t>(k)).get<double>();
  return matrix;
}

/// Runs the golden steps of one type of filter.
template <class Run>
void for_every_golden_step(const char* type, Run run) {
  int count = 0;
  for (const nlohmann::json& step : golden_json("ekf_steps.json")) {
    if (step["type"] != type) continue;
    SCOPED_TRACE(step["set"].get<std::string>() + " " + std::to_string(count++));
    run(step);
  }
  EXPECT_EQ(count, 8);
}

/// |value - expected| / |expected|; absolute where expected is 0.
inline double relative_error(double value, double expected) {
  return std::abs(value - expected) / (expected == 0.0 ? 1.0 : std::abs(expected));
}

}  // namespace morepro::test
