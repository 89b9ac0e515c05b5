#pragma once
#include <optional>
#include <string>
#include <vector>

namespace morepro::host::thesis {

/// From a lowest to a highest value; both the same for a single one.
struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// The range of values, which must not be empty.
Range range_of(const std::vector<double>& values);

/// One quantity of a figure: what the thesis prints beside what the library computes.
struct Comparison {
  std::string quantity;
  std::string unit;
  std::optional<Range> printed;  ///< nothing: the thesis states no value
  std::optional<Range> ours;     ///< nothing: undetermined, see `note`
  std::string note = {};         ///< instead of a difference
};

/// What differs, in a few characters: in percent or as a factor, by the ends of a range, or the note.
std::string difference_of(const Comparison& comparison);

struct Curve {
  std::string label;
  std::vector<double> y;  ///< as many as the chart has x; NaN where there is none
  bool is_dashed = false;
};

struct Chart {
  std::string title;
  std::string unit;    ///< of y
  std::string x_name;  ///< with its unit
  std::vector<double> x;
  std::vector<Curve> curves;
};

/// One figure of the thesis, recomputed.
struct Figure {
  int number = 0;
  std::string section;
  std::string title;
  std::vector<Chart> charts = {};
  std::vector<Comparison> comparisons = {};
  std::string remark = {};  ///< where and why the two differ, or what cannot be compared
};

/// Figures 13 .. 17: a path, what the tool does along it, and the joints by CLIK.
std::vector<Figure> kinematic_figures();
/// Figures 21 .. 26: the friction models.
std::vector<Figure> friction_figures();
/// Figures 28 .. 33: the seven parameters over time.
std::vector<Figure> identification_figures();
/// All of them, in the order of their numbers.
std::vector<Figure> all_figures();

}  // namespace morepro::host::thesis
