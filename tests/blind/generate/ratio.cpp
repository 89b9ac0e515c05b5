#include "ratio.hpp"

#include <cmath>

namespace blind {
namespace {

Eigen::VectorXd refitted_residuals(const BalanceRows& rows, const GroupPower& floor) {
  Eigen::VectorXd weight(rows.y.size());
  for (Eigen::Index r = 0; r < weight.size(); ++r)
    weight(r) = 1.0 / std::sqrt(floor[static_cast<std::size_t>(rows.group[static_cast<std::size_t>(r)])]);
  const Eigen::MatrixXd scaled = weight.asDiagonal() * rows.x;
  const Eigen::VectorXd norms = scaled.colwise().norm().cwiseMax(1e-300);
  const Eigen::MatrixXd unit = scaled * norms.cwiseInverse().asDiagonal();
  const Eigen::VectorXd fit = unit.colPivHouseholderQr().solve(weight.cwiseProduct(rows.y));
  return rows.y - rows.x * norms.cwiseInverse().cwiseProduct(fit);
}

/// Noise of the sampled state and of the integrated regressors, in the units of the balance.
struct RowNoise {
  double level = 0.0, integral = 0.0;
};

double row_power(const std::array<double, kWindow>& phi, const RowNoise& noise, double sample_s) {
  double steps = phi[0] * phi[0] + phi[kWindow - 1] * phi[kWindow - 1], sums = 0.0;
  for (int k = 0; k + 1 < kWindow; ++k) {
    steps += std::pow(phi[k] - phi[k + 1], 2);
    sums += std::pow(0.5 * sample_s * (phi[k] + phi[k + 1]), 2);
  }
  return noise.level * noise.level * steps + noise.integral * noise.integral * sums;
}

double colored_power(const std::array<double, kWindow>& phi, int band, double correlation_s,
                     double sample_s) {
  double sum = 0.0;
  for (double value : phi) sum += value * value;
  const double rate = 6.283185307 * 3.0 * band / (kWindow * sample_s);
  return sample_s * sum * 2.0 * correlation_s / (1.0 + std::pow(rate * correlation_s, 2));
}

/// Standard deviation of a colored acceleration whose mean share of the sensors' row power is `share`.
double matching_sigma(const RowNoise& noise, double share, double correlation_s, double sample_s) {
  const TestFunctions& f = test_functions();
  double mean = 0.0;
  for (std::size_t j = 0; j < f.phi.size(); ++j)
    mean += colored_power(f.phi[j], f.band[j], correlation_s, sample_s) /
            row_power(f.phi[j], noise, sample_s) / 9.0;
  return std::sqrt(share / mean);
}

double deviation(const Sensor& sensor) {
  return std::sqrt(sensor.noise * sensor.noise + sensor.lsb * sensor.lsb / 12.0);
}

RowNoise row_noise(const Machine& m, Balance balance) {
  const double speed = deviation(m.speed), current = deviation(m.current), feed = deviation(m.feed);
  if (balance == kSpindleTorque) return {speed, current * m.torque_constant / m.inertia};
  if (balance == kFeedForce) return {feed, feed * m.feed_viscous / m.mass};
  return {current, std::hypot(current * m.resistance, speed * m.back_emf_constant) / m.inductance};
}

}  // namespace

GroupPower refitted_power(const BalanceRows& rows, const GroupPower& floor) {
  const Eigen::VectorXd residual = refitted_residuals(rows, floor);
  GroupPower power{}, count{};
  for (Eigen::Index r = 0; r < residual.size(); ++r) {
    const auto group = static_cast<std::size_t>(rows.group[static_cast<std::size_t>(r)]);
    power[group] += residual(r) * residual(r);
    count[group] += 1.0;
  }
  for (std::size_t g = 0; g < power.size(); ++g) power[g] = count[g] > 0.0 ? power[g] / count[g] : 1.0;
  return power;
}

Columns columns_of(const Run& run) {
  Columns c;
  c.sample_s = run.sample_s;
  for (const Row& row : run.rows) {
    c.voltage.push_back(row.in.voltage_v);
    c.force.push_back(row.in.force_n);
    c.contact.push_back(row.in.contact);
    c.engagement.push_back(row.in.engagement);
    c.chip_load.push_back(row.in.chip_load_mm);
    c.w.push_back(row.seen.w);
    c.v.push_back(row.seen.v);
    c.i.push_back(row.seen.i);
    c.tool_c.push_back(row.tool_c);
  }
  return c;
}

Floor floor_of(const Columns& columns, const Machine& nominal) {
  Floor floor;
  for (int b = 0; b < kBalances; ++b) {
    const BalanceRows rows =
        windowed(nominal_columns(columns, nominal, static_cast<Balance>(b)), columns.contact);
    GroupPower& power = floor.power[static_cast<std::size_t>(b)];
    power.fill(1.0);
    for (int pass = 0; pass < 3; ++pass) power = refitted_power(rows, power);
  }
  return floor;
}

std::array<double, kBalances> residual_ratios(const Columns& columns, const Machine& nominal,
                                              const Floor& floor) {
  std::array<double, kBalances> ratios{};
  for (std::size_t b = 0; b < ratios.size(); ++b) {
    const BalanceRows rows =
        windowed(nominal_columns(columns, nominal, static_cast<Balance>(b)), columns.contact);
    const Eigen::VectorXd residual = refitted_residuals(rows, floor.power[b]);
    for (Eigen::Index r = 0; r < residual.size(); ++r)
      ratios[b] += residual(r) * residual(r) /
                   floor.power[b][static_cast<std::size_t>(rows.group[static_cast<std::size_t>(r)])];
    ratios[b] /= static_cast<double>(std::max<Eigen::Index>(1, residual.size()));
  }
  return ratios;
}

GroupPower sensor_floor(const Machine& m, Balance balance, double sample_s) {
  const RowNoise noise = row_noise(m, balance);
  const TestFunctions& f = test_functions();
  GroupPower power{}, count{};
  for (std::size_t j = 0; j < f.phi.size(); ++j)
    for (const int state : {0, 5}) {
      const auto group = static_cast<std::size_t>(f.band[j] + state);
      power[group] += row_power(f.phi[j], noise, sample_s);
      count[group] += 1.0;
    }
  for (std::size_t g = 0; g < power.size(); ++g) power[g] /= count[g];
  return power;
}

ProcessNoise process_noise_for(const Machine& m, double share, double correlation_s, double contact_gain,
                               double sample_s) {
  ProcessNoise n;
  n.torque_nm = m.inertia * matching_sigma(row_noise(m, kSpindleTorque), share, correlation_s, sample_s);
  n.force_n = m.mass * matching_sigma(row_noise(m, kFeedForce), share, correlation_s, sample_s);
  n.voltage_v = m.inductance * matching_sigma(row_noise(m, kArmatureVoltage), share, correlation_s, sample_s);
  n.correlation_s = correlation_s;
  n.contact_gain = contact_gain;
  return n;
}

}  // namespace blind
