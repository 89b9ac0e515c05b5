#pragma once
#include <algorithm>
#include <cstdint>
#include <numbers>

#include "lib/math/elementary.hpp"

namespace morepro {

/// What is wrong with a cut's description.
enum class CutError : std::uint8_t {
  kNone = 0,
  kPressure = 1,   ///< Kt is not above 0, or a ratio is below 0
  kGeometry = 2,   ///< diameter, depth or chip load is not above 0
  kTeeth = 3,      ///< the number of teeth is not 1 .. kMostTeeth
  kHelix = 4,      ///< the helix is not in [0, 85 degrees]
  kImmersion = 5,  ///< not 0 <= entry < exit <= half a turn
  kRake = 6,       ///< the friction angle, atan(Kr) plus the rake, is not between 0 and 85 degrees
};

/// One milling cut (thesis 4.2.1). The thesis gives no values: these are of a 10 mm cutter in steel, full
/// slot.
struct MillingCut {
  static constexpr int kMostTeeth = 32;

  double pressure_n_mm2 = 1800.0;  ///< [Kt] tangential force per area of the chip
  double radial_ratio = 0.35;      ///< [Kr] radial over tangential force
  double axial_ratio = 0.20;       ///< [Ka] axial over tangential force
  double chip_load_mm = 0.05;      ///< [fz] feed per tooth
  double depth_mm = 1.0;           ///< [ap] axial depth
  double diameter_mm = 10.0;
  double helix_rad = std::numbers::pi / 6.0;
  int teeth = 4;
  double entry_rad = 0.0;                     ///< immersion angle where a tooth begins to cut
  double exit_rad = std::numbers::pi;         ///< and where it ends
  double rake_rad = std::numbers::pi / 30.0;  ///< [gamma]

  [[nodiscard]] constexpr CutError validate() const {
    constexpr double kSteepest = 85.0 / 180.0 * std::numbers::pi;
    if (!(pressure_n_mm2 > 0.0 && pressure_n_mm2 < 1.0e9)) return CutError::kPressure;
    if (!(radial_ratio >= 0.0 && radial_ratio < 1.0e3 && axial_ratio >= 0.0 && axial_ratio < 1.0e3))
      return CutError::kPressure;
    if (!is_length(chip_load_mm) || !is_length(depth_mm) || !is_length(diameter_mm))
      return CutError::kGeometry;
    if (teeth < 1 || teeth > kMostTeeth) return CutError::kTeeth;
    if (!(helix_rad >= 0.0 && helix_rad <= kSteepest)) return CutError::kHelix;
    if (!(entry_rad >= 0.0 && entry_rad < exit_rad && exit_rad <= std::numbers::pi))
      return CutError::kImmersion;
    const double angle = double{math::atan2(static_cast<float>(radial_ratio), 1.0F)} + rake_rad;
    return angle > 0.0 && angle < kSteepest ? CutError::kNone : CutError::kRake;
  }

 private:
  static constexpr bool is_length(double x_mm) { return x_mm > 0.0 && x_mm < 1.0e4; }
};

/// Force of the cut on the tool, and its torque on the spindle.
template <class Real>
struct CuttingForce {
  Real x_n = 0;  ///< along the feed
  Real y_n = 0;  ///< across it
  Real axial_n = 0;
  Real tangential_n = 0;  ///< sum over the teeth
  Real torque_nm = 0;
};

/// A friction coefficient that may not exist.
template <class Real>
struct FrictionRatio {
  Real value = 0;
  bool is_defined = true;  ///< false: no tooth cuts, or the formula has its pole there
};

/// Cutting forces per tooth and slice of the cutter's depth: dFt = Kt h dz, dFr = Kr dFt, dFa = Ka dFt, with
/// the chip h = fz sin(phi_j) while tooth j is in the cut and its immersion angle phi_j = phi + 2 pi j/N - 2
/// tan(helix) z/D. (The thesis calls phi the shear angle and the three forces tangential, axial, radial.)
/// Fixed memory, teeth x slices evaluations; finite for every finite angle. The sum is taken in one order on
/// every machine.
template <class Real>
class CuttingForceModel {
 public:
  static constexpr int kSlices = 50;

  /// The cut must have been validated.
  explicit CuttingForceModel(const MillingCut& cut)
      : teeth_(cut.teeth),
        radial_ratio_(Real(cut.radial_ratio)),
        axial_ratio_(Real(cut.axial_ratio)),
        slice_n_(Real(cut.pressure_n_mm2 * cut.chip_load_mm * cut.depth_mm / kSlices)),
        radius_m_(Real(cut.diameter_mm / 2000.0)),
        entry_(Real(cut.entry_rad)),
        exit_(Real(cut.exit_rad)),
        rake_(Real(cut.rake_rad)) {
    const auto helix = math::sin_cos(Real(cut.helix_rad));
    lag_ = Real(2.0 * cut.depth_mm / cut.diameter_mm / kSlices) * helix.sin / helix.cos;
  }

  /// Sum over teeth and slices; the angle is that of tooth 0 at the tip. Zero forces at an angle that is no
  /// number.
  CuttingForce<Real> at(Real angle_rad) const {
    CuttingForce<Real> sum;
    for (int tooth = 0; tooth < teeth_; ++tooth) {
      const Real tip = angle_rad + kTurn * static_cast<Real>(tooth) / static_cast<Real>(teeth_);
      for (int slice = 0; slice < kSlices; ++slice)
        add_slice(tip - lag_ * (static_cast<Real>(slice) + Real(0.5)), sum);
    }
    sum.axial_n = axial_ratio_ * sum.tangential_n;
    sum.torque_nm = sum.tangential_n * radius_m_;
    return sum;
  }

  /// mu = tan(atan(dFr/dFt) + gamma): the ratio of friction to normal force on the rake face. The same at
  /// every angle and slice, because dFr/dFt = Kr.
  Real friction_coefficient() const { return tangent(math::atan2(radial_ratio_, Real(1)) + rake_).value; }

  /// As printed in the thesis, with dFy/dFx instead of dFr/dFt, for one tooth at an angle: tan(phi - atan(Kr)
  /// + gamma), which only turns the frame: it depends on neither force nor chip, and has a pole.
  FrictionRatio<Real> literal_coefficient(Real angle_rad) const {
    if (!is_cutting(wrapped(angle_rad))) return {Real(0), false};
    return tangent(angle_rad - math::atan2(radial_ratio_, Real(1)) + rake_);
  }

 private:
  static constexpr Real kTurn = Real(2.0 * std::numbers::pi);
  static constexpr Real kSmallestCosine = Real(1.0e-6);

  static FrictionRatio<Real> tangent(Real angle_rad) {
    const auto [s, c] = math::sin_cos(angle_rad);
    if (!(math::abs(c) > kSmallestCosine)) return {Real(0), false};
    return {s / c, true};
  }

  /// In [0, 2 pi) up to a rounding; angles of many thousand turns lose digits before this.
  static Real wrapped(Real angle_rad) {
    if (angle_rad >= Real(0) && angle_rad < kTurn) return angle_rad;
    const auto [s, c] = math::sin_cos(angle_rad);
    const Real angle = math::atan2(s, c);
    return angle < Real(0) ? angle + kTurn : angle;
  }

  bool is_cutting(Real immersion_rad) const { return immersion_rad > entry_ && immersion_rad < exit_; }

  void add_slice(Real angle_rad, CuttingForce<Real>& sum) const {
    const Real immersion = wrapped(angle_rad);
    if (!is_cutting(immersion)) return;
    const auto [s, c] = math::sin_cos(immersion);
    const Real tangential = slice_n_ * s;
    const Real radial = radial_ratio_ * tangential;
    sum.x_n += tangential * c + radial * s;
    sum.y_n += tangential * s - radial * c;
    sum.tangential_n += tangential;
  }

  int teeth_;
  Real radial_ratio_;
  Real axial_ratio_;
  Real slice_n_;
  Real radius_m_;
  Real entry_;
  Real exit_;
  Real rake_;
  Real lag_{};
};

}  // namespace morepro
